//! Computes a run from its first time to its last time, in one motion or in parts.

use super::law_breaks::LawBreaks;
use super::stepper::Stepper;
use super::{SolverOptions, compiled, redundant};
use crate::model::error::surface::Surface;
use crate::model::error::{Error, Result};
use crate::solve::explain::Explain;
use crate::solve::first_run;
use crate::solve::motion::Motion;
use crate::system::System;
use crate::system::evaluate::Instant;

/// A function that the run calls before each single step, with the number of finished times. The
/// run ends if it returns false.
pub(crate) type Progress<'a> = &'a mut (dyn FnMut(usize) -> bool + 'a);

/// Computes position, velocity and acceleration at each of the times.
pub(crate) fn run<'a>(
    system: &'a System,
    times: &[f64],
    options: &'a SolverOptions,
    explain: Option<Explain>,
    progress: Option<Progress<'a>>,
) -> Result<Motion> {
    check(times)?;
    options.check_memory(1, times.len(), system.n_coordinates())?;
    let computing = compiled::Computing::new(system, times.len(), options)?;
    let mut run = Run::new(system, options, explain)?;
    run.progress = progress.map(|progress| (progress, times.len()));
    let mut found = run.whole(times, computing);
    first_run::note_result(system, &mut found, run.first_pivot());
    found
}

/// Runs with a given engine, over times that were checked.
pub(crate) fn run_by<'a>(
    system: &'a System,
    times: &[f64],
    (options, explain): (&'a SolverOptions, Option<Explain>),
    computing: compiled::Computing,
) -> Result<Motion> {
    let mut found = Run::new(system, options, explain)?.whole(times, computing);
    if let Ok(motion) = &mut found {
        motion.guess = system.initial().to_vec();
        // Nobody has looked: an angle far from its guess may have been turned to.
        motion.turned_before = true;
    }
    found
}

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

    /// The motion at all of these times.
    fn whole(&mut self, times: &[f64], mut computing: compiled::Computing) -> Result<Motion> {
        let mut motion = Motion::new(self.system, times.len());
        match computing.run(self, times, &mut motion) {
            Ok(()) => Ok(motion),
            Err(error) => Err(self.failed(error, motion)),
        }
    }

    /// The smallest pivot of C_q at the first position; `None` before it is found.
    pub(super) fn first_pivot(&self) -> Option<f64> {
        match &self.stepper {
            AnyStepper::Plain(stepper) => stepper.first_pivot,
            AnyStepper::Redundant(stepper) => stepper.first_pivot,
        }
    }

    /// The same at each of the times, one by one.
    pub(super) fn reach_all(&mut self, times: &[f64], motion: &mut Motion) -> Result<()> {
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
                return stepper.reach(t, &mut self.law_breaks, motion);
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
    pub(super) fn system(&self) -> &'a System {
        self.system
    }

    /// Returns the step-by-step solver, or `None` for a mechanism with more equations than
    /// coordinates.
    pub(super) fn stepper(&self) -> Option<&Stepper<'a>> {
        match &self.stepper {
            AnyStepper::Plain(stepper) => Some(stepper),
            AnyStepper::Redundant(_) => None,
        }
    }

    /// Returns the step-by-step solver, mutable.
    pub(super) fn stepper_mut(&mut self) -> Option<&mut Stepper<'a>> {
        match &mut self.stepper {
            AnyStepper::Plain(stepper) => Some(stepper),
            AnyStepper::Redundant(_) => None,
        }
    }

    /// Returns true if the ends of a step show everything that time does in between.
    pub(super) fn ends_suffice(&mut self, from: f64, to: f64, pivot: f64) -> bool {
        match &mut self.stepper {
            AnyStepper::Plain(stepper) => stepper.ends_suffice(from, to, pivot),
            AnyStepper::Redundant(_) => false,
        }
    }

    /// Tests the ends of a step and samples equations without bounds, at the position of the later
    /// time.
    pub(super) fn samples_suffice(
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
    pub(super) fn look(&mut self, instant: &Instant, motion: &mut Motion) -> Result<()> {
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

/// Checks that the times are finite and strictly increasing or strictly decreasing.
pub(crate) fn check(times: &[f64]) -> Result<()> {
    let fail = |reason: String| Err(Error::InvalidTimes { reason });
    if times.is_empty() {
        return fail(format!(
            "the list is empty. Give at least one time, or many such as {}",
            Surface::chosen().many_times()
        ));
    }
    // Usually the times increase; then those between finite ends are finite. All pairs are compared
    // without an early exit, so that the compiler can vectorise the loop.
    if times.windows(2).fold(true, |rise, pair| rise & (pair[0] < pair[1]))
        && (times[times.len() - 1] - times[0]).is_finite()
    {
        return Ok(());
    }
    if let Some((k, t)) = times.iter().enumerate().find(|(_, t)| !t.is_finite()) {
        return fail(format!("the time with number {k} is {t}. Give finite times"));
    }
    let first = times[0];
    let last = times[times.len() - 1];
    if !(last - first).is_finite() {
        return fail(format!(
            "the span from {first:e} to {last:e} is above the largest number, {:e}. Give times that are closer together",
            f64::MAX
        ));
    }
    let backwards = times.len() > 1 && times[1] < times[0];
    match times.windows(2).position(|pair| pair[0] == pair[1] || (pair[1] < pair[0]) != backwards) {
        Some(k) => fail(format!(
            "the time {} is followed by {}. Give times that only increase, or only decrease",
            times[k],
            times[k + 1]
        )),
        None => Ok(()),
    }
}

/// Checks times that come one by one.
#[derive(Default)]
pub(crate) struct Order {
    /// The last two times.
    last: [Option<f64>; 2],
}

impl Order {
    /// Checks one more time.
    pub(crate) fn check(&mut self, t: f64) -> Result<()> {
        let all: Vec<f64> = self.last.into_iter().flatten().chain([t]).collect();
        self.last = [self.last[1], Some(t)];
        check(&all)
    }

    /// Returns an error if there was no time.
    pub(crate) fn some(&self) -> Result<()> {
        if self.last[1].is_some() { Ok(()) } else { check(&[]) }
    }
}
