//! A whole mechanism as one program: all equations in one graph, what they give explicitly put in,
//! the rest eliminated, as straight-line stages.
//!
//! Pure passes, each a file, in their order: `kind` (derivatives of one kind of constraint),
//! `gather` (all constraints in one graph; what differs from case to case is left free, and values
//! of time that only the user's program knows are laws there), `substitute` (coordinates that a row
//! gives), `eliminate` (the linear systems of what is left), `stages`, `schedule` (the tape). Then
//! `replay` runs a tape over any number, `newton` solves with it, many times of one run in lanes
//! (`times`) or one time alone (`alone`); `along` makes tapes of what is asked of a motion that is
//! known.

mod along;
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

pub(crate) use along::{Asked, Guarded};
pub(crate) use blocks::blocks;
pub(crate) use eliminate::Elimination;
pub(crate) use gather::{
    ABROAD, Case, Column, Differences, Leaves, Refusal, Row, UNREAD, Whole, columns, gather_where,
};
pub(crate) use kind::SELF;
pub(crate) use reduce::Reduced;
#[cfg(test)]
pub(crate) use stages::Program;
pub(crate) use stages::{Pose, REDUNDANT, program, program_of_cases};
pub(crate) use tape::{IntoRows, Masks, NO_LANES, Summed, Tape, alone, schedule, times};
pub(crate) use transposed::take;
