//! W2: loop closure of the offset slider-crank, two bare coordinates.

use kin::prelude::*;

use crate::hand::slider_crank::{H, L2, L3, OMEGA, run, start};
use crate::sweep::{Table, Workload, add, build, routes};

const DT: f64 = 1e-4;
const STEPS: usize = 100_000;

/// The loop of crank, coupler and slider, offset by h.
#[constraint(symbolic)]
fn slider_crank(
    theta3: Coord,
    x: Coord,
    l2: f64,
    l3: f64,
    h: f64,
    omega: f64,
    t: Time,
) -> (f64, f64) {
    let theta2 = omega * t;
    (l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h)
}

pub fn workload() -> Workload {
    Workload {
        name: "W2".to_string(),
        dt: DT,
        steps: STEPS,
        links: None,
        routes: routes(|| run(STEPS, DT), model),
        error: Box::new(error),
        allowed: 1e-7,
        build: Box::new(|| model(false)),
    }
}

fn model(dual: bool) -> System {
    let mut m = Mechanism::new("slider-crank");
    let [guess_theta3, guess_x] = start();
    let theta3 = m.angle("theta3", guess_theta3).unwrap_or_else(|error| panic!("{error}"));
    let x = m.length("x", guess_x).unwrap_or_else(|error| panic!("{error}"));
    add(&mut m, dual, "loop", slider_crank(theta3, x, L2, L3, H, OMEGA));
    build(m, &start())
}

/// The largest error of both coordinates and their derivatives, against the closed form.
fn error(table: &Table) -> f64 {
    let step = |k: usize| {
        let (q, qd, qdd) = table.at(k);
        let (s, c) = (OMEGA * k as f64 * DT).sin_cos();
        let theta = ((H - L2 * s) / L3).asin();
        let (y, x) = theta.sin_cos();
        let rate = -L2 * OMEGA * c / L3 / x;
        let second = (L2 * OMEGA * OMEGA * s / L3 + y * rate * rate) / x;
        let slider = [
            L2 * c + L3 * x,
            -L2 * OMEGA * s - L3 * y * rate,
            -L2 * OMEGA * OMEGA * c - L3 * (x * rate * rate + y * second),
        ];
        let errors = [
            q[0] - theta,
            qd[0] - rate,
            qdd[0] - second,
            q[1] - slider[0],
            qd[1] - slider[1],
            qdd[1] - slider[2],
        ];
        errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()))
    };
    (0..table.len()).map(step).fold(0.0, f64::max)
}
