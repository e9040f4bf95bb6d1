//! A constraint whose time stands still.

use crate::coordinates::Argument;
use crate::model::constraint::{Constraint, Facts, Parameters, Parts};
use crate::model::state::{At, Rates};

/// A constraint at one time t0, whatever the time of the solver is. Its C_t, C_qt and C_tt are
/// zero.
#[derive(Clone)]
pub(super) struct Frozen {
    pub inner: Box<dyn Constraint>,
    /// The time at which the constraint is evaluated. \[s\]
    pub t0: f64,
}

impl Constraint for Frozen {
    fn facts(&self) -> Facts<'_> {
        self.inner.facts()
    }

    fn arguments(&self) -> Vec<Argument> {
        self.inner.arguments()
    }

    fn at_time(&self, _t: f64, timed: &mut [f64]) {
        let facts = self.inner.facts();
        self.inner.at_time(self.t0, timed);
        let rows = facts.rows.len();
        let slopes = facts.sides_of_time.map(|first| first + rows..first + 3 * rows);
        if let Some(slopes) = slopes.and_then(|range| timed.get_mut(range)) {
            slopes.fill(0.0);
        }
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        self.inner.residual(&at.at_time(self.t0), c);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        self.inner.jacobian(&at.at_time(self.t0), c_q);
    }

    fn linearize(&self, at: &At<'_>, c: &mut [f64], c_q: &mut [f64]) {
        self.inner.linearize(&at.at_time(self.t0), c, c_q);
    }

    fn velocity_rhs(&self, _at: &At<'_>, rhs: &mut [f64]) {
        let rows = self.inner.facts().rows.len();
        rhs.iter_mut().take(rows).for_each(|place| *place = 0.0);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, _t_dot: f64, q_d: &mut [f64]) {
        self.inner.acceleration_rhs(&at.at_time(self.t0), qd, 0.0, q_d);
    }

    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        self.inner.measure(k, &at.at_time(self.t0), rates)
    }

    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        self.inner.wrong_branch(&at.at_time(self.t0))
    }

    fn parts(&self) -> Parts<'_> {
        Parts { written: None, ..self.inner.parts() }
    }

    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        self.inner.parameters_mut()
    }
}
