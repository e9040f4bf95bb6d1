//! Computes many times of one run at once, one time in each lane: Newton's method on torn
//! coordinates, velocities and accelerations, C as written, and the checks of each time.
//!
//! The digits of a lane never depend on its neighbours: a converged lane does not change while
//! others continue.

use std::sync::Arc;

use pulp::NullaryFnOnce;

use super::Tape;
use super::newton::{Checked, Solver};
use crate::numbers::lanes::lanewise::misses;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::program::gather::Case;

/// The coefficients of a coordinate as a polynomial of time.
pub(crate) type Curve = [f64; 9];

/// The number of orders in the check of a time: q, q̇ and q̈.
pub(crate) const ORDERS: usize = 3;

/// The limits for convergence and for the checks of lanes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Limits {
    /// The largest permitted correction of each torn coordinate.
    pub correction: Vec<f64>,
    /// The permitted correction in addition, as a share of the coordinate itself.
    pub rounding: f64,
    /// The sizes of the torn coordinates.
    pub sizes: Vec<f64>,
    /// The allowance of each row.
    pub rows: Vec<f64>,
    /// The largest number of Newton steps.
    pub steps: usize,
    /// The smallest permitted ratio of a pivot or determinant to its value at the mark.
    pub pivot: f64,
    /// The largest permitted rotation between two times.
    pub reach: f64,
    /// For each coordinate one divided by its size.
    pub shares: Vec<f64>,
    /// For each coordinate 1 if it rotates, otherwise 0.
    pub turns: Vec<f64>,
}

/// The checks of each lane.
#[derive(Clone, Copy)]
pub(crate) struct Judged<S: Level> {
    /// The error of the prediction from either end of a step at the other end. It is NaN if it is
    /// unknown, or if there is another objection: Newton's method has not converged, C = 0 as
    /// written does not hold, a block has changed its sign, a pivot is small, something has rotated
    /// too far.
    pub miss: Wide<S>,
    /// The smallest ratio of a pivot or determinant to its value at the mark.
    pub pivot: Wide<S>,
    /// max |C_i|.
    pub residual: Wide<S>,
}

/// A tape with its memory over lanes.
pub(crate) struct Times<S: Level> {
    pub(super) simd: S,
    pub(super) solver: Solver<Wide<S>>,
    /// q, q̇ and q̈ of each coordinate: first the preceding time, then those of the lanes. After
    /// all of them follows q⃛ of each coordinate, if it is computed.
    pub(super) lines: Vec<f64>,
    /// The numbers that select branches, in the preceding lane.
    sides: Vec<f64>,
    pub judged: Judged<S>,
}

impl<S: Level> Times<S> {
    pub(crate) const LANES: usize = Wide::<S>::LANES;
    pub(super) const STRIDE: usize = Self::LANES + 1;

    /// Creates the solver for a case.
    pub(crate) fn new(simd: S, tape: Arc<Tape>, case: Case) -> Self {
        let numbers = ORDERS * tape.values.len() + tape.third_rates.len();
        let lines = vec![0.0; Self::STRIDE * numbers];
        let none = Wide::splat(simd, f64::NAN);
        let sides = vec![f64::NAN; tape.sides.len()];
        let judged = Judged { miss: none, pivot: none, residual: none };
        Times { simd, solver: Solver::new(simd, none, tape, case), lines, sides, judged }
    }

    /// Returns true if anything may jump depending on coordinates.
    pub(crate) fn jumps(&self) -> bool {
        self.tape().jumps()
    }

    /// Returns the torn coordinates.
    pub(crate) fn torn(&self) -> &[usize] {
        &self.tape().columns
    }

    /// Sets the position before the first lane of the first group. Before a later group it is that
    /// of the last lane.
    pub(crate) fn begin(&mut self, before: [&[f64]; ORDERS]) {
        for (order, all) in before.into_iter().enumerate() {
            all.iter()
                .enumerate()
                .for_each(|(column, x)| self.lines[Self::line(column, order)] = *x);
        }
    }

    /// Returns the tape.
    pub(super) fn tape(&self) -> &Tape {
        &self.solver.tape
    }

    /// Returns the number of Newton steps of each lane.
    pub(crate) fn steps(&self) -> &[f64] {
        self.solver.steps.as_slice()
    }

    pub(super) fn line(column: usize, order: usize) -> usize {
        (column * ORDERS + order) * Self::STRIDE
    }

    /// Returns the place of q, q̇, q̈ or q⃛ of a coordinate in the preceding lane.
    pub(super) fn line_of(&self, column: usize, order: usize) -> usize {
        if order < ORDERS {
            Self::line(column, order)
        } else {
            (ORDERS * self.tape().values.len() + column) * Self::STRIDE
        }
    }

    /// Returns q, q̇, q̈ or q⃛ of a coordinate in all lanes.
    pub(crate) fn of(&self, column: usize, order: usize) -> &[f64] {
        let first = self.line_of(column, order) + 1;
        &self.lines[first..first + Self::LANES]
    }

    /// Returns the row with the largest |C_i| in a lane.
    pub(crate) fn worst(&self, lane: usize) -> usize {
        self.solver.worst(lane)
    }

    /// Solves at all these times, one in each lane; `before` is the time before the first lane.
    /// Torn coordinates begin on their curves, which are powers of the time since `origin`. If
    /// `begins` is true, the pivots and determinants of the first lane become the marks.
    pub(crate) fn solve(
        &mut self,
        before: f64,
        times: &[f64],
        (origin, curves): (f64, &[Curve]),
        limits: &Limits,
        begins: bool,
    ) {
        let simd = self.simd;
        simd.vectorize(Solving { times: self, before, all: times, origin, curves, limits, begins });
    }
}

/// A group of times, passed to the function that uses the machine's SIMD instructions.
struct Solving<'x, S: Level> {
    times: &'x mut Times<S>,
    /// The time before the first one of the group.
    before: f64,
    /// The times of the group; there may be fewer than lanes.
    all: &'x [f64],
    origin: f64,
    curves: &'x [Curve],
    limits: &'x Limits,
    begins: bool,
}

impl<S: Level> NullaryFnOnce for Solving<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Solving { times, before, all, origin, curves, limits, begins } = self;
        let simd = times.simd;
        let mut t = Wide::splat(simd, 0.0);
        let mut from = t;
        // Lanes beyond the last time repeat it.
        for (lane, (t, from)) in t.as_mut_slice().iter_mut().zip(from.as_mut_slice()).enumerate() {
            let own = lane.min(all.len().saturating_sub(1));
            *t = all[own];
            *from = if own == 0 { before } else { all[own - 1] };
        }
        let Solver { tape, memory, .. } = &mut times.solver;
        memory[tape.t as usize] = t;
        let s = t - Wide::splat(simd, origin);
        for (place, curve) in tape.torn.iter().zip(curves) {
            let own = curve
                .iter()
                .rev()
                .fold(Wide::splat(simd, 0.0), |sum, c| sum.mul_add(s, Wide::splat(simd, *c)));
            memory[*place as usize] = own;
        }
        let Checked { met, residual, pivot, turned } = times.solver.solve(simd, limits, begins);
        let same = times.same_sides(begins);
        let known = times.write(begins);
        let [miss, reach] = times.missed(t - from, limits);
        let least = Wide::splat(simd, limits.pivot);
        let most = Wide::splat(simd, limits.reach);
        let good = met & same & known & !turned & pivot.ge(least) & reach.le(most);
        let miss = good.select(miss, Wide::splat(simd, f64::NAN));
        times.judged = Judged { miss, pivot, residual };
    }
}

impl<S: Level> Times<S> {
    /// Returns the lanes in which all branch selections equal those of the preceding lane. At the
    /// beginning of a block the first lane is not compared.
    #[inline(always)]
    fn same_sides(&mut self, begins: bool) -> Mask<S> {
        let mut same = Mask::splat(self.simd, true);
        for (place, last) in self.solver.tape.sides.iter().zip(&mut self.sides) {
            let now = self.solver.at(*place);
            let mut before = now;
            before.as_mut_slice()[1..].copy_from_slice(&now.as_slice()[..Self::LANES - 1]);
            if !begins {
                before.as_mut_slice()[0] = *last;
            }
            *last = now.as_slice()[Self::LANES - 1];
            same = same & now.equal(before);
        }
        same
    }

    /// Writes q with its last correction, q̇, q̈ and q⃛ into the lines, after the data of the last
    /// lane. Returns the lanes with a finite q⃛. If an equation may jump with the last correction,
    /// the correction is omitted.
    #[inline(always)]
    fn write(&mut self, begins: bool) -> Mask<S> {
        let Times { simd, solver, lines, .. } = self;
        let tape = &*solver.tape;
        let zero = Wide::splat(*simd, 0.0);
        let rates = tape.rates.iter().zip(&tape.second_rates);
        let places = tape.values.iter().zip(&tape.corrections).zip(rates);
        for (own, ((value, correction), (rate, second_rate))) in
            lines.chunks_exact_mut(ORDERS * Self::STRIDE).zip(places)
        {
            let mut q = solver.at(*value);
            if !tape.jumps() {
                q = q + solver.at(*correction);
            }
            let all = [q, solver.at(*rate), solver.at(*second_rate)];
            for (line, numbers) in own.chunks_exact_mut(Self::STRIDE).zip(&all) {
                if !begins {
                    line[0] = line[Self::LANES];
                }
                line[1..].copy_from_slice(numbers.as_slice());
            }
        }
        let mut none = zero;
        let behind = &mut lines[ORDERS * Self::STRIDE * tape.values.len()..];
        for (line, place) in behind.chunks_exact_mut(Self::STRIDE).zip(&tape.third_rates) {
            let x = solver.at(*place);
            line[1..].copy_from_slice(x.as_slice());
            // 0 · x is 0 for a finite x, otherwise NaN.
            none = none + x * zero;
        }
        none.equal(zero)
    }

    /// Returns the error of q + h q̇ + ½ h² q̈ from either end of each step at the other end, and
    /// the largest rotation.
    #[inline(always)]
    fn missed(&self, h: Wide<S>, limits: &Limits) -> [Wide<S>; 2] {
        let simd = self.simd;
        let zero = Wide::splat(simd, 0.0);
        let mut miss = zero;
        let mut reach = zero;
        let mut all = zero;
        let own = self
            .lines
            .chunks_exact(ORDERS * Self::STRIDE)
            .zip(limits.shares.iter().zip(&limits.turns));
        for (lines, (share, turn)) in own {
            let before = [
                self.wide(lines, 0),
                self.wide(lines, Self::STRIDE),
                self.wide(lines, 2 * Self::STRIDE),
            ];
            let now = [
                self.wide(lines, 1),
                self.wide(lines, Self::STRIDE + 1),
                self.wide(lines, 2 * Self::STRIDE + 1),
            ];
            let [forward, back, d] = misses(h, before, now);
            miss = miss.or_larger(forward.abs().or_larger(back.abs()) * Wide::splat(simd, *share));
            reach = reach.or_larger(d.abs() * Wide::splat(simd, *turn));
            all = all + (forward + back);
        }
        let none = !all.equal(all);
        [none.select(Wide::splat(simd, f64::NAN), miss), reach]
    }

    /// Returns one number for each lane, from a place on.
    #[inline(always)]
    fn wide(&self, lines: &[f64], place: usize) -> Wide<S> {
        let mut wide = Wide::splat(self.simd, 0.0);
        wide.as_mut_slice().copy_from_slice(&lines[place..place + Self::LANES]);
        wide
    }
}
