//! The calls of a system with default options: positions, motions, sweeps, diagnoses, assemblies.

use crate::ask::diagnosis::Diagnosis;
use crate::ask::solver::At;
use crate::outcome::error::Result;
use crate::solve::assembly::{Assemblies, Assembly, Label};
use crate::solve::motion::{EventKind, Motion};
use crate::solve::sweep::Sweep;
use crate::system::{Solution, System};

impl System {
    /// Solves for position, velocity and acceleration at time t, from the guess to the preferred
    /// assembly.
    ///
    /// Errors: the iteration does not converge; the position is singular; a value is not finite.
    pub fn position(&self, t: f64) -> Result<Solution> {
        self.solver().position(t)
    }

    /// Solves for position, velocity and acceleration at time t by damped Newton steps from q0
    /// (length n).
    ///
    /// The call ignores preferred assemblies.
    ///
    /// Errors: q0 has the wrong length; the iteration does not converge; the position is singular;
    /// a value is not finite.
    ///
    /// After a call of [`System::compile`] the compiled program finds positions near q0, two to
    /// nine times faster than the step-by-step solver. A position is near q0 if each coordinate is
    /// within a tenth of a radian, or of the mechanism's typical length, and if Newton's steps
    /// shrink quickly. [`crate::results::Report::compiled`] says whether the program found the
    /// position.
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
        self.solver().solve_at(t, q0)
    }

    /// Solves for position, velocity and acceleration at each of the times, which must only
    /// increase or only decrease.   \[s\]
    ///
    /// Errors: the iteration does not converge; a position is singular; a value is not finite. Each
    /// error carries the motion before the failure ([`Error::motion`](crate::Error::motion)).
    pub fn run(&self, times: impl AsRef<[f64]>) -> Result<Motion> {
        self.solver().run(times)
    }

    /// Prepares many cases of this system, which differ in the named parameters or initial values.
    ///
    /// A parameter has a name such as `A.u_i.x`, an initial value a name such as `rocker.theta`.
    /// [`Sweep`] describes how to run the cases.
    ///
    /// Errors: a name that is neither a parameter nor a coordinate.
    pub fn sweep(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Sweep<'_>> {
        self.solver().sweep(names)
    }

    /// Diagnoses the mechanism at a time: counts, rank, dependencies between equations, and
    /// freedoms by name.
    ///
    /// Kin first assembles the mechanism from the guess. If you give a pose, as in
    /// `diagnose((t, &q))`, Kin assembles the mechanism from that pose.
    ///
    /// Errors: t is not finite; the pose has the wrong length; Kin finds no nearby pose at which
    /// all equations are finite.
    pub fn diagnose<'q>(&self, at: impl Into<At<'q>>) -> Result<Diagnosis> {
        self.solver().diagnose(at)
    }

    /// Returns all assemblies that Kin finds at time t, in the order of their labels.
    ///
    /// [`Assemblies::complete`] says whether the list is complete. The result is the same in every
    /// run and with any number of threads. [`Assemblies`] dereferences to a slice.
    ///
    /// The search ends when Kin expects no other assembly from more starts. The list omits poses in
    /// which the two axes of a hinge have opposite directions. If Kin finds no assembly, the list
    /// is empty.
    ///
    /// Errors: t is not finite; the mechanism is free to move.
    pub fn assemblies(&self, t: f64) -> Result<Assemblies> {
        self.solver().assemblies(t)
    }

    /// Returns the assembly with a label from [`System::assemblies`].
    ///
    /// Errors: those of [`System::assemblies`]; no assembly has this label.
    pub fn assembly(&self, t: f64, label: &Label) -> Result<Assembly> {
        self.solver().assembly(t, label)
    }

    /// A run with what has happened on its way.
    pub(super) fn noted(&self, mut run: Result<Motion>) -> Result<Motion> {
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
    pub(super) fn note_after(&self, before: Option<&Motion>, part: &mut Motion) {
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
}
