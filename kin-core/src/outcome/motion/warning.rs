//! Describes the warnings of a motion: common mistakes with which a run still succeeds.

use std::f64::consts::FRAC_PI_4;

use serde::{Deserialize, Serialize};

/// The largest number of warnings of one kind: a hundred bodies with the same slip need one cure.
pub(crate) const MOST: usize = 4;

/// Angles whose multiple of 45° is off by less are meant in radians: "300 turns", "π/4". \[-\]
const EXACT: f64 = 1e-9;

/// Kinds of [`Warning`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum WarningKind {
    /// A number looks like an angle in degrees, but Kin expects radians.
    Degrees,
    /// The first position of a body is far from its drawn position.
    FarFromDrawn,
    /// The run begins at or near a singular position.
    SingularStart,
    /// The run continues beyond the end of the table of a law.
    BeyondRange,
}

impl std::fmt::Display for WarningKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            WarningKind::Degrees => "degrees",
            WarningKind::FarFromDrawn => "far from drawn",
            WarningKind::SingularStart => "singular start",
            WarningKind::BeyondRange => "beyond range",
        })
    }
}

/// A common mistake that Kin suspects although the run succeeds.
///
/// The numbers of the motion are correct for the mechanism in the program, but the user may have
/// intended another mechanism.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Warning {
    /// The kind of the warning.
    pub kind: WarningKind,
    /// The constraints, bodies, coordinates and measures that the warning concerns, by the names
    /// that the user gave.
    pub names: Vec<String>,
    /// The text of the warning: the observation, and what to do.
    pub text: String,
}

impl Warning {
    pub(crate) fn new(kind: WarningKind, names: &[&str], text: String) -> Self {
        let names = names.iter().map(|name| name.to_string()).collect();
        Warning { kind, names, text }
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// An angle to one decimal.
pub(crate) fn shown(angle: f64) -> f64 {
    (angle * 10.0).round() / 10.0
}

/// True of a number that people write in radians: a multiple of π/4, such as 300 turns.
pub(crate) fn is_usual(angle: f64) -> bool {
    let eighths = angle / FRAC_PI_4;
    (eighths - eighths.round()).abs() <= EXACT * eighths.abs().max(1.0)
}
