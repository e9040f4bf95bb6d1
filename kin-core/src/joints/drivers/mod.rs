//! Defines drivers: equations with time that prescribe the motion of a motor, a cylinder or a path.
//!
//! This module contains the drivers of coordinates and planar bodies. The module [`spatial`]
//! contains the drivers of spatial bodies.

mod planar;
pub mod spatial;

pub use planar::*;
