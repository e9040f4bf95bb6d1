//! From one solved time to the next: in one step of time if that works, else in smaller ones, which
//! grow again. Plain steps and those of redundant mechanisms are taken by this one loop; programs
//! take whole steps only, and leave the rest to it where that needs smaller ones.

use super::Outcome;
use super::options::resolution;
use crate::model::error::surface::Surface;
use crate::model::error::{Error, Result};
use crate::model::units::Units;

/// The curve is followed for this many of the last, short steps of time at least, and for this
/// share of the time asked for.
const PASSED_STEPS: f64 = 32.0;
const PASSED_SHARE: f64 = 1.0 / 64.0;

/// No step of time is shorter than this share of the time asked for.   \[-\]
pub(super) const SHORTEST: f64 = 1e-9;

/// Smaller steps of one step of time after which it is estimated how many more there will be.
const MANY: f64 = 8192.0;

/// The effort that a run may spend on smaller steps of time, which are no results: so many steps
/// times coordinates, `OVERHEAD` of them for what each step does beside its coordinates. A
/// processor of today takes some seconds for it. And so many smaller steps for each time of the
/// run.
const EFFORT: f64 = 1e7;
const OVERHEAD: f64 = 4.0;
const EACH: f64 = 20.0;

/// The length of a step may be all that is wrong with it where it is more than this share of the
/// time asked for.   \[-\]
const CLEARLY_SHORT: f64 = 1e-6;

/// A step along a curve takes as long as so many of these.
const ALONG: f64 = 10.0;

/// The work that a run may still spend on smaller steps of time. It is counted, not timed, so that
/// the verdict is the same on each machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Smaller steps that are left.
    left: f64,
    /// Smaller steps that each time of the run adds.
    each: f64,
}

impl Effort {
    /// For a run of a system with so many coordinates, with so many times the usual effort.
    pub(crate) fn new(coordinates: usize, times: f64) -> Self {
        Effort { left: times * EFFORT / (OVERHEAD + coordinates as f64), each: times * EACH }
    }

    /// One more time is asked for.
    pub(super) fn grant(&mut self) {
        self.left += self.each;
    }

    /// So many steps along a curve were tried.
    pub(super) fn walk(&mut self, steps: usize) {
        self.left -= ALONG * steps as f64;
    }

    /// So many steps were tried; false if no more may be.
    fn spend(&mut self, steps: f64) -> bool {
        self.left -= steps;
        self.left > 0.0
    }
}

/// The step of time that is asked for.
#[derive(Clone, Copy)]
pub(super) struct Asked {
    pub from: f64,
    pub to: f64,
}

impl Asked {
    pub(super) fn whole(self) -> f64 {
        (self.to - self.from).abs()
    }

    /// No judged step is shorter than this.
    pub(super) fn shortest(self) -> f64 {
        (SHORTEST * self.whole()).max(resolution(self.from, self.to))
    }
}

/// A solver that takes single steps of time.
pub(super) trait Stepping {
    /// Why a step was not taken.
    type Trouble;

    /// The position in hand becomes the last one.
    fn keep(&mut self);

    /// One step of time h to `target`, judged.
    fn attempt(
        &mut self,
        h: f64,
        target: f64,
        asked: Asked,
    ) -> std::result::Result<Outcome, Self::Trouble>;

    /// A step that is smaller than what was asked for has been taken.
    fn confirm(&mut self);

    /// The last position is in hand again, and nothing that was seen beyond it.
    fn go_back(&mut self);

    /// True if steps shorter than h help no more.
    fn is_short(&mut self, h: f64, target: f64, asked: Asked, trouble: &Self::Trouble) -> bool;

    /// On from t by other means, as far as `goal`, where shorter steps help no more; or the error
    /// that ends the run.
    fn give_up(
        &mut self,
        trouble: Self::Trouble,
        t: f64,
        target: f64,
        goal: f64,
        asked: Asked,
    ) -> Result<Outcome>;

    /// The work that the run may still spend.
    fn effort(&mut self) -> &mut Effort;

    /// Why steps are not taken, where that is not that they are too long.
    fn objection(trouble: &Self::Trouble) -> Option<&'static str>;

    /// The words for lengths and times in messages.
    fn units(&self) -> &Units;
}

/// From one solved time to the next; gives what the last step of time did.
#[inline(always)]
pub(super) fn advance<S: Stepping>(stepper: &mut S, asked: Asked) -> Result<Outcome> {
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
                    return Err(exhausted(stepper, t, Surface::chosen().too_many_steps()));
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
                        objection.unwrap_or_else(|| Surface::chosen().too_many_steps()),
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

/// The error of a run that has spent its effort at time t.
#[cold]
fn exhausted(stepper: &impl Stepping, t: f64, reason: &'static str) -> Error {
    Error::CannotFollow { t, units: stepper.units().clone(), reason, motion: None }
}
