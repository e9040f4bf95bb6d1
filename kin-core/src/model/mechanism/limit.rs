//! Sets permitted ranges of measures.

use super::Mechanism;
use crate::outcome::error::{Error, Result};

/// The permitted range of a measure. An infinite end means no limit.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Limit {
    /// The measure of a joint or the coordinate, by name.
    pub name: String,
    pub ends: [f64; 2],
}

impl Limit {
    /// Returns an error if the ends are not in order.
    fn check(&self) -> Result<()> {
        let [from, to] = self.ends;
        if from < to {
            return Ok(());
        }
        let reason = format!(
            "the limits are {from} and {to}. Give the lower limit first and the higher limit second"
        );
        Err(Error::InvalidParameters {
            constraint: self.name.clone(),
            kind: "limit".to_string(),
            reason,
        })
    }
}

impl Mechanism {
    /// Sets the permitted range of a measure of a joint (`"A.angle"`) or of a coordinate
    /// (`"slider.R_x"`), in its unit.
    ///
    /// An infinite end means no limit. The range does not stop a run: a run reports an event where
    /// the measure leaves the range ([`crate::Motion::events`]). A run also reports the ends of
    /// slots, without this call.
    ///
    /// Errors: `from` is not below `to`. If no measure has the name, [`Mechanism::build`] returns
    /// an error with the available names.
    pub fn limit(&mut self, measure: &str, from: f64, to: f64) -> Result<()> {
        let limit = Limit { name: measure.to_string(), ends: [from, to] };
        limit.check()?;
        self.limits.retain(|known| known.name != limit.name);
        self.limits.push(limit);
        Ok(())
    }
}
