//! Implements Newton's method on torn coordinates, and the checks of a position, for one time or
//! for one time in each lane.

use std::sync::Arc;

use super::replay::Replay;
use super::times::Limits;
use super::{SHORT, Stage, Tape};
use crate::law::Law;
use crate::numbers::lanes::Level;
use crate::numbers::lanes::lanewise::{Answer, Computed};
use crate::program::gather::Case;
use crate::system::stop;

/// If a pivot or determinant is below this share of its value at the choice of the elimination, it
/// loses digits: another pivot would have been chosen. \[-\]
const FAINT: f64 = 1e-4;

/// A tape with its memory.
pub(super) struct Solver<N> {
    pub tape: Arc<Tape>,
    /// The memory, by places.
    pub memory: Vec<N>,
    /// The laws of the case, by their indices.
    laws: Vec<Law>,
    /// For each block the pivots and determinants at a known position, whose signs and sizes are
    /// the reference.
    marks: Vec<Vec<f64>>,
    /// The number of Newton steps.
    pub steps: N,
    /// The largest corrections of the first two steps, in units of the sizes.
    pub corrections: [N; 2],
}

/// The checks of a position, in each lane.
pub(super) struct Checked<N: Computed> {
    /// True if Newton's method has converged and C = 0 as written holds.
    pub met: N::Answer,
    /// max |C_i|.
    pub residual: N,
    /// The smallest ratio of a pivot or determinant to its value at the mark.
    pub pivot: N,
    /// True if the sign of a block differs from that at the mark.
    pub turned: N::Answer,
}

impl<N: Computed> Solver<N> {
    /// Creates the solver for a case; `zero` is any number.
    pub(super) fn new<S: Level>(simd: S, zero: N, tape: Arc<Tape>, case: Case) -> Self {
        let mut memory = vec![zero.all(0.0); tape.places.max(SHORT)];
        let given = tape.parameters.iter().zip(&case.parameters);
        for (place, x) in given.chain(tape.constants.iter().map(|(place, x)| (place, x))) {
            memory[*place as usize] = zero.all(*x);
        }
        let marks = tape.guards.iter().map(|own| vec![f64::NAN; own.len()]).collect();
        let steps = zero.all(0.0);
        let corrections = [zero.all(0.0); 2];
        let mut solver = Solver { tape, memory, laws: case.laws, marks, steps, corrections };
        solver.replay(simd, |tape| &tape.setup);
        solver
    }

    /// Returns the number at a place.
    #[inline(always)]
    pub(super) fn at(&self, place: u32) -> N {
        self.memory[place as usize]
    }

    /// Makes the pivots and determinants of the first lane the marks. Returns false if one is so
    /// small, relative to its value at the choice of the elimination, that digits are lost.
    pub(super) fn mark(&mut self) -> bool {
        for (marks, guards) in self.marks.iter_mut().zip(&self.tape.guards) {
            let first = |guard: &u32| self.memory[*guard as usize].lane(0);
            marks.iter_mut().zip(guards).for_each(|(mark, guard)| *mark = first(guard));
        }
        let all = self.marks.iter().flatten().zip(self.tape.chosen.iter().flatten());
        all.into_iter().all(|(mark, chosen)| mark.abs() >= FAINT * chosen.abs())
    }

    /// Returns the row with the largest |C_i| in a lane.
    pub(super) fn worst(&self, lane: usize) -> usize {
        let rows =
            self.tape.verify.iter().map(|place| self.at(*place).lane(lane).abs()).enumerate();
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst }).0
    }

    /// Runs all stages at the time and from the torn coordinates in the memory. If a block of times
    /// `begins`, the pivots and determinants become the marks.
    #[inline(always)]
    pub(super) fn solve<S: Level>(&mut self, simd: S, limits: &Limits, begins: bool) -> Checked<N> {
        self.replay(simd, |tape| &tape.time);
        let converged = self.newton(simd, limits);
        self.replay(simd, |tape| &tape.rest);
        let keeps_digits = !begins || self.mark();
        let (met, residual) = self.verified(limits);
        let met = if keeps_digits { met } else { met & !met };
        let (pivot, turned) = self.guarded();
        Checked { met: converged & met, residual, pivot, turned }
    }

    #[inline(always)]
    fn replay<S: Level>(&mut self, simd: S, stage: impl Fn(&Tape) -> &Stage) {
        // One function serves all stages.
        let Solver { tape, memory, laws, .. } = self;
        simd.vectorize(Replay { stage: stage(tape), laws, memory });
    }

    /// Runs Newton's method and returns where it has converged.
    #[inline(always)]
    fn newton<S: Level>(&mut self, simd: S, limits: &Limits) -> N::Answer {
        let one = self.steps.all(1.0);
        let mut open = one.equals(one);
        let mut previous = one.all(f64::INFINITY);
        self.steps = one.all(0.0);
        if self.tape.torn.is_empty() {
            return open;
        }
        for step in 0..=limits.steps {
            self.replay(simd, |tape| &tape.correct);
            let (within, largest) = self.within(limits);
            if let Some(own) = self.corrections.get_mut(step) {
                *own = largest;
            }
            let ends = open & (within | stop::has_stalled(largest, previous));
            open = open & !ends;
            if self.tape.jumps() {
                self.correct_last(ends);
            }
            if !open.any() {
                break;
            }
            previous = largest;
            for (place, change) in self.tape.torn.iter().zip(&self.tape.correction) {
                let own = self.memory[*place as usize];
                let change = self.memory[*change as usize];
                self.memory[*place as usize] = (own + change).where_or(open, own);
            }
            self.steps = self.steps + one.one_where(open);
        }
        if self.tape.jumps() {
            self.replay(simd, |tape| &tape.correct);
        }
        !open
    }

    /// Applies the last correction if an equation can jump with it; the equation is checked
    /// afterwards.
    #[cold]
    fn correct_last(&mut self, ends: N::Answer) {
        for (place, change) in self.tape.torn.iter().zip(&self.tape.correction) {
            let own = self.memory[*place as usize];
            let change = self.memory[*change as usize];
            self.memory[*place as usize] = (own + change).where_or(ends, own);
        }
    }

    /// Returns where the present correction and its cause are small enough, and the largest
    /// correction in units of the sizes.
    #[inline(always)]
    fn within(&self, limits: &Limits) -> (N::Answer, N) {
        let tape = &*self.tape;
        let mut largest = self.steps.all(0.0);
        let mut within = largest.equals(largest);
        let own =
            tape.correction.iter().zip(&tape.torn).zip(limits.correction.iter().zip(&limits.sizes));
        for ((change, place), (allowed, size)) in own {
            let change = self.at(*change).abs();
            let q = self.at(*place).abs();
            within = within & change.at_most(q.all(limits.rounding).fused(q, q.all(*allowed)));
            largest = largest.or_larger(change * q.all(size.recip()));
        }
        for (row, place) in tape.rows.iter().zip(&tape.left) {
            within = within & self.at(*place).abs().at_most(largest.all(0.5 * limits.rows[*row]));
        }
        (within, largest)
    }

    /// Returns where C = 0 as written holds, and max |C_i|.
    #[inline(always)]
    fn verified(&self, limits: &Limits) -> (N::Answer, N) {
        let mut most = self.steps.all(0.0);
        let mut met = most.equals(most);
        for (place, allowed) in self.tape.verify.iter().zip(&limits.rows) {
            let c = self.at(*place).abs();
            met = met & c.at_most(c.all(*allowed));
            most = most.or_larger(c);
        }
        (met, most)
    }

    /// Returns the smallest ratio of a pivot or determinant to its value at the mark, and where the
    /// sign of a block differs.
    #[inline(always)]
    fn guarded(&self) -> (N, N::Answer) {
        let one = self.steps.all(1.0);
        let mut least = one;
        let mut turned = one.below(one);
        for (guards, marks) in self.tape.guards.iter().zip(&self.marks) {
            let mut product = one;
            for (guard, mark) in guards.iter().zip(marks) {
                let share = self.at(*guard) * one.all(mark.recip());
                let size = share.abs();
                // A NaN is not among the permitted sizes.
                let other = least.where_or(size.above(least), one.all(0.0));
                least = size.where_or(size.at_most(least), other);
                product = product * share;
            }
            turned = turned | product.below(one.all(0.0));
        }
        (least, turned)
    }
}
