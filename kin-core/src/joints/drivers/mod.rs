//! Driving constraints: what a motor or a prescribed path asks for, as an equation with time in it.
//!
//! Those of coordinates and of planar bodies are here; those of spatial bodies are in [`spatial`].

mod planar;
pub mod spatial;

pub use planar::*;
