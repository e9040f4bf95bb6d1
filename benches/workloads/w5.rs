//! W5: the Stewart platform, one spatial body on six legs.

use kin::prelude::*;
use kin::{EulerParameters, SpatialPose};

use crate::hand::stewart::{START, legs, run};
use crate::sweep::{Table, Workload, add, build, routes};

const DT: f64 = 1e-3;
const STEPS: usize = 10_001;

/// A leg from the base to a point of the platform: |r_P − b|² − L(t)² = 0.
#[constraint(symbolic)]
fn leg(platform: Spatial, u: Vec3, base: Vec3, length: Law, t: Time) -> f64 {
    let d = platform.point(u) - base;
    let l = length.at(t);
    d.norm_squared() - l * l
}

pub fn workload() -> Workload {
    Workload {
        name: "W5".to_string(),
        dt: DT,
        steps: STEPS,
        links: None,
        routes: routes(|| run(STEPS, DT), model),
        error: Box::new(error),
        allowed: 1e-5,
        build: Box::new(|| model(false)),
    }
}

fn model(dual: bool) -> System {
    let mut m = Mechanism::new("Stewart platform");
    let at = SpatialPose::new(vec3(0.0, 0.0, 1.0), EulerParameters::new(1.0, 0.0, 0.0, 0.0));
    let platform = m.spatial("platform", at).unwrap_or_else(|error| panic!("{error}"));
    for (i, l) in legs().iter().enumerate() {
        let length = Law::constant(l.l0 - 0.1 * l.phase.sin()) + Law::sine(0.1, PI, l.phase);
        let [u, base] = [l.u, l.base].map(|v| vec3(v[0], v[1], v[2]));
        add(&mut m, dual, &format!("leg{i}"), leg(platform, u, base, length));
    }
    let inertia = [[0.9, 0.02, -0.01], [0.02, 1.1, 0.03], [-0.01, 0.03, 1.6]];
    m.mass(platform, 30.0, vec3(0.02, -0.01, 0.05), inertia)
        .unwrap_or_else(|error| panic!("{error}"));
    m.gravity(vec3(0.0, 0.0, -9.81));
    build(m, &START)
}

/// Leg lengths; velocities and accelerations against central differences of q, of which the
/// differences themselves are most.
fn error(table: &Table) -> f64 {
    (0..table.len()).map(|k| leg_error(table, k).max(rate_error(table, k))).fold(0.0, f64::max)
}

fn leg_error(table: &Table, k: usize) -> f64 {
    let q = table.at(k).0;
    let turns = crate::hand::spatial_joints::rotation(&[q[3], q[4], q[5], q[6]]);
    let leg = |l: &crate::hand::stewart::Leg| {
        let d = (0..3)
            .map(|i| q[i] + turns[i].iter().zip(&l.u).map(|(a, u)| a * u).sum::<f64>() - l.base[i]);
        (d.map(|d| d * d).sum::<f64>().sqrt() - l.length(k as f64 * DT)[0]).abs()
    };
    legs().iter().map(leg).fold(0.0, f64::max)
}

fn rate_error(table: &Table, k: usize) -> f64 {
    if k == 0 || k + 1 == table.len() {
        return 0.0;
    }
    let before = table.at(k - 1).0;
    let (q, qd, qdd) = table.at(k);
    let after = table.at(k + 1).0;
    let first = |i: usize| qd[i] - (after[i] - before[i]) / (2.0 * DT);
    let second = |i: usize| qdd[i] - (after[i] - 2.0 * q[i] + before[i]) / (DT * DT);
    (0..q.len()).fold(0.0, |m, i| first(i).abs().max(second(i).abs()).max(m))
}
