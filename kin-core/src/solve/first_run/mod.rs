//! Checks a run once, when the run begins, for common mistakes with which the run still succeeds.
//!
//! [`Motion::warnings`] adds the warnings that Kin derives from the motion itself.

mod degrees;
mod laws;
mod near_singular;

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::coordinates::Target;
use crate::outcome::error::Result;
use crate::outcome::error::surface::Surface;
use crate::outcome::motion::warning::{MOST, is_usual, shown};
use crate::outcome::motion::{Warning, WarningKind};
use crate::solve::motion::Motion;
use crate::system::System;

/// The warnings about the numbers of a system; kept beside it until one of them is set.
struct OfSystem(Vec<Warning>);

/// Notes the warnings of a run that begins at the first time of this motion, whose smallest pivot
/// there was `pivot`; the same for a run that ended early.
pub(crate) fn note_result(system: &System, run: &mut Result<Motion>, pivot: Option<f64>) {
    match run {
        Ok(motion) => note(system, motion, pivot),
        Err(error) => error.motion_mut().into_iter().for_each(|motion| note(system, motion, pivot)),
    }
}

/// Notes the warnings of a run that begins at the first time of this motion.
pub(crate) fn note(system: &System, motion: &mut Motion, pivot: Option<f64>) {
    let Some(&t) = motion.times().first() else { return };
    motion.guess = system.initial().to_vec();
    motion.begun = of_system(system).0.clone();
    let seen = beginnings(system, t);
    motion.turned_before = seen.turned_before;
    if motion.begun.is_empty() {
        motion.begun.extend(seen.beyond_a_turn.into_iter().take(MOST));
    }
    motion.begun.extend(near_singular::warning(system, motion, pivot));
}

/// The warnings about numbers, found once for each state of the system.
fn of_system(system: &System) -> Arc<OfSystem> {
    if let Some(known) = system.cache().get::<OfSystem>() {
        return known;
    }
    let found = Arc::new(OfSystem(degrees::warnings(system)));
    system.cache().put(Arc::clone(&found));
    found
}

/// The angles of drivers at the first time of a run.
#[derive(Default)]
struct Beginnings {
    /// Drivers of turns in space that begin beyond a turn: bodies there do not show how often they
    /// have turned.
    beyond_a_turn: Vec<Warning>,
    /// True if a law has moved by more than a turn between t = 0 and the first time.
    turned_before: bool,
}

/// Compares each law of a driver at the first time with the same law at t = 0. Only laws that are
/// angles count. To find that out takes longer, so that laws within a turn are left out before.
fn beginnings(system: &System, t: f64) -> Beginnings {
    let mut found = Beginnings::default();
    let equations = system.equations();
    let mut drivers = equations.blocks.iter().enumerate().filter(|(_, block)| block.drives);
    let Some(first) = drivers.next() else { return found };
    let [now, zero] = [t, 0.0].map(|t| equations.instant_at(t, system.initial()));
    let search = degrees::Search::new(system);
    let mut begins_odd = false;
    for (k, block) in std::iter::once(first).chain(drivers) {
        let mut at_zero = Vec::new();
        block.constraint.laws(&equations.at(block, &zero), &mut |_, law, x| {
            at_zero.push(law.at(x));
        });
        let in_space = block
            .constraint
            .arguments()
            .iter()
            .any(|argument| matches!(argument.target, Target::Spatial(_)));
        let mut begins = at_zero.into_iter();
        block.constraint.laws(&equations.at(block, &now), &mut |name, law, x| {
            let angle = law.at(x);
            let begins = begins.next().unwrap_or(angle);
            let is_odd = begins.abs() > TAU && !is_usual(begins);
            let has_turned = (angle - begins).abs() > TAU;
            let matters = is_odd && (in_space || t != 0.0) || has_turned;
            if !(matters && search.block(k).law_is_angle(name, law)) {
                return;
            }
            begins_odd |= is_odd;
            found.turned_before |= has_turned;
            if is_odd && in_space {
                found.beyond_a_turn.push(begins_beyond_a_turn(&block.name, begins));
            }
        });
    }
    found.turned_before &= !begins_odd;
    found
}

fn begins_beyond_a_turn(driver: &str, angle: f64) -> Warning {
    let text = format!(
        "`{driver}` begins at {angle:.1} rad, more than a turn. Angles are in radians; if {angle:.1}° \
         is meant, give {}.",
        Surface::chosen().angle(shown(angle)),
    );
    Warning::new(WarningKind::Degrees, &[driver], text)
}
