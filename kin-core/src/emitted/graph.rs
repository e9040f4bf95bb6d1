//! Names for the tables of [`crate::model::blame`], as emitted code writes them.

pub use crate::model::blame::trace::{Body, blame as traced};
pub use crate::model::formula::{Given, Table, give, give_law, nothing_outside};
pub use crate::numbers::enclosure::Series;
pub use crate::numbers::real::Dual3_64;
pub use kin_graph::{Graph, Node};
