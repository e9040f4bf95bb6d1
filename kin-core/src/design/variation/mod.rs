//! Computes derivatives of a motion by parameters with one tape of the whole mechanism, for several
//! times of the motion at once.
//!
//! The position and its derivatives are known, so the tape needs no iteration. C_q, C_p and their
//! time derivatives are nodes of coordinates and velocities (`nodes.rs`); points of a rotating body
//! share their sums (`turns.rs`). Kin chooses the order of the elimination of C_q at one time of
//! the motion. The outputs are the derivatives (`forward.rs`), or one sum of the derivatives
//! (`backward.rs`). If a pivot at some time is small relative to the pivot at the chosen time,
//! `along.rs` computes this time equation by equation.

use crate::solve::motion::Motion;

mod backward;
mod forward;
mod nodes;
#[cfg(test)]
mod tests;
mod turns;

pub(super) use backward::adjoint;
pub(super) use forward::forward;

/// The number of times from which compiling is faster. For W1, W3 and W5 compiling takes as long as
/// about forty times.
const LEAST: usize = 50;

/// Returns true if a motion has enough times for a tape.
pub(super) fn pays(motion: &Motion) -> bool {
    motion.len() >= LEAST
}
