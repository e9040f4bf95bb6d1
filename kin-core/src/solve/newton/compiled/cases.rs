//! One program for many cases of a system: what differs between them is left free in it.

use std::sync::Arc;

use super::{Computing, Wanted, can_be, refused, wanted};
use crate::model::error::Result;
use crate::numbers::lanes::Lanes;
use crate::program::{Differences, NO_LANES, Pose, Refusal, Tape, program_of_cases, schedule};
use crate::solve::motion::Motion;
use crate::solve::newton::run::Run;
use crate::solve::newton::{Engine, SolverOptions};
use crate::system::System;
use crate::system::parameters::CasePlace;

/// From so many times of a case on a program pays for it.
const FEWEST: usize = 24;

/// Cases that are tried at most, to find one with a first position where the system as it is has
/// none.
const TRIED: usize = 8;

/// Many cases of a system.
pub(crate) struct Varied<'a> {
    pub system: &'a System,
    /// The numbers that differ, and where they go.
    pub names: &'a [String],
    pub places: &'a [CasePlace],
    /// The number of cases, and the times of each.
    pub count: usize,
    pub times: &'a [f64],
    /// Gives a system the numbers of a case.
    pub set: &'a dyn Fn(&mut System, usize) -> Result<()>,
}

/// The means that compute the cases of a sweep.
pub(crate) struct Cases {
    pub(super) by: By,
    lanes: Lanes,
}

/// The means by which the cases of a sweep are computed.
pub(super) enum By {
    /// The step-by-step solver; the reason, if a program was looked for.
    Steps(Option<Arc<str>>),
    /// One program.
    Program(Arc<Tape>),
    /// The means of each case alone, for no first position was found to compile a program at.
    Each,
}

impl Cases {
    /// As these options ask for it. Errors: options that a program does not know, or a mechanism
    /// that cannot be compiled, where a program is asked for.
    pub(crate) fn new(varied: &Varied<'_>, options: &SolverOptions, lanes: Lanes) -> Result<Self> {
        let Varied { system, count, times, .. } = *varied;
        let pays = times.len() >= FEWEST || options.engine == Engine::Compiled;
        let (wanted, plain) = wanted(system, count.saturating_mul(times.len()), options)?;
        if wanted == Wanted::Plain || !pays || lanes == Lanes::Off {
            return Ok(Cases { by: By::Steps(plain.map(Into::into)), lanes });
        }
        let by = match varied.tape(options, lanes) {
            Ok(Some(tape)) => By::Program(Arc::new(tape)),
            Ok(None) => By::Each,
            Err(refusal) if wanted == Wanted::Compiled => return Err(refused(&refusal)),
            Err(refusal) => By::Steps(Some(refusal.to_string().into())),
        };
        Ok(Cases { by, lanes })
    }

    /// The means for one case, of so many times. Errors: as [`Computing::new`].
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
                // Something is another one that was folded.
                None => own(),
            },
        }
    }
}

impl Varied<'_> {
    /// The tape of all cases, its elimination chosen at the first position of the system as it is,
    /// so that no case hangs on others; or of a case, where that has none. None where the first
    /// cases have none either.
    fn tape(
        &self,
        options: &SolverOptions,
        lanes: Lanes,
    ) -> std::result::Result<Option<Tape>, Refusal> {
        can_be(self.system)?;
        if !lanes.are_there() {
            return Err(Refusal { constraint: String::new(), reason: NO_LANES });
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

    /// The same, made of one of the cases; `None` where that has no first position.
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
