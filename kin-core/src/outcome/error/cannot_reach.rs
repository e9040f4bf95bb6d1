//! A follower that stops on its way.

use std::fmt;

use crate::outcome::motion::{Motion, SingularKind};
use crate::outcome::named_value::NamedValue;
use crate::outcome::words::{joined, list};

/// Why a follower stopped before the driver values that a call gave it, and where.
#[derive(Debug)]
#[non_exhaustive]
pub struct CannotReach {
    /// The drivers that were moved, with the values that the call gave.
    pub asked: Vec<NamedValue>,
    /// The same drivers at the place where the follower stopped.
    pub reached: Vec<NamedValue>,
    /// The kind of the singular position there; `None` if another reason stopped the follower.
    pub singular: Option<SingularKind>,
    /// Bodies and coordinates that can move there while all drivers are at rest.
    pub movable: Vec<String>,
    /// Equations that depend on one another there.
    pub dependent: Vec<String>,
    /// The configuration there, as a motion of one time with all drivers at rest.
    pub motion: Motion,
    /// The reason, if the place is not a singular position.
    pub reason: String,
}

impl fmt::Display for CannotReach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values = |all: &[NamedValue]| {
            joined(&all.iter().map(NamedValue::to_string).collect::<Vec<_>>(), "and")
        };
        let verb = if self.singular.is_some() { "stops" } else { "stays" };
        write!(
            f,
            "the follower {verb} at {} on its way to {}.",
            values(&self.reached),
            values(&self.asked)
        )?;
        match self.singular {
            Some(kind) => {
                let place = match kind {
                    SingularKind::TurningPoint => "a toggle, beyond which no position exists",
                    SingularKind::Bifurcation => {
                        "a change point, where branches of the motion cross"
                    }
                };
                write!(f, " The follower reached {place}")?;
                if !self.movable.is_empty() {
                    let can = list(&self.movable);
                    write!(f, ": {can} can move at this position while the drivers stand still")?;
                }
                f.write_str(".")?;
                if !self.dependent.is_empty() {
                    write!(
                        f,
                        " These equations depend on one another: {}.",
                        list(&self.dependent)
                    )?;
                }
            }
            None => write!(f, " The reason is: {}.", self.reason)?,
        }
        f.write_str(" Give values before this position, or begin with another assembly")
    }
}

impl std::error::Error for CannotReach {}
