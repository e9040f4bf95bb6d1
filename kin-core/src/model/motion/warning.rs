//! Warnings of a motion: usual slips that still give a motion.

use serde::{Deserialize, Serialize};

/// Kinds of [`Warning`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum WarningKind {
    /// A number looks like an angle in degrees, where Kin reads radians.
    Degrees,
    /// The first position of a body is far from the drawn one.
    FarFromDrawn,
    /// The run begins at a position that is singular, or nearly so.
    SingularStart,
    /// The run goes on beyond the end of a table of a law.
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

/// A usual slip that Kin sees in a run that succeeds. The numbers of the motion are right for the
/// mechanism as it was described, but the mechanism may not be the one that was meant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Warning {
    /// Kind of the warning.
    pub kind: WarningKind,
    /// The constraints, bodies, coordinates and measures that the warning concerns, by the names
    /// that the user gave.
    pub names: Vec<String>,
    /// The warning in plain sentences: what Kin sees, and what to do.
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
