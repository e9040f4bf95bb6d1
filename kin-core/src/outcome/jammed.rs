//! Mechanisms that friction jams.

use crate::coordinates::units::Units;
use crate::outcome::words;

/// Friction jams the mechanism: no finite forces of its drivers move it along the motion.
///
/// Kin increases friction from zero to its full size. If friction jams the mechanism, the forces
/// grow without bound before friction reaches its full size, or no solution exists. Beyond this
/// limit a driver would have to pull although it pushes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "friction in `{constraint}` jams the mechanism at t = {}: a fraction {share:.3} of this friction already requires infinite forces{}. Make the guide longer, make the pin or the coefficient of friction smaller, or drive the part closer to its line of motion",
    words::at(*.t, .units), driven(.drives)
)]
#[non_exhaustive]
pub struct Jammed {
    /// The joint whose friction jams the mechanism. If several joints have friction, the field
    /// names the joint that dissipates the most power.
    pub constraint: String,
    /// The first time of the motion at which friction jams the mechanism. \[s\]
    pub t: f64,
    /// The fraction of the full friction at which forces have no bound; 1 if the mechanism is about
    /// to jam. \[-\]
    pub share: f64,
    /// The drivers that work against the friction.
    pub drives: Vec<String>,
    /// Names of the units of length and time.
    pub units: Units,
}

fn driven(drives: &[String]) -> String {
    if drives.is_empty() { String::new() } else { format!(" of {}", words::list(drives)) }
}
