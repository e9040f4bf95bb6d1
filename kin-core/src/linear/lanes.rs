//! The recorded elimination replayed over lanes: several matrices of one pattern at once, each lane watched by itself.
//!
//! One recording serves all lanes. Where one of them does not fit it any more, the elimination is recorded anew at the numbers of that lane;
//! lanes that fit neither are told to their owner, who goes on without them.

use super::program::Kind;
use super::record::Recording;
use super::replay::{Replay, SMALL};
use super::{FADED, GROWTH, Linear, REFINED, SINGULAR, SLACK, SUSPICIOUS};
use crate::lanes::{Level, Mask, Wide};

/// Square matrices of one pattern, one in each lane.
pub(crate) struct WideLinear<S: Level> {
    simd: S,
    /// Records, and knows the pattern; and as it was at first, with the recording that all groups of lanes begin with.
    recorder: Linear,
    first: Linear,
    recorded_anew: bool,
    memory: Vec<Wide<S>>,
    factor: Replay,
    solve: Replay,
    /// Whether all places of the memory are below [`SMALL`].
    small: bool,
    /// The multipliers and the other numbers that are factored: their places, and what makes each one of order 1.
    multipliers: Vec<(u32, f64)>,
    cells: Vec<(u32, f64)>,
    /// The pivots that are no constants: their places, row and column, and one over what makes each a share of these.
    pivots: Vec<(u32, [u32; 2], Wide<S>)>,
    sizes: Vec<Wide<S>>,
    norms: Vec<Wide<S>>,
    tops: Vec<Wide<S>>,
    /// Values that can change and do not stand on the ground, and their limits.
    varying: Vec<u32>,
    limits: Vec<Wide<S>>,
    /// Whether nothing has been measured since the beginning.
    fresh: bool,
    /// Whether the weights of pivots know the measures.
    told: bool,
    smallest_constant: Wide<S>,
    smallest: Wide<S>,
    best: Wide<S>,
}

impl<S: Level> WideLinear<S> {
    /// Matrices of the pattern that `recorder` was made for, with its recording if it has one.
    pub(crate) fn new(simd: S, recorder: Linear) -> Self {
        let (n, number) = (recorder.n, |x: f64| Wide::splat(simd, x));
        let varies = |k: &u32| recorder.constants.get(*k as usize).copied().flatten().is_none();
        let varying: Vec<u32> = recorder.sorted.iter().copied().filter(varies).collect();
        let mut linear = WideLinear {
            simd,
            first: recorder.clone(),
            recorded_anew: false,
            memory: vec![number(0.0); recorder.places.zero as usize + 1],
            factor: Replay::default(),
            solve: Replay::default(),
            small: false,
            multipliers: Vec::new(),
            cells: Vec::new(),
            pivots: Vec::new(),
            sizes: vec![number(1.0); n],
            norms: vec![number(0.0); n],
            tops: vec![number(0.0); n],
            limits: vec![number(0.0); varying.len()],
            varying,
            fresh: true,
            told: false,
            smallest_constant: number(0.0),
            smallest: number(0.0),
            best: number(0.0),
            recorder,
        };
        let constants = linear.recorder.constants.clone();
        linear.memory.iter_mut().zip(constants.iter()).for_each(|(place, constant)| *place = number(constant.unwrap_or(0.0)));
        linear.load();
        linear
    }

    /// Forgets all matrices before, for others that begin at these sizes: nothing of what was measured stays.
    pub(crate) fn begin(&mut self, sizes: &[Wide<S>]) {
        let zero = Wide::splat(self.simd, 0.0);
        self.norms.fill(zero);
        self.tops.fill(zero);
        (self.fresh, self.best) = (true, zero);
        if std::mem::take(&mut self.recorded_anew) {
            self.recorder = self.first.clone();
            self.load();
        }
        self.set_sizes(sizes);
    }

    pub(crate) fn set_sizes(&mut self, sizes: &[Wide<S>]) {
        self.sizes.copy_from_slice(sizes);
        self.set_limits();
    }

    pub(crate) fn values_mut(&mut self) -> &mut [Wide<S>] {
        &mut self.memory[..self.recorder.entries.len()]
    }

    pub(crate) fn values(&self) -> &[Wide<S>] {
        &self.memory[..self.recorder.entries.len()]
    }

    pub(crate) fn rhs_mut(&mut self) -> &mut [Wide<S>] {
        &mut self.memory[self.recorder.places.rhs as usize..][..self.recorder.n]
    }

    pub(crate) fn solution(&self) -> &[Wide<S>] {
        &self.memory[self.recorder.places.solution as usize..][..self.recorder.n]
    }

    pub(crate) fn norms(&self) -> &[Wide<S>] {
        &self.norms
    }

    /// Row and column of each value.
    pub(crate) fn entries(&self) -> &[Option<(u32, u32)>] {
        &self.recorder.entries
    }

    /// The smallest pivot of the last factoring, by the measures of its row and column.   \[-\]
    #[inline(always)]
    pub(crate) fn smallest_pivot(&self) -> Wide<S> {
        self.smallest
    }

    /// Of each block whose determinant can change its sign, that sign at the last factoring, −1 or 1, into `signs`.
    #[inline(always)]
    pub(crate) fn orientation(&self, signs: &mut Vec<Wide<S>>) {
        signs.clear();
        let Some(recording) = &self.recorder.recording else { return };
        let number = |negative: bool| Wide::splat(self.simd, if negative { -1.0 } else { 1.0 });
        signs.extend(recording.orientation.blocks.iter().map(|negative| number(*negative)));
        let zero = Wide::splat(self.simd, 0.0);
        for &(place, block) in &recording.orientation.pivots {
            let sign = &mut signs[block as usize];
            *sign = self.memory[place as usize].lt(zero).select(-*sign, *sign);
        }
    }

    /// Measures rows and columns of the values as written in the lanes that are wanted; true where all values are finite.
    #[inline(always)]
    pub(crate) fn measure(&mut self, wanted: Mask<S>) -> Mask<S> {
        let mut inside = Mask::splat(self.simd, true);
        for (place, limit) in self.varying.iter().zip(&self.limits) {
            inside = inside & self.memory[*place as usize].abs().le(*limit);
        }
        let grown = if std::mem::take(&mut self.fresh) { Mask::splat(self.simd, true) } else { wanted & !inside };
        if grown.any() { self.measure_anew(grown) } else { inside }
    }

    /// The same where something has grown, or is not finite.
    #[cold]
    #[inline(never)]
    fn measure_anew(&mut self, grown: Mask<S>) -> Mask<S> {
        let zero = Wide::splat(self.simd, 0.0);
        let same_place = |a: &u32, b: &u32| self.recorder.entries[*a as usize] == self.recorder.entries[*b as usize];
        let size = |same: &[u32]| {
            let (i, j) = self.recorder.entries[same[0] as usize].unwrap_or_default();
            let value = same.iter().fold(zero, |sum, k| sum + self.memory[*k as usize]);
            (i as usize, j as usize, value.abs() * self.sizes[j as usize])
        };
        let sizes: Vec<(usize, usize, Wide<S>)> = self.recorder.sorted.chunk_by(same_place).map(size).collect();
        for &(i, _, size) in &sizes {
            self.norms[i] = grown.select(self.norms[i].max(size), self.norms[i]);
        }
        for &(i, j, size) in &sizes {
            let share = size.gt(zero).select(size / self.norms[i], zero);
            self.tops[j] = grown.select(self.tops[j].max(share), self.tops[j]);
        }
        self.set_limits();
        let largest = Wide::splat(self.simd, f64::MAX);
        let finite = |all, k: &u32| all & self.memory[*k as usize].abs().le(largest);
        self.recorder.sorted.iter().fold(Mask::splat(self.simd, true), finite)
    }

    fn set_limits(&mut self) {
        let (slack, one) = (Wide::splat(self.simd, SLACK), Wide::splat(self.simd, 1.0));
        for (place, limit) in self.varying.iter().zip(&mut self.limits) {
            let Some((i, j)) = self.recorder.entries[*place as usize].map(|(i, j)| (i as usize, j as usize)) else { continue };
            *limit = slack * self.norms[i] * self.tops[j].min(one) / self.sizes[j];
        }
        self.told = false;
    }

    /// A = L U in every lane; true in those of `wanted` where the factors can be trusted.
    #[inline(always)]
    pub(crate) fn factor(&mut self, wanted: Mask<S>) -> Mask<S> {
        if self.recorder.recording.is_some() {
            let fits = self.replay();
            if !(wanted & !fits).any() {
                return wanted;
            }
        }
        self.factor_anew(wanted)
    }

    /// The same with a new recording, made at the first lane that does not fit the old one.
    #[cold]
    #[inline(never)]
    fn factor_anew(&mut self, wanted: Mask<S>) -> Mask<S> {
        let mut fits = if self.recorder.recording.is_some() { wanted & self.replay() } else { wanted & !wanted };
        for lane in 0..Wide::<S>::LANES {
            if !wanted.lane(lane) || fits.lane(lane) {
                continue;
            }
            if self.record(lane) {
                // Others must fit the new recording too.
                fits = wanted & self.replay();
                break;
            }
        }
        fits
    }

    /// Records the elimination at the numbers of a lane; false if they are singular.
    fn record(&mut self, lane: usize) -> bool {
        let of_lane = |x: &Wide<S>| x.as_slice()[lane];
        let sizes: Vec<f64> = self.sizes.iter().map(of_lane).collect();
        let recorder = &mut self.recorder;
        recorder.recording = None;
        recorder.forget();
        recorder.set_sizes(&sizes);
        recorder.values_mut().iter_mut().zip(&self.memory).for_each(|(value, x)| *value = of_lane(x));
        recorder.measure();
        let recorded = recorder.factor();
        self.recorded_anew = true;
        if recorded {
            self.load();
        }
        recorded
    }

    /// Takes over the recording, if there is one.
    fn load(&mut self) {
        let Some(recording) = &self.recorder.recording else { return };
        let Recording { factor, solve, weights, .. } = recording.as_ref();
        (self.factor, self.solve) = (Replay::new(factor), Replay::new(solve));
        let zero = Wide::splat(self.simd, 0.0);
        let written: Vec<(Kind, u32)> = factor.written().collect();
        let weighted = |wanted: fn(Kind) -> bool| {
            let all = written.iter().zip(weights).filter(|((kind, _), _)| wanted(*kind));
            all.map(|((_, place), weight)| (*place, *weight)).collect::<Vec<_>>()
        };
        self.multipliers = weighted(|kind| kind == Kind::Scaled);
        self.cells = weighted(|kind| matches!(kind, Kind::Plain | Kind::Negated));
        self.pivots = recording.watched.iter().map(|&(step, row, column)| (written[step as usize].1, [row, column], zero)).collect();
        // What is no value, right side or solution is a constant, or computed before it is read.
        let known = self.recorder.places.zero as usize;
        self.memory.truncate(known);
        self.memory.extend(self.recorder.memory.iter().skip(known).map(|x| Wide::splat(self.simd, *x)));
        self.memory.resize(self.memory.len().max(SMALL), Wide::splat(self.simd, 0.0));
        (self.small, self.told, self.best) = (self.memory.len() <= SMALL, false, Wide::splat(self.simd, 0.0));
    }

    /// Runs the recorded elimination; true in the lanes that it fits.
    #[inline(always)]
    fn replay(&mut self) -> Mask<S> {
        if !self.told {
            self.tell_watch();
        }
        let simd = self.simd;
        match self.memory.first_chunk_mut::<SMALL>().filter(|_| self.small) {
            Some(memory) => self.factor.run(simd, memory),
            None => self.factor.run(simd, &mut self.memory[..]),
        }
        let (mut largest_inverse, mut sound) = (self.smallest_constant.reciprocal(), Mask::splat(simd, true));
        for &(place, _, per_unit) in &self.pivots {
            let inverse = self.memory[place as usize].abs() * per_unit;
            // A NaN counts as the worst.
            largest_inverse = inverse.le(largest_inverse).select(largest_inverse, inverse);
        }
        for &(place, weight) in &self.multipliers {
            sound = sound & (self.memory[place as usize].abs() * Wide::splat(simd, weight)).le(Wide::splat(simd, GROWTH));
        }
        for &(place, weight) in &self.cells {
            sound = sound & (self.memory[place as usize].abs() * Wide::splat(simd, weight)).le(Wide::splat(simd, REFINED));
        }
        let smallest = largest_inverse.reciprocal();
        self.smallest = smallest;
        self.best = self.best.max(smallest);
        let faded = self.best * smallest.lt(Wide::splat(simd, SUSPICIOUS)).select(Wide::splat(simd, 0.5), Wide::splat(simd, FADED));
        sound & smallest.gt(Wide::splat(simd, SINGULAR)) & smallest.ge(faded)
    }

    /// Tells the watch how pivots are measured.
    #[cold]
    #[inline(never)]
    fn tell_watch(&mut self) {
        self.told = true;
        let Some(recording) = &self.recorder.recording else { return };
        let (zero, one) = (Wide::splat(self.simd, 0.0), Wide::splat(self.simd, 1.0));
        let (norms, tops, sizes) = (&self.norms, &self.tops, &self.sizes);
        let unit = |row: u32, column: u32| {
            let (norm, top, size) = (norms[row as usize], tops[column as usize], sizes[column as usize]);
            norm.gt(zero).select(one / norm, one) * top.gt(zero).select(size / top, size)
        };
        for (_, [row, column], per_unit) in &mut self.pivots {
            *per_unit = unit(*row, *column).reciprocal();
        }
        let constant = recording.constant.iter().map(|&(row, column, value)| Wide::splat(self.simd, value.abs()) * unit(row, column));
        self.smallest_constant = constant.fold(Wide::splat(self.simd, f64::INFINITY), |smallest, x| smallest.min(x));
    }

    /// A x = b with the factors at hand: from the right side to the solution.
    #[inline(always)]
    pub(crate) fn solve(&mut self) {
        match self.memory.first_chunk_mut::<SMALL>().filter(|_| self.small) {
            Some(memory) => self.solve.run(self.simd, memory),
            None => self.solve.run(self.simd, &mut self.memory[..]),
        }
    }
}
