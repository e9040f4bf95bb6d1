//! Compiles one program for many cases of a system.
//!
//! The numbers that differ between cases are inputs of the program.

use std::sync::Arc;

use super::{Computing, Wanted, can_be, refused, wanted};
use crate::numbers::lanes::Lanes;
use crate::outcome::error::Result;
use crate::program::{Differences, Obstacle, Pose, Refusal, Tape, program_of_cases, schedule};
use crate::solve::motion::Motion;
use crate::solve::options::{Engine, SolverOptions};
use crate::solve::run::Run;
use crate::system::System;
use crate::system::parameters::CasePlace;

/// The number of times of a case from which a program is faster.
const FEWEST: usize = 24;

/// The largest number of cases in which to look for a first position, if the system itself has
/// none.
const TRIED: usize = 8;

/// Many cases of a system.
pub(crate) struct Varied<'a> {
    pub system: &'a System,
    /// The numbers that differ, with their places.
    pub names: &'a [String],
    pub places: &'a [CasePlace],
    /// The number of cases, and the times of each.
    pub count: usize,
    pub times: &'a [f64],
    /// Sets the numbers of a case in a system.
    pub set: &'a dyn Fn(&mut System, usize) -> Result<()>,
}

/// The engine that computes the cases of a sweep.
pub(crate) struct Cases {
    pub(super) by: By,
    lanes: Lanes,
}

/// The engine of the cases.
pub(super) enum By {
    /// The step-by-step solver, with the reason if the sweep looked for a program.
    Steps(Option<Arc<str>>),
    /// One program for all cases.
    Program(Arc<Tape>),
    /// A separate engine for each case, because no first position was found for a program.
    Each,
}

impl Cases {
    /// Selects the engine for these options. Errors: options that a program does not support, or a
    /// mechanism that cannot be compiled, if the user requires a program.
    pub(crate) fn new(varied: &Varied<'_>, options: &SolverOptions, lanes: Lanes) -> Result<Self> {
        let Varied { system, count, times, .. } = *varied;
        let pays = times.len() >= FEWEST || options.engine == Engine::Compiled;
        let (wanted, plain) = wanted(system, count.saturating_mul(times.len()), options)?;
        if wanted == Wanted::Plain || !pays || lanes == Lanes::Off {
            return Ok(Cases { by: By::Steps(plain.map(|why| why.to_string().into())), lanes });
        }
        let by = match varied.tape(options, lanes) {
            Ok(Some(tape)) => By::Program(Arc::new(tape)),
            Ok(None) => By::Each,
            Err(refusal) if wanted == Wanted::Compiled => return Err(refused(&refusal)),
            Err(refusal) => By::Steps(Some(refusal.to_string().into())),
        };
        Ok(Cases { by, lanes })
    }

    /// Returns the engine for one case with this number of times. Errors: those of
    /// [`Computing::new`].
    pub(crate) fn computing(
        &self,
        system: &System,
        times: usize,
        options: &SolverOptions,
    ) -> Result<Computing> {
        let own = || Ok(Computing { lanes: self.lanes, ..Computing::new(system, times, options)? });
        match &self.by {
            By::Steps(reason) => Ok(Computing::by(None, reason.clone(), self.lanes)),
            By::Each => own(),
            By::Program(tape) => match tape.case(system) {
                Some(case) => Ok(Computing::by(Some((Arc::clone(tape), case)), None, self.lanes)),
                // A number that the program treats as a constant differs in this case.
                None => own(),
            },
        }
    }
}

impl Varied<'_> {
    /// Makes the tape of all cases. Its elimination is chosen at the first position of the system,
    /// so that no case depends on others. If the system has no first position, it is chosen at one
    /// of the first cases. Returns `None` if these have none either.
    fn tape(
        &self,
        options: &SolverOptions,
        lanes: Lanes,
    ) -> std::result::Result<Option<Tape>, Refusal> {
        can_be(self.system)?;
        if !lanes.are_there() {
            return Err(Refusal::whole(Obstacle::NoLanes));
        }
        let mut typical = self.system.clone();
        for case in 0..=self.count.min(TRIED) {
            let is_set = case == 0 || (self.set)(&mut typical, case - 1).is_ok();
            if let Some(made) = is_set.then(|| self.made_of(&typical, options)).flatten() {
                return made.map(Some);
            }
        }
        Ok(None)
    }

    /// Makes the tape from one of the cases, or returns `None` if that case has no first position.
    fn made_of(
        &self,
        typical: &System,
        options: &SolverOptions,
    ) -> Option<std::result::Result<Tape, Refusal>> {
        let first = *self.times.first()?;
        let mut run = Run::new(typical, options, None).ok()?;
        run.reach(first, &mut Motion::new(typical, 1)).ok()?;
        let newton = &run.stepper()?.newton;
        let mut differences = Differences::new(typical, &typical.varied(self.places));
        differences.note(&typical.nudged(self.names, self.places));
        let pose = Pose { t: first, q: &newton.q, sizes: &newton.sizes };
        Some(program_of_cases(typical, pose, options.jerk, differences).map(schedule))
    }
}
