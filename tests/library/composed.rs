//! Joints of spatial bodies are made of the primitives: their rows are those of at-point, dot-1,
//! dot-2 and distance, one below the other.

use kin::check::any_spatial as s;
use kin::extend::terms;
use kin::joints::spatial::primitives::{at_point, distance, dot_1, dot_2};
use kin::prelude::*;
use nalgebra::{DMatrix, DVector};

use crate::sample::{Random, columns};

/// Every term of the joint is that of its parts, up to rounding.
fn is_made_of(joint: &dyn Constraint, parts: &[(&dyn Constraint, f64)], random: &mut Random) {
    for _ in 0..20 {
        let q = random.pose(joint);
        let qd = random.numbers(columns(joint));
        let whole = terms(joint, &q, &qd, 0.0);
        let mut c = Vec::new();
        let mut q_d = Vec::new();
        let mut c_q = Vec::new();
        for (part, factor) in parts {
            let own = terms(*part, &q, &qd, 0.0);
            c.extend(own.c.iter().map(|x| factor * x));
            q_d.extend(own.q_d.iter().map(|x| factor * x));
            c_q.extend(own.c_q.row_iter().map(|row| row * *factor));
        }
        let close = |a: &DMatrix<f64>, b: &DMatrix<f64>| (a - b).amax() < 1e-12 * (1.0 + b.amax());
        let column = |v: &[f64]| DMatrix::from_column_slice(v.len(), 1, v);
        let of = |v: &DVector<f64>| column(v.as_slice());
        let kind = joint.facts().kind;
        assert!(
            close(&of(&whole.c), &column(&c)) && close(&whole.c_q, &DMatrix::from_rows(&c_q)),
            "`{kind}`: C or C_q"
        );
        assert!(close(&of(&whole.q_d), &column(&q_d)), "`{kind}`: Q_d");
    }
}

#[test]
fn joints_are_made_of_the_primitives() {
    let mut r = Random::new(11);
    let u_i = r.v3();
    let u_j = r.v3();
    let h_i = r.axis();
    let h_j = r.v3();
    let k = r.axis();
    let point = at_point(s(), s(), u_i, u_j);
    let f = dot_1(s(), s(), h_i.f, h_j);
    let g = dot_1(s(), s(), h_i.g, h_j);
    is_made_of(&spatial::parallel(s(), s(), h_i, h_j), &[(&f, 1.0), (&g, 1.0)], &mut r);
    is_made_of(
        &spatial::revolute(s(), s(), u_i, u_j, h_i, h_j),
        &[(&point, 1.0), (&f, 1.0), (&g, 1.0)],
        &mut r,
    );
    is_made_of(
        &spatial::universal(s(), s(), u_i, u_j, h_i.h, h_j),
        &[(&point, 1.0), (&dot_1(s(), s(), h_i.h, h_j), 1.0)],
        &mut r,
    );
    let height = dot_2(s(), s(), u_i, u_j, h_j);
    is_made_of(
        &spatial::planar(s(), s(), u_i, u_j, h_i, h_j),
        &[(&f, 1.0), (&g, 1.0), (&height, 1.0)],
        &mut r,
    );
    is_made_of(
        &spatial::point_on_line(s(), s(), u_i, u_j, k),
        &[(&dot_2(s(), s(), u_i, u_j, k.f), 1.0), (&dot_2(s(), s(), u_i, u_j, k.g), 1.0)],
        &mut r,
    );
}

/// The same with the bodies of a dot-2 the other way round: f_i · (r_Pi − r_Pj).
#[test]
fn cylindrical_and_links_are_made_of_the_primitives() {
    let mut r = Random::new(12);
    let u_i = r.v3();
    let u_j = r.v3();
    let h_i = r.axis();
    let h_j = r.v3();
    let length = r.length();
    let exchanged = |joint: &dyn Constraint, q: &[f64], qd: &[f64]| {
        let swap = |v: &[f64]| [&v[7..], &v[..7]].concat();
        terms(joint, &swap(q), &swap(qd), 0.0)
    };
    let f = dot_2(s(), s(), u_j, u_i, h_i.f);
    let g = dot_2(s(), s(), u_j, u_i, h_i.g);
    let cylindrical = spatial::cylindrical(s(), s(), u_i, u_j, h_i, h_j);
    let rod = distance(s(), s(), u_i, u_j, length);
    let link = spatial::revolute_spherical(s(), s(), u_i, u_j, h_i.h, length);
    let plane = dot_2(s(), s(), u_j, u_i, h_i.h);
    for _ in 0..20 {
        let q = r.pose(&cylindrical);
        let qd = r.numbers(14);
        let whole = terms(&cylindrical, &q, &qd, 0.0);
        for (row, part) in [(2, &f), (3, &g)] {
            let own = exchanged(part, &q, &qd);
            assert!(
                (whole.c[row] + own.c[0]).abs() < 1e-13
                    && (whole.q_d[row] + own.q_d[0]).abs() < 1e-11,
                "row {row}"
            );
        }
        let whole = terms(&link, &q, &qd, 0.0);
        let own = exchanged(&plane, &q, &qd);
        let rod = terms(&rod, &q, &qd, 0.0);
        assert!(
            (whole.c[0] - own.c[0]).abs() < 1e-13 && (whole.q_d[0] - own.q_d[0]).abs() < 1e-11,
            "{} {}",
            whole.c[0],
            own.c[0]
        );
        assert!((whole.c[1] - rod.c[0]).abs() < 1e-13 && (whole.q_d[1] - rod.q_d[0]).abs() < 1e-11);
    }
}
