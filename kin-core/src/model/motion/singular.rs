//! Singular positions that a run has met.

use serde::{Deserialize, Serialize};

use super::{Event, EventKind};
use crate::model::units::Units;

/// Kinds of singular positions of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum SingularKind {
    /// A toggle: time cannot go on, there is no position beyond.
    TurningPoint,
    /// A change point: branches of the motion cross.
    Bifurcation,
}

/// One branch through a singular position, by its rates there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Branch {
    /// q̇   \[m/s, rad/s\]
    pub qd: Vec<f64>,
    /// q̈   \[m/s², rad/s²\]
    pub qdd: Vec<f64>,
}

/// A position at which C_q is singular, met by a motion between times of the grid or at one of
/// them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SingularPosition {
    /// When it is reached.   \[s\]
    pub t: f64,
    /// Kind of the singular position.
    pub kind: SingularKind,
    /// The position.   \[m, rad\]
    pub q: Vec<f64>,
    /// Bodies and coordinates that can move there although everything that drives stands still.
    pub movable: Vec<String>,
    /// Equations that depend on one another there.
    pub dependent: Vec<String>,
    /// The branches that cross there, the one that was taken first; a branch on which the drivers
    /// stand still is not among them. None at a turning point, where q̇ has no bound.
    pub branches: Vec<Branch>,
}

impl SingularPosition {
    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &f64> {
        let rates = self.branches.iter().flat_map(|branch| branch.qd.iter().chain(&branch.qdd));
        [&self.t].into_iter().chain(&self.q).chain(rates)
    }

    /// The same as an event.
    pub(crate) fn event(&self) -> Event {
        let names: Vec<String> = self.movable.iter().map(|name| format!("`{name}`")).collect();
        let can = format!("{} can move although what drives stands still", names.join(", "));
        let (kind, text) = match self.kind {
            SingularKind::TurningPoint => (
                EventKind::TurningPoint,
                format!("a toggle, beyond which there is no position: {can}"),
            ),
            SingularKind::Bifurcation => (
                EventKind::Bifurcation,
                format!("a change point, where branches of the motion cross: {can}"),
            ),
        };
        Event { t: self.t, units: Units::default(), kind, name: self.movable.join(", "), text }
    }
}
