//! Derivatives of a motion by parameters as one tape of the whole mechanism, replayed over several
//! times of the motion at once: what `along.rs` walks equation by equation, and the solves with it.
//!
//! The position and its rates are known, so that nothing is iterated: C_q, C_p and their
//! derivatives by time are nodes of coordinates and rates (`nodes.rs`), the points of a turning
//! body made of shared sums (`turns.rs`), C_q is eliminated in an order that is chosen at one time
//! of the motion, and what is asked for are outputs: the derivatives (`forward.rs`), or one sum of
//! them (`backward.rs`). A time at which a pivot is small beside what it was there is left to the
//! walk.

use crate::solve::motion::Motion;

mod backward;
mod forward;
mod nodes;
#[cfg(test)]
mod tests;
mod turns;

pub(super) use backward::adjoint;
pub(super) use forward::forward;

/// Times from which on compiling saves more than it takes: of W1, W3 and W5 it takes what the walk
/// takes for forty of them.
const LEAST: usize = 50;

/// True if a motion has so many times that a tape is worth its while.
pub(super) fn pays(motion: &Motion) -> bool {
    motion.len() >= LEAST
}
