//! Stores the diagnosis of a mechanism at one time and pose.

use serde::{Deserialize, Serialize};

use super::change::Change;
use super::dependency::{Class, Dependency};
use super::elsewhere::Elsewhere;
use super::freedom::{Freedom, Persistence};
use super::gap::Gap;
use crate::coordinates::units::Units;

/// The diagnosis of a mechanism at one time and pose, as data for programs.
///
/// `Display` writes a report for people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Diagnosis {
    /// The name of the mechanism.
    pub mechanism: String,
    /// The time.   \[s\]
    pub t: f64,
    /// Names of the units of length and time.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The examined pose: an assembled pose, or the pose with the smallest gap if the mechanism
    /// cannot be assembled. \[m, rad\]
    pub q: Vec<f64>,
    /// Number of coordinates n.
    pub coordinates: usize,
    /// Number of equations m, including those of Euler parameters.
    pub equations: usize,
    /// Number of equations of drivers.
    pub drivers: usize,
    /// Number of freedoms by counting (Grübler): n minus the equations that do not drive.
    pub gruebler: isize,
    /// Number of freedoms that the joints leave: n minus the rank of the joints' equations at
    /// nearby poses.
    pub mobility: usize,
    /// Rank of C_q at the pose.
    pub rank: usize,
    /// Rank of C_q at nearby poses of the same assembly, or at the pose itself if no nearby poses
    /// exist.
    pub nearby_rank: usize,
    /// True if nearby poses exist, or if the rank is full and Kin did not need nearby poses.
    pub moves: bool,
    /// The smallest accepted pivot divided by the largest rejected pivot. The decision about the
    /// rank is clear if this ratio is at least 1e6. \[-\]
    #[serde(with = "super::unbounded")]
    pub gap: f64,
    /// Constraints that cannot be satisfied together with all others, with their smallest
    /// residuals.
    pub gaps: Vec<Gap>,
    /// Sets of equations that depend on one another.
    pub dependencies: Vec<Dependency>,
    /// Motions that no constraint holds or drives.
    pub freedoms: Vec<Freedom>,
    /// An alternative position at which to start, if only the examined position is singular;
    /// otherwise `None`.
    #[serde(default)]
    pub elsewhere: Option<Elsewhere>,
    /// The smallest set of changes after which the mechanism is exactly constrained. The list is
    /// empty if no change is necessary, or if Kin finds no change that helps.
    pub changes: Vec<Change>,
}

impl Diagnosis {
    /// Returns true if the mechanism can be driven at this pose: the diagnosis contains no
    /// contradiction and no free motion.
    pub fn can_be_driven(&self) -> bool {
        self.rank == self.coordinates
            && self.contradictions().next().is_none()
            && self.gaps.is_empty()
    }

    /// Returns true if the mechanism has as many equations as coordinates, and all equations are
    /// independent.
    pub fn is_exactly_constrained(&self) -> bool {
        self.can_be_driven() && self.equations == self.coordinates
    }

    /// Returns the dependencies between equations that can be satisfied together, at this pose and
    /// nearby.
    pub fn redundancies(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| found.class == Class::Redundant)
    }

    /// Returns the dependencies between equations that cannot be satisfied together.
    pub fn contradictions(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| matches!(found.class, Class::Contradictory { .. }))
    }

    /// Returns the freedoms that also exist at nearby poses, so a driver or constraint is missing.
    pub fn lasting_freedoms(&self) -> impl Iterator<Item = &Freedom> {
        self.freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Always)
    }

    /// Returns true if the count of equations is right only because a redundant equation hides a
    /// missing one.
    pub fn count_misleads(&self) -> bool {
        self.equations == self.coordinates && self.nearby_rank < self.coordinates && self.moves
    }
}
