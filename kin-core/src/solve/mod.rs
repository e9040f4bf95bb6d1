//! Computes positions, velocities and accelerations.
//!
//! The modules in order, each of which imports only from earlier ones:
//!
//! * `assembly`, `options`, `explain`: the search for a pose, the options of all solvers, and the
//!   diagnosis as functions.
//! * `newton`: one position by Newton's method, with its velocities and accelerations.
//! * `motion`, `first_run`: results derived from a motion, and warnings.
//! * `follow`: the checks that a step of time stays on its branch.
//! * `step`, `redundant`: one step of time, of mechanisms with as many equations as coordinates and
//!   with more.
//! * `run`, `compiled`, `whole_run`: one time after the other, many times with the compiled
//!   program, and a run with either engine.
//! * `sweep`, `circuit`, `free`: many runs, a curve of positions, and a surface of positions with
//!   the way on it towards wishes.

#[macro_use]
mod setters;

pub(crate) mod assembly;
pub(crate) mod circuit;
pub(crate) mod compiled;
pub(crate) mod explain;
pub(crate) mod first_run;
pub(crate) mod follow;
pub(crate) mod free;
pub mod motion;
pub(crate) mod newton;
pub mod options;
pub(crate) mod redundant;
pub(crate) mod run;
pub(crate) mod step;
pub mod sweep;
pub(crate) mod whole_run;
