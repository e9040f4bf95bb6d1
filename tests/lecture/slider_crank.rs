//! "Loop Closure Kinematics" of the slider-crank: its Jacobian and both right sides.

use kin::check::any_coord;
use kin::prelude::*;
use nalgebra::DMatrix;

use crate::support::*;

/// As the lecture has it: the crank turns at constant ω.
#[constraint]
fn steady(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// The crank follows any law of time.
#[constraint]
fn driven(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, crank: Law) -> [f64; 2] {
    let theta2 = crank.at(t);
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// A run-up of the user's own: from rest to ω with time constant τ.      \[rad\]
#[law]
fn run_up(t: f64, omega: f64, tau: f64) -> f64 {
    omega * (t - tau * (1.0 - (-t / tau).exp()))
}

/// Lengths and offset: l2, l3, h.
#[derive(Clone, Copy)]
struct Crank {
    l2: f64,
    l3: f64,
    h: f64,
}

impl Crank {
    fn random(random: &mut Random) -> Self {
        Crank { l2: 1.0 + random.within(0.9), l3: 3.0 + random.within(2.0), h: random.within(1.0) }
    }

    /// The slides' formulas at (θ3, x_B), their rates, and θ2, θ̇2, θ̈2.
    fn by_hand(&self, q: &[f64; 2], qd: &[f64; 2], [theta2, w2, alpha2]: [f64; 3]) -> Hand {
        let Crank { l2, l3, h } = *self;
        let [theta3, x] = *q;
        let [w3, vx] = *qd;
        let (s2, c2) = theta2.sin_cos();
        let (s3, c3) = theta3.sin_cos();
        let mut hand = Hand::new(2, 2);
        hand.c = column(&[l2 * c2 + l3 * c3 - x, l2 * s2 + l3 * s3 - h]);
        // "Jacobian Matrix"
        hand.c_q = DMatrix::from_row_slice(2, 2, &[-l3 * s3, -1.0, l3 * c3, 0.0]);
        hand.c_q_qd = column(&[-l3 * w3 * s3 - vx, l3 * w3 * c3]);
        // "Velocity Analysis": J (θ̇3, ẋ) = θ̇2 (l2 sin θ2, −l2 cos θ2) = −C_t
        hand.c_t = -w2 * column(&[l2 * s2, -l2 * c2]);
        // "Acceleration Analysis": J (θ̈3, ẍ) = θ̇2² (l2 cos θ2, l2 sin θ2) + θ̈2 (l2 sin θ2, −l2
        // cos θ2) + θ̇3² (l3 cos θ3, l3 sin θ3)
        let given = w2 * w2 * column(&[l2 * c2, l2 * s2]) + alpha2 * column(&[l2 * s2, -l2 * c2]);
        let quadratic = w3 * w3 * column(&[l3 * c3, l3 * s3]);
        hand.c_tt = -&given;
        hand.c_qqd_qd = -&quadratic;
        hand.q_d = given + quadratic;
        hand
    }
}

fn state(random: &mut Random) -> ([f64; 2], [f64; 2]) {
    ([random.within(4.0 * PI), random.within(5.0)], random.array(5.0))
}

#[test]
fn slider_crank_terms_at_constant_speed_are_the_lectures() {
    let mut random = Random::new(4);
    let mut comparison = Comparison::of("slider-crank, constant speed");
    for _ in 0..STATES {
        let (q, qd) = state(&mut random);
        let crank = Crank::random(&mut random);
        let t = random.within(2.0);
        let omega = random.within(5.0);
        let closure = steady(any_coord(), any_coord(), crank.l2, crank.l3, crank.h, omega);
        comparison.check(&closure, &q, &qd, t, &crank.by_hand(&q, &qd, [omega * t, omega, 0.0]));
    }
}

#[test]
fn slider_crank_terms_with_an_accelerating_crank_are_the_lectures() {
    let mut random = Random::new(5);
    let mut comparison = Comparison::of("slider-crank, accelerating crank");
    for k in 0..STATES {
        let (q, qd) = state(&mut random);
        let crank = Crank::random(&mut random);
        let t = 2.0 + random.within(2.0);
        let [f0, w, alpha] = random.array(3.0);
        // each law with θ2, θ̇2, θ̈2 by hand
        let (law, given) = match k % 3 {
            0 => (
                Law::polynomial(&[f0, w, alpha / 2.0]),
                [f0 + w * t + alpha * t * t / 2.0, w + alpha * t, alpha],
            ),
            1 => {
                let (s, c) = (w * t + f0).sin_cos();
                (Law::sine(alpha, w, f0), [alpha * s, alpha * w * c, -alpha * w * w * s])
            }
            _ => {
                let tau = 2.0;
                let decay = (-t / 2.0_f64).exp();
                (
                    run_up(w, tau),
                    [w * (t - tau * (1.0 - decay)), w * (1.0 - decay), w * decay / tau],
                )
            }
        };
        let closure = driven(any_coord(), any_coord(), crank.l2, crank.l3, crank.h, law);
        comparison.check(&closure, &q, &qd, t, &crank.by_hand(&q, &qd, given));
    }
}

#[test]
fn slider_crank_elimination_formula_closes_the_loop() {
    let mut random = Random::new(6);
    for _ in 0..STATES {
        let crank = Crank { l2: 0.9 + random.within(0.5), ..Crank::random(&mut random) };
        let Crank { l2, h, .. } = crank;
        let theta2 = random.within(4.0 * PI);
        // θ3 = asin((h − l2 sin θ2) / l3) and its other branch, π − that; l3 long enough for both.
        let l3 = 2.5 + random.within(0.05);
        let angle = ((h - l2 * theta2.sin()) / l3).asin();
        for (theta3, side) in [(angle, 1.0), (PI - angle, -1.0)] {
            let x = l2 * theta2.cos() + side * (l3 * l3 - (h - l2 * theta2.sin()).powi(2)).sqrt();
            let closure = driven(any_coord(), any_coord(), l2, l3, h, Law::constant(theta2));
            let c = kin::extend::terms(&closure, &[theta3, x], &[0.0; 2], 0.0).c;
            assert!(c.amax() <= TOLERANCE * (1.0 + l2 + l3), "{c}");
        }
    }
}
