//! Diagnosis of a mechanism, whether something is wrong with it or not, in the user's own names.
//!
//! A mechanism of n coordinates and m equations can be driven if C_q has rank n: then everything
//! has its place, and m − n equations repeat others. [`Diagnosis`] tells the count, the rank of C_q
//! at the pose and at poses near it in the same assembly, for each dependency between equations a
//! minimal set of them with coefficients, for each freedom left what moves and how, and the least
//! change that helps.
//!
//! Ranks are taken with lengths in units of the model's own typical length and every row by its
//! norm, so that verdicts are the same in mm, m and km. Pivots below 1e-7 of that count as zero,
//! for the solver as for a diagnosis; [`Diagnosis::gap`] tells how clear the cut was.

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
mod order;
mod rank;
mod search_under_way;

pub(crate) use examine::diagnose;

pub use crate::model::verdict::{
    Against, Asks, BodyMotion, Change, Class, Dependency, Diagnosis, Elsewhere, Freedom, Gap,
    GlobalPoint, How, Level, Persistence, Play, Resize, Size, Step, Term,
};
