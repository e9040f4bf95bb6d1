//! "Velocity", "Acceleration" and both "Equivalence" slides: a point fixed in its body.

use kin::check::any_planar;
use kin::extend::{dual_terms, terms};
use kin::prelude::*;
use nalgebra::Matrix2;

use crate::support::*;

/// r_P itself, as a constraint that holds it at the global origin.      \[m\]
#[constraint]
fn at_origin(i: Planar, u: Vec2) -> Vec2 {
    i.point(u)
}

/// θ̇ [0, −1; 1, 0]: ω ×, in the plane.
fn omega_cross(w: f64) -> Matrix2<f64> {
    w * Matrix2::new(0.0, -1.0, 1.0, 0.0)
}

#[test]
fn point_velocity_and_acceleration_are_the_lectures() {
    let mut random = Random::new(9);
    let mut worst = 0.0_f64;
    for _ in 0..STATES {
        let (q, qd): ([f64; 3], [f64; 3]) = random.bodies();
        let qdd = random.array::<3>(3.0);
        let u = random.vector(2.0);
        let [x, y, theta] = q;
        let [vx, vy, w] = qd;
        let [ax, ay, alpha] = qdd;
        let point = at_origin(any_planar(), vec2(u.x, u.y));
        // r = R + A ū,  ṙ = Ṙ + θ̇ A_θ ū,  r̈ = R̈ + θ̈ A_θ ū − θ̇² A ū
        let r = V2::new(x, y) + a(theta) * u;
        let v = V2::new(vx, vy) + w * (a_theta(theta) * u);
        let acceleration = V2::new(ax, ay) + alpha * (a_theta(theta) * u) - w * w * (a(theta) * u);
        // the classical forms, with u = A ū: v_O + ω × u,  a_O + α × u + ω × (ω × u)
        let global = a(theta) * u;
        let classical_v = V2::new(vx, vy) + omega_cross(w) * global;
        let classical_a = V2::new(ax, ay)
            + omega_cross(alpha) * global
            + omega_cross(w) * (omega_cross(w) * global);
        for found in [terms(&point, &q, &qd, 0.0), dual_terms(&point, &q, &qd, 0.0)] {
            let rates = &found.c_q * column(&qd);
            let second_rates = &found.c_q * column(&qdd) - &found.q_d;
            for (found, hand) in [
                (&found.c, r),
                (&rates, v),
                (&rates, classical_v),
                (&second_rates, acceleration),
                (&second_rates, classical_a),
            ] {
                let error = difference(found, &column_of(hand));
                assert!(error <= TOLERANCE, "{found} {hand}");
                worst = worst.max(error);
            }
        }
    }
    println!("point of a body: worst {worst:.1e}");
}
