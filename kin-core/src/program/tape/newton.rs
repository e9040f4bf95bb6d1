//! Newton's method on what is torn, and what a position is judged by, over any number: that of one
//! time, or of one in each lane.

use std::sync::Arc;

use super::replay::Replay;
use super::times::Limits;
use super::{SHORT, Stage, Tape};
use crate::model::law::Law;
use crate::numbers::lanes::Level;
use crate::numbers::lanes::lanewise::{Answer, Computed};
use crate::program::gather::Case;
use crate::system::stop;

/// A pivot or determinant that is less than this share of what it was where the elimination was
/// chosen loses digits: other ones would have been chosen.   \[-\]
const FAINT: f64 = 1e-4;

/// A tape with its memory.
pub(super) struct Solver<N> {
    pub tape: Arc<Tape>,
    pub memory: Vec<N>,
    laws: Vec<Law>,
    /// Pivots and determinants where the signs and sizes were those of a position that is known.
    marks: Vec<Vec<f64>>,
    /// How many Newton steps were taken.
    pub steps: N,
    /// The largest corrections of the first two steps, by sizes.
    pub corrections: [N; 2],
}

/// The findings about a position, in each lane.
pub(super) struct Checked<N: Computed> {
    /// True where Newton's method has converged, and C = 0 holds as it was written.
    pub met: N::Answer,
    pub residual: N,
    /// The least share of a pivot or determinant of what it was at the mark, and where the sign of
    /// a block is another one.
    pub pivot: N,
    pub turned: N::Answer,
}

impl<N: Computed> Solver<N> {
    /// For a case; `zero` is any number.
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

    /// The number in a place.
    #[inline(always)]
    pub(super) fn at(&self, place: u32) -> N {
        self.memory[place as usize]
    }

    /// Pivots and determinants of the first lane become the marks; false where one is so small
    /// beside what it was where the elimination was chosen that digits are lost by it.
    pub(super) fn mark(&mut self) -> bool {
        for (marks, guards) in self.marks.iter_mut().zip(&self.tape.guards) {
            let first = |guard: &u32| self.memory[*guard as usize].lane(0);
            marks.iter_mut().zip(guards).for_each(|(mark, guard)| *mark = first(guard));
        }
        let all = self.marks.iter().flatten().zip(self.tape.chosen.iter().flatten());
        all.into_iter().all(|(mark, chosen)| mark.abs() >= FAINT * chosen.abs())
    }

    /// The row with the largest |C_i| in a lane.
    pub(super) fn worst(&self, lane: usize) -> usize {
        let rows =
            self.tape.verify.iter().map(|place| self.at(*place).lane(lane).abs()).enumerate();
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst }).0
    }

    /// All stages at the time that stands there, from the torn coordinates that stand there. Where
    /// a block of times `begins`, pivots and determinants become the marks.
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
        // One function for all stages.
        let Solver { tape, memory, laws, .. } = self;
        simd.vectorize(Replay { stage: stage(tape), laws, memory });
    }

    /// Newton's method; where it has converged.
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

    /// The last correction where an equation can jump with it: that is looked at then.
    #[cold]
    fn correct_last(&mut self, ends: N::Answer) {
        for (place, change) in self.tape.torn.iter().zip(&self.tape.correction) {
            let own = self.memory[*place as usize];
            let change = self.memory[*change as usize];
            self.memory[*place as usize] = (own + change).where_or(ends, own);
        }
    }

    /// Where the correction in hand and what made it are as small as they have to be, and the
    /// largest of it by sizes.
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

    /// Where C = 0 holds as it was written, and max |C_i|.
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

    /// The least share of a pivot or determinant of what it was at the mark, and where the sign of
    /// a block is another one.
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
                // A NaN is not among the sizes that are allowed.
                let other = least.where_or(size.above(least), one.all(0.0));
                least = size.where_or(size.at_most(least), other);
                product = product * share;
            }
            turned = turned | product.below(one.all(0.0));
        }
        (least, turned)
    }
}
