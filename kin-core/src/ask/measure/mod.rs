//! Answers that people want of a mechanism: measures of its joints, extremes and crossings with
//! their exact times, limits.
//!
//! Anything that is one number over time can be asked: by name, by coordinate, or by a function of
//! a motion. Times between those of the grid are found by solving the pose there, not by
//! interpolation.

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

use crate::model::coordinates::Coordinate;
use crate::model::error::Result;
use crate::model::layout::Place;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// One number over time that can be asked of a motion: a name (`"slot.slide"` of a joint,
/// `"crank.theta"` of a coordinate; a `String` too), a coordinate (`crank.theta()`), or a function
/// such as `|m: &Motion| m.transmission_angle(coupler, rocker)`.
pub trait Measure {
    /// The measure over the times of a motion of the system, with its rates.
    fn of(&self, system: &System, motion: &Motion) -> Result<Quantity>;

    /// Its name, where it is asked by one.
    fn name(&self) -> Option<&str> {
        None
    }

    /// The place among [`System::coordinate_names`] of the coordinate that it is, where it is one.
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
    /// One number over the times of a motion of this system, with its rates: a measure of a joint
    /// or a coordinate by name (`"slot.slide"`, `"crank.theta"`), a coordinate, a function of the
    /// motion.
    ///
    /// Angles of joints are counted over any number of turns, from −π to π at the first time; for
    /// that the grid must not be so coarse that a rate changes by a turn a step.
    ///
    /// Errors: a name that nothing has, with what can be asked; a motion of another system.
    pub fn measure(&self, motion: &Motion, what: impl Measure) -> Result<Quantity> {
        self.own(motion)?;
        what.of(self, motion)
    }
}
