//! Names for the tables of [`crate::blame`], as emitted code writes them.

pub use crate::blame::table::{Given, Table, give, give_law, nothing_outside};
pub use crate::blame::trace::{Body, blame as traced};
pub use crate::proof::Series;
pub use crate::real::Dual3_64;
