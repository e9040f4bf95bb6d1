//! Compiles a whole mechanism to one program: all equations in one graph, with explicit coordinates
//! substituted and the rest eliminated, as straight-line stages.
//!
//! The passes are pure, one in each file, in this order:
//!
//! 1. `kind` differentiates one kind of constraint.
//! 2. `gather` collects all constraints in one graph. Numbers that differ from case to case become
//!    inputs; values of time that only the user's program knows become laws.
//! 3. `substitute` finds the coordinates that a row determines.
//! 4. `eliminate` solves the linear systems of the rest.
//! 5. `stages` builds the stages, and `schedule` converts them to a tape.
//!
//! `replay` runs a tape over any type of number. `newton` solves with a tape: many times of one run
//! in lanes (`times`), or one time (`alone`). `along` makes tapes of results along a known motion.

mod along;
mod blocks;
mod cofactors;
mod eliminate;
mod gather;
mod kind;
#[cfg(test)]
pub(crate) mod plant;
mod print;
mod reduce;
mod refusal;
mod stages;
mod substitute;
mod tape;
#[cfg(test)]
pub(crate) mod tests;
mod transposed;

pub(crate) use along::{Asked, Guarded};
pub(crate) use blocks::blocks;
pub(crate) use eliminate::Elimination;
pub(crate) use gather::{Case, Column, Differences, Leaves, Row, Whole, columns, gather_where};
pub(crate) use kind::SELF;
pub(crate) use print::{Sample, Sheet, Symbol, equations, file};
pub(crate) use reduce::Reduced;
pub(crate) use refusal::{Obstacle, Refusal};
#[cfg(test)]
pub(crate) use stages::Program;
pub(crate) use stages::{Pose, program, program_of_cases};
pub(crate) use tape::{IntoRows, Masks, Straight, Summed, Tape, alone, schedule, straight, times};
pub(crate) use transposed::take;
