//! "Driving Constraints": simple and complex drivers.

use kin::check::{any_coord, any_planar};
use kin::prelude::*;
use nalgebra::DMatrix;

use crate::support::*;

/// The lecture's complex driver with a path of the test's own: (c0 + c1 cos c2 t, c3 + c4 sin c5
/// t).   \[m\]
#[constraint]
fn trajectory(i: Planar, u: Vec2, c: [f64; 6], t: Time) -> [f64; 2] {
    let f = (c[0] + c[1] * (c[2] * t).cos(), c[3] + c[4] * (c[5] * t).sin());
    [
        i.r.x + u.x * i.theta.cos() - u.y * i.theta.sin() - f.0,
        i.r.y + u.x * i.theta.sin() + u.y * i.theta.cos() - f.1,
    ]
}

/// R_x + x̄ cos θ − ȳ sin θ = f1(t), R_y + x̄ sin θ + ȳ cos θ = f2(t); f, ḟ, f̈ given.
fn complex_by_hand(q: &[f64; 3], qd: &[f64; 3], u: V2, [f, f_dot, f_ddot]: [V2; 3]) -> Hand {
    let [x, y, theta] = *q;
    let [vx, vy, w] = *qd;
    let (s, c) = theta.sin_cos();
    let mut hand = Hand::new(2, 3);
    hand.c = column(&[x + u.x * c - u.y * s - f.x, y + u.x * s + u.y * c - f.y]);
    let turn = [-u.x * s - u.y * c, u.x * c - u.y * s];
    hand.c_q = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, turn[0], 0.0, 1.0, turn[1]]);
    hand.c_q_qd = column(&[vx + w * turn[0], vy + w * turn[1]]);
    hand.c_t = column_of(-f_dot);
    hand.c_qqd_qd = -w * w * column(&[u.x * c - u.y * s, u.x * s + u.y * c]);
    hand.c_tt = column_of(-f_ddot);
    hand.q_d = w * w * column(&[u.x * c - u.y * s, u.x * s + u.y * c]) + column_of(f_ddot);
    hand
}

#[test]
fn complex_driver_terms_are_the_lectures() {
    let mut random = Random::new(10);
    let mut comparison = Comparison::of("complex driver, own path");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let u = random.vector(2.0);
        let t = random.within(2.0);
        let c: [f64; 6] = random.array(2.0);
        let (s2, c2) = (c[2] * t).sin_cos();
        let (s5, c5) = (c[5] * t).sin_cos();
        let f = V2::new(c[0] + c[1] * c2, c[3] + c[4] * s5);
        let f_dot = V2::new(-c[1] * c[2] * s2, c[4] * c[5] * c5);
        let f_ddot = V2::new(-c[1] * c[2] * c[2] * c2, -c[4] * c[5] * c[5] * s5);
        let driver = trajectory(any_planar(), vec2(u.x, u.y), c);
        comparison.check(&driver, &q, &qd, t, &complex_by_hand(&q, &qd, u, [f, f_dot, f_ddot]));
    }
}

#[test]
fn shipped_point_driver_terms_are_the_lectures() {
    let mut random = Random::new(11);
    let mut comparison = Comparison::of("complex driver, laws");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let u = random.vector(2.0);
        let t = random.within(2.0);
        let [b0, b1, b2, b3] = random.array(1.0);
        let [amplitude, omega, phase] = random.array(2.0);
        let (s, c) = (omega * t + phase).sin_cos();
        let f = V2::new(b0 + b1 * t + b2 * t * t + b3 * t * t * t, amplitude * s);
        let f_dot = V2::new(b1 + 2.0 * b2 * t + 3.0 * b3 * t * t, amplitude * omega * c);
        let f_ddot = V2::new(2.0 * b2 + 6.0 * b3 * t, -amplitude * omega * omega * s);
        let path = (Law::polynomial(&[b0, b1, b2, b3]), Law::sine(amplitude, omega, phase));
        let driver = drive_point(any_planar(), vec2(u.x, u.y), path.0, path.1);
        comparison.check(&driver, &q, &qd, t, &complex_by_hand(&q, &qd, u, [f, f_dot, f_ddot]));
    }
}

/// θ − f(t) = 0 in column `column` of n.
fn simple_by_hand(theta: f64, w: f64, [f, f_dot, f_ddot]: [f64; 3], at: usize, n: usize) -> Hand {
    let mut hand = Hand::new(1, n);
    hand.c = column(&[theta - f]);
    hand.c_q[(0, at)] = 1.0;
    hand.c_q_qd = column(&[w]);
    hand.c_t = column(&[-f_dot]);
    hand.c_tt = column(&[-f_ddot]);
    hand.q_d = column(&[f_ddot]);
    hand
}

#[test]
fn simple_driver_terms_are_the_lectures() {
    let mut random = Random::new(12);
    let mut comparison = Comparison::of("simple driver");
    for _ in 0..STATES {
        let ((q, qd), t): (([f64; 3], [f64; 3]), f64) = (random.bodies(), random.within(4.0));
        let [theta0, omega, alpha] = random.array(3.0);
        // ω t + θ0, and the same with a constant acceleration
        for (law, f) in [
            (Law::linear(theta0, omega), [omega * t + theta0, omega, 0.0]),
            (
                Law::polynomial(&[theta0, omega, alpha / 2.0]),
                [theta0 + omega * t + alpha * t * t / 2.0, omega + alpha * t, alpha],
            ),
        ] {
            comparison.check(
                &drive_angle(any_planar(), law.clone()),
                &q,
                &qd,
                t,
                &simple_by_hand(q[2], qd[2], f, 2, 3),
            );
            comparison.check(
                &drive(any_coord(), law),
                &q[..1],
                &qd[..1],
                t,
                &simple_by_hand(q[0], qd[0], f, 0, 1),
            );
        }
    }
}
