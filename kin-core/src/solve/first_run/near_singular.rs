//! Finds runs that begin at or near a singular position and still continue.

use crate::outcome::motion::{Warning, WarningKind};
use crate::outcome::words::{at, list};
use crate::solve::motion::Motion;
use crate::system::System;
use crate::system::singular::{Singular, singular_within};

/// A smallest pivot above this is that of a regular position, whatever the mechanism is: nothing
/// more is computed.   \[-\]
const REGULAR: f64 = 1e-2;

/// A position with a pivot below this is nearly singular: 0.06° before a dead centre.   \[-\]
const NEAR: f64 = 1e-3;

/// The same of a motion of one time, where no other position can be compared.   \[-\]
const ALONE: f64 = 1e-5;

/// In the middle of the motion the smallest pivot is so many times larger, if the first position is
/// the cause, and not a mechanism that is badly conditioned wherever it is.   \[-\]
const BESIDE: f64 = 30.0;

/// The warning, if there is a reason. The run has computed `pivot`, the smallest one of the first
/// position in its order of elimination; a small one is looked at by an elimination that chooses
/// its pivots there.
pub(super) fn warning(system: &System, motion: &Motion, pivot: Option<f64>) -> Option<Warning> {
    if pivot.is_none_or(|pivot| pivot > REGULAR) {
        return None;
    }
    let alone = motion.len() == 1;
    let here = at_time(system, motion, 0, if alone { ALONE } else { NEAR })?;
    let n = system.n_coordinates();
    let is_regular_elsewhere = || {
        let there = at_time(system, motion, motion.len() / 2, BESIDE * here.pivot);
        there.is_some_and(|there| there.rank == n)
    };
    if here.rank == n || !alone && !is_regular_elsewhere() {
        return None;
    }
    let t = at(motion.times()[0], motion.unit_words());
    let bodies: Vec<&str> = here.movable.iter().map(String::as_str).collect();
    let text = format!(
        "The run begins at t = {t} near a singular position. At this position {} can move while the drivers hardly move, and the mechanism may continue in more than one way. Check the motion, or begin farther from this position.",
        list(&here.movable),
    );
    Some(Warning::new(WarningKind::SingularStart, &bodies, text))
}

/// C_q at time k, pivots below `least` taken for zero; `None` where it is not finite.
fn at_time(system: &System, motion: &Motion, k: usize, least: f64) -> Option<Singular> {
    let model = system.model();
    let q = motion.q(k);
    let t = motion.times()[k];
    let point = model.linearize(q, t).ok()?;
    Some(singular_within(&model, &point.values, &model.measure(q, t), least))
}
