//! The recorded elimination replayed over lanes: several matrices of one pattern at once, each lane watched
//! by itself.
//!
//! One recording serves all lanes. Where one of them does not fit it any more, the elimination is recorded
//! anew at the numbers of that lane; lanes that fit neither are told to their owner, who goes on without
//! them.

mod measures;
mod recorded;

use super::recorded::replay::{Replay, SMALL};
use super::{FADED, Linear, SINGULAR, SUSPICIOUS};
use crate::numbers::lanes::{Level, Mask, Wide};
use recorded::{Areas, GROUND};

/// Square matrices of one pattern, one in each lane.
pub(crate) struct WideLinear<S: Level> {
    simd: S,
    /// Records, and knows the pattern; and as it was at first, with the recording that all groups of lanes
    /// begin with.
    recorder: Linear,
    first: Linear,
    recorded_anew: bool,
    memory: Vec<Wide<S>>,
    areas: Areas,
    factor: Replay,
    /// From C to the correction, from −C_t to q̇, from Q_d to q̈.
    correct: Replay,
    velocity: Replay,
    acceleration: Replay,
    /// The rows of −C_t, and of Q_d, that are zero for good.
    zeros: [Vec<u32>; 2],
    /// True if all places of the memory are below [`SMALL`].
    small: bool,
    /// The numbers that are factored but for the pivots, multipliers and others: where they begin, and the
    /// share of what is allowed that each unit of them is.
    judged: [(usize, Vec<f64>); 2],
    /// The pivots that are no constants: their places, row and column, and one over what makes each a share
    /// of these.
    pivots: Vec<(u32, [u32; 2], Wide<S>)>,
    sizes: Vec<Wide<S>>,
    norms: Vec<Wide<S>>,
    tops: Vec<Wide<S>>,
    /// Values that can change and do not stand on the ground, and their limits.
    varying: Vec<u32>,
    limits: Vec<Wide<S>>,
    /// True if nothing has been measured since the beginning.
    fresh: bool,
    /// True if the weights of pivots agree with the present measures.
    weighted: bool,
    /// One over the smallest constant pivot, and over the smallest of all at the last factoring; the smallest
    /// that this has been.
    inverse_constant: Wide<S>,
    inverse: Wide<S>,
    best: Wide<S>,
}

impl<S: Level> WideLinear<S> {
    /// Matrices of the pattern that `recorder` was made for, with its recording if it has one; −C_t, and Q_d,
    /// can be other than zero in the rows `asked`.
    pub(crate) fn new(simd: S, recorder: Linear, asked: [Vec<usize>; 2]) -> Self {
        let (n, number) = (recorder.n, |x: f64| Wide::splat(simd, x));
        let varies = |k: &u32| recorder.constants.get(*k as usize).copied().flatten().is_none();
        let varying: Vec<u32> = recorder.sorted.iter().copied().filter(varies).collect();
        let areas = Areas::new(recorder.places, n);
        let mut linear = WideLinear {
            simd,
            first: recorder.clone(),
            recorded_anew: false,
            memory: vec![number(0.0); areas.end],
            areas,
            factor: Replay::default(),
            correct: Replay::default(),
            velocity: Replay::default(),
            acceleration: Replay::default(),
            zeros: asked.map(|asked| {
                (0..n)
                    .filter(|row| !asked.contains(row))
                    .map(|row| recorder.places.rhs + row as u32)
                    .collect()
            }),
            small: false,
            judged: Default::default(),
            pivots: Vec::new(),
            sizes: vec![number(1.0); n],
            norms: vec![number(0.0); n],
            tops: vec![number(0.0); n],
            limits: vec![number(0.0); varying.len()],
            varying,
            fresh: true,
            weighted: false,
            inverse_constant: number(0.0),
            inverse: number(f64::INFINITY),
            best: number(f64::INFINITY),
            recorder,
        };
        let constants = linear.recorder.constants.clone();
        linear
            .memory
            .iter_mut()
            .zip(constants.iter())
            .for_each(|(place, constant)| *place = number(constant.unwrap_or(0.0)));
        linear.load();
        linear
    }

    /// Forgets all matrices before, for others that begin at these sizes: nothing of what was measured stays.
    pub(crate) fn begin(&mut self, sizes: &[Wide<S>]) {
        let zero = Wide::splat(self.simd, 0.0);
        self.norms.fill(zero);
        self.tops.fill(zero);
        (self.fresh, self.best) = (true, Wide::splat(self.simd, f64::INFINITY));
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

    /// C, and the values of C_q, to be written.
    pub(crate) fn written(&mut self) -> (&mut [Wide<S>], &mut [Wide<S>]) {
        let (values, rest) = self.memory.split_at_mut(self.areas.recorded.rhs as usize);
        (&mut rest[..self.areas.n], &mut values[..self.recorder.entries.len()])
    }

    pub(crate) fn c(&self) -> &[Wide<S>] {
        self.area(self.areas.recorded.rhs as usize)
    }

    pub(crate) fn values(&self) -> &[Wide<S>] {
        &self.memory[..self.recorder.entries.len()]
    }

    /// The correction, which is to be subtracted from q.
    pub(crate) fn correction(&self) -> &[Wide<S>] {
        self.area(self.areas.recorded.solution as usize)
    }

    /// −C_t, to be written.
    pub(crate) fn velocity_rhs(&mut self) -> &mut [Wide<S>] {
        &mut self.memory[self.areas.velocity..][..self.areas.n]
    }

    /// q̇ with the rates of the ground behind it, and Q_d, to be written.
    pub(crate) fn acceleration_rhs(&mut self) -> (&[Wide<S>], &mut [Wide<S>]) {
        let (rates, rest) = self.memory[self.areas.rates..].split_at_mut(self.areas.n + GROUND);
        (rates, &mut rest[..self.areas.n])
    }

    /// q̇
    pub(crate) fn rates(&self) -> &[Wide<S>] {
        self.area(self.areas.rates)
    }

    /// q̈
    pub(crate) fn second_rates(&self) -> &[Wide<S>] {
        self.area(self.areas.second_rates)
    }

    /// q̇ and q̈, to be written.
    pub(crate) fn all_rates(&mut self) -> [&mut [Wide<S>]; 2] {
        let Areas { n, rates, second_rates, .. } = self.areas;
        let (first, second) = self.memory.split_at_mut(second_rates);
        [&mut first[rates..rates + n], &mut second[..n]]
    }

    #[inline(always)]
    fn area(&self, first: usize) -> &[Wide<S>] {
        &self.memory[first..first + self.areas.n]
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
        self.inverse.reciprocal()
    }

    /// The lanes in which it is at least that.
    #[inline(always)]
    pub(crate) fn regular(&self, least: f64) -> Mask<S> {
        self.inverse.le(Wide::splat(self.simd, 1.0 / least))
    }

    /// Of each block whose determinant can change its sign, that sign at the last factoring, −1 or 1, into
    /// `signs`.
    #[inline(always)]
    pub(crate) fn orientation(&self, signs: &mut Vec<Wide<S>>) {
        signs.clear();
        let Some(recording) = &self.recorder.recording else { return };
        let number = |negative: bool| Wide::splat(self.simd, if negative { -1.0 } else { 1.0 });
        signs.extend(recording.orientation.blocks.iter().map(|negative| number(*negative)));
        let zero = Wide::splat(self.simd, 0.0);
        for &(place, block) in &recording.orientation.pivots {
            let sign = &mut signs[block as usize];
            *sign = self.memory[self.areas.moved(place) as usize].lt(zero).select(-*sign, *sign);
        }
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
        let wanted = wanted & self.finite();
        let mut fits =
            if self.recorder.recording.is_some() { wanted & self.replay() } else { wanted & !wanted };
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

    /// Runs the recorded elimination; true in the lanes that it fits.
    #[inline(always)]
    fn replay(&mut self) -> Mask<S> {
        if !self.weighted {
            self.weight_pivots();
        }
        let simd = self.simd;
        run(simd, &self.factor, self.small, &mut self.memory);
        let mut inverse = self.inverse_constant;
        for &(place, _, per_unit) in &self.pivots {
            // A pivot that is not a number shows in the solution.
            inverse = (self.memory[place as usize].abs() * per_unit).or_larger(inverse);
        }
        let mut share = Wide::splat(simd, 0.0);
        for (first, shares) in &self.judged {
            for (x, own) in self.memory[*first..].iter().zip(shares) {
                share = (x.abs() * Wide::splat(simd, *own)).or_larger(share);
            }
        }
        let number = |x: f64| Wide::splat(simd, x);
        self.inverse = inverse;
        self.best = inverse.or_smaller(self.best);
        let faded = inverse.gt(number(1.0 / SUSPICIOUS)).select(number(0.5), number(FADED));
        share.le(number(1.0)) & inverse.lt(number(1.0 / SINGULAR)) & (inverse * faded).le(self.best)
    }

    /// Computes the correction from C, with the factors at hand.
    #[inline(always)]
    pub(crate) fn correct(&mut self) {
        run(self.simd, &self.correct, self.small, &mut self.memory);
    }

    /// Computes q̇ from −C_t.
    #[inline(always)]
    pub(crate) fn solve_velocity(&mut self) {
        run(self.simd, &self.velocity, self.small, &mut self.memory);
    }

    /// Computes q̈ from Q_d.
    #[inline(always)]
    pub(crate) fn solve_acceleration(&mut self) {
        run(self.simd, &self.acceleration, self.small, &mut self.memory);
    }
}

/// Runs a program on the memory, whose places are all below [`SMALL`] if it is `small`.
#[inline(always)]
fn run<S: Level>(simd: S, replay: &Replay, small: bool, memory: &mut [Wide<S>]) {
    match memory.first_chunk_mut::<SMALL>() {
        Some(memory) if small => replay.run(simd, memory),
        _ => replay.run(simd, memory),
    }
}
