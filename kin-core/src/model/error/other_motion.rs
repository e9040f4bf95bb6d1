//! A motion that is asked of a system which is not, or no longer, the one that it is a motion of.

use crate::model::units::Units;
use crate::model::words;

/// A motion of another system, or of one that has been changed since: at one of its times an
/// equation does not hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "the motion is not one of \"{system}\" as it is now: at t = {} `{equation}` is {} off. Run it again after what was \
     set since",
    words::at(*.t, .units),
    words::time(*.off)
)]
#[non_exhaustive]
pub struct OtherMotion {
    /// The system that was asked.
    pub system: String,
    /// The equation that does not hold.
    pub equation: String,
    /// By how much it is off, in the unit of its row.
    pub off: f64,
    /// Time.   \[s\]
    pub t: f64,
    /// Names of the units of length and time.
    pub units: Units,
}
