//! Moves from one solved time to the next.
//!
//! `stepper` is the step-by-step solver of mechanisms with as many equations as coordinates. The
//! loop of `advance` makes smaller steps of time where a whole step fails. `advance` and
//! `predictor` serve redundant mechanisms too ([`crate::solve::redundant`]).

pub(super) mod advance;
mod beyond;
pub(crate) mod moves;
pub(super) mod predictor;
mod resumed;
mod stepper;

pub(super) use stepper::Stepper;
