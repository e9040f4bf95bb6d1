//! The outcome of an import, and mistakes in a file.

use std::fmt;

use kin::Mechanism;

/// A mechanism out of a file, and what of the file is not in it.
#[derive(Clone)]
#[non_exhaustive]
pub struct Imported {
    /// The mechanism, its parts where the file has them.
    pub mechanism: Mechanism,
    /// Everything that was left out, in the order of the file.
    pub left_out: Vec<LeftOut>,
    /// The times at which the other program solves it; none where the file does not say.   \[s\]
    pub times: Vec<f64>,
}

/// Something of a file that Kin has no place for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOut {
    /// The line of the file, counted from 1.
    pub line: usize,
    /// Its name, with its kind.
    pub name: String,
    /// Why it is left out.
    pub reason: String,
    /// True if the mechanism may move otherwise, or other forces act in it: a joint, a motion, a
    /// load.
    pub matters: bool,
}

impl fmt::Display for LeftOut {
    /// "line 210: CurveCurveContact `Joint3` is left out: …"
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: Kin leaves out {}: {}", self.line, self.name, self.reason)
    }
}

/// A file that cannot be read, at the line where it cannot.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mistake {
    /// The line of the file, counted from 1; 0 where it is the whole file.
    pub line: usize,
    /// The reason.
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
