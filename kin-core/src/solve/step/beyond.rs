//! Handles times at which smaller steps do not help: follows the curve past a singular position, or
//! ends the run.

use super::advance::{Asked, SHORTEST};
use super::stepper::{SHORT, Stepper, Trouble};
use crate::coordinates::units::Units;
use crate::outcome::error::{Error, FailureKind, Result, UnfollowedReason};
use crate::solve::follow::{
    self, Branch, Check, Landed, Lost, Objection, SingularKind, SingularPosition,
};
use crate::solve::newton::{Failure, Newton, Outcome, Steps, largest};

impl Stepper<'_> {
    /// Follows the curve as far as `goal` if possible, because short steps of time from t to
    /// `target` do not help. `to` is the requested time.
    pub(super) fn pass(
        &mut self,
        trouble: Trouble,
        t: f64,
        target: f64,
        goal: f64,
        asked: Asked,
    ) -> Result<Outcome> {
        let to = asked.to;
        if self.check.is_some() {
            let before = self.bifurcations;
            let options = self.newton.options;
            let turns = |number| options.follow.turns(before + number);
            let (passed, steps) = follow::pass(&self.newton, &self.q, t, goal, &turns);
            self.effort.walk(steps);
            match passed {
                Ok(passage) => {
                    self.bifurcations += passage.passed.len();
                    self.passed.extend(passage.passed);
                    return self.land(passage.landed, t, goal);
                }
                Err(Lost::Turned(found)) => {
                    let error = toggle(&found, to, self.newton.system.unit_words());
                    self.passed.push(*found);
                    return Err(error);
                }
                Err(Lost::Lost) => {}
            }
        }
        let is_far = (target - t).abs() <= SHORTEST * (to - t).abs()
            && self.check.is_some()
            && self.moved(target - t, target) > SHORT;
        let units = self.newton.system.unit_words();
        let lost = |reason| FailureKind::CannotFollow { reason }.at(t, units);
        Err(match trouble {
            // Even the shortest step rotates bodies too far for Newton's method.
            Trouble::Failed(_) if is_far => lost(UnfollowedReason::TooManySteps),
            Trouble::Failed(failure) => {
                self.newton.q.copy_from_slice(&self.failed);
                // The error names the worst equation, so the equations are evaluated at the failed
                // position.
                let _ = self.newton.linearize(target);
                self.newton.error(failure, target, Some(t))
            }
            Trouble::Objected(Objection::Long) => lost(UnfollowedReason::TooManySteps),
            Trouble::Objected(objection) => lost(objection.reason()),
        })
    }

    /// Takes the end of the curve as the position at time `to`.
    fn land(&mut self, landed: Landed, t: f64, to: f64) -> Result<Outcome> {
        self.predictor.forget();
        self.untouched = false;
        let newton = &mut self.newton;
        let outcome = match landed {
            Landed::Regular(q) => {
                newton.q.copy_from_slice(&q);
                let solved = newton.solve(to, Steps::Near);
                let outcome = solved.and_then(|outcome| newton.rates().map(|()| outcome));
                let outcome = outcome.map_err(|failure| newton.error(failure, to, Some(t)))?;
                self.check.iter_mut().for_each(|check| check.accept(newton));
                outcome
            }
            Landed::Singular(q, branch) => {
                if newton.options.jerk {
                    let jerk = jerk_between(newton, &q, &branch, to)
                        .map_err(|failure| newton.error(failure, to, Some(t)))?;
                    newton.qddd.copy_from_slice(&jerk);
                }
                newton.q.copy_from_slice(&q);
                newton.linearize(to).map_err(|failure| newton.error(failure, to, Some(t)))?;
                newton.qd.copy_from_slice(&branch.qd);
                newton.qdd.copy_from_slice(&branch.qdd);
                self.check.iter_mut().for_each(Check::leave_open);
                Outcome { iterations: 0, residual: newton.worst().1 }
            }
        };
        Ok(outcome)
    }
}

/// Returns q⃛ at a singular position on one of its branches, from the means of its values a little
/// before and after, with Richardson extrapolation.
fn jerk_between(
    newton: &mut Newton<'_>,
    q: &[f64],
    Branch { qd, qdd }: &Branch,
    t: f64,
) -> std::result::Result<Vec<f64>, Failure> {
    /// The displacement of the fastest coordinate to the nearer poses. \[-\]
    const NEAR: f64 = 0.05;
    let rates = qd
        .iter()
        .zip(qdd)
        .zip(newton.shares())
        .map(|((qd, qdd), share)| (qd.abs() * share).max((qdd.abs() * share).sqrt()));
    let fastest = largest(rates);
    let mut jerk = vec![0.0; q.len()];
    for (steps, weight) in
        [(-1.0, 2.0 / 3.0), (1.0, 2.0 / 3.0), (-2.0, -1.0 / 6.0), (2.0, -1.0 / 6.0)]
    {
        let h = steps * NEAR / fastest;
        newton
            .q
            .iter_mut()
            .zip(q)
            .zip(qd.iter().zip(qdd))
            .for_each(|((next, q), (qd, qdd))| *next = q + h * (qd + 0.5 * h * qdd));
        newton.solve(t + h, Steps::Near)?;
        newton.rates()?;
        jerk.iter_mut().zip(&newton.qddd).for_each(|(jerk, qddd)| *jerk += weight * qddd);
    }
    Ok(jerk)
}

/// Builds the error of a run that turning points end.
fn toggle(found: &SingularPosition, asked: f64, units: &Units) -> Error {
    debug_assert_eq!(found.kind, SingularKind::TurningPoint);
    let SingularPosition { t, movable, dependent, .. } = found.clone();
    FailureKind::Toggle { asked, movable, dependent }.at(t, units)
}
