//! Iterates one position of a mechanism with as many equations as coordinates.

use super::iterate::{Ending, Iterating};
use super::{Failure, Newton, Steps, largest};
use crate::numbers::padded;
use crate::system::stop;

/// A single position that Newton's steps search.
pub(super) struct Single<'n, 'a> {
    pub newton: &'n mut Newton<'a>,
    pub t: f64,
    pub steps: Steps,
    /// True if the present point is the solution of another time.
    pub still: bool,
    pub iterations: usize,
    /// The reason for a failure, if a number or a matrix shows it.
    pub failure: Option<Failure>,
    /// The position before the last correction, if an equation jumps with that correction.
    pub left: Option<Box<Left>>,
}

/// A position that satisfies all equations, on a branch that its last correction leaves.
pub(super) struct Left {
    pub q: Vec<f64>,
    choices: Vec<f64>,
}

impl Single<'_, '_> {
    /// Records the reason and returns false.
    #[cold]
    #[inline(never)]
    fn fail(&mut self, why: Failure) -> bool {
        self.failure = Some(why);
        false
    }

    /// Handles a last correction that led over a jump. Its target is the more exact position, so
    /// Newton's steps continue from there. If they lead back over the jump, both branches are
    /// correct within rounding, and the one with greater choices is taken: an integer that is
    /// reached counts as reached.
    #[cold]
    fn jump(&mut self) -> Ending {
        let newton = &mut *self.newton;
        let equations = newton.system.equations();
        let mut choices = Vec::new();
        newton.instant_at(self.t, true);
        equations.choices(&newton.instant, &mut choices);
        let Some(left) = &self.left else {
            self.left = Some(Box::new(Left { q: newton.before.clone(), choices }));
            newton.instant_at(self.t, false);
            return Ending::Jumped;
        };
        if left.choices > choices {
            return Ending::Failed;
        }
        newton.q.copy_from_slice(&newton.before);
        self.left = None;
        Ending::Found
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
        let all = linear.solution().iter().zip(q.iter()).zip(sizes);
        let rounding = stop::rounding(tolerance);
        largest(all.map(|((dq, q), size)| stop::share(*dq, *q, *size, rounding)))
    }

    #[inline(always)]
    fn is_met(&mut self, tolerance: f64) -> bool {
        self.newton.is_within(tolerance)
    }

    #[cold]
    fn rests(&mut self, correction: f64, tolerance: f64) -> bool {
        let Newton { linear, q, sizes, .. } = &*self.newton;
        correction <= stop::resting(q, sizes, linear.smallest_pivot()) && self.is_met(tolerance)
    }

    /// The last correction prevents errors of predictions from accumulating. Where equations jump,
    /// it decides the branch.
    #[inline(always)]
    fn end(&mut self) -> Ending {
        let is_corrected = self.newton.options.predict || self.newton.jumps;
        if is_corrected && !self.newton.correct_last() {
            return self.jump();
        }
        self.left = None;
        Ending::Found
    }

    #[cold]
    fn has_changed_branch(&mut self) -> bool {
        if !self.newton.has_branches || self.iterations == 0 {
            return false;
        }
        let [mut before, mut now] = [Vec::new(), Vec::new()];
        for (is_before, list) in [(true, &mut before), (false, &mut now)] {
            self.newton.instant_at(self.t, is_before);
            self.newton.system.equations().sides(&self.newton.instant, list);
        }
        before != now
    }

    #[inline(always)]
    fn step(&mut self, correction: f64) -> bool {
        let newton = &mut *self.newton;
        if newton.has_branches {
            newton.before.copy_from_slice(&newton.q);
        }
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
