//! Something to look at: charts, drawings of a mechanism, a page that moves, an animated picture. Nothing here needs a network.
//!
//! * [`Figure`] and [`Panel`]: quantities over time and paths in the plane, as SVG.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod color;
mod figure;
mod file;

pub use figure::{Figure, Panel};
