//! The diagnosis of a failed run lives in a room above; solvers carry it as functions.

use crate::model::error::Error;
use crate::solve::newton::SolverOptions;
use crate::system::System;
use crate::system::scaled::Model;

/// Where an examination begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start<'a> {
    /// A guess, from which the mechanism is assembled first.
    Guess(&'a [f64]),
    /// A pose at which C = 0 holds, or nearly.
    Pose(&'a [f64]),
}

/// The functions that find out why a run has failed.
#[derive(Clone, Copy)]
pub(crate) struct Explain {
    /// The error of a mechanism that cannot be driven at a time, with its diagnosis.
    pub cannot_be_driven: fn(Model<'_>, Start<'_>, f64, &SolverOptions) -> Error,
    /// An error of a run with what is wrong with the mechanism at that time, as far as the size of
    /// the system allows to look for it.
    pub explained: fn(Error, &System, &SolverOptions) -> Error,
}
