//! Diagnoses a mechanism, with or without faults, and names the user's bodies and constraints.
//!
//! A mechanism of n coordinates and m equations can be driven if C_q has rank n. The equations then
//! determine every coordinate, and m − n equations repeat others. [`Diagnosis`] contains:
//!
//! * the counts, and the rank of C_q at the pose and at nearby poses of the same assembly,
//! * for each dependency a minimal set of equations with their coefficients,
//! * for each freedom the bodies that move, and how,
//! * the smallest change that helps.
//!
//! For ranks Kin measures lengths in units of a typical length of the model and divides every row
//! by its norm. So the diagnosis is the same in mm, m and km. The solver and the diagnosis treat
//! pivots below 1e-7 as zero. [`Diagnosis::gap`] says how clear the decision about the rank is.

mod contradiction;
mod cure;
mod dependency;
mod elsewhere;
mod examine;
mod examined;
pub(crate) mod explain;
mod freedom;
mod gap;
mod generic;
mod nearest;
pub(in crate::ask) mod order;
mod rank;
mod search_under_way;

pub(crate) use examine::diagnose;

pub use crate::outcome::verdict::{
    Against, Asks, BodyMotion, Change, Class, Dependency, Diagnosis, Elsewhere, Freedom, Gap,
    GlobalPoint, How, Level, Persistence, Play, Resize, Size, Step, Term,
};
