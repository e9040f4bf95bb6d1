//! A configuration: the position of a mechanism at given values of its drivers.

use super::Follower;
use crate::ask::measure::Measure;
use crate::ask::still::Still;
use crate::outcome::error::Result;
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;

/// The position where a follower is, with all drivers at rest.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    pub(super) follower: &'a Follower,
}

impl<'a> Configuration<'a> {
    /// Returns q in the order of [`crate::System::coordinate_names`]. \[m, rad\]
    pub fn q(self) -> &'a [f64] {
        &self.follower.q
    }

    /// Returns a coordinate by its name, such as `rocker.theta`.
    pub fn coordinate(self, name: &str) -> Option<f64> {
        self.still().coordinate(name)
    }

    /// Returns the values of all drivers.
    pub fn drivers(self) -> Vec<NamedValue> {
        self.follower.drivers()
    }

    /// Returns the values of the drivers that are left out because other values are given, in the
    /// order of the constraints; empty if the follower moves the drivers. Kin counts the whole
    /// turns of an angle from move to move, so that one move changes it by less than half a turn.
    pub fn left_out(self) -> Vec<NamedValue> {
        let Some(whole) = &self.follower.whole else { return Vec::new() };
        let given = |name: &str| self.follower.drivers.iter().any(|own| own.value.name == name);
        let out = whole.drivers.iter().filter(|driver| !given(&driver.value.name));
        out.map(|driver| driver.value.clone()).collect()
    }

    /// Returns a measure: the angle or slide of a joint or a coordinate by name, or whatever else
    /// [`crate::System::measure`] takes.
    ///
    /// Errors: an unknown name, with the known ones.
    pub fn measure(self, what: impl Measure) -> Result<f64> {
        self.still().measure(what)
    }

    /// Returns all measures of joints, with names, units and values.
    ///
    /// Errors: a measure that is not finite here.
    pub fn measures(self) -> Result<Vec<NamedValue>> {
        self.still().measures()
    }

    /// Returns the configuration as a motion of one time, 0, for points, pictures and tables. All
    /// velocities and accelerations are zero.
    pub fn motion(self) -> Motion {
        self.still().motion()
    }

    fn still(self) -> Still<'a> {
        Still { system: &self.follower.system, q: &self.follower.q }
    }
}
