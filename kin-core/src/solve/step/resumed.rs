//! Continues with the step-by-step solver after a compiled program.

use super::stepper::Stepper;
use crate::outcome::error::Result;
use crate::solve::follow::Span;
use crate::solve::motion::Motion;
use crate::solve::newton::{Newton, Steps, first_position};
use crate::system::evaluate::Instant;

impl Stepper<'_> {
    /// Returns true if the ends of a step between two times with this smallest pivot show
    /// everything that time does in between.
    pub(in crate::solve) fn ends_suffice(&mut self, from: f64, to: f64, pivot: f64) -> bool {
        self.check.as_mut().is_none_or(|check| check.ends_suffice(from, to, pivot))
    }

    /// Tests the ends of a step and samples equations without bounds, at the position of the later
    /// time. The instant is at that position.
    pub(in crate::solve) fn samples_suffice(
        &mut self,
        (from, to, q): (f64, f64, &[f64]),
        pivot: f64,
        instant: &mut Instant,
    ) -> bool {
        let equations = self.newton.system.equations();
        let Some(check) = self.check.as_mut().filter(|check| check.may_sample()) else {
            return false;
        };
        equations.set_time(to, instant);
        equations.set_position(q, instant);
        check.samples_suffice(Span { equations, from, to, pivot }, instant)
    }

    /// Takes the last three times of a motion as those before the next step; `pivot` is the
    /// smallest pivot at the last one.
    pub(in crate::solve) fn go_on(&mut self, motion: &Motion, pivot: f64) {
        let Some(last) = motion.len().checked_sub(1) else { return };
        let times = motion.times();
        self.predictor.forget();
        for k in (0..2).rev().filter(|k| *k < last) {
            let at = last - 1 - k;
            self.newton.qd.copy_from_slice(motion.qd(at));
            self.newton.qdd.copy_from_slice(motion.qdd(at));
            let h = times[at + 1] - times[at];
            self.predictor.advance(h, &mut self.newton.qd, &mut self.newton.qdd);
        }
        self.newton.q.copy_from_slice(motion.q(last));
        self.newton.qd.copy_from_slice(motion.qd(last));
        self.newton.qdd.copy_from_slice(motion.qdd(last));
        self.last = Some(times[last]);
        self.untouched = false;
        self.check.iter_mut().for_each(|check| check.go_on(pivot));
    }

    /// Begins the next step at this pose, which satisfies the equations at time t but for rounding,
    /// as at the first position of a run. Errors: C_q is singular there.
    pub(in crate::solve) fn begin_from(&mut self, t: f64, q: &[f64]) -> Result<()> {
        self.begin(t, q, first_position::resume)
    }

    /// Begins the next step at time k of a motion, with the sizes of the present point, whatever
    /// was done before. Errors: C_q is singular there.
    pub(in crate::solve) fn begin_at(&mut self, motion: &Motion, k: usize) -> Result<()> {
        self.begin(motion.times()[k], motion.q(k), |newton, t| {
            first_position::from_start(newton, t, Steps::Near).map(|_| ())
        })
    }

    fn begin(
        &mut self,
        t: f64,
        q: &[f64],
        solve: impl FnOnce(&mut Newton<'_>, f64) -> Result<()>,
    ) -> Result<()> {
        self.predictor.forget();
        self.passed.clear();
        self.newton.q.copy_from_slice(q);
        solve(&mut self.newton, t)?;
        self.check.iter_mut().for_each(|check| check.accept(&self.newton));
        self.newton.linear.confirm();
        (self.last, self.untouched) = (Some(t), true);
        Ok(())
    }
}
