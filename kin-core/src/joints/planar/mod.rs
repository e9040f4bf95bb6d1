//! Defines the joints between planar bodies.
//!
//! Local positions `u_i`, `u_j` and directions `h_i`, `h_j` are in the frames of bodies i and j.
//! Angles are counter-clockwise positive.

mod couplings;
mod curves;
mod moving;
mod pins;
mod slides;
mod terms;

pub use couplings::*;
pub use curves::*;
pub use moving::*;
pub use pins::*;
pub use slides::*;
