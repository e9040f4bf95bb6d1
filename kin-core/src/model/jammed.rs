//! Mechanisms that friction holds fast.

use crate::model::units::Units;
use crate::model::words;

/// A mechanism that friction holds fast: no finite forces of its drives move it as the motion has
/// it. As friction grows from nothing, forces grow beyond all bounds, or end, before it has its
/// full size; beyond that a drive would have to pull where it pushes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "t = {}: jammed: at {share:.3} of its friction `{constraint}` already needs forces without bound{}. Make the \
     guide longer, the pin or the coefficient smaller, or drive it closer to the line on which it moves",
    words::at(*.t, .units), driven(.drives)
)]
#[non_exhaustive]
pub struct Jammed {
    /// The joint with the friction that holds: of several the one that takes most power.
    pub constraint: String,
    /// The first time of the motion at which it is jammed.   \[s\]
    pub t: f64,
    /// The share of all friction with which forces are without bound: 1 where it is about to
    /// jam.   \[-\]
    pub share: f64,
    /// The drives that work against it.
    pub drives: Vec<String>,
    /// Names of the units of length and time.
    pub units: Units,
}

fn driven(drives: &[String]) -> String {
    if drives.is_empty() {
        String::new()
    } else {
        format!(", whatever {} gives", words::list(drives))
    }
}
