//! Where to begin instead.

use serde::{Deserialize, Serialize};

use super::gap::Asks;

/// What leads to a position that is not singular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Elsewhere {
    /// Another time.   \[s\]
    Time(f64),
    /// Another value for a driver.
    Drive {
        /// The driver.
        constraint: String,
        /// What it asks for now, and what to ask for: where the coordinate stands at a position that is not
        /// singular.
        asks: Asks,
    },
}
