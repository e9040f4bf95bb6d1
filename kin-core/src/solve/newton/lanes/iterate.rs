//! Newton's iteration over lanes: the one of [`crate::solve::newton::iterate`], by matrices of several cases.

use pulp::NullaryFnOnce;

use super::Lockstep;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::solve::newton::iterate::Iterating;
use crate::system::evaluate::lanes::LaneSystems;
use crate::system::stop;

/// The positions of all lanes that are looked for.
pub(super) struct All<'x, 'o, 'c, S: Level> {
    pub lanes: &'x mut Lockstep<'o, S>,
    pub batch: &'x LaneSystems<'c>,
    /// True if the points in hand are the solutions of another time.
    pub still: bool,
    pub first: bool,
    /// True if rows and columns have been measured at this time.
    pub measured: bool,
}

impl<S: Level> Iterating for All<'_, '_, '_, S> {
    type Number = Wide<S>;

    #[inline(always)]
    fn look(&mut self, open: Mask<S>, done: Mask<S>) -> [Mask<S>; 2] {
        let lanes = &mut *self.lanes;
        let changed = if std::mem::take(&mut self.still) {
            let (c, values) = lanes.linear.written();
            lanes.equations.relinearize(self.batch, &lanes.instant, c, values)
        } else {
            lanes.look(self.batch);
            true
        };
        let mut open = open & lanes.measured();
        if !changed {
            return [open, done];
        }
        // From one iterate of a step to the next the values hardly change.
        if self.first || !std::mem::replace(&mut self.measured, true) {
            open = open & lanes.linear.measure(open);
        }
        // Lanes that are done stay as they are, and so do their factors.
        let fits = lanes.linear.factor(open | done);
        [open & fits, done & fits]
    }

    #[inline(always)]
    fn residual(&self) -> Wide<S> {
        self.lanes.residual
    }

    /// C_q dq = C, which is to be taken from q.
    #[inline(always)]
    fn solve(&mut self) {
        self.lanes.linear.correct();
    }

    #[inline(always)]
    fn correction(&self) -> Wide<S> {
        let Lockstep { simd, linear, per_size, .. } = &*self.lanes;
        let number = |x: f64| Wide::splat(*simd, x);
        let (mut largest, mut sum) = (number(0.0), number(0.0));
        for (dq, per_size) in linear.correction().iter().zip(per_size) {
            let share = dq.abs() * *per_size;
            (largest, sum) = (share.or_larger(largest), sum + share);
        }
        // A number that is not finite may be lost among the largest, not in a sum.
        sum.le(number(f64::MAX)).select(largest, number(f64::INFINITY))
    }

    #[inline(always)]
    fn correction_but_for_rounding(&self, tolerance: f64) -> Wide<S> {
        let Lockstep { simd, linear, q, sizes, .. } = &*self.lanes;
        let number = |x: f64| Wide::splat(*simd, x);
        let (rounding, mut largest, mut sum) = (number(stop::rounding(tolerance)), number(0.0), number(0.0));
        for ((dq, q), size) in linear.correction().iter().zip(q).zip(sizes) {
            let share = stop::share(*dq, *q, *size, rounding);
            (largest, sum) = (share.or_larger(largest), sum + share);
        }
        sum.le(number(f64::MAX)).select(largest, number(f64::INFINITY))
    }

    #[inline(always)]
    fn is_met(&mut self, tolerance: f64, asked: Mask<S>) -> Mask<S> {
        let lanes = &*self.lanes;
        let mut met = Mask::splat(lanes.simd, true);
        for (c, norm) in lanes.linear.c().iter().zip(lanes.linear.norms()) {
            met = met & c.abs().le(norm.all(tolerance) * *norm);
        }
        if (asked & !met).any() { lanes.met_but_for_rounding(tolerance) } else { met }
    }

    #[inline(always)]
    fn end(&mut self, converged: Mask<S>) -> Mask<S> {
        let Lockstep { linear, last, .. } = &mut *self.lanes;
        for (last, dq) in last.iter_mut().zip(linear.correction()) {
            *last = converged.select(*dq, *last);
        }
        converged
    }

    #[inline(always)]
    fn step(&mut self, open: Mask<S>, _: Wide<S>) -> Mask<S> {
        let Lockstep { linear, q, iterations, .. } = &mut *self.lanes;
        for (q, dq) in q.iter_mut().zip(linear.correction()) {
            *q = open.select(*q - *dq, *q);
        }
        *iterations = *iterations + open.as_numbers();
        open
    }
}

/// A look at C, on its way into the function that has the machine's instructions.
struct Look<'x, 'o, S: Level>(&'x Lockstep<'o, S>, f64);

impl<S: Level> NullaryFnOnce for Look<'_, '_, S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn call(self) -> Mask<S> {
        let Look(Lockstep { simd, linear, q, .. }, tolerance) = self;
        let entries = linear.entries().iter().zip(linear.values());
        let entries = entries
            .filter_map(|(entry, value)| entry.map(|(row, column)| (row as usize, column as usize, *value)));
        let mut allowed = Vec::new();
        stop::allowances(tolerance, linear.norms(), entries, q, &mut allowed);
        let mut met = Mask::splat(*simd, true);
        for (c, allowed) in linear.c().iter().zip(&allowed) {
            met = met & c.abs().le(*allowed);
        }
        met
    }
}

impl<S: Level> Lockstep<'_, S> {
    /// True where C = 0 holds if rounding of q is allowed for.
    #[cold]
    #[inline(never)]
    fn met_but_for_rounding(&self, tolerance: f64) -> Mask<S> {
        let simd = self.simd;
        simd.vectorize(Look(self, tolerance))
    }
}
