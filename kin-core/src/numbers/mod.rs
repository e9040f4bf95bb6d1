//! Defines vectors and matrices, numbers that carry derivatives, lanes of SIMD registers, padded
//! vectors, and bounds.
//!
//! No module in this folder knows mechanisms.

pub mod algebra;
pub(crate) mod enclosure;
pub(crate) mod lanes;
mod offsets;
pub(crate) mod padded;
pub(crate) mod random;
pub mod real;
pub(crate) mod rounded;
pub(crate) mod wide;
pub(crate) mod with_rate;

pub use offsets::Offsets;
