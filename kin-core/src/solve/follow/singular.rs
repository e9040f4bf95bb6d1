//! Singular positions of a motion, as they are told.

use crate::model::motion::{Branch, SingularKind, SingularPosition};
use crate::solve::newton::Newton;
use crate::system::System;
use crate::system::singular::{self, Singular};

/// Pivots below this vanish at one singular position: where several do so at once q is known to half of its digits.   \[-\]
const AT_ONCE: f64 = 1e-7;

impl SingularPosition {
    /// At q and t, with names by the null vectors of C_q there.
    pub(super) fn new(system: &System, kind: SingularKind, t: f64, q: &[f64], branches: Vec<Branch>) -> Self {
        let model = system.model();
        let values = model.linearize(q, t).map(|point| point.values).unwrap_or_else(|_| vec![0.0; model.equations.entries.len()]);
        let Singular { movable, dependent, .. } = singular::singular_within(&model, &values, &model.measure(q, t), AT_ONCE);
        SingularPosition { t, kind, q: q.to_vec(), movable, dependent, branches }
    }
}

/// The measure of time: what the fastest driver needs to move something of order 1; the step of time where all stand still.
pub(super) fn time(newton: &Newton<'_>, q: &[f64], t: f64, h: f64) -> f64 {
    let c_t = newton.system.model().c_t(q, t).unwrap_or_default();
    let fastest = c_t.iter().zip(newton.linear.norms()).fold(0.0_f64, |most, (c_t, norm)| most.max((c_t / norm).abs()));
    if fastest.is_finite() && fastest > 0.0 { fastest.recip() } else { h.abs() }
}
