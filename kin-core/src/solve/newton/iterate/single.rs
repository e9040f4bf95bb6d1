//! The iteration of one position, by the matrix of a mechanism with as many equations as coordinates.

use super::Iterating;
use crate::numbers::padded;
use crate::solve::newton::{Failure, Newton, Steps, largest};
use crate::system::stop;

/// A single position that is looked for by such steps.
pub(in crate::solve::newton) struct Single<'n, 'a> {
    pub newton: &'n mut Newton<'a>,
    pub t: f64,
    pub steps: Steps,
    /// True if the point in hand is the solution of another time.
    pub still: bool,
    pub iterations: usize,
    /// Why it is not found, where a number or a matrix says so.
    pub failure: Option<Failure>,
}

impl Single<'_, '_> {
    /// Keeps the reason; gives that the position is not found.
    #[cold]
    #[inline(never)]
    fn fail(&mut self, why: Failure) -> bool {
        self.failure = Some(why);
        false
    }
}

impl Iterating for Single<'_, '_> {
    #[inline(always)]
    fn look(&mut self) -> bool {
        let looked = if std::mem::take(&mut self.still) {
            self.newton.relinearize(self.t)
        } else {
            self.newton.linearize(self.t).map(|()| true)
        };
        match looked {
            Err(why) => self.fail(why),
            Ok(changed) => !changed || self.newton.linear.factor() || self.fail(Failure::Singular),
        }
    }

    #[inline(always)]
    fn residual(&self) -> f64 {
        self.newton.residual
    }

    #[inline(always)]
    fn solve(&mut self) {
        self.newton.linear.solve();
    }

    #[inline(always)]
    fn correction(&self) -> f64 {
        padded::largest_share(self.newton.linear.whole_solution(), self.newton.shares.whole())
    }

    #[inline(always)]
    fn correction_but_for_rounding(&self, tolerance: f64) -> f64 {
        let Newton { linear, q, sizes, .. } = &*self.newton;
        let (all, rounding) = (linear.solution().iter().zip(q.iter()).zip(sizes), stop::rounding(tolerance));
        largest(all.map(|((dq, q), size)| stop::share(*dq, *q, *size, rounding)))
    }

    #[inline(always)]
    fn is_met(&mut self, tolerance: f64) -> bool {
        self.newton.is_within(tolerance)
    }

    /// The last correction keeps errors of predictions from adding up.
    #[inline(always)]
    fn end(&mut self) -> bool {
        if self.newton.options.predict {
            self.newton.correct_last();
        }
        true
    }

    #[inline(always)]
    fn step(&mut self, correction: f64) -> bool {
        let newton = &mut *self.newton;
        if self.steps == Steps::Damped && correction > stop::STALL && !newton.met() {
            if let Err(why) = newton.damped() {
                return self.fail(why);
            }
        } else {
            newton.correct();
        }
        newton.steps += 1;
        self.iterations += 1;
        true
    }
}
