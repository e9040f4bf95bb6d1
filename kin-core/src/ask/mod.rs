//! The analyses of mechanisms and motions: the calls of a system, diagnosis, proof, measures, and
//! the check of derivatives.

mod build;
mod calls;
pub mod check;
pub(crate) mod circuit;
pub mod diagnosis;
pub mod emit;
pub mod follower;
pub mod measure;
pub mod proof;
mod rates;
pub(crate) mod released;
pub(crate) mod solver;
mod still;
