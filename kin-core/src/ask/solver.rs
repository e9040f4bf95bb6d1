//! The solver of a system: the calls of a system, with options.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::ask::diagnosis::explain::{EXPLAIN, explained};
use crate::ask::diagnosis::{self, Diagnosis};
use crate::ask::follower::dead_centre;
use crate::outcome::error::{Error, Result};
use crate::solve::assembly::{Assemblies, Assembly, Label, modes};
use crate::solve::explain::Start;
use crate::solve::motion::Motion;
use crate::solve::newton::{Newton, Steps, first_position};
use crate::solve::options::SolverOptions;
use crate::solve::run::{Run, times};
use crate::solve::sweep::Sweep;
use crate::solve::{compiled, redundant, whole_run};
use crate::system::{Solution, System, time};

/// A time, and the pose at which the solver begins.
///
/// With a time alone, as in `diagnose(0.0)`, the solver begins at the drawn position. With a pair
/// of a time and a pose q (length n, \[m, rad\]), as in `diagnose((0.0, &q))`, the solver begins at
/// the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At<'q> {
    pub(crate) t: f64,
    pub(crate) q: Option<&'q [f64]>,
}

impl From<f64> for At<'_> {
    fn from(t: f64) -> Self {
        At { t, q: None }
    }
}

impl<'q> From<(f64, &'q [f64])> for At<'q> {
    fn from((t, q): (f64, &'q [f64])) -> Self {
        At { t, q: Some(q) }
    }
}

impl<'q> From<(f64, &'q Vec<f64>)> for At<'q> {
    fn from((t, q): (f64, &'q Vec<f64>)) -> Self {
        At { t, q: Some(q) }
    }
}

/// The solver of a system, with its options and a progress callback.
///
/// [`System::run`], [`System::position`] and the other calls of a [`System`] use a solver with
/// default options.
///
/// ```
/// use kin::SolverOptions;
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("crank");
/// let crank = m.link("crank", 1.0)?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
/// let system = m.build()?;
///
/// let mut solver = system.solver().options(SolverOptions::new().jerk(true));
/// let motion = solver.run(linspace(0.0, 1.0, 101))?;
/// assert!(motion.has_jerk());
/// # Ok(())
/// # }
/// ```
#[must_use]
pub struct Solver<'a> {
    pub(crate) system: &'a System,
    pub(crate) options: SolverOptions,
    progress: Option<Progress<'a>>,
    stop: Option<&'a AtomicBool>,
    start: Option<dead_centre::Start>,
}

/// Receives how many times are done, of how many.
type Progress<'a> = Box<dyn FnMut(usize, usize) + 'a>;

impl System {
    /// Returns the solver of this system, with default options.
    pub fn solver(&self) -> Solver<'_> {
        Solver {
            system: self,
            options: SolverOptions::default(),
            progress: None,
            stop: None,
            start: None,
        }
    }
}

impl<'a> Solver<'a> {
    /// Sets the options of all calls of this solver.
    pub fn options(mut self, options: SolverOptions) -> Self {
        self.options = options;
        self
    }

    /// Calls `progress` during a run with the number of computed times and the number of all times.
    ///
    /// The step-by-step solver calls it before each step. The compiled program calls it once for
    /// each block of times, and [`Solver::run_in_parts`] before each part. For a sweep use
    /// [`Sweep::progress`] instead.
    pub fn progress(mut self, progress: impl FnMut(usize, usize) + 'a) -> Self {
        self.progress = Some(Box::new(progress));
        self
    }

    /// Stops a run or a sweep soon after the flag `stop` becomes true.
    ///
    /// A run in parts stops before its next part. A stopped run returns [`Error::Stopped`], which
    /// contains the motion computed so far.
    pub fn stop_when(mut self, stop: &'a AtomicBool) -> Self {
        self.stop = Some(stop);
        self
    }

    /// States the direction in which a run leaves the dead centre at which it begins.
    ///
    /// The driver must be at rest at the first time, with an acceleration other than zero, so that
    /// all velocities and accelerations are finite. Exactly one driver moves.
    ///
    /// ```
    /// use kin::prelude::*;
    /// use kin::solver::Start;
    ///
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("press");
    /// let crank = m.link("crank", 1.0)?;
    /// let rod = m.link("rod", 2.0)?;
    /// let slider = m.planar("slider", pose(2.9, 0.0, 0.0))?;
    /// let zero = vec2(0.0, 0.0);
    /// m.add("O", revolute(Ground, crank, zero, crank.start()))?;
    /// m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    /// m.add("B", revolute(rod, slider, rod.end(), zero))?;
    /// m.add("guide", prismatic(slider, Ground, zero, zero, vec2(0.0, 1.0), 0.0))?;
    /// // The cylinder begins where crank and rod are in line.
    /// m.add("cylinder", drive(slider.x(), Law::polynomial(&[3.0, 0.0, -0.5])))?;
    /// let system = m.build()?;
    ///
    /// let times = linspace(0.0, 1.0, 101);
    /// let mut solver = system.solver().start(Start::towards("crank", 1));
    /// let motion = solver.run(&times)?;
    /// let crank = motion.coordinate(crank.theta())?;
    /// assert!(crank.value.values()[100] > 0.8 && crank.rate.values()[0] > 0.8);
    /// # Ok(())
    /// # }
    /// ```
    pub fn start(mut self, start: dead_centre::Start) -> Self {
        self.start = Some(start);
        self
    }

    /// Solves for position, velocity and acceleration at time t, from the guess to the preferred
    /// assembly.
    ///
    /// Errors: the iteration does not converge; the position is singular; a value is not finite.
    pub fn position(&self, t: f64) -> Result<Solution> {
        let Solver { system, options, .. } = self;
        options.check()?;
        if system.is_redundant() {
            return redundant::at(system, time(t)?, None, options, EXPLAIN);
        }
        let mut newton = Newton::new(system, options);
        let outcome = first_position::assemble(&mut newton, time(t)?)
            .map_err(|error| explained(error, system, options))?;
        Ok(newton.solution(t, outcome))
    }

    /// Solves for position, velocity and acceleration at time t from q0 (length n), as
    /// [`System::solve_at`] does.
    ///
    /// Errors: q0 has the wrong length; the iteration does not converge; the position is singular;
    /// a value is not finite.
    pub fn solve_at(&self, t: f64, q0: &[f64]) -> Result<Solution> {
        let Solver { system, options, .. } = self;
        system.check(q0, "start")?;
        options.check()?;
        if system.is_redundant() {
            return redundant::at(system, time(t)?, Some(q0), options, EXPLAIN);
        }
        if let Some(found) = compiled::position(system, time(t)?, q0, options) {
            return Ok(found);
        }
        let mut newton = Newton::new(system, options);
        newton.q.copy_from_slice(q0);
        let outcome = first_position::from_start(&mut newton, time(t)?, Steps::Damped)?;
        Ok(newton.solution(t, outcome))
    }

    /// Solves for position, velocity and acceleration at each of the times, which must only
    /// increase or only decrease. \[s\]
    ///
    /// Errors: the iteration does not converge; a position is singular; a value is not finite; the
    /// flag of [`Solver::stop_when`] stopped the run. Each error carries the motion before the
    /// failure ([`Error::motion`]). A run that begins at a dead centre asks for
    /// [`Solver::start`]. A run whose last time is a dead centre, at which the driver comes to rest
    /// smoothly, is no error.
    pub fn run(&mut self, times: impl AsRef<[f64]>) -> Result<Motion> {
        let times = times.as_ref();
        let Solver { system, options, progress, stop, start } = self;
        if start.is_some() {
            times::check(times)?;
            options.check_memory(1, times.len(), system.n_coordinates())?;
            let begun = dead_centre::begun(system, options, times, start.as_ref()).transpose();
            return system.noted(begun.unwrap_or_else(|| Err(dead_centre::elsewhere(times))));
        }
        let is_watched = progress.is_some() || stop.is_some();
        let mut watch = |done: usize| {
            if let Some(progress) = progress {
                progress(done, times.len());
            }
            !is_set(*stop)
        };
        let watch = is_watched.then_some(&mut watch as &mut dyn FnMut(usize) -> bool);
        let ran = whole_run::run(system, times, options, Some(EXPLAIN), watch);
        system.noted(ran.or_else(|error| dead_centre::at_an_end(system, options, times, error)))
    }

    /// Runs in parts of `size` times each, so that the run needs the memory of one part only.
    ///
    /// The times may come from any iterator, also from one without end. Kin passes each part to
    /// `keep` as a separate motion.
    ///
    /// By default the step-by-step solver computes all times, and all numbers equal those of
    /// [`System::run`] with [`crate::Engine::StepByStep`] to the last digit. With
    /// [`crate::Engine::Compiled`] the last digits depend on where a part ends.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("crank");
    /// let crank = m.link("crank", 1.0)?;
    /// m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
    /// m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    /// let times = (0..10_000).map(|k| 0.001 * f64::from(k));
    /// let mut highest = 0.0_f64;
    /// m.build()?.solver().run_in_parts(times, 1000, |part| {
    ///     let path = part.point(crank, crank.end())?;
    ///     highest = path.r().iter().fold(highest, |highest, r| highest.max(r.y));
    ///     Ok(())
    /// })?;
    /// assert!((highest - 1.0).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Kin treats a `size` of 0 as 1. Kin also checks the limits of joints between the last time of
    /// a part and the first time of the next part. Kin counts the revolutions of angles from the
    /// beginning of each part.
    ///
    /// Errors: those of [`Solver::run`], which carry the unfinished part; those of `keep`, which
    /// end the run.
    pub fn run_in_parts(
        &mut self,
        times: impl IntoIterator<Item = f64>,
        size: usize,
        mut keep: impl FnMut(&Motion) -> Result<()>,
    ) -> Result<()> {
        let Solver { system, options, progress, stop, .. } = self;
        let size = size.max(1);
        let mut times = times.into_iter().peekable();
        options.check_memory(1, size, system.n_coordinates())?;
        let mut run = Run::new(system, options, Some(EXPLAIN))?;
        let mut computing = compiled::Computing::in_parts(system, options)?;
        let mut order = times::Order::default();
        let mut before: Option<Motion> = None;
        let mut done = 0;
        while times.peek().is_some() {
            // Times without end count as many as there are numbers.
            let all = times.size_hint().0.saturating_add(done);
            if let Some(progress) = progress {
                progress(done, all);
            }
            if is_set(*stop) {
                return Err(Error::Stopped { done, all, motion: before.map(Box::new) });
            }
            let mut part = Motion::new(system, size.min(times.size_hint().0.max(1)));
            let mut own = Vec::with_capacity(part.times.capacity());
            let mut ordered = Ok(());
            for t in times.by_ref().take(size) {
                ordered = order.check(t);
                if ordered.is_err() {
                    break;
                }
                own.push(t);
            }
            // Times before one that is out of order are computed all the same.
            let computed = computing.run(&mut run, &own, &mut part).and(ordered);
            system.note_after(before.as_ref(), &mut part);
            if let Err(error) = computed {
                return Err(run.failed(error, part));
            }
            keep(&part)?;
            done += part.len();
            before = Some(part.last());
        }
        order.some()
    }

    /// Prepares many cases of the system, with the options of this solver.
    ///
    /// The cases differ in the named parameters and initial values ([`Sweep`]).
    ///
    /// Errors: a name that is neither a parameter nor a coordinate.
    pub fn sweep(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Sweep<'a>> {
        let sweep = Sweep::new(self.system, names, System::noted)?;
        let sweep = sweep.options(self.options.clone());
        Ok(match self.stop {
            Some(stop) => sweep.stop_when(stop),
            None => sweep,
        })
    }

    /// Diagnoses the mechanism at a time: counts, rank, dependencies between equations, and
    /// freedoms by name.
    ///
    /// Kin first assembles the mechanism from the guess, or from the given pose.
    ///
    /// Errors: t is not finite; the pose has the wrong length; Kin finds no nearby pose at which
    /// all equations are finite.
    pub fn diagnose<'q>(&self, at: impl Into<At<'q>>) -> Result<Diagnosis> {
        let At { t, q } = at.into();
        let system = self.system;
        let search = &self.options.search;
        if let Some(q) = q {
            system.check(q, "pose")?;
            return diagnosis::diagnose(system.model(), Start::Pose(q), time(t)?, search);
        }
        let t = time(t)?;
        match system.nearer(None, t, search) {
            Some(q) => diagnosis::diagnose(system.model(), Start::Pose(&q), t, search),
            None => diagnosis::diagnose(system.model(), Start::Guess(system.initial()), t, search),
        }
    }

    /// Searches for all assemblies at time t, as [`System::assemblies`] does.
    ///
    /// Errors: t is not finite; the mechanism is free to move.
    pub fn assemblies(&self, t: f64) -> Result<Assemblies> {
        let system = self.system;
        modes::all(system.model(), system.initial(), time(t)?, &self.options.assemblies)
    }

    /// Returns the assembly with a label that [`Solver::assemblies`] returned with the same
    /// options.
    ///
    /// Errors: those of [`System::assemblies`]; no assembly has this label.
    pub fn assembly(&self, t: f64, label: &Label) -> Result<Assembly> {
        let all = self.assemblies(t)?;
        let known = || all.iter().map(|assembly| assembly.label.to_string()).collect();
        let found = all.iter().find(|assembly| assembly.label == *label).cloned();
        found.ok_or_else(|| Error::UnknownName {
            what: "assembly",
            name: label.to_string(),
            known: known(),
        })
    }
}

/// True if a flag that ends a run is there and set.
fn is_set(stop: Option<&AtomicBool>) -> bool {
    stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
}

impl Sweep<'_> {
    /// Sets whether the error of a failed case contains a diagnosis of the mechanism
    /// ([`Error::diagnosis`]).
    ///
    /// The default is `false`, because a diagnosis takes from a tenth of a second to several
    /// seconds for each failed case, a thousand times as long as most cases.
    #[must_use]
    pub fn diagnose(mut self, diagnose: bool) -> Self {
        self.explain = diagnose.then_some(EXPLAIN);
        self
    }
}
