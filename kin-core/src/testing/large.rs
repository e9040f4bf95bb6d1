//! Mechanisms of tens of thousands of coordinates.

use super::models::*;
use super::*;
use crate::coordinates::Ground;
use crate::joints::planar;
use crate::model::mechanism::{Mechanism, pose};
use crate::outcome::error::FailureKind;
use crate::solve::newton::{Newton, first_position};
use crate::solve::options::SolverOptions;
use crate::system::System;

/// θ_j − θ_i − f(t) = 0.   \[rad\]
#[kin_macros::constraint]
fn relative(i: Planar, j: Planar, law: Law, t: crate::coordinates::Time) -> f64 {
    j.theta - i.theta - law.at(t)
}

/// Angle of joint k (workload W4).
fn phi(k: usize, t: f64) -> f64 {
    0.3 * (t + 0.1 * k as f64).sin()
}

/// Poses of the links of length 1 at time t.
fn poses(n: usize, t: f64) -> Vec<f64> {
    let mut x = 0.0;
    let mut y = 0.0;
    let mut theta = 0.0;
    let link = |k: usize| {
        theta += phi(k, t);
        let (s, c) = f64::sin_cos(theta);
        let q = [x + 0.5 * c, y + 0.5 * s, theta];
        (x, y) = (x + c, y + s);
        q
    };
    (0..n).flat_map(link).collect()
}

/// The driven chain of workload W4, from poses that are `off` by that much.
fn chain(n: usize, off: f64) -> System {
    let mut m = Mechanism::new("chain");
    let guess = poses(n, 0.0);
    let mut last: Option<PlanarBody> = None;
    for k in 0..n {
        let noise = off * (k as f64).cos();
        let body = m
            .planar(
                &format!("link {k}"),
                pose(guess[3 * k] + noise, guess[3 * k + 1] - noise, guess[3 * k + 2] + noise),
            )
            .unwrap();
        let law = Law::sine(0.3, 1.0, 0.1 * k as f64);
        match last {
            None => {
                m.add("pin 0", planar::revolute(Ground, body, v(0.0, 0.0), v(-0.5, 0.0))).unwrap();
                m.add("motor 0", drive_angle(body, law)).unwrap();
            }
            Some(last) => {
                m.add(&format!("pin {k}"), planar::revolute(last, body, v(0.5, 0.0), v(-0.5, 0.0)))
                    .unwrap();
                m.add(&format!("motor {k}"), relative(last, body, law)).unwrap();
            }
        }
        last = Some(body);
    }
    m.build().unwrap()
}

#[test]
fn chain_of_30_000_coordinates_is_the_recursion() {
    let n = 10_000;
    let system = chain(n, 0.0);
    let options = SolverOptions::default();
    let mut newton = Newton::new(&system, &options);
    first_position::assemble(&mut newton, 0.02).unwrap();
    let exact = poses(n, 0.02);
    let worst = newton.q.iter().zip(&exact).fold(0.0_f64, |m, (q, exact)| m.max((q - exact).abs()));
    assert!(worst < 1e-9, "{worst:e}");
    assert_eq!(newton.linear.recordings(), 1);
}

#[test]
fn chain_assembles_from_a_rough_guess_and_steps() {
    let n = 400;
    let motion = chain(n, 0.05).run([0.0, 0.01, 0.02]).unwrap();
    let exact = poses(n, 0.02);
    assert!(motion.q(2).iter().zip(&exact).all(|(q, exact)| (q - exact).abs() < 1e-11));
    assert!(motion.iterations()[1..].iter().all(|steps| *steps <= 2), "{:?}", motion.iterations());
}

/// A motor that repeats another: told without a dense matrix.
#[test]
fn large_singular_system_is_told() {
    let n = 60;
    let mut m = Mechanism::new("chain");
    let bodies: Vec<PlanarBody> = (0..n)
        .map(|k| m.planar(&format!("link {k}"), pose(k as f64 + 0.5, 0.0, 0.0)).unwrap())
        .collect();
    m.add("pin 0", planar::revolute(Ground, bodies[0], v(0.0, 0.0), v(-0.5, 0.0))).unwrap();
    m.add("motor 0", drive_angle(bodies[0], Law::ramp(1.0))).unwrap();
    for k in 1..n {
        m.add(
            &format!("pin {k}"),
            planar::revolute(bodies[k - 1], bodies[k], v(0.5, 0.0), v(-0.5, 0.0)),
        )
        .unwrap();
        let (i, j) = if k == n - 1 { (0, 1) } else { (k - 1, k) };
        m.add(&format!("motor {k}"), relative(bodies[i], bodies[j], Law::constant(0.0))).unwrap();
    }
    let error = m.build().unwrap().run([0.0]).unwrap_err();
    let Some(FailureKind::SingularAt { rank, movable, dependent, .. }) = error.kind() else {
        panic!("{error}")
    };
    assert_eq!(*rank, 3 * n - 1);
    assert_eq!(movable, &["link 59"]);
    assert_eq!(dependent[..], ["motor 1", "motor 59"]);
}
