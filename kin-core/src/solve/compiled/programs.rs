//! Stores the programs of a system, one for each position at which runs begin, until the user sets
//! a value of the system.

use std::sync::Arc;

use super::can_be;
use super::position::Positions;
use crate::program::{Pose, Refusal, Tape, program, schedule};
use crate::solve::newton::Newton;
use crate::system::System;

/// The outcome of compiling.
pub(crate) type Compiling = std::result::Result<Arc<Tape>, Refusal>;

/// The program of [`System::compile`], and the last program of a run.
#[derive(Clone, Default)]
pub(super) struct Programs {
    asked: Option<Made>,
    last: Option<Made>,
    /// The program for single positions, if [`System::compile`] was called.
    positions: Option<Arc<Positions>>,
}

/// A program with the pose at which its elimination was chosen. At another pose the last digits
/// would differ, and these must not depend on earlier runs.
#[derive(Clone)]
struct Made {
    pose: Arc<[u64]>,
    tape: Compiling,
}

/// Returns the program for a run that begins at the present position.
pub(super) fn cached(newton: &Newton<'_>, t: f64) -> Compiling {
    let system = newton.system;
    let pose = bits(newton, t);
    let mut programs = known(system);
    if let Some(made) = programs.asked.iter().chain(&programs.last).find(|made| made.pose == pose) {
        return made.tape.clone();
    }
    let tape = tape(newton, t);
    programs.last = Some(Made { pose, tape: tape.clone() });
    system.cache().put(Arc::new(programs));
    tape
}

/// Makes the program for [`System::compile`], kept for all runs that begin there.
pub(crate) fn ask(newton: &Newton<'_>, t: f64) -> Compiling {
    let tape = cached(newton, t);
    let asked = Some(Made { pose: bits(newton, t), tape: tape.clone() });
    let positions =
        tape.as_ref().ok().map(|tape| Arc::new(Positions::new(Arc::clone(tape), newton, t)));
    newton.system.cache().put(Arc::new(Programs { asked, positions, ..known(newton.system) }));
    tape
}

impl Programs {
    /// Returns the program for single positions.
    pub(super) fn positions(&self) -> Option<&Positions> {
        self.positions.as_deref()
    }
}

/// Returns true if [`System::compile`] was called; that program has no q⃛.
pub(super) fn is_asked(system: &System) -> bool {
    known(system).asked.is_some()
}

fn known(system: &System) -> Programs {
    system.cache().get::<Programs>().map(|programs| (*programs).clone()).unwrap_or_default()
}

/// Returns all data from which a program is made, as bits: those that determine the elimination,
/// and whether q⃛ is computed.
fn bits(newton: &Newton<'_>, t: f64) -> Arc<[u64]> {
    let numbers =
        [t].into_iter().chain(newton.q.iter().copied()).chain(newton.sizes.iter().copied());
    numbers.map(f64::to_bits).chain([u64::from(newton.options.jerk)]).collect()
}

/// Makes the program of a system with an elimination chosen at the present position.
fn tape(newton: &Newton<'_>, t: f64) -> Compiling {
    can_be(newton.system)?;
    let pose = Pose { t, q: &newton.q, sizes: &newton.sizes };
    program(newton.system, pose, newton.options.jerk).map(schedule).map(Arc::new)
}
