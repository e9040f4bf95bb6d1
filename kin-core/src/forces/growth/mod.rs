//! Computes the growth of forces near singular positions, where C_qᵀ λ = Q has no solution.
//!
//! Near a singular position the smallest singular value of C_q is proportional to the distance s
//! along the path. The time |t − t*| is proportional to s² at a toggle and to s at a change point.
//! So forces grow as a power of |t − t*|. The exponent is −1 at a change point. At a toggle the
//! exponent is −½ for loads at rest and −2 for masses, because accelerations have no bound at a
//! toggle. Kin determines the exponent from forces along the path, for any mechanism.

mod approach;
mod asked;
mod power;

use super::acting::Now;
use crate::outcome::error::{Error, FailureKind, Result};
use crate::outcome::growth::{Growth, Unbounded};
use crate::solve::follow::SingularPosition;
use crate::solve::motion::Motion;
use crate::system::System;
use crate::system::evaluate::Block;
use approach::{Approach, Side};
use power::{Values, power};

/// An exponent above this value counts as zero. \[-\]
const FLAT: f64 = -0.04;

/// Times that differ by less than this share of the step of the motion are equal. \[-\]
const AT_ONCE: f64 = 1e-6;

/// The generalised forces of everything except constraints, Q_e + Q_v − M q̈.
pub(super) type Acting<'a> = &'a mut dyn FnMut(Now<'_>) -> Result<Vec<f64>>;

/// Returns the growth towards one singular position, in the order of the constraints.
fn towards(
    system: &System,
    motion: &Motion,
    to: &SingularPosition,
    acting: Acting<'_>,
) -> Result<Vec<Growth>> {
    let blocks = &system.equations().blocks;
    let mut steepest = vec![0.0_f64; blocks.len()];
    for side in [Side::Before, Side::After] {
        let Some(approach) = Approach::new(system, motion, (to, side), acting)? else { continue };
        let Approach { times, ways, sizes } = &approach;
        for part in sizes {
            for (steepest, sizes) in steepest.iter_mut().zip(part) {
                let of = sizes.as_ref().map(|sizes| Values { times, ways, sizes });
                let found = of.and_then(|of| power(&of)).unwrap_or(0.0);
                *steepest = steepest.min(found);
            }
        }
    }
    let grows = blocks
        .iter()
        .zip(steepest)
        .filter(|(block, power)| *power < FLAT && block.constraint.facts().kind != "euler_norm");
    let units = system.unit_words();
    let told = |(block, power): (&Block, f64)| Growth {
        constraint: block.name.clone(),
        t: to.t,
        power,
        units: units.clone(),
    };
    Ok(grows.map(told).collect())
}

/// Converts an error of forces at time t to a report of what grows there, if t is a singular
/// position of the motion.
pub(super) fn explained(
    system: &System,
    motion: &Motion,
    t: f64,
    error: Error,
    acting: Acting<'_>,
) -> Error {
    let times = motion.times();
    let step =
        times.windows(2).fold(f64::INFINITY, |least, two| least.min((two[1] - two[0]).abs()));
    let is_here = |position: &&SingularPosition| (position.t - t).abs() <= AT_ONCE * step;
    let Some(position) = motion.singular_positions().iter().find(is_here) else { return error };
    match (error.kind(), towards(system, motion, position, acting)) {
        (Some(FailureKind::SingularAt { .. }), Ok(growth)) if !growth.is_empty() => {
            Box::new(Unbounded { t, growth, units: system.unit_words().clone() }).into()
        }
        _ => error,
    }
}
