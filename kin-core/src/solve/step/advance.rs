//! Moves from one solved time to the next: in one step of time if this step succeeds, otherwise in
//! smaller steps, which grow again.
//!
//! The step-by-step solver and redundant mechanisms share this loop. Compiled programs make only
//! whole steps. If a whole step of a program fails, this loop continues.

use crate::coordinates::units::Units;
use crate::outcome::error::{Error, FailureKind, Result, UnfollowedReason};
use crate::solve::newton::Outcome;
use crate::solve::options::resolution;

/// The curve is followed for at least this many of the last, short steps of time, and for this
/// share of the requested time.
const PASSED_STEPS: f64 = 32.0;
const PASSED_SHARE: f64 = 1.0 / 64.0;

/// The shortest step of time, as a share of the requested step. \[-\]
pub(super) const SHORTEST: f64 = 1e-9;

/// The number of smaller steps after which the loop estimates how many more will follow.
const MANY: f64 = 8192.0;

/// The effort that a run may spend on smaller steps of time, which are no results: steps times
/// coordinates, with `OVERHEAD` coordinates added for the fixed cost of a step. A present processor
/// takes some seconds for it. Each time of the run adds a number of smaller steps.
const EFFORT: f64 = 1e7;
const OVERHEAD: f64 = 4.0;
const EACH: f64 = 20.0;

/// If a step is longer than this share of the requested step, its length may be the only reason for
/// the failure. \[-\]
const CLEARLY_SHORT: f64 = 1e-6;

/// The cost of a step along a curve, in steps of time.
const ALONG: f64 = 10.0;

/// The work that a run may still spend on smaller steps of time. It counts steps, not time, so the
/// result is the same on each machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// The remaining smaller steps.
    left: f64,
    /// The smaller steps that each time of the run adds.
    each: f64,
}

impl Effort {
    /// Creates the effort for a run of a system with this number of coordinates; `times` multiplies
    /// the usual effort.
    pub(crate) fn new(coordinates: usize, times: f64) -> Self {
        Effort { left: times * EFFORT / (OVERHEAD + coordinates as f64), each: times * EACH }
    }

    /// Adds the steps of one more time.
    pub(in crate::solve) fn grant(&mut self) {
        self.left += self.each;
    }

    /// Spends steps along a curve.
    pub(in crate::solve) fn walk(&mut self, steps: usize) {
        self.left -= ALONG * steps as f64;
    }

    /// Spends steps. Returns false if no more are allowed.
    fn spend(&mut self, steps: f64) -> bool {
        self.left -= steps;
        self.left > 0.0
    }
}

/// The requested step of time.
#[derive(Clone, Copy)]
pub(in crate::solve) struct Asked {
    pub from: f64,
    pub to: f64,
}

impl Asked {
    pub(in crate::solve) fn whole(self) -> f64 {
        (self.to - self.from).abs()
    }

    /// Returns the shortest step that is tested.
    pub(in crate::solve) fn shortest(self) -> f64 {
        (SHORTEST * self.whole()).max(resolution(self.from, self.to))
    }
}

/// A solver that makes single steps of time.
pub(in crate::solve) trait Stepping {
    /// The reason why a step failed.
    type Trouble;

    /// Makes the present position the last one.
    fn keep(&mut self);

    /// Makes and tests one step of time h to `target`.
    fn attempt(
        &mut self,
        h: f64,
        target: f64,
        asked: Asked,
    ) -> std::result::Result<Outcome, Self::Trouble>;

    /// Confirms a step that is smaller than the requested one.
    fn confirm(&mut self);

    /// Restores the last position and discards everything found beyond it.
    fn go_back(&mut self);

    /// Returns true if steps shorter than h do not help.
    fn is_short(&mut self, h: f64, target: f64, asked: Asked, trouble: &Self::Trouble) -> bool;

    /// Continues from t by other methods up to `goal`, if shorter steps do not help. Returns the
    /// error that ends the run otherwise.
    fn give_up(
        &mut self,
        trouble: Self::Trouble,
        t: f64,
        target: f64,
        goal: f64,
        asked: Asked,
    ) -> Result<Outcome>;

    /// Returns the work that the run may still spend.
    fn effort(&mut self) -> &mut Effort;

    /// Returns why steps fail, if their length is not the reason.
    fn objection(trouble: &Self::Trouble) -> Option<UnfollowedReason>;

    /// Returns the names of the units for messages.
    fn units(&self) -> &Units;
}

/// Moves from one solved time to the next and returns the outcome of the last step of time.
#[inline(always)]
pub(in crate::solve) fn advance<S: Stepping>(stepper: &mut S, asked: Asked) -> Result<Outcome> {
    let Asked { from, to } = asked;
    let mut t = from;
    let mut h = to - from;
    let mut tried = 0.0;
    loop {
        let target = if (to - t).abs() <= h.abs() * 1.001 { to } else { t + h };
        stepper.keep();
        match stepper.attempt(target - t, target, asked) {
            Ok(outcome) if target == to => return Ok(outcome),
            Ok(_) => {
                stepper.confirm();
                t = target;
                h *= 2.0;
                tried += 1.0;
                let more = tried * ((to - t) / (t - from)).abs();
                let effort = stepper.effort();
                if !effort.spend(1.0) || (tried >= MANY && more > effort.left) {
                    return Err(exhausted(stepper, t, UnfollowedReason::TooManySteps));
                }
            }
            Err(trouble) => {
                stepper.go_back();
                tried += 1.0;
                if !stepper.effort().spend(1.0) {
                    let is_short = (target - t).abs() <= CLEARLY_SHORT * asked.whole();
                    let objection = S::objection(&trouble).filter(|_| is_short);
                    return Err(exhausted(
                        stepper,
                        t,
                        objection.unwrap_or(UnfollowedReason::TooManySteps),
                    ));
                }
                if !stepper.is_short(target - t, target, asked, &trouble) {
                    h *= 0.5;
                    continue;
                }
                let ahead = (PASSED_STEPS * h.abs()).max(PASSED_SHARE * asked.whole());
                let goal = if (to - t).abs() <= 1.001 * ahead { to } else { t + ahead.copysign(h) };
                let outcome = stepper.give_up(trouble, t, target, goal, asked)?;
                if goal == to {
                    return Ok(outcome);
                }
                t = goal;
            }
        }
    }
}

/// Builds the error of a run that has spent its effort at time t.
#[cold]
fn exhausted(stepper: &impl Stepping, t: f64, reason: UnfollowedReason) -> Error {
    FailureKind::CannotFollow { reason }.at(t, stepper.units())
}
