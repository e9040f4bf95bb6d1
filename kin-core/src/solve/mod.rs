//! Computes positions, velocities and accelerations: Newton's method, runs that stay on their
//! branch, assembly from poor guesses, sweeps, and motions.

#[macro_use]
mod setters;

pub(crate) mod assembly;
pub(crate) mod circuit;
pub(crate) mod compile;
pub(crate) mod explain;
pub(crate) mod first_run;
pub(crate) mod follow;
pub mod motion;
pub mod newton;
pub mod sweep;
