//! Ranges that measures should keep to.

use super::Mechanism;
use crate::model::error::{Error, Result};

/// The range that a measure should keep to; an end that is infinite is none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Limit {
    /// The measure of a joint, or the coordinate, by name.
    pub name: String,
    pub ends: [f64; 2],
}

impl Limit {
    /// Refuses ends that are not in order.
    fn check(&self) -> Result<()> {
        let [from, to] = self.ends;
        if from < to {
            return Ok(());
        }
        let reason = format!("its limits are {from} and {to}; give a smaller one and a larger one");
        Err(Error::InvalidParameters {
            constraint: self.name.clone(),
            kind: "limit".to_string(),
            reason,
        })
    }
}

impl Mechanism {
    /// The range that a measure of a joint (`"A.angle"`) or a coordinate (`"slider.R_x"`) should
    /// keep to, in its unit; infinite for no end. It stops nothing: a run tells by an event when an
    /// end is passed ([`crate::Motion::events`]). Slots know their ends by themselves.
    ///
    /// Errors: limits that are not in order. A name that nothing has is told by
    /// [`Mechanism::build`], with what can be asked.
    pub fn limit(&mut self, measure: &str, from: f64, to: f64) -> Result<()> {
        let limit = Limit { name: measure.to_string(), ends: [from, to] };
        limit.check()?;
        self.limits.retain(|known| known.name != limit.name);
        self.limits.push(limit);
        Ok(())
    }
}
