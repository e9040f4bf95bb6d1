//! Runs by a program beside plain ones, as a user sees them: the same numbers, the same verdicts,
//! and refusals by name.

mod alike;
mod auto;
mod campaign;
mod foreign;
mod gallery;
mod jerk;
mod jumps;
mod refused;
mod singly;
mod summary;
mod told;

use kin::prelude::*;
use kin::{Engine, SolverOptions};

#[path = "../data/engines.rs"]
mod engines;
#[path = "../data/families.rs"]
mod families;
#[path = "../data/steps.rs"]
mod steps;

/// The defaults, compiled.
pub fn compiled() -> SolverOptions {
    SolverOptions::new().engine(Engine::Compiled)
}

/// Lengths of crank, coupler, rocker and ground of the four-bar that most tests take.
pub const USUAL: [f64; 4] = [1.0, 3.5, 3.0, 4.0];

/// A four-bar of these lengths, its rocker near 100°; `motor` is given its crank and its rocker.
pub fn four_bar([a, b, c, d]: [f64; 4], motor: impl FnOnce(&mut Mechanism, Link, Link)) -> System {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [("crank", a), ("coupler", b), ("rocker", c)]
        .map(|(name, l)| m.link(name, l).expect("a link"));
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).expect("adds");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("adds");
    m.add("C", revolute(Ground, rocker, vec2(d, 0.0), rocker.start())).expect("adds");
    motor(&mut m, crank, rocker);
    m.prefer(rocker, deg(100.0));
    m.build().expect("builds")
}

/// The largest differences of q, q̇ and q̈, by 1 and the size of the number.
pub fn differences(a: &Motion, b: &Motion) -> [f64; 3] {
    assert_eq!(a.times(), b.times());
    let mut most = [0.0_f64; 3];
    for k in 0..a.len() {
        for (order, (a, b)) in
            [(a.q(k), b.q(k)), (a.qd(k), b.qd(k)), (a.qdd(k), b.qdd(k))].into_iter().enumerate()
        {
            let off = a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + a.abs()));
            most[order] = off.fold(most[order], |m, x| if x <= m { m } else { x });
        }
    }
    most
}
