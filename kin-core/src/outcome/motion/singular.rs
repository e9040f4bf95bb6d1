//! Describes the singular positions of a run.

use serde::{Deserialize, Serialize};

use super::{Event, EventKind};
use crate::coordinates::units::Units;
use crate::outcome::words::list;

/// The kind of a singular position of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum SingularKind {
    /// A toggle: no position exists beyond this position.
    TurningPoint,
    /// A change point: branches of the motion cross.
    Bifurcation,
}

/// A branch through a singular position, with its velocities and accelerations at this position.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Branch {
    /// q̇   \[m/s, rad/s\]
    pub qd: Vec<f64>,
    /// q̈   \[m/s², rad/s²\]
    pub qdd: Vec<f64>,
}

/// A position with a singular C_q that a motion reaches, at or between times of the grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SingularPosition {
    /// The time. \[s\]
    pub t: f64,
    /// The kind of the singular position.
    pub kind: SingularKind,
    /// The position.   \[m, rad\]
    pub q: Vec<f64>,
    /// Bodies and coordinates that can move at the singular position while all drivers are at rest.
    pub movable: Vec<String>,
    /// Equations that depend on one another at the singular position.
    pub dependent: Vec<String>,
    /// The branches that cross at the singular position; the first branch is the one that the run
    /// took. The list omits a branch on which the drivers rest. The list is empty at a toggle,
    /// where q̇ has no bound.
    pub branches: Vec<Branch>,
}

impl SingularPosition {
    /// Returns all numbers of the position.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &f64> {
        let rates = self.branches.iter().flat_map(|branch| branch.qd.iter().chain(&branch.qdd));
        [&self.t].into_iter().chain(&self.q).chain(rates)
    }

    /// Returns the position as an event.
    pub(crate) fn event(&self) -> Event {
        let can = format!("{} can move while the drivers stand still", list(&self.movable));
        let (kind, text) = match self.kind {
            SingularKind::TurningPoint => (
                EventKind::TurningPoint,
                format!("a toggle, beyond which no position exists: {can}"),
            ),
            SingularKind::Bifurcation => (
                EventKind::Bifurcation,
                format!("a change point, where branches of the motion cross: {can}"),
            ),
        };
        Event { t: self.t, units: Units::default(), kind, name: self.movable.join(", "), text }
    }
}
