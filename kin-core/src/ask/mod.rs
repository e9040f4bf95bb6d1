//! Questions about mechanisms and motions: the calls of a system, diagnosis, proof, measures, and
//! whether the routes to derivatives agree.

mod build;
mod calls;
pub mod check;
pub mod diagnosis;
pub mod measure;
pub mod proof;
mod rates;
pub(crate) mod solver;
