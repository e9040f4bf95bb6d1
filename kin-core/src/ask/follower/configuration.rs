//! A configuration: the position of a mechanism at given values of its drivers.

use super::Follower;
use crate::ask::measure::Measure;
use crate::outcome::error::Result;
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;
use crate::solve::newton::Outcome;
use crate::system::System;

/// The position where a follower is, with all drivers at rest.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    pub(super) follower: &'a Follower,
}

impl<'a> Configuration<'a> {
    /// Returns q in the order of [`System::coordinate_names`]. \[m, rad\]
    pub fn q(self) -> &'a [f64] {
        &self.follower.q
    }

    /// Returns a coordinate by its name, such as `rocker.theta`.
    pub fn coordinate(self, name: &str) -> Option<f64> {
        let names = self.follower.system.coordinate_names();
        let column = names.iter().position(|known| known == name)?;
        self.q().get(column).copied()
    }

    /// Returns the values of all drivers.
    pub fn drivers(self) -> Vec<NamedValue> {
        self.follower.drivers()
    }

    /// Returns a measure: the angle or slide of a joint or a coordinate by name, or whatever else
    /// [`System::measure`] takes.
    ///
    /// Errors: an unknown name, with the known ones.
    pub fn measure(self, what: impl Measure) -> Result<f64> {
        let motion = self.motion();
        Ok(self.follower.system.measure(&motion, what)?.value.values()[0])
    }

    /// Returns all measures of joints, with names, units and values.
    ///
    /// Errors: a measure that is not finite here.
    pub fn measures(self) -> Result<Vec<NamedValue>> {
        let motion = self.motion();
        let system = &self.follower.system;
        let value = |name: String| {
            let quantity = system.measure(&motion, name.as_str())?;
            let unit = Some(quantity.value.unit().to_string());
            Ok(NamedValue { name, unit, value: quantity.value.values()[0] })
        };
        system.measures().into_iter().map(value).collect()
    }

    /// Returns the configuration as a motion of one time, 0, for points, pictures and tables. All
    /// velocities and accelerations are zero.
    pub fn motion(self) -> Motion {
        let Follower { system, q, .. } = self.follower;
        let rest = vec![0.0; q.len()];
        let mut motion = Motion::new(system, 1);
        let (worst, residual) = largest_residual(system, q);
        let outcome = Outcome { iterations: 0, residual };
        motion.append(0.0, [q, &rest, &rest, &[]], outcome, worst);
        motion
    }
}

/// Returns the row with the largest |C_i| at this position, and that value.
fn largest_residual(system: &System, q: &[f64]) -> (usize, f64) {
    let c = system.residual(q, 0.0).unwrap_or_default();
    let sizes = c.iter().map(|c| c.abs()).enumerate();
    sizes.fold((0, 0.0), |worst, one| if one.1 > worst.1 { one } else { worst })
}
