//! Derivatives of a motion by parameters as one tape of the whole mechanism, replayed over several
//! times of the motion at once.
//!
//! The position and its derivatives are known, so nothing is iterated. C_q, C_p and their time
//! derivatives are nodes of coordinates and velocities (`nodes.rs`); points of a rotating body
//! share their sums (`turns.rs`). The elimination of C_q has an order that is chosen at one time of
//! the motion. The outputs are the derivatives (`forward.rs`), or one sum of them (`backward.rs`).
//! A time at which a pivot is small relative to its value at that time is computed by `along.rs`,
//! equation by equation.

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
