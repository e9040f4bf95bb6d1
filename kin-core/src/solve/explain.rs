//! Holds the functions that explain a failed run.
//!
//! The diagnosis is in a module above the solvers, so the solvers receive the diagnosis as
//! functions.

use crate::outcome::error::Error;
use crate::solve::options::SolverOptions;
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
    /// Adds a diagnosis of the mechanism at the time of the failure to an error of a run, if the
    /// system is small enough.
    pub explained: fn(Error, &System, &SolverOptions) -> Error,
}
