//! One move of a follower: a run along the straight line between values of drivers.

use super::small::Small;
use super::{Follower, Regular};
use crate::ask::diagnosis::explain::EXPLAIN;
use crate::ask::proof::Proof;
use crate::outcome::error::{CannotReach, Error, FailureKind, Result};
use crate::outcome::motion::{Motion, SingularPosition};
use crate::outcome::named_value::NamedValue;
use crate::outcome::words::list;
use crate::solve::newton::Outcome;
use crate::solve::options::SolverOptions;
use crate::solve::run::Run;
use crate::system::System;

/// The run of a move goes from this time to 0, so that the values at its end are the given ones to
/// the last digit. \[-\]
const START: f64 = -1.0;

/// After a stop the next move begins before the singular position by this share of the way. \[-\]
const BEFORE: f64 = 1e-3;

impl Follower {
    /// Moves all drivers to these values. After an error the follower is at the singular position,
    /// or where it was.
    pub(super) fn move_to(&mut self, targets: &[f64]) -> Result<()> {
        if self.step_to(targets) {
            return Ok(());
        }
        let (start, q) = match &self.regular {
            Some(Regular { values, q }) => (values.clone(), q.clone()),
            None => (self.values(), self.q.clone()),
        };
        match self.run(&start, &q, targets) {
            Ok(reached) => {
                self.q = reached;
                self.regular = None;
                self.rest_at(targets);
                self.follow_left_out();
                Ok(())
            }
            Err(error) => Err(self.stop(error, (start, q), targets)),
        }
    }

    /// Moves the named drivers as [`Follower::to`] does, over so many equal steps, and proves by
    /// interval bounds that each step stays on its branch: there is exactly one curve of positions
    /// near the way, and the computed positions are on it. The follower moves also where a step is
    /// not proved.
    ///
    /// The times of the proof are −1 at the beginning of the move and 0 at its end; the values of
    /// the drivers are linear in the time.
    ///
    /// Errors: those of [`Follower::to`] and of [`System::prove`]; no step; the follower is at a
    /// singular position. After an error the follower is where it was.
    pub fn prove_to(
        &mut self,
        values: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
        steps: usize,
    ) -> Result<Proof> {
        let mut targets = Vec::new();
        self.targets(values, &mut targets)?;
        let refused = |reason: &str| Error::InvalidOptions { reason: reason.to_string() };
        if steps == 0 {
            return Err(refused("a proof has at least 1 step, not 0. Request more"));
        }
        if self.regular.is_some() {
            return Err(refused(
                "the follower stands at a singular position. Move it back before the proof",
            ));
        }
        self.options.check_memory(1, steps + 1, self.q.len())?;
        let start = self.values();
        self.lead(&start, &targets);
        let first = self.system.velocity(&self.q, START).and_then(|qd| {
            let qdd = self.system.acceleration(&self.q, &qd, START)?;
            Ok([qd, qdd])
        });
        let way = first
            .and_then(|[qd, qdd]| go(&self.system, &self.options, [&self.q, &qd, &qdd], steps));
        let proved = way.and_then(|motion| Ok((self.system.prove(&motion)?, motion)));
        match proved {
            Ok((proof, motion)) => {
                self.q.copy_from_slice(motion.q(steps));
                self.small = Small::default();
                self.rest_at(&targets);
                self.follow_left_out();
                Ok(proof)
            }
            Err(error) => {
                self.rest_at(&start);
                Err(error)
            }
        }
    }

    /// Lets the drivers go from these values to the targets, from the time [`START`] to 0.
    fn lead(&self, start: &[f64], targets: &[f64]) {
        for ((driver, start), target) in self.drivers.iter().zip(start).zip(targets) {
            driver.path.lead([*target, target - start, 0.0]);
        }
    }

    /// Returns the position at the targets, followed from the position q at the values `start`.
    fn run(&mut self, start: &[f64], q: &[f64], targets: &[f64]) -> Result<Vec<f64>> {
        if start == targets {
            return Ok(q.to_vec());
        }
        self.lead(start, targets);
        let rest = vec![0.0; q.len()];
        Ok(go(&self.system, &self.options, [q, &rest, &rest], 1)?.q(1).to_vec())
    }

    /// Takes the follower to the place where a move stopped, and says why.
    fn stop(&mut self, error: Error, (start, q): (Vec<f64>, Vec<f64>), targets: &[f64]) -> Error {
        let singular =
            error.motion().and_then(|motion| motion.singular_positions().last().cloned());
        let is_end = matches!(error.kind(), Some(FailureKind::Toggle { .. }));
        let Some(found) = singular.filter(|_| is_end) else {
            let reason = reason(&error);
            self.rest_at(&self.values());
            return self.cannot_reach(targets, None, reason);
        };
        let way = |share: f64| -> Vec<f64> {
            targets
                .iter()
                .zip(&start)
                .map(|(target, start)| target + (target - start) * share)
                .collect()
        };
        let before = found.t - BEFORE * (found.t - START);
        let values = way(before);
        let regular = self.run(&start, &q, &values).ok().map(|q| Regular { values, q });
        self.regular = Some(regular.unwrap_or(Regular { values: start.clone(), q }));
        self.q.clone_from(&found.q);
        self.rest_at(&way(found.t));
        self.follow_left_out();
        self.cannot_reach(targets, Some(&found), String::new())
    }

    fn cannot_reach(
        &self,
        targets: &[f64],
        singular: Option<&SingularPosition>,
        reason: String,
    ) -> Error {
        let reached = self.drivers();
        let pairs = || reached.iter().zip(targets.iter().copied());
        let mut moved: Vec<(&NamedValue, f64)> =
            pairs().filter(|(value, target)| value.value != *target).collect();
        if moved.is_empty() {
            // The values are those of the singular position itself.
            moved = pairs().collect();
        }
        let asked =
            moved.iter().map(|(value, target)| NamedValue { value: *target, ..(*value).clone() });
        Error::from(Box::new(CannotReach {
            asked: asked.collect(),
            reached: moved.iter().map(|(value, _)| (*value).clone()).collect(),
            singular: singular.map(|found| found.kind),
            movable: singular.map(|found| found.movable.clone()).unwrap_or_default(),
            dependent: singular.map(|found| found.dependent.clone()).unwrap_or_default(),
            motion: self.here().motion(),
            reason,
        }))
    }

    fn values(&self) -> Vec<f64> {
        self.drivers.iter().map(|driver| driver.value.value).collect()
    }

    /// Takes the drivers to rest at these values.
    pub(super) fn rest_at(&mut self, values: &[f64]) {
        for (driver, value) in self.drivers.iter_mut().zip(values) {
            driver.value.value = *value;
            driver.rest();
        }
    }
}

/// Returns why a move ended, without the path parameter that stands for the time of the run.
fn reason(error: &Error) -> String {
    let Some(kind) = error.kind() else { return error.to_string() };
    match kind {
        FailureKind::CannotFollow { reason } => reason.to_string(),
        FailureKind::WrongBranch { constraint, reason, .. } => {
            format!("the axes of `{constraint}` would change their branch: {reason}")
        }
        FailureKind::NotFinite { constraint, quantity, .. } => {
            format!("{quantity} of `{constraint}` is not finite on the way")
        }
        FailureKind::NoConvergence { constraint, .. } => {
            format!("Newton's method does not satisfy `{constraint}` on the way")
        }
        FailureKind::SingularAt { dependent, .. } => {
            format!("the equations {} depend on one another on the way", list(dependent))
        }
        _ => error.to_string(),
    }
}

/// Follows the branch through q, a position at the time [`START`], to the time 0, over equal
/// steps. The motion begins with these q, q̇ and q̈.
fn go(
    system: &System,
    options: &SolverOptions,
    [q, qd, qdd]: [&[f64]; 3],
    steps: usize,
) -> Result<Motion> {
    let mut run = Run::new(system, options, Some(EXPLAIN))?;
    let mut motion = Motion::new(system, steps + 1);
    motion.append(START, [q, qd, qdd, &[]], Outcome { iterations: 0, residual: 0.0 }, 0);
    // The sum makes the last time 0 and not −0.
    let time = |k: usize| 0.0 + START * (steps - k) as f64 / steps as f64;
    let reached = run
        .begin_from(START, q)
        .and_then(|()| (1..=steps).try_for_each(|k| run.reach(time(k), &mut motion)));
    match reached {
        Ok(()) => Ok(motion),
        Err(error) => Err(run.failed(error, motion)),
    }
}
