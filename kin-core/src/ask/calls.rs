//! The calls of a system: positions, motions, sweeps, diagnoses, assemblies.

use crate::ask::diagnosis::explain::{EXPLAIN, explained};
use crate::ask::diagnosis::{self, Diagnosis, DiagnosisOptions};
use crate::model::error::{Error, Result};
use crate::solve::assembly::{Assemblies, Assembly, AssemblyOptions, Label, modes};
use crate::solve::explain::Start;
use crate::solve::motion::{EventKind, Motion};
use crate::solve::newton::{self, Newton, Options, Steps, first_position, redundant};
use crate::solve::sweep::Sweep;
use crate::system::{Solution, System, time};

impl System {
    /// Position, velocity and acceleration at time t, assembled from the initial guess into the
    /// preferred assembly. Errors: no convergence, singular, not finite.
    pub fn position(&self, t: f64) -> Result<Solution> {
        self.position_with(t, &Options::default())
    }

    /// The same with other options.
    pub fn position_with(&self, t: f64, options: &Options) -> Result<Solution> {
        options.check()?;
        if self.is_redundant() {
            return redundant::at(self, time(t)?, None, options, EXPLAIN);
        }
        let mut newton = Newton::new(self, options);
        let outcome = first_position::assemble(&mut newton, time(t)?)
            .map_err(|error| explained(error, self, options))?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at time t by damped Newton steps from q0 (length n),
    /// nothing preferred. Errors: wrong length, no convergence, singular, not finite.
    ///
    /// After a call of [`System::compile`] positions that are near q0 (each coordinate within a
    /// tenth of a radian, or of the mechanism's typical length, and Newton's steps shrink quickly)
    /// are found by the program, two to nine times faster; [`crate::Report::compiled`] tells.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # let mut m = Mechanism::new("crank");
    /// # let crank = m.link("crank", 1.0)?;
    /// # m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    /// # m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
    /// let system = m.build()?;
    /// system.compile()?;
    /// let mut q = system.position(0.0)?.q;
    /// for k in 1..100 {
    ///     let now = system.solve_at(0.001 * f64::from(k), &q)?;
    ///     assert!(now.report.compiled);
    ///     q = now.q;
    /// }
    /// # Ok::<(), kin::Error>(())
    /// ```
    pub fn solve_at(&self, t: f64, q0: &[f64]) -> Result<Solution> {
        self.solve_at_with(t, q0, &Options::default())
    }

    /// The same with other options.
    pub fn solve_at_with(&self, t: f64, q0: &[f64], options: &Options) -> Result<Solution> {
        self.check(q0, "start")?;
        options.check()?;
        if self.is_redundant() {
            return redundant::at(self, time(t)?, Some(q0), options, EXPLAIN);
        }
        if let Some(found) = newton::compiled::position(self, time(t)?, q0, options) {
            return Ok(found);
        }
        let mut newton = Newton::new(self, options);
        newton.q.copy_from_slice(q0);
        let outcome = first_position::from_start(&mut newton, time(t)?, Steps::Damped)?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at each of the times, which must only increase or only
    /// decrease.   \[s\]
    ///
    /// Errors: no convergence, singular, not finite; each carries the motion up to it
    /// ([`Error::motion`]).
    pub fn run(&self, times: impl AsRef<[f64]>) -> Result<Motion> {
        self.run_with(times, &Options::default())
    }

    /// The same with other options.
    pub fn run_with(&self, times: impl AsRef<[f64]>, options: &Options) -> Result<Motion> {
        self.noted(newton::run::run(self, times.as_ref(), options, Some(EXPLAIN), None))
    }

    /// The same run, watched: `progress` is called before each plain step with the number of times
    /// that are done; the run goes on while it says so. A program calls it once a block of times.
    ///
    /// Errors: those of a run; [`Error::Stopped`], with the motion up to there.
    pub fn run_watched(
        &self,
        times: impl AsRef<[f64]>,
        options: &Options,
        mut progress: impl FnMut(usize) -> bool,
    ) -> Result<Motion> {
        self.noted(newton::run::run(
            self,
            times.as_ref(),
            options,
            Some(EXPLAIN),
            Some(&mut progress),
        ))
    }

    /// A run with what has happened on its way.
    fn noted(&self, mut run: Result<Motion>) -> Result<Motion> {
        match &mut run {
            Ok(motion) => self.note(motion),
            Err(error) => error.motion_mut().into_iter().for_each(|motion| self.note(motion)),
        }
        run
    }

    /// Tells a motion what has happened on its way.
    fn note(&self, motion: &mut Motion) {
        self.note_limits(motion);
        self.note_kinks(motion);
        self.note_ranges(motion);
    }

    /// The same of a part of a run, from the end of the part before on.
    fn note_after(&self, before: Option<&Motion>, part: &mut Motion) {
        let Some(before) = before.filter(|_| !part.is_empty()) else { return self.note(part) };
        let mut whole = before.followed_by(part);
        let start = before.times().first().copied();
        self.note(&mut whole);
        // The part before has told of events at its last time, which is where this one begins.
        let found = whole.events().iter().filter(|event| {
            matches!(event.kind, EventKind::Limit | EventKind::Kink | EventKind::BeyondRange)
                && Some(event.t) != start
        });
        found.for_each(|event| part.add_event(event.clone()));
    }

    /// The run of [`System::run_with`] in parts of so many times, for times without end: `keep` is
    /// shown one part after the other, each a motion of its own that can be asked whatever a motion
    /// can be asked, and keeps of it what is wanted. Memory is that of one part, and the times may
    /// come from any iterator, which is asked for those of a part at once. All numbers are those of
    /// the run in one by plain steps ([`crate::Engine::Plain`]), to the last digit, unless a
    /// program is asked for by [`crate::Engine::Compiled`]: its last digits hang on where parts
    /// end.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("crank");
    /// let crank = m.link("crank", 1.0)?;
    /// m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
    /// m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    /// let (times, mut highest) = ((0..10_000).map(|k| 0.001 * f64::from(k)), 0.0_f64);
    /// m.build()?.run_in_parts(times, 1000, &kin::Options::default(), |part| {
    ///     let path = part.point(crank, crank.end())?;
    ///     highest = path.r().iter().fold(highest, |highest, r| highest.max(r.y));
    ///     Ok(())
    /// })?;
    /// assert!((highest - 1.0).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// A part of no times counts as one of one. Limits of joints are looked at from the last time
    /// of the part before on; angles over many turns are counted from the beginning of each part.
    ///
    /// Errors: those of a run, which carry the part that was under way; those of `keep`, with which
    /// the run ends.
    pub fn run_in_parts(
        &self,
        times: impl IntoIterator<Item = f64>,
        size: usize,
        options: &Options,
        mut keep: impl FnMut(&Motion) -> Result<()>,
    ) -> Result<()> {
        let size = size.max(1);
        let mut times = times.into_iter().peekable();
        options.check_memory(1, size, self.n_coordinates())?;
        let mut run = newton::run::Run::new(self, options, Some(EXPLAIN))?;
        let mut computing = newton::compiled::Computing::in_parts(self, options)?;
        let mut order = newton::run::Order::default();
        let mut before: Option<Motion> = None;
        while times.peek().is_some() {
            let mut part = Motion::new(self, size.min(times.size_hint().0.max(1)));
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
            let done = computing.run(&mut run, &own, &mut part).and(ordered);
            self.note_after(before.as_ref(), &mut part);
            if let Err(error) = done {
                return Err(run.failed(error, part));
            }
            keep(&part)?;
            before = Some(part.last());
        }
        order.some()
    }

    /// Many cases of this system: in each of them the named parameters (such as `A.u_i.x`) and
    /// initial values (such as `rocker.theta`) are others. See [`Sweep`].
    ///
    /// Errors: a name that is neither a parameter nor a coordinate.
    pub fn sweep(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Sweep<'_>> {
        Sweep::new(self, names, System::noted)
    }

    /// Diagnoses the mechanism at time t, assembled from the initial guess: counts, rank,
    /// dependencies and freedoms by name.
    ///
    /// Errors: t not finite, nothing finite near the guess.
    pub fn diagnose(&self, t: f64) -> Result<Diagnosis> {
        self.diagnose_with(t, &DiagnosisOptions::default())
    }

    /// The same with other options.
    pub fn diagnose_with(&self, t: f64, options: &DiagnosisOptions) -> Result<Diagnosis> {
        let t = time(t)?;
        match self.nearer(None, t, &options.search) {
            Some(q) => diagnosis::diagnose(self.model(), Start::Pose(&q), t, options),
            None => diagnosis::diagnose(self.model(), Start::Guess(self.initial()), t, options),
        }
    }

    /// The same at a pose q (length n), brought onto C = 0 first where it is off.
    ///
    /// Errors: wrong length, not finite.
    pub fn diagnose_at(&self, t: f64, q: &[f64]) -> Result<Diagnosis> {
        self.diagnose_at_with(t, q, &DiagnosisOptions::default())
    }

    /// The same with other options.
    pub fn diagnose_at_with(
        &self,
        t: f64,
        q: &[f64],
        options: &DiagnosisOptions,
    ) -> Result<Diagnosis> {
        self.check(q, "pose")?;
        diagnosis::diagnose(self.model(), Start::Pose(q), time(t)?, options)
    }

    /// All assemblies that are found at time t, in the order of their labels, and whether they are
    /// all there are ([`Assemblies::complete`]); the same each time, by any number of threads. A
    /// list reads like a slice.
    ///
    /// The search goes on until more starts are not expected to lead to another assembly. Poses
    /// with a hinge turned over, its axes opposed, are left out. If no assembly is found, the list
    /// is empty.
    ///
    /// Errors: t not finite, a mechanism that is free to move.
    pub fn assemblies(&self, t: f64) -> Result<Assemblies> {
        self.assemblies_with(t, &AssemblyOptions::default())
    }

    /// The same with other options.
    pub fn assemblies_with(&self, t: f64, options: &AssemblyOptions) -> Result<Assemblies> {
        modes::all(self.model(), self.initial(), time(t)?, options)
    }

    /// The assembly of a label that [`System::assemblies`] gave out.
    ///
    /// Errors: those of [`System::assemblies`]; no assembly of that name.
    pub fn assembly(&self, t: f64, label: &Label) -> Result<Assembly> {
        self.assembly_with(t, label, &AssemblyOptions::default())
    }

    /// The same with other options: those that the label was given out with.
    pub fn assembly_with(
        &self,
        t: f64,
        label: &Label,
        options: &AssemblyOptions,
    ) -> Result<Assembly> {
        let all = self.assemblies_with(t, options)?;
        let known = || all.iter().map(|assembly| assembly.label.to_string()).collect();
        let found = all.iter().find(|assembly| assembly.label == *label).cloned();
        found.ok_or_else(|| Error::UnknownName {
            what: "assembly",
            name: label.to_string(),
            known: known(),
        })
    }
}

impl Sweep<'_> {
    /// With `true`, the error of a case that fails says what is wrong with the mechanism there
    /// ([`Error::diagnosis`]), as that of a run does; without this call it does not. To find that
    /// out takes from a tenth of a second to seconds a case, a thousand times what most cases take.
    #[must_use]
    pub fn diagnose(mut self, diagnose: bool) -> Self {
        self.explain = diagnose.then_some(EXPLAIN);
        self
    }
}
