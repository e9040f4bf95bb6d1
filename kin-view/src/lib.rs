//! Something to look at: charts, drawings of a mechanism, a page that moves, an animated picture.
//! Nothing here needs a network.
//!
//! * [`Figure`] and [`Panel`]: quantities over time and paths in the plane, as SVG.
//! * [`Scene`]: how a mechanism is drawn; from it a [`Picture`] at a time, as a sequence or
//!   animated, and a [`Page`].
//! * [`Bars`]: which dimensions a tolerance comes from.
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
