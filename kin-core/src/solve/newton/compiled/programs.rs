//! The programs of a system: made once for each position that runs begin at, and kept beside the
//! system until something in it is set.

use std::sync::Arc;

use super::can_be;
use super::position::Positions;
use crate::program::{Pose, Refusal, Tape, program, schedule};
use crate::solve::newton::Newton;
use crate::system::System;

/// The outcome of compiling.
pub(crate) type Compiling = std::result::Result<Arc<Tape>, Refusal>;

/// The program that was asked for by [`System::compile`], and the last one that a run has made.
#[derive(Clone, Default)]
pub(super) struct Programs {
    asked: Option<Made>,
    last: Option<Made>,
    /// The one that was asked for, for single positions.
    positions: Option<Arc<Positions>>,
}

/// A program with the pose that its elimination was chosen at. At another one it would give the
/// same numbers but for the last digits, and those must not depend on what was run before.
#[derive(Clone)]
struct Made {
    pose: Arc<[u64]>,
    tape: Compiling,
}

/// The program for a run that begins at the position in hand.
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

/// The same where it was asked for, to be kept for all runs that begin there.
pub(crate) fn ask(newton: &Newton<'_>, t: f64) -> Compiling {
    let tape = cached(newton, t);
    let asked = Some(Made { pose: bits(newton, t), tape: tape.clone() });
    let positions =
        tape.as_ref().ok().map(|tape| Arc::new(Positions::new(Arc::clone(tape), newton, t)));
    newton.system.cache().put(Arc::new(Programs { asked, positions, ..known(newton.system) }));
    tape
}

impl Programs {
    /// The program that was asked for, for single positions.
    pub(super) fn positions(&self) -> Option<&Positions> {
        self.positions.as_deref()
    }
}

/// True if a program was asked for by [`System::compile`]: that is one without q⃛.
pub(super) fn is_asked(system: &System) -> bool {
    known(system).asked.is_some()
}

fn known(system: &System) -> Programs {
    system.cache().get::<Programs>().map(|programs| (*programs).clone()).unwrap_or_default()
}

/// All that a program is made by: what an elimination is chosen by, and whether q⃛ is asked for.
fn bits(newton: &Newton<'_>, t: f64) -> Arc<[u64]> {
    let numbers =
        [t].into_iter().chain(newton.q.iter().copied()).chain(newton.sizes.iter().copied());
    numbers.map(f64::to_bits).chain([u64::from(newton.options.jerk)]).collect()
}

/// The program of a system, its elimination chosen at the position in hand.
fn tape(newton: &Newton<'_>, t: f64) -> Compiling {
    can_be(newton.system)?;
    let pose = Pose { t, q: &newton.q, sizes: &newton.sizes };
    program(newton.system, pose, newton.options.jerk).map(schedule).map(Arc::new)
}
