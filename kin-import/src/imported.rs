//! Stores the result of an import, and mistakes in a file.

use std::fmt;

use kin::Mechanism;

/// A mechanism from a file, and the parts of the file that the mechanism omits.
#[derive(Clone)]
#[non_exhaustive]
pub struct Imported {
    /// The mechanism, with its parts at their positions in the file.
    pub mechanism: Mechanism,
    /// The omitted parts of the file, in the order of the file.
    pub left_out: Vec<LeftOut>,
    /// The times at which the other program solves the mechanism; empty if the file contains no
    /// times. \[s\]
    pub times: Vec<f64>,
}

/// A part of a file that Kin cannot represent.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOut {
    /// The line of the file, counted from 1.
    pub line: usize,
    /// The name of the part, with its kind.
    pub name: String,
    /// The reason why Kin omits the part.
    pub reason: String,
    /// True if the omission can change the motion or the forces of the mechanism: a joint, a
    /// motion, a load.
    pub matters: bool,
}

impl fmt::Display for LeftOut {
    /// "line 210: CurveCurveContact `Joint3` is left out: …"
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: Kin leaves out {}: {}", self.line, self.name, self.reason)
    }
}

/// A mistake in a file that Kin cannot read, with its line.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mistake {
    /// The line of the file, counted from 1; 0 if the mistake concerns the whole file.
    pub line: usize,
    /// A description of the mistake.
    pub reason: String,
}

impl Mistake {
    pub(crate) fn at(line: usize, reason: impl Into<String>) -> Mistake {
        Mistake { line, reason: reason.into() }
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(&self.reason),
            line => write!(f, "line {line}: {}", self.reason),
        }
    }
}

impl std::error::Error for Mistake {}
