//! Describes where to start instead of a singular position.

use serde::{Deserialize, Serialize};

use super::gap::Asks;

/// A way to reach a position that is not singular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Elsewhere {
    /// Another time. \[s\]
    Time(f64),
    /// Another value of a driver.
    Drive {
        /// The driver.
        constraint: String,
        /// The present value of the driver, and the coordinate's value at a position that is not
        /// singular.
        asks: Asks,
    },
}
