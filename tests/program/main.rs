//! Runs by a program beside plain ones, as a user sees them: the same numbers, the same verdicts, and
//! refusals by name.

mod alike;
mod auto;
mod before;
mod foreign;
mod gallery;
mod jerk;
mod jumps;
mod refused;
mod summary;
mod told;

use kin::prelude::*;
use kin::{Engine, Options};

#[path = "../data/engines.rs"]
mod engines;

/// The defaults, compiled.
pub fn compiled() -> Options {
    Options { engine: Engine::Compiled, ..Options::default() }
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
