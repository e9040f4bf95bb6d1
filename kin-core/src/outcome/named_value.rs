//! A number with its name and unit.

use std::fmt;

use crate::outcome::words;

/// The value of one driver or of one measure of a joint.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct NamedValue {
    /// The name: of a driver that of its constraint, or `NAME.LAW` if the constraint has several
    /// laws of time.
    pub name: String,
    /// The unit, such as `rad` or `m`; `None` if it is unknown.
    pub unit: Option<String>,
    /// The value, in this unit.
    pub value: f64,
}

impl fmt::Display for NamedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` = {}", self.name, words::time(self.value))?;
        match &self.unit {
            Some(unit) => write!(f, " {unit}"),
            None => Ok(()),
        }
    }
}
