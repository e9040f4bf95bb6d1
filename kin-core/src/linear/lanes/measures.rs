//! Measures of rows and columns over lanes, the largest so far, and what follows from them: limits of values,
//! weights of pivots.

use pulp::NullaryFnOnce;

use super::super::{Linear, SLACK};
use super::WideLinear;
use crate::numbers::lanes::{Level, Mask, Wide};

/// Matrices that are measured in some lanes, on their way into the function that has the machine's
/// instructions.
struct Anew<'x, S: Level>(&'x mut WideLinear<S>, Mask<S>);

impl<S: Level> NullaryFnOnce for Anew<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.0.measure_all(self.1);
        self.0.set_limits();
    }
}

/// Pivots that are weighted, on the same way.
struct Weighted<'x, S: Level>(&'x mut WideLinear<S>);

impl<S: Level> NullaryFnOnce for Weighted<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.0.weigh();
    }
}

impl<S: Level> WideLinear<S> {
    /// Measures rows and columns of the values as written in the lanes that are wanted; true where all values
    /// are finite.
    #[inline(always)]
    pub(crate) fn measure(&mut self, wanted: Mask<S>) -> Mask<S> {
        let mut inside = Mask::splat(self.simd, true);
        for (place, limit) in self.varying.iter().zip(&self.limits) {
            inside = inside & self.memory[*place as usize].abs().le(*limit);
        }
        let grown =
            if std::mem::take(&mut self.fresh) { Mask::splat(self.simd, true) } else { wanted & !inside };
        if grown.any() { self.measure_anew(grown) } else { inside }
    }

    /// The same where something has grown, or is not finite.
    #[cold]
    #[inline(never)]
    fn measure_anew(&mut self, grown: Mask<S>) -> Mask<S> {
        let simd = self.simd;
        simd.vectorize(Anew(self, grown));
        self.finite()
    }

    #[inline(always)]
    fn measure_all(&mut self, grown: Mask<S>) {
        let (zero, WideLinear { recorder, memory, sizes, norms, tops, .. }) =
            (Wide::splat(self.simd, 0.0), self);
        for same in cells(recorder) {
            let (i, j, value) = sum(same, recorder, memory, zero);
            norms[i] = grown.select(norms[i].max(value.abs() * sizes[j]), norms[i]);
        }
        for same in cells(recorder) {
            let (i, j, value) = sum(same, recorder, memory, zero);
            let size = value.abs() * sizes[j];
            let share = size.gt(zero).select(size / norms[i], zero);
            tops[j] = grown.select(tops[j].max(share), tops[j]);
        }
    }

    /// Sets the limits of values by the measures and the sizes.
    #[inline(always)]
    pub(super) fn set_limits(&mut self) {
        let (slack, one) = (Wide::splat(self.simd, SLACK), Wide::splat(self.simd, 1.0));
        for (place, limit) in self.varying.iter().zip(&mut self.limits) {
            let Some((i, j)) = self.recorder.entries[*place as usize] else { continue };
            let (i, j) = (i as usize, j as usize);
            *limit = slack * self.norms[i] * self.tops[j].min(one) / self.sizes[j];
        }
        self.weighted = false;
    }

    /// The lanes in which all values are finite.
    pub(super) fn finite(&self) -> Mask<S> {
        let largest = Wide::splat(self.simd, f64::MAX);
        let finite = |all, k: &u32| all & self.memory[*k as usize].abs().le(largest);
        self.recorder.sorted.iter().fold(Mask::splat(self.simd, true), finite)
    }

    /// Tells the watch how pivots are measured.
    #[cold]
    #[inline(never)]
    pub(super) fn weight_pivots(&mut self) {
        self.weighted = true;
        let simd = self.simd;
        simd.vectorize(Weighted(self));
    }

    #[inline(always)]
    fn weigh(&mut self) {
        let (zero, one) = (Wide::splat(self.simd, 0.0), Wide::splat(self.simd, 1.0));
        let WideLinear { recorder, norms, tops, sizes, pivots, .. } = self;
        let Some(recording) = &recorder.recording else { return };
        for (_, [row, column], per_unit) in pivots {
            *per_unit =
                unit(norms[*row as usize], tops[*column as usize], sizes[*column as usize], zero, one)
                    .reciprocal();
        }
        self.inverse_constant = zero;
        for &(row, column, value) in &recording.constant {
            let unit = unit(norms[row as usize], tops[column as usize], sizes[column as usize], zero, one);
            self.inverse_constant = self.inverse_constant.max((unit * unit.all(value.abs())).reciprocal());
        }
    }
}

/// The values of each place of the matrix.
#[inline(always)]
fn cells(recorder: &Linear) -> impl Iterator<Item = &[u32]> {
    recorder.sorted.chunk_by(|a, b| recorder.entries[*a as usize] == recorder.entries[*b as usize])
}

/// Row, column and value of one place of the matrix.
#[inline(always)]
fn sum<S: Level>(
    same: &[u32],
    recorder: &Linear,
    memory: &[Wide<S>],
    zero: Wide<S>,
) -> (usize, usize, Wide<S>) {
    let (i, j) = recorder.entries[same[0] as usize].unwrap_or_default();
    let mut value = zero;
    for k in same {
        value = value + memory[*k as usize];
    }
    (i as usize, j as usize, value)
}

/// The factor by which a pivot is measured.
#[inline(always)]
fn unit<S: Level>(norm: Wide<S>, top: Wide<S>, size: Wide<S>, zero: Wide<S>, one: Wide<S>) -> Wide<S> {
    norm.gt(zero).select(one / norm, one) * top.gt(zero).select(size / top, size)
}
