//! Computes one time of a run after the other, with the events in between.

mod law_breaks;
pub(crate) mod times;

use crate::outcome::error::{Error, Result};
use crate::solve::explain::Explain;
use crate::solve::motion::Motion;
use crate::solve::options::SolverOptions;
use crate::solve::redundant;
use crate::solve::step::Stepper;
use crate::system::System;
use crate::system::evaluate::Instant;
use law_breaks::LawBreaks;

/// A function that the run calls before each single step, with the number of finished times. The
/// run ends if it returns false.
pub(crate) type Progress<'a> = &'a mut (dyn FnMut(usize) -> bool + 'a);

/// A run in progress.
pub(crate) struct Run<'a> {
    system: &'a System,
    options: &'a SolverOptions,
    explain: Option<Explain>,
    stepper: AnyStepper<'a>,
    law_breaks: LawBreaks,
    /// The progress function, with the number of all times.
    progress: Option<(Progress<'a>, usize)>,
}

/// The solver that advances a run.
enum AnyStepper<'a> {
    Plain(Box<Stepper<'a>>),
    /// The solver of a mechanism with more equations than coordinates.
    Redundant(Box<redundant::Stepper<'a>>),
}

impl<'a> Run<'a> {
    /// Creates a run that has not begun. Errors: options out of range, an unknown jerk.
    pub(crate) fn new(
        system: &'a System,
        options: &'a SolverOptions,
        explain: Option<Explain>,
    ) -> Result<Self> {
        options.check()?;
        if options.jerk {
            system.knows_jerk()?;
        }
        let stepper = if system.is_redundant() {
            AnyStepper::Redundant(Box::new(redundant::Stepper::new(system, options, explain)))
        } else {
            AnyStepper::Plain(Box::new(Stepper::new(system, options)))
        };
        Ok(Run {
            system,
            options,
            explain,
            stepper,
            law_breaks: LawBreaks::default(),
            progress: None,
        })
    }

    /// Sets the function that the run calls before each single step, with the number of all times.
    pub(crate) fn watched(self, progress: Option<Progress<'a>>, all: usize) -> Self {
        Run { progress: progress.map(|progress| (progress, all)), ..self }
    }

    /// The smallest pivot of C_q at the first position; `None` before it is found.
    pub(in crate::solve) fn first_pivot(&self) -> Option<f64> {
        match &self.stepper {
            AnyStepper::Plain(stepper) => stepper.first_pivot,
            AnyStepper::Redundant(stepper) => stepper.first_pivot,
        }
    }

    /// The same at each of the times, one by one.
    pub(in crate::solve) fn reach_all(&mut self, times: &[f64], motion: &mut Motion) -> Result<()> {
        times.iter().try_for_each(|t| self.reach(*t, motion))
    }

    /// Solves at the next time and appends it to the motion, with the events since the last time.
    #[inline]
    pub(crate) fn reach(&mut self, t: f64, motion: &mut Motion) -> Result<()> {
        if let Some((progress, all)) = &mut self.progress
            && !progress(motion.len())
        {
            let before = Some(Box::new(motion.last()));
            return Err(Error::Stopped { done: motion.len(), all: *all, motion: before });
        }
        let stepper = match &mut self.stepper {
            AnyStepper::Plain(stepper) => stepper,
            AnyStepper::Redundant(stepper) => {
                let (position, outcome) = stepper.reach(t)?;
                self.law_breaks.look(self.system, position.instant(), &mut motion.breaks)?;
                position.append(outcome, motion);
                motion.misfit = position.misfit();
                return Ok(());
            }
        };
        let reached = stepper.reach(t);
        if !stepper.passed.is_empty() {
            stepper.passed.drain(..).for_each(|found| motion.add_singular(found));
        }
        let outcome = reached?;
        self.law_breaks.look(self.system, &stepper.newton.instant, &mut motion.breaks)?;
        motion.push(t, &stepper.newton, outcome);
        Ok(())
    }

    /// Begins the run at this pose, which satisfies the equations at time t but for rounding.
    pub(crate) fn begin_from(&mut self, t: f64, q: &[f64]) -> Result<()> {
        match &mut self.stepper {
            AnyStepper::Redundant(stepper) => stepper.begin_from(t, q),
            AnyStepper::Plain(stepper) => stepper.begin_from(t, q),
        }
    }

    /// Appends the pose at time t to `motion`, reached by tested steps from time k of a known
    /// motion. It is on the branch of that time. Errors: those of a run from there to t.
    pub(crate) fn go_from(
        &mut self,
        known: &Motion,
        k: usize,
        t: f64,
        motion: &mut Motion,
    ) -> Result<()> {
        match &mut self.stepper {
            AnyStepper::Redundant(stepper) => stepper.go_from(known, k, t, motion),
            AnyStepper::Plain(stepper) => {
                stepper.begin_at(known, k)?;
                let outcome = stepper.reach(t)?;
                motion.push(t, &stepper.newton, outcome);
                Ok(())
            }
        }
    }

    /// Returns the system of the run.
    pub(in crate::solve) fn system(&self) -> &'a System {
        self.system
    }

    /// Returns the step-by-step solver, or `None` for a mechanism with more equations than
    /// coordinates.
    pub(in crate::solve) fn stepper(&self) -> Option<&Stepper<'a>> {
        match &self.stepper {
            AnyStepper::Plain(stepper) => Some(stepper),
            AnyStepper::Redundant(_) => None,
        }
    }

    /// Returns the step-by-step solver, mutable.
    pub(in crate::solve) fn stepper_mut(&mut self) -> Option<&mut Stepper<'a>> {
        match &mut self.stepper {
            AnyStepper::Plain(stepper) => Some(stepper),
            AnyStepper::Redundant(_) => None,
        }
    }

    /// Returns true if the ends of a step show everything that time does in between.
    pub(in crate::solve) fn ends_suffice(&mut self, from: f64, to: f64, pivot: f64) -> bool {
        match &mut self.stepper {
            AnyStepper::Plain(stepper) => stepper.ends_suffice(from, to, pivot),
            AnyStepper::Redundant(_) => false,
        }
    }

    /// Tests the ends of a step and samples equations without bounds, at the position of the later
    /// time.
    pub(in crate::solve) fn samples_suffice(
        &mut self,
        (from, to, q): (f64, f64, &[f64]),
        pivot: f64,
        instant: &mut Instant,
    ) -> bool {
        match &mut self.stepper {
            AnyStepper::Plain(stepper) => stepper.samples_suffice((from, to, q), pivot, instant),
            AnyStepper::Redundant(_) => false,
        }
    }

    /// Looks for breaks of laws on the way to a time that the compiled program has solved.
    pub(in crate::solve) fn look(&mut self, instant: &Instant, motion: &mut Motion) -> Result<()> {
        self.law_breaks.look(self.system, instant, &mut motion.breaks)
    }

    /// Continues with the step-by-step solver after the last times of the motion, which the
    /// compiled program has solved. `pivot` is the smallest pivot there.
    pub(crate) fn go_on(&mut self, motion: &Motion, pivot: f64) {
        if let AnyStepper::Plain(stepper) = &mut self.stepper {
            stepper.go_on(motion, pivot);
        }
    }

    /// Completes the error that ends the run: adds the computed motion, and a diagnosis if the
    /// options allow it.
    pub(crate) fn failed(&self, error: Error, motion: Motion) -> Error {
        let error = error.with_motion(motion);
        match (&self.stepper, self.explain) {
            (AnyStepper::Plain(_), Some(explain)) => {
                (explain.explained)(error, self.system, self.options)
            }
            _ => error,
        }
    }
}
