//! Computes results of a motion: measures of joints, extremes and crossings with their exact times,
//! limits.
//!
//! A measure is any number over time: a name, a coordinate, or a function of a motion. For a time
//! between two times of the grid Kin solves the pose and does not interpolate.

mod assemblies;
mod between;
mod changes;
mod condition;
mod extremes;
mod fine;
mod joint;
pub(crate) mod kinks;
mod limits;
mod own;
mod passed;
mod ranges;
mod roots;

pub(crate) use between::quintic;
pub use extremes::{Extreme, Extremes};
pub use roots::Crossing;

use crate::coordinates::Coordinate;
use crate::coordinates::layout::Place;
use crate::outcome::error::Result;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// A quantity over time that a motion determines.
///
/// A measure is a name (`"slot.slide"` of a joint, `"crank.theta"` of a coordinate; also a
/// `String`), a coordinate (`crank.theta()`), or a function such as
/// `|m: &Motion| m.transmission_angle(coupler, rocker)`.
pub trait Measure {
    /// Returns the measure over the times of a motion of the system, with its derivatives.
    fn of(&self, system: &System, motion: &Motion) -> Result<Quantity>;

    /// Returns the name of the measure, if the measure is given by a name.
    fn name(&self) -> Option<&str> {
        None
    }

    /// Returns the index in [`System::coordinate_names`], if the measure is a coordinate.
    fn coordinate(&self, system: &System) -> Option<usize> {
        let name = self.name()?;
        system.coordinate_names().iter().position(|known| known == name)
    }
}

impl Measure for &str {
    fn of(&self, system: &System, motion: &Motion) -> Result<Quantity> {
        joint::named(system, motion, self)
    }

    fn name(&self) -> Option<&str> {
        Some(self)
    }
}

impl Measure for String {
    fn of(&self, system: &System, motion: &Motion) -> Result<Quantity> {
        joint::named(system, motion, self)
    }

    fn name(&self) -> Option<&str> {
        Some(self)
    }
}

impl Measure for &String {
    fn of(&self, system: &System, motion: &Motion) -> Result<Quantity> {
        joint::named(system, motion, self)
    }

    fn name(&self) -> Option<&str> {
        Some(self)
    }
}

impl Measure for Coordinate {
    fn of(&self, _: &System, motion: &Motion) -> Result<Quantity> {
        motion.coordinate(*self)
    }

    fn coordinate(&self, system: &System) -> Option<usize> {
        match system.layout().coordinate(self)? {
            Place::Own { first, .. } => Some(first),
            Place::Ground(_) => None,
        }
    }
}

impl<F: Fn(&Motion) -> Result<Quantity>> Measure for F {
    fn of(&self, _: &System, motion: &Motion) -> Result<Quantity> {
        self(motion)
    }
}

impl System {
    /// Returns a measure over the times of a motion of this system, with its derivatives.
    ///
    /// The argument `what` is the name of a measure of a joint or of a coordinate (`"slot.slide"`,
    /// `"crank.theta"`), a coordinate, or a function of a motion.
    ///
    /// An angle of a joint starts between −π and π and counts full revolutions from there. To count
    /// revolutions, Kin needs a fine enough grid: within a step the angular velocity must change by
    /// less than one revolution per step.
    ///
    /// Errors: no joint or coordinate has the name (the error lists the available names); the
    /// motion belongs to another system.
    pub fn measure(&self, motion: &Motion, what: impl Measure) -> Result<Quantity> {
        self.own(motion)?;
        what.of(self, motion)
    }
}
