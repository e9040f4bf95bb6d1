//! From one solved time to the next: in one step of time if that works, else in smaller ones, which grow
//! again. Plain steps and those of redundant mechanisms are taken by this one loop; programs take whole steps
//! only, and leave the rest to it where that needs smaller ones.

use super::Outcome;
use super::options::resolution;
use crate::model::error::{Error, Result};
use crate::model::units::Units;

/// The curve is followed for this many of the last, short steps of time at least, and for this share of the
/// time asked for.
const PASSED_STEPS: f64 = 32.0;
const PASSED_SHARE: f64 = 1.0 / 64.0;

/// No step of time is shorter than this share of the time asked for.   \[-\]
pub(super) const SHORTEST: f64 = 1e-9;

/// Smaller steps of one step of time after which it is asked how many more there will be, and how many there
/// may be.
const MANY: f64 = 8192.0;
const MOST: f64 = 4e6;
pub(super) const TOO_MANY: &str = "millions of smaller steps lead to the next time, which is too far away: give times that are nearer to one another";

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
    fn attempt(&mut self, h: f64, target: f64, asked: Asked) -> std::result::Result<Outcome, Self::Trouble>;

    /// A step that is smaller than what was asked for has been taken.
    fn confirm(&mut self);

    /// The last position is in hand again, and nothing that was seen beyond it.
    fn go_back(&mut self);

    /// True if steps shorter than h help no more.
    fn is_short(&mut self, h: f64, target: f64, asked: Asked, trouble: &Self::Trouble) -> bool;

    /// On from t by other means, as far as `goal`, where shorter steps help no more; or the error that ends
    /// the run.
    fn give_up(
        &mut self,
        trouble: Self::Trouble,
        t: f64,
        target: f64,
        goal: f64,
        asked: Asked,
    ) -> Result<Outcome>;

    /// The words for lengths and times in messages.
    fn units(&self) -> &Units;
}

/// From one solved time to the next; gives what the last step of time did.
#[inline(always)]
pub(super) fn advance(stepper: &mut impl Stepping, asked: Asked) -> Result<Outcome> {
    let Asked { from, to } = asked;
    let (mut t, mut h, mut taken) = (from, to - from, 0.0);
    loop {
        let target = if (to - t).abs() <= h.abs() * 1.001 { to } else { t + h };
        stepper.keep();
        match stepper.attempt(target - t, target, asked) {
            Ok(outcome) if target == to => return Ok(outcome),
            Ok(_) => {
                stepper.confirm();
                t = target;
                h *= 2.0;
                taken += 1.0;
                if taken >= MANY && taken * asked.whole() > MOST * (t - from).abs() {
                    let units = stepper.units().clone();
                    return Err(Error::CannotFollow { t, units, reason: TOO_MANY, motion: None });
                }
            }
            Err(trouble) => {
                stepper.go_back();
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
