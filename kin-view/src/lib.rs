//! Draws charts, mechanisms, animated pictures and interactive pages.
//!
//! No picture or page needs a network.
//!
//! * [`Figure`] and [`Panel`]: quantities over time and paths in the plane, as SVG.
//! * [`Scene`]: describes how a mechanism is drawn. A scene creates a [`Picture`] (at a time, as a
//!   sequence, or animated) and a [`Page`].
//! * [`Bars`]: the share of each dimension in a tolerance.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod bars;
mod color;
mod drawing;
mod figure;
mod file;
mod gallery;
mod map;
mod page;
mod picture;
mod scene;

pub use bars::Bars;
pub use figure::{Figure, Panel};
pub use gallery::Gallery;
pub use map::Map;
pub use page::Page;
pub use picture::Picture;
pub use scene::{Body, Outline, Point, Scene};
