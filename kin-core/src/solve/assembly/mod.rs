//! Finds poses from poor guesses: the nearest pose, all poses, or the smallest gap if no pose
//! exists.

mod complete;
mod finder;
mod groups;
mod known;
mod label;
pub(crate) mod levenberg_marquardt;
pub(crate) mod modes;
pub(crate) mod options;
mod preferred;
pub(crate) mod search;
mod turn;
pub(crate) mod turned_over;

pub use complete::{Assemblies, Assembly, Complete};
pub use label::Label;
pub use options::{AssemblyOptions, SearchOptions};
pub(crate) use preferred::{apart, distance};
