//! Describes the error for a motion that does not belong to the present system.

use crate::coordinates::units::Units;
use crate::outcome::words;

/// A motion belongs to another system, or the system has changed after the run.
///
/// At one time of the motion an equation of the system is not satisfied.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "the motion does not belong to \"{system}\" with its present values: at t = {} the equation `{equation}` has the residual {} (in the unit of this equation). Run the system again",
    words::at(*.t, .units),
    words::time(*.off)
)]
#[non_exhaustive]
pub struct OtherMotion {
    /// The system that received the motion.
    pub system: String,
    /// The equation that is not satisfied.
    pub equation: String,
    /// The residual of the equation, in the unit of its row.
    pub off: f64,
    /// The time at which the equation is not satisfied. \[s\]
    pub t: f64,
    /// Names of the units of length and time.
    pub units: Units,
}
