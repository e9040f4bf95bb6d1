//! Computes the efforts of the values that a follower moves.

use super::calls::Forces;
use crate::ask::follower::Follower;
use crate::outcome::error::Result;
use crate::outcome::named_value::NamedValue;
use crate::system::System;

impl Follower {
    /// Returns the efforts that masses and loads require of the values that the follower moves, for
    /// given rates of these values: pairs of a name and \[u̇, ü\]. Other values are at rest. The
    /// effort of an angle is a torque, and that of a length is a force. It is positive in the
    /// direction in which the value grows.
    ///
    /// If other values are given than those of the drivers, the efforts act on these values. So the
    /// efforts of two sets of values of one mechanism differ by Jᵀ ([`crate::solver::Map`]).
    ///
    /// Errors: those of [`Follower::rates`] and of [`System::forces`].
    pub fn efforts(
        &mut self,
        rates: impl IntoIterator<Item = (impl AsRef<str>, [f64; 2])>,
    ) -> Result<Vec<NamedValue>> {
        let motion = self.moving(rates)?;
        let names = self.drivers();
        let blocks = self.constraints_of_drivers();
        let system: &System = self.system();
        let forces: Forces<'_> = system.forces(&motion)?;
        let mut found = Vec::with_capacity(names.len());
        for (k, one) in names.into_iter().enumerate() {
            let number = blocks[..k].iter().filter(|block| **block == blocks[k]).count();
            let drive = forces.drive(&blocks[k])?;
            let series = drive.efforts().get(number).unwrap_or_else(|| drive.effort());
            found.push(NamedValue {
                name: one.name,
                unit: Some(series.unit().to_string()),
                value: series.values()[0],
            });
        }
        Ok(found)
    }
}
