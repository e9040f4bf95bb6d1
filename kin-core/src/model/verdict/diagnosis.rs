//! The verdict on a mechanism at one time and pose.

use serde::{Deserialize, Serialize};

use super::change::Change;
use super::dependency::{Class, Dependency};
use super::elsewhere::Elsewhere;
use super::freedom::{Freedom, Persistence};
use super::gap::Gap;
use crate::model::units::Units;

/// Diagnosis of a mechanism at one time and pose: data for programs; `Display` is a report for
/// people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Diagnosis {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The time.   \[s\]
    pub t: f64,
    /// Names of the units of length and time.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The pose that was examined: assembled, or where the smallest gap was found.   \[m, rad\]
    pub q: Vec<f64>,
    /// Number of coordinates n.
    pub coordinates: usize,
    /// Number of equations m, those of Euler parameters included.
    pub equations: usize,
    /// How many of the equations are of driving constraints.
    pub drivers: usize,
    /// Freedoms by counting (Grübler): n less the equations that do not drive.
    pub gruebler: isize,
    /// Freedoms that the joints do leave: n less their rank at nearby poses.
    pub mobility: usize,
    /// Rank of C_q at the pose.
    pub rank: usize,
    /// Rank of C_q at nearby poses of the same assembly; that at the pose where there are none.
    pub nearby_rank: usize,
    /// True if there are nearby poses, or no need to look for any because the rank is full.
    pub moves: bool,
    /// The smallest pivot that counted over the largest that did not: 1e6 and more is
    /// clear.   \[-\]
    #[serde(with = "super::unbounded")]
    pub gap: f64,
    /// Constraints that cannot be met together with all others, with what is missing at the least.
    pub gaps: Vec<Gap>,
    /// Sets of equations that depend on one another.
    pub dependencies: Vec<Dependency>,
    /// Motions that nothing holds or drives.
    pub freedoms: Vec<Freedom>,
    /// Where to begin instead, at a position that is singular alone.
    #[serde(default)]
    pub elsewhere: Option<Elsewhere>,
    /// The least change after which the mechanism is exactly constrained; empty where nothing is to
    /// be changed or nothing helps.
    pub changes: Vec<Change>,
}

impl Diagnosis {
    /// True if the mechanism can be driven at this pose: nothing contradicts, nothing is left free.
    pub fn can_be_driven(&self) -> bool {
        self.rank == self.coordinates
            && self.contradictions().next().is_none()
            && self.gaps.is_empty()
    }

    /// True if there are as many equations as coordinates, all independent.
    pub fn is_exactly_constrained(&self) -> bool {
        self.can_be_driven() && self.equations == self.coordinates
    }

    /// Dependencies between equations that can be met together, at this pose and nearby ones.
    pub fn redundancies(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| found.class == Class::Redundant)
    }

    /// Dependencies between equations that cannot be met together.
    pub fn contradictions(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| matches!(found.class, Class::Contradictory { .. }))
    }

    /// Freedoms that are left at nearby poses too: something is not driven.
    pub fn lasting_freedoms(&self) -> impl Iterator<Item = &Freedom> {
        self.freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Always)
    }

    /// True if the count is right only because a superfluous equation hides a missing one.
    pub fn count_misleads(&self) -> bool {
        self.equations == self.coordinates && self.nearby_rank < self.coordinates && self.moves
    }
}
