//! Functions that explain a failed run. The diagnosis is in a higher room, so solvers receive it as
//! functions.

use crate::model::error::Error;
use crate::solve::newton::SolverOptions;
use crate::system::System;
use crate::system::scaled::Model;

/// Where a diagnosis begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start<'a> {
    /// A guess, from which the mechanism must be assembled.
    Guess(&'a [f64]),
    /// A pose with C = 0, at least nearly.
    Pose(&'a [f64]),
}

/// The functions that find out why a run has failed.
#[derive(Clone, Copy)]
pub(crate) struct Explain {
    /// Returns the error of a mechanism that cannot be driven at a time, with its diagnosis.
    pub cannot_be_driven: fn(Model<'_>, Start<'_>, f64, &SolverOptions) -> Error,
    /// Adds to an error of a run what is wrong with the mechanism at that time, if the system is
    /// small enough.
    pub explained: fn(Error, &System, &SolverOptions) -> Error,
}
