//! Where the iteration of a lane ends: its correction, and the stop rule.

use super::Lockstep;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::solve::newton::{STALL, Stop, rounding};

impl<S: Level> Lockstep<'_, S> {
    /// C_q dq = C, which is to be taken from q; gives max |dq_j| against what may be asked of it, and where
    /// it is finite.
    #[inline(always)]
    pub(super) fn correction(&mut self) -> (Wide<S>, Mask<S>) {
        self.linear.correct();
        let simd = self.simd;
        if matches!(self.options.stop, Stop::ResidualOnly(_)) && !self.options.rescue {
            return (Wide::splat(simd, f64::INFINITY), Mask::splat(simd, true));
        }
        let (mut shares, mut sum) = (Wide::splat(simd, 0.0), Wide::splat(simd, 0.0));
        for (dq, per_size) in self.linear.correction().iter().zip(&self.per_size) {
            let share = dq.abs() * *per_size;
            (shares, sum) = (share.or_larger(shares), sum + share);
        }
        let finite = sum.le(Wide::splat(simd, f64::MAX));
        let Stop::Converged { tolerance } = self.options.stop else { return (shares, finite) };
        let within = shares.le(Wide::splat(simd, tolerance));
        if !(!within).any() {
            return (shares, finite);
        }
        // Rounding of a large coordinate is no error.
        let (rounding, mut allowed) = (Wide::splat(simd, rounding(tolerance)), Wide::splat(simd, 0.0));
        for ((dq, q), size) in self.linear.correction().iter().zip(&self.q).zip(&self.sizes) {
            let share = dq.abs() / rounding.mul_add(q.abs(), *size);
            allowed = share.gt(allowed).select(share, allowed);
        }
        (within.select(shares, allowed), finite)
    }

    /// The stop rule that tests the correction too, as [`Newton`] has it.
    #[inline(always)]
    pub(super) fn converged(
        &mut self,
        open: Mask<S>,
        correction: Wide<S>,
        previous: Wide<S>,
        tolerance: f64,
    ) -> Mask<S> {
        let simd = self.simd;
        let stalled =
            correction.gt(Wide::splat(simd, 0.5) * previous) & correction.le(Wide::splat(simd, STALL));
        let within = correction.le(Wide::splat(simd, tolerance));
        if !(open & within & !stalled).any() {
            return stalled;
        }
        let mut met = Mask::splat(self.simd, true);
        for (c, norm) in self.linear.c().iter().zip(self.linear.norms()) {
            met = met & c.abs().le(Wide::splat(simd, tolerance) * *norm);
        }
        if (open & within & !met).any() {
            met = self.met_but_for_rounding(tolerance);
        }
        (within & met) | stalled
    }

    /// True if C = 0 holds where rounding of q is allowed for: Σ_j |∂C_i/∂q_j| |q_j| ε in row i.
    #[cold]
    #[inline(never)]
    fn met_but_for_rounding(&self, tolerance: f64) -> Mask<S> {
        let simd = self.simd;
        let left = |(c, norm): (&Wide<S>, &Wide<S>)| Wide::splat(simd, tolerance) * *norm - c.abs();
        let mut left: Vec<Wide<S>> = self.linear.c().iter().zip(self.linear.norms()).map(left).collect();
        for (entry, value) in self.linear.entries().iter().zip(self.linear.values()) {
            if let Some((row, column)) = *entry {
                let allowed = Wide::splat(simd, tolerance * rounding(tolerance))
                    * (*value * self.q[column as usize]).abs();
                left[row as usize] = left[row as usize] + allowed;
            }
        }
        left.iter().fold(Mask::splat(self.simd, true), |met, left| met & left.ge(Wide::splat(simd, 0.0)))
    }
}
