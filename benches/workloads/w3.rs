//! W3: the four-bar in absolute coordinates, nine of them.

use std::f64::consts::TAU;

use kin::prelude::*;

use crate::hand::four_bar::{FourBar, run};
use crate::sweep::{Table, Workload, add, build, routes, weigh};

const DT: f64 = 1e-3;
const STEPS: usize = 10_001;
const MODEL: FourBar = FourBar { a: 1.0, b: 3.5, c: 3.0, d: 4.0, omega: TAU };

pub fn workload() -> Workload {
    Workload {
        name: "W3".to_string(),
        dt: DT,
        steps: STEPS,
        links: None,
        routes: routes(|| run(&MODEL, STEPS, DT), |dual| model(&MODEL, dual)),
        error: Box::new(error),
        allowed: 1e-7,
        build: Box::new(|| model(&MODEL, false)),
    }
}

/// Crank, coupler and rocker between pins O, A, B, C, on the open branch.
pub fn model(lengths: &FourBar, dual: bool) -> System {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let link = |m: &mut Mechanism, name, length| {
        m.link(name, length).unwrap_or_else(|error| panic!("{error}"))
    };
    let crank = link(&mut m, "crank", lengths.a);
    let coupler = link(&mut m, "coupler", lengths.b);
    let rocker = link(&mut m, "rocker", lengths.c);
    add(&mut m, dual, "O", revolute(crank, ground, crank.start(), vec2(0.0, 0.0)));
    add(&mut m, dual, "A", revolute(crank, coupler, crank.end(), coupler.start()));
    add(&mut m, dual, "B", revolute(coupler, rocker, coupler.end(), rocker.end()));
    add(&mut m, dual, "C", revolute(rocker, ground, rocker.start(), vec2(lengths.d, 0.0)));
    add(&mut m, dual, "motor", drive_angle(crank, Law::ramp(lengths.omega)));
    weigh(&mut m, [crank, coupler, rocker].map(PlanarBody::from));
    build(m, &lengths.position(0.0))
}

fn error(table: &Table) -> f64 {
    (0..table.len())
        .map(|k| position_error(table.at(k).0, k).max(rate_error(table, k)))
        .fold(0.0, f64::max)
}

/// Against the closed form; angles of coupler and rocker up to whole turns.
fn position_error(q: &[f64], k: usize) -> f64 {
    let exact = MODEL.position(TAU * k as f64 * DT);
    let difference = |i: usize| {
        if i == 5 || i == 8 {
            (q[i] - exact[i] + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
        } else {
            q[i] - exact[i]
        }
    };
    (0..9).fold(0.0, |m, i| difference(i).abs().max(m))
}

/// C_q q̇ + C_t and C_q q̈ − Q_d, by pins: each is a point of one link less a point of the next.
fn rate_error(table: &Table, k: usize) -> f64 {
    let (q, qd, qdd) = table.at(k);
    // Velocity and acceleration of the end (side 1) or start (side −1) of link `i` of length `l`;
    // link 3 is the ground.
    let point = |i: usize, l: f64, side: f64| {
        if i == 3 {
            return [0.0; 4];
        }
        let q = &q[3 * i..];
        let qd = &qd[3 * i..];
        let qdd = &qdd[3 * i..];
        let x = 0.5 * side * l * q[2].cos();
        let y = 0.5 * side * l * q[2].sin();
        let w = qd[2];
        let a = qdd[2];
        [qd[0] - y * w, qd[1] + x * w, qdd[0] - y * a - x * w * w, qdd[1] + x * a - y * w * w]
    };
    let FourBar { a, b, c, omega, .. } = MODEL;
    let pins = [
        (point(0, a, -1.0), point(3, 0.0, 0.0)),
        (point(0, a, 1.0), point(1, b, -1.0)),
        (point(1, b, 1.0), point(2, c, 1.0)),
        (point(2, c, -1.0), point(3, 0.0, 0.0)),
    ];
    let rows = pins.iter().flat_map(|(p, r)| (0..4).map(|i| p[i] - r[i]));
    rows.chain([qd[2] - omega, qdd[2]]).fold(0.0, |m, e| m.max(e.abs()))
}
