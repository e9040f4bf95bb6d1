//! Where to begin instead.

use serde::{Deserialize, Serialize};

use super::gap::Asks;

/// A way to a position that is not singular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Elsewhere {
    /// Another time.   \[s\]
    Time(f64),
    /// Another value for a driver.
    Drive {
        /// The driver.
        constraint: String,
        /// Its present value, and the one to ask for: where the coordinate stands at a position
        /// that is not singular.
        asks: Asks,
    },
}
