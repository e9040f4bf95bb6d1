//! "Example: Two Link Manipulator": the full set of nine constraints in nine coordinates, assembled
//! by hand from its five constraints.

use kin::check::any_planar;
use kin::extend::dual_route::Equation;
use kin::extend::{Terms, by_dual, dual_terms, terms};
use kin::prelude::*;
use kin::{Mechanism, pose};
use nalgebra::{DMatrix, DVector};

use crate::support::*;

/// "Solving 2 Link Manipulator"
const L2: f64 = 0.2;
const L3: f64 = 0.35;
const W2: f64 = 0.5;
const W3: f64 = 0.75;
const START2: f64 = PI / 6.0;
const START3: f64 = PI / 12.0;

/// "Full Set of Constraints" and what follows from it, row by row.
fn by_hand(q: &[f64; 9], qd: &[f64; 9], t: f64) -> Hand {
    let [x1, y1, t1, x2, y2, t2, x3, y3, t3] = *q;
    let [vx1, vy1, w1, vx2, vy2, w2, vx3, vy3, w3] = *qd;
    let (s2, c2) = t2.sin_cos();
    let (s3, c3) = t3.sin_cos();
    let m2 = L2 / 2.0;
    let m3 = L3 / 2.0;
    let mut hand = Hand::new(9, 9);
    hand.c = column(&[
        x1,
        y1,
        t1,
        x1 - x2 + m2 * c2,
        y1 - y2 + m2 * s2,
        x2 + m2 * c2 - x3 + m3 * c3,
        y2 + m2 * s2 - y3 + m3 * s3,
        t2 - W2 * t - START2,
        t3 - W3 * t - START3,
    ]);
    // every entry that is not zero
    for (row, column, value) in [
        (0, 0, 1.0),
        (1, 1, 1.0),
        (2, 2, 1.0),
        (3, 0, 1.0),
        (3, 3, -1.0),
        (3, 5, -m2 * s2),
        (4, 1, 1.0),
        (4, 4, -1.0),
        (4, 5, m2 * c2),
        (5, 3, 1.0),
        (5, 5, -m2 * s2),
        (5, 6, -1.0),
        (5, 8, -m3 * s3),
        (6, 4, 1.0),
        (6, 5, m2 * c2),
        (6, 7, -1.0),
        (6, 8, m3 * c3),
        (7, 5, 1.0),
        (8, 8, 1.0),
    ] {
        hand.c_q[(row, column)] = value;
    }
    // last slide; its fifth row begins with Ṙ_y^1 (printed: Ṙ_x^1)
    hand.c_q_qd = column(&[
        vx1,
        vy1,
        w1,
        vx1 - vx2 - m2 * w2 * s2,
        vy1 - vy2 + m2 * w2 * c2,
        vx2 - vx3 - m2 * w2 * s2 - m3 * w3 * s3,
        vy2 - vy3 + m2 * w2 * c2 + m3 * w3 * c3,
        w2,
        w3,
    ]);
    // "Velocity Analysis": seven zeros (printed: six)
    hand.c_t = column(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -W2, -W3]);
    // "Acceleration Analysis": C_qt and C_tt are zero
    let n2 = (m2 * w2 * w2 * c2, m2 * w2 * w2 * s2);
    let n3 = (m3 * w3 * w3 * c3, m3 * w3 * w3 * s3);
    hand.c_qqd_qd = column(&[0.0, 0.0, 0.0, -n2.0, -n2.1, -n2.0 - n3.0, -n2.1 - n3.1, 0.0, 0.0]);
    hand.q_d = column(&[0.0, 0.0, 0.0, n2.0, n2.1, n2.0 + n3.0, n2.1 + n3.1, 0.0, 0.0]);
    hand
}

/// The 9 × 9 terms, put together by hand from those of single constraints on either route.
struct Assembly<'a> {
    q: &'a [f64; 9],
    qd: &'a [f64; 9],
    t: f64,
    routes: [Terms; 2],
}

impl<'a> Assembly<'a> {
    fn new(q: &'a [f64; 9], qd: &'a [f64; 9], t: f64) -> Self {
        let v = || DVector::zeros(9);
        let empty = || Terms {
            c: v(),
            c_q: DMatrix::zeros(9, 9),
            c_t: v(),
            c_qqd_qd: v(),
            c_qt_qd: v(),
            c_tt: v(),
            q_d: v(),
        };
        Assembly { q, qd, t, routes: [empty(), empty()] }
    }

    /// A constraint whose first row is `row`, on the bodies with these numbers.
    fn add<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
        &mut self,
        row: usize,
        bodies: &[usize],
        constraint: E,
    ) {
        assert_eq!(constraint.route(), Route::Symbolic, "{}", constraint.facts().kind);
        let columns: Vec<usize> = bodies.iter().flat_map(|body| 3 * (body - 1)..3 * body).collect();
        let local = |all: &[f64; 9]| columns.iter().map(|&k| all[k]).collect::<Vec<f64>>();
        let q = local(self.q);
        let qd = local(self.qd);
        let found = [terms(&constraint, &q, &qd, self.t), dual_terms(&constraint, &q, &qd, self.t)];
        for (all, one) in self.routes.iter_mut().zip(found) {
            for k in 0..M {
                for (n, &column) in columns.iter().enumerate() {
                    all.c_q[(row + k, column)] += one.c_q[(k, n)];
                }
            }
            for (all, one) in [
                (&mut all.c, one.c),
                (&mut all.c_t, one.c_t),
                (&mut all.c_qqd_qd, one.c_qqd_qd),
                (&mut all.c_qt_qd, one.c_qt_qd),
                (&mut all.c_tt, one.c_tt),
                (&mut all.q_d, one.q_d),
            ] {
                all.rows_mut(row, M).copy_from(&one);
            }
        }
    }
}

fn pin_o(i: impl Into<PlanarBody>, j: impl Into<PlanarBody>) -> revolute {
    revolute(i, j, vec2(0.0, 0.0), vec2(-L2 / 2.0, 0.0))
}

fn pin_a(i: impl Into<PlanarBody>, j: impl Into<PlanarBody>) -> revolute {
    revolute(i, j, vec2(L2 / 2.0, 0.0), vec2(-L3 / 2.0, 0.0))
}

#[test]
fn two_link_constraints_assemble_to_the_lectures_nine_by_nine() {
    let mut random = Random::new(13);
    let mut comparison = Comparison::of("two-link, 9 x 9 by hand");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let t = 12.0 + random.within(12.0);
        let mut all = Assembly::new(&q, &qd, t);
        all.add(0, &[1], fixed(any_planar(), vec2(0.0, 0.0), 0.0));
        all.add(3, &[1, 2], pin_o(any_planar(), any_planar()));
        all.add(5, &[2, 3], pin_a(any_planar(), any_planar()));
        all.add(7, &[2], drive_angle(any_planar(), Law::linear(START2, W2)));
        all.add(8, &[3], drive_angle(any_planar(), Law::linear(START3, W3)));
        let hand = by_hand(&q, &qd, t);
        for (k, route) in ["symbolic", "dual"].into_iter().enumerate() {
            comparison.same(route, k, &all.routes[k], &column(&qd), &hand);
        }
    }
}

/// The same as a mechanism: what Kin assembles.
fn mechanism(dual: bool) -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("two-link manipulator");
    let body1 = m.planar("1", pose(0.0, 0.0, 0.0))?;
    let body2 = m.planar("2", pose(0.1, 0.0, 0.0))?;
    let body3 = m.planar("3", pose(0.3, 0.0, 0.0))?;
    let ground = fixed(body1, vec2(0.0, 0.0), 0.0);
    let o = pin_o(body1, body2);
    let a = pin_a(body2, body3);
    let drive2 = drive_angle(body2, Law::linear(START2, W2));
    let drive3 = drive_angle(body3, Law::linear(START3, W3));
    if dual {
        m.add("ground", by_dual(ground))?;
        m.add("O", by_dual(o))?;
        m.add("A", by_dual(a))?;
        m.add("drive 2", by_dual(drive2))?;
        m.add("drive 3", by_dual(drive3))?;
    } else {
        m.add("ground", ground)?;
        m.add("O", o)?;
        m.add("A", a)?;
        m.add("drive 2", drive2)?;
        m.add("drive 3", drive3)?;
    }
    Ok(m)
}

#[test]
fn two_link_system_is_the_lectures_nine_by_nine() -> kin::Result<()> {
    let mut random = Random::new(14);
    let mut worst = [0.0_f64; 2];
    for (dual, worst) in [false, true].into_iter().zip(&mut worst) {
        let system = mechanism(dual)?.build()?;
        assert_eq!((system.n_coordinates(), system.n_equations()), (9, 9));
        for _ in 0..STATES {
            let (q, qd) = random.bodies();
            let t = 12.0 + random.within(12.0);
            let hand = by_hand(&q, &qd, t);
            let c_q = system.jacobian(&q, t)?;
            for (term, found, hand) in [
                ("C", column(&system.residual(&q, t)?), hand.c),
                ("C_q", column(c_q.as_slice()), column(hand.c_q.as_slice())),
                ("C_q qd", c_q * column(&qd), hand.c_q_qd),
                ("C_t", column(&system.c_t(&q, t)?), hand.c_t),
                ("Q_d", column(&system.acceleration_rhs(&q, &qd, t)?), hand.q_d),
            ] {
                let error = difference(&found, &hand);
                assert!(error <= TOLERANCE, "{term}: {found}by hand {hand}");
                *worst = worst.max(error);
            }
        }
    }
    println!("two-link system: worst {:.1e} symbolic, {:.1e} dual", worst[0], worst[1]);
    Ok(())
}
