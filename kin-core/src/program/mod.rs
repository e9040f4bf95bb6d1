//! A whole mechanism as one program: all equations in one graph, what they give explicitly put in, the rest
//! eliminated, as straight-line stages.
//!
//! Pure passes, each a file, in their order: `kind` (derivatives of one kind of constraint), `gather` (all
//! constraints in one graph), `substitute` (coordinates that a row gives), `eliminate` (the linear systems of
//! what is left), `stages`, `schedule` (the tape). Then `replay` runs a tape over lanes, and `times` solves
//! many times of one run with it.

mod blocks;
mod cofactors;
mod eliminate;
mod gather;
mod kind;
#[cfg(test)]
pub(crate) mod plant;
mod reduce;
mod stages;
mod substitute;
mod tape;
#[cfg(test)]
pub(crate) mod tests;
mod transposed;

pub(crate) use eliminate::Elimination;
pub(crate) use gather::{ABROAD, Column, Leaves, Refusal, UNREAD, Whole, columns};
pub(crate) use kind::SELF;
pub(crate) use reduce::Reduced;
#[cfg(test)]
pub(crate) use stages::Program;
pub(crate) use stages::{At, Pose, REDUNDANT, numbers, program};
pub(crate) use substitute::{Explicit, constants, ordered};
pub(crate) use tape::{IntoRows, OverTimes, Rows, Straight, Summed, Tape, schedule, straight, times};
pub(crate) use transposed::take;
