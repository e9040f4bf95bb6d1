//! What is asked of mechanisms and motions: the calls of a system, diagnosis, proof, measures, and whether the routes to derivatives agree.

mod calls;
pub mod check;
pub mod diagnosis;
pub mod measure;
pub mod proof;
