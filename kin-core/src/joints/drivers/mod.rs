//! Drivers: equations with time that prescribe the motion of a motor, a cylinder or a path.
//!
//! This module contains the drivers of coordinates and planar bodies. Those of spatial bodies are
//! in [`spatial`].

mod planar;
pub mod spatial;

pub use planar::*;
