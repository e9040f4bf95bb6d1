//! Both routes against the reference samples: every term at random states, computed elsewhere at 60
//! digits (`tests/data/README.md`).

mod data;

use data::model::{BOTH, build};
use data::{array, error, number, numbers, read, rows};
use kin::check::{any_planar, any_spatial};
use kin::extend::dual_route::Equation;
use kin::extend::{Terms, by_dual, dual_terms, terms};
use kin::prelude::*;
use nalgebra::DVector;
use serde_json::Value;

/// Largest error that counts as rounding, relative to 1 + the largest entry of the term.
const TOLERANCE: f64 = 1e-12;

/// The cylindrical joint by four dot products with directions of any kind, which the library has as
/// primitives.
#[constraint]
fn cylindrical_dot(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_j: Vec3,
    v: [Vec3; 2],
) -> [f64; 4] {
    let s = i.point(u_i) - j.point(u_j);
    let h = j.direction(h_j);
    let v1 = i.direction(v[0]);
    let v2 = i.direction(v[1]);
    [v1.dot(h), v2.dot(h), v1.dot(s), v2.dot(s)]
}

/// The lecture's cross products, six rows of rank four.
#[constraint]
fn cylindrical_cross(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Vec3,
    h_j: Vec3,
) -> (Vec3, Vec3) {
    let h = i.direction(h_i);
    (h.cross(j.direction(h_j)), h.cross(i.point(u_i) - j.point(u_j)))
}

#[test]
fn revolute_agrees_with_the_samples() {
    planar("revolute_planar", |p| revolute(any_planar(), any_planar(), vec(p, "ui"), vec(p, "uj")));
}

#[test]
fn prismatic_agrees_with_the_samples() {
    planar("prismatic_planar", |p| {
        prismatic(
            any_planar(),
            any_planar(),
            vec(p, "ui"),
            vec(p, "uj"),
            vec(p, "hi"),
            number(p, "theta0"),
        )
    });
}

#[test]
fn prismatic_blocks_d1_to_d4_agree_with_the_samples() {
    let file = read("prismatic_planar");
    let mut worst = 0.0_f64;
    for sample in samples(&file, 12) {
        let p = &sample["params"];
        let q = numbers(sample, "q");
        let qd = numbers(sample, "qd");
        let joint = prismatic(
            any_planar(),
            any_planar(),
            vec(p, "ui"),
            vec(p, "uj"),
            vec(p, "hi"),
            number(p, "theta0"),
        );
        for by_dual in [None, Some(by_dual(joint.clone()))] {
            let constraint: &dyn Constraint = by_dual.as_ref().map_or(&joint, |dual| dual);
            // Column k of (C_q q̇)_q by polarisation of the quadratic form (C_q q̇)_q q̇.
            let quadratic = |k: usize, side: f64| {
                let moved: Vec<f64> =
                    (0..6).map(|n| qd[n] + if n == k { side } else { 0.0 }).collect();
                terms(constraint, &q, &moved, 0.0).c_qqd_qd[1]
            };
            let d: Vec<f64> =
                (0..6).map(|k| (quadratic(k, 1.0) - quadratic(k, -1.0)) / 4.0).collect();
            for (field, found) in [("D1", &d[0..2]), ("D3", &d[3..5])] {
                check(&mut worst, sample, field, found);
            }
            for (field, found) in [("D2", d[2]), ("D4", d[5])] {
                check(
                    &mut worst,
                    &serde_json::json!({ field: [number(sample, field)] }),
                    field,
                    &[found],
                );
            }
        }
    }
    println!("prismatic_planar, D1 to D4: worst error {worst:.1e}");
}

#[test]
fn moving_point_agrees_with_the_samples() {
    planar("moving_point_planar", |p| {
        let c: [f64; 6] = array(p, "c");
        let x = Law::polynomial(&c[..3]);
        let y = Law::sine(c[3], c[4], c[5]);
        moving_point(any_planar(), any_planar(), x, y, vec(p, "uj"))
    });
}

#[test]
fn trajectory_driver_agrees_with_the_samples() {
    planar("trajectory_driver_planar", |p| {
        let c: [f64; 6] = array(p, "c");
        let x = Law::fourier(c[0], c[2], &[(c[1], 0.0)]);
        let y = Law::fourier(c[3], c[5], &[(0.0, c[4])]);
        drive_point(any_planar(), vec(p, "ui"), x, y)
    });
}

#[test]
fn spherical_agrees_with_the_samples() {
    of_space("spherical_spatial", |p| {
        spatial::spherical(any_spatial(), any_spatial(), vec_3(p, "ui"), vec_3(p, "uj"))
    });
}

#[test]
fn universal_agrees_with_the_samples() {
    of_space("universal_spatial", |p| {
        spatial::universal(
            any_spatial(),
            any_spatial(),
            vec_3(p, "ui"),
            vec_3(p, "uj"),
            vec_3(p, "hi"),
            vec_3(p, "hj"),
        )
    });
}

#[test]
fn cylindrical_by_dot_products_agrees_with_the_samples() {
    of_space("cylindrical_dot_spatial", |p| {
        let v = [vec_3(p, "v1"), vec_3(p, "v2")];
        cylindrical_dot(
            any_spatial(),
            any_spatial(),
            vec_3(p, "ui"),
            vec_3(p, "uj"),
            vec_3(p, "hj"),
            v,
        )
    });
}

/// The library's joint is these four dot products with the directions f and g across its axis, and
/// the cross products h_i × h_j and h_i × s in their components along f and g.
#[test]
fn the_cylindrical_joint_is_that_of_the_samples() {
    let file = read("cylindrical_cross_spatial");
    let mut worst = 0.0_f64;
    for sample in samples(&file, 8) {
        let p = &sample["params"];
        let q = numbers(sample, "q");
        let h_i = vec_3(p, "hi");
        let axis = Axis::along(vec_3(p, "hi"));
        let joint = spatial::cylindrical(
            any_spatial(),
            any_spatial(),
            vec_3(p, "ui"),
            vec_3(p, "uj"),
            axis,
            vec_3(p, "hj"),
        );
        let own = terms(&joint, &q, &[], 0.0);
        let dots = cylindrical_dot(
            any_spatial(),
            any_spatial(),
            vec_3(p, "ui"),
            vec_3(p, "uj"),
            vec_3(p, "hj"),
            [axis.f, axis.g],
        );
        assert!((terms(&dots, &q, &[], 0.0).c_q - &own.c_q).amax() <= TOLERANCE);
        let exact = numbers(&sample["forms"]["T"], "C");
        let a = EulerParameters::new(q[3], q[4], q[5], q[6]).rotation();
        let f = a * axis.f / h_i.norm();
        let g = a * axis.g / h_i.norm();
        let cross = |k: usize| vec3(exact[k], exact[k + 1], exact[k + 2]);
        let expected = [g.dot(cross(0)), -f.dot(cross(0)), g.dot(cross(3)), -f.dot(cross(3))];
        check(&mut worst, &serde_json::json!({ "C": expected }), "C", own.c.as_slice());
    }
    println!("cylindrical joint beside cross products: worst error {worst:.1e}");
}

#[test]
fn cylindrical_by_cross_products_agrees_with_the_samples() {
    of_space("cylindrical_cross_spatial", |p| {
        cylindrical_cross(
            any_spatial(),
            any_spatial(),
            vec_3(p, "ui"),
            vec_3(p, "uj"),
            vec_3(p, "hi"),
            vec_3(p, "hj"),
        )
    });
}

#[test]
fn two_link_system_agrees_with_the_samples() {
    let file = read("two_link_assembled");
    let description = read("two_link_25");
    assert_eq!(file["parameters"], description["parameters"]);
    let mut worst = 0.0_f64;
    for by in BOTH {
        let (mechanism, _) = build(&description, by).expect("a mechanism");
        let system = mechanism.build().expect("a square system");
        for sample in samples(&file, 4) {
            let q = numbers(sample, "q");
            let qd = numbers(sample, "qd");
            let t = number(sample, "t");
            let c_q = system.jacobian(&q, t).expect("finite");
            check(&mut worst, sample, "C", &system.residual(&q, t).expect("finite"));
            check(&mut worst, sample, "Cq", c_q.transpose().as_slice());
            check(&mut worst, sample, "Cq_qd", (&c_q * DVector::from_row_slice(&qd)).as_slice());
            check(&mut worst, sample, "Ct", &system.c_t(&q, t).expect("finite"));
            check(&mut worst, sample, "Qd", &system.acceleration_rhs(&q, &qd, t).expect("finite"));
            // This system's drivers are linear in t: both terms with t in them are zero, and Q_d is
            // the quadratic term alone.
            assert!(
                ["Cqt_qd", "Ctt"]
                    .iter()
                    .all(|field| numbers(sample, field).iter().all(|x| *x == 0.0))
            );
            let quadratic: Vec<f64> =
                system.acceleration_rhs(&q, &qd, t).expect("finite").iter().map(|x| -x).collect();
            check(&mut worst, sample, "CqqdQ_qd", &quadratic);
        }
    }
    println!("two_link_assembled: worst error {worst:.1e}");
}

/// Every sample of a planar joint, every field, on both routes.
fn planar<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    name: &str,
    joint: impl Fn(&Value) -> E,
) {
    let file = read(name);
    let mut worst = [0.0_f64; 2];
    for sample in samples(&file, 12) {
        let both = both_routes(&joint(&sample["params"]), sample, number(sample, "t"));
        for (found, worst) in both.iter().zip(&mut worst) {
            checked(found, sample, sample, worst);
            let vectors = [("Ct", &found.c_t), ("Cqt_qd", &found.c_qt_qd), ("Ctt", &found.c_tt)];
            vectors.iter().for_each(|(field, term)| check(worst, sample, field, term.as_slice()));
        }
    }
    println!("{name}: worst error {:.1e} symbolic, {:.1e} dual", worst[0], worst[1]);
}

/// Every sample of a spatial joint, every field, on both routes, for Kin's form of A(e).
fn of_space<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    name: &str,
    joint: impl Fn(&Value) -> E,
) {
    let file = read(name);
    let mut worst = [0.0_f64; 2];
    let mut tangents = 0;
    for sample in samples(&file, 8) {
        // There is no t in these equations: any will do.
        let both = both_routes(&joint(&sample["params"]), sample, 0.7);
        for (found, worst) in both.iter().zip(&mut worst) {
            checked(found, &sample["forms"]["T"], sample, worst);
            let timeless = [&found.c_t, &found.c_qt_qd, &found.c_tt];
            assert!(
                timeless.iter().all(|term| term.iter().all(|x| *x == 0.0)),
                "{name}: a term with t in it"
            );
            if sample["tangent"] == true {
                let qdd = DVector::from_vec(numbers(sample, "qdd"));
                check(worst, sample, "Cdd", (&found.c_q * qdd - &found.q_d).as_slice());
                tangents += 1;
            }
        }
    }
    assert_eq!(tangents, 2 * 4, "{name}: tangent samples, both routes");
    println!("{name}: worst error {:.1e} symbolic, {:.1e} dual", worst[0], worst[1]);
}

/// The terms that every sample has.
fn checked(found: &Terms, exact: &Value, sample: &Value, worst: &mut f64) {
    check(worst, exact, "C", found.c.as_slice());
    check(worst, exact, "Cq", found.c_q.transpose().as_slice());
    check(
        worst,
        exact,
        "Cq_qd",
        (&found.c_q * DVector::from_vec(numbers(sample, "qd"))).as_slice(),
    );
    check(worst, exact, "CqqdQ_qd", found.c_qqd_qd.as_slice());
    check(worst, exact, "Qd", found.q_d.as_slice());
}

fn both_routes<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    joint: &E,
    sample: &Value,
    t: f64,
) -> [Terms; 2] {
    assert_eq!(joint.route(), Route::Symbolic, "{}", joint.facts().kind);
    let q = numbers(sample, "q");
    let qd = numbers(sample, "qd");
    [terms(joint, &q, &qd, t), dual_terms(joint, &q, &qd, t)]
}

/// One field against what was found, row by row.
fn check(worst: &mut f64, exact: &Value, field: &str, found: &[f64]) {
    let of_field = if exact[field][0].is_array() {
        rows(exact, field).concat()
    } else {
        numbers(exact, field)
    };
    let error = error(found, &of_field);
    assert!(error <= TOLERANCE, "{field}: error {error:.1e}\nfound {found:?}\nexact {of_field:?}");
    *worst = worst.max(error);
}

fn samples(file: &Value, at_least: usize) -> &[Value] {
    let samples = file["samples"].as_array().expect("samples");
    assert!(samples.len() >= at_least, "{} samples", samples.len());
    samples
}

fn vec(params: &Value, name: &str) -> Vec2 {
    let [x, y] = array(params, name);
    vec2(x, y)
}

fn vec_3(params: &Value, name: &str) -> Vec3 {
    let [x, y, z] = array(params, name);
    vec3(x, y, z)
}
