//! Prediction over lanes, by the formulas of [`crate::solve::newton::predictor`].

use crate::numbers::lanes::lanewise::gone;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::solve::newton::predictor::{Long, Pace};

/// The rates at the two times before the last one, and in which lanes the long formula is to be trusted.
pub(super) struct Predictor<S: Level> {
    simd: S,
    past: [[Vec<Wide<S>>; 2]; 2],
    pace: Pace,
    trusted: Mask<S>,
}

/// The last solution: q, q̇, q̈.
pub(super) type Last<'a, S> = [&'a [Wide<S>]; 3];

impl<S: Level> Predictor<S> {
    pub(super) fn new(simd: S, n: usize) -> Self {
        let rates = || [vec![Wide::splat(simd, 0.0); n], vec![Wide::splat(simd, 0.0); n]];
        Predictor { simd, past: [rates(), rates()], pace: Pace::NONE, trusted: Mask::splat(simd, true) }
    }

    /// Forgets everything.
    pub(super) fn begin(&mut self) {
        (self.pace, self.trusted) = (Pace::NONE, Mask::splat(self.simd, true));
    }

    /// The position a step h after the last solution, into `q`.
    #[inline(always)]
    pub(super) fn predict(&self, h: f64, last: Last<'_, S>, q: &mut [Wide<S>]) {
        let (knows, long) = (self.pace.knows(h), Long::new(Wide::splat(self.simd, 0.0), h));
        for (j, q) in q.iter_mut().enumerate() {
            let short = self.short(h, last, j);
            *q = if knows { self.trusted.select(self.long(&long, last, j), short) } else { short };
        }
    }

    /// The step h from the last solution has ended at `q`: was the right formula used, in the lanes that took
    /// Newton steps?
    #[inline(always)]
    pub(super) fn compare(
        &mut self,
        h: f64,
        last: Last<'_, S>,
        q: &[Wide<S>],
        per_size: &[Wide<S>],
        stepped: Mask<S>,
    ) {
        if !self.pace.knows(h) || !stepped.any() {
            return;
        }
        let zero = Wide::splat(self.simd, 0.0);
        let (by_long, mut long, mut short) = (Long::new(zero, h), zero, zero);
        for (j, (q, per_size)) in q.iter().zip(per_size).enumerate() {
            long = long.or_larger((self.long(&by_long, last, j) - *q).abs() * *per_size);
            short = short.or_larger((self.short(h, last, j) - *q).abs() * *per_size);
        }
        self.trusted = (stepped & long.le(short)) | (!stepped & self.trusted);
    }

    /// A step h has ended: what was the last solution's is now the past.
    #[inline(always)]
    pub(super) fn advance(&mut self, h: f64, qd: &[Wide<S>], qdd: &[Wide<S>]) {
        self.pace.advance(h);
        self.past.swap(0, 1);
        self.past[0][0].copy_from_slice(qd);
        self.past[0][1].copy_from_slice(qdd);
    }

    #[inline(always)]
    fn long(&self, long: &Long<Wide<S>>, [q, qd, qdd]: Last<'_, S>, j: usize) -> Wide<S> {
        let [one, two] = &self.past;
        let (rates, second_rates) = ([qd[j], one[0][j], two[0][j]], [qdd[j], one[1][j], two[1][j]]);
        long.position(q[j], rates, second_rates)
    }

    /// q + h q̇ + ½ h² q̈
    #[inline(always)]
    fn short(&self, h: f64, [q, qd, qdd]: Last<'_, S>, j: usize) -> Wide<S> {
        q[j] + gone(q[j].all(h), q[j].all(0.5 * h), [qd[j], qdd[j]])
    }
}
