//! What a system is asked for: positions, motions, sweeps, diagnoses, assemblies.

use super::{Solution, System, time};
use crate::assembly::{Assembly, AssemblyOptions, Label, modes};
use crate::diagnosis::{self, Diagnosis, DiagnosisOptions, Start};
use crate::error::{Error, Result};
use crate::motion::Motion;
use crate::newton::{self, Newton, Options, Steps, assembly, redundant};
use crate::sweep::Sweep;

impl System {
    /// Position, velocity and acceleration at time t, assembled from the initial guess into the preferred assembly.
    /// Errors: no convergence, singular, not finite.
    pub fn position(&self, t: f64) -> Result<Solution> {
        self.position_with(t, &Options::default())
    }

    /// The same with other options.
    pub fn position_with(&self, t: f64, options: &Options) -> Result<Solution> {
        options.check()?;
        if redundant::is_redundant(self) {
            return redundant::at(self, time(t)?, None, options);
        }
        let mut newton = Newton::new(self, options);
        let outcome = assembly::assemble(&mut newton, time(t)?).map_err(|error| error.explained(self, options))?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at time t by damped Newton steps from q0 (length n), nothing preferred.
    /// Errors: wrong length, no convergence, singular, not finite.
    pub fn solve_at(&self, t: f64, q0: &[f64]) -> Result<Solution> {
        self.solve_at_with(t, q0, &Options::default())
    }

    /// The same with other options.
    pub fn solve_at_with(&self, t: f64, q0: &[f64], options: &Options) -> Result<Solution> {
        self.check(q0, "start")?;
        options.check()?;
        if redundant::is_redundant(self) {
            return redundant::at(self, time(t)?, Some(q0), options);
        }
        let mut newton = Newton::new(self, options);
        newton.q.copy_from_slice(q0);
        let outcome = assembly::from_start(&mut newton, time(t)?, Steps::Damped)?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at each of the times, which must only increase or only decrease.   \[s\]
    ///
    /// Errors: no convergence, singular, not finite; each carries the motion up to it ([`Error::motion`]).
    pub fn run(&self, times: impl AsRef<[f64]>) -> Result<Motion> {
        self.run_with(times, &Options::default())
    }

    /// The same with other options.
    pub fn run_with(&self, times: impl AsRef<[f64]>, options: &Options) -> Result<Motion> {
        let mut run = newton::sweep::run(self, times.as_ref(), options);
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
    }

    /// Many cases of this system: in each of them the named parameters (such as `A.u_i.x`) and initial values (such as `rocker.theta`) are
    /// others. See [`Sweep`].
    ///
    /// Errors: a name that is neither a parameter nor a coordinate.
    pub fn sweep(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Sweep<'_>> {
        Sweep::new(self, names)
    }

    /// What the mechanism is at time t, assembled from the initial guess: counts, rank, dependencies and freedoms by name.
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
            None => diagnosis::diagnose(self.model(), Start::Guess(&self.initial), t, options),
        }
    }

    /// The same at a pose q (length n), brought onto C = 0 first where it is off.
    ///
    /// Errors: wrong length, not finite.
    pub fn diagnose_at(&self, t: f64, q: &[f64]) -> Result<Diagnosis> {
        self.diagnose_at_with(t, q, &DiagnosisOptions::default())
    }

    /// The same with other options.
    pub fn diagnose_at_with(&self, t: f64, q: &[f64], options: &DiagnosisOptions) -> Result<Diagnosis> {
        self.check(q, "pose")?;
        diagnosis::diagnose(self.model(), Start::Pose(q), time(t)?, options)
    }

    /// All assemblies that are found at time t, in the order of their labels; the same each time.
    ///
    /// The search goes on until nothing new turns up for a while, so for difficult mechanisms ask for more patience
    /// ([`System::assemblies_with`]). None is an empty list.
    ///
    /// Errors: t not finite, a mechanism that is free to move.
    pub fn assemblies(&self, t: f64) -> Result<Vec<Assembly>> {
        self.assemblies_with(t, &AssemblyOptions::default())
    }

    /// The same with other options.
    pub fn assemblies_with(&self, t: f64, options: &AssemblyOptions) -> Result<Vec<Assembly>> {
        modes::all(self.model(), &self.initial, time(t)?, options)
    }

    /// The assembly of a label that [`System::assemblies`] gave out.
    ///
    /// Errors: those of [`System::assemblies`]; no assembly of that name.
    pub fn assembly(&self, t: f64, label: &Label) -> Result<Assembly> {
        self.assembly_with(t, label, &AssemblyOptions::default())
    }

    /// The same with other options: those that the label was given out with.
    pub fn assembly_with(&self, t: f64, label: &Label, options: &AssemblyOptions) -> Result<Assembly> {
        let all = self.assemblies_with(t, options)?;
        let known = || all.iter().map(|assembly| assembly.label.to_string()).collect();
        let found = all.iter().find(|assembly| assembly.label == *label).cloned();
        found.ok_or_else(|| Error::UnknownName { what: "assembly", name: label.to_string(), known: known() })
    }
}
