//! One time alone, from torn coordinates that are given.

use std::sync::Arc;

use pulp::NullaryFnOnce;

use super::Tape;
use super::newton::{Checked, Solver};
use super::times::Limits;
use crate::numbers::lanes::Level;
use crate::program::gather::Case;

/// The second step is at most this share of the first one: the position is near then, and no other
/// one is as near.   \[-\]
const SHRINKING: f64 = 0.125;

/// A tape with its memory of single numbers.
pub(crate) struct Alone(Solver<f64>);

/// The findings about one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    pub steps: usize,
    pub residual: f64,
    /// The row that has it.
    pub worst: usize,
    /// The least of pivots and determinants, as a share of what it was at the mark, whatever their
    /// signs.
    pub pivot: f64,
}

/// A time on its way into the function that has the machine's instructions.
struct Solving<'x, S: Level> {
    solver: &'x mut Solver<f64>,
    simd: S,
    limits: &'x Limits,
}

impl<S: Level> NullaryFnOnce for Solving<'_, S> {
    type Output = Checked<f64>;

    #[inline(always)]
    fn call(self) -> Checked<f64> {
        self.solver.solve(self.simd, self.limits, false)
    }
}

impl Alone {
    pub(crate) fn new<S: Level>(simd: S, tape: Arc<Tape>, case: Case) -> Self {
        Alone(Solver::new(simd, 0.0, tape, case))
    }

    /// Solves at one time, torn coordinates from where they are in `q`; nothing where Newton's
    /// steps do not shrink quickly, C = 0 does not hold as it is written, or a pivot is small.
    pub(crate) fn solve<S: Level>(
        &mut self,
        simd: S,
        t: f64,
        q: &[f64],
        limits: &Limits,
    ) -> Option<Found> {
        let Alone(solver) = self;
        solver.memory[solver.tape.t as usize] = t;
        for (place, column) in solver.tape.torn.iter().zip(&solver.tape.columns) {
            solver.memory[*place as usize] = q[*column];
        }
        let Checked { met, residual, pivot, .. } = simd.vectorize(Solving { solver, simd, limits });
        let steps = solver.steps as usize;
        let worst = solver.worst(0);
        let [first, second] = solver.corrections;
        let shrinks = steps < 2 || second <= SHRINKING * first;
        // A side that rounding decides is not a number.
        let decided = solver.tape.sides.iter().all(|place| !solver.at(*place).is_nan());
        (met && decided && shrinks && pivot >= limits.pivot).then_some(Found {
            steps,
            residual,
            worst,
            pivot,
        })
    }

    /// Pivots and determinants of the last time become the marks.
    pub(crate) fn mark(&mut self) {
        let _ = self.0.mark();
    }

    /// q with its last correction, q̇ and q̈ of the last time. An equation may jump with the last
    /// correction, which is left out then.
    pub(crate) fn numbers(&self) -> [Vec<f64>; 3] {
        let Solver { tape, .. } = &self.0;
        let all =
            |places: &[u32]| places.iter().map(|place| self.0.at(*place)).collect::<Vec<f64>>();
        let mut q = all(&tape.values);
        if !tape.jumps() {
            q.iter_mut().zip(&tape.corrections).for_each(|(q, place)| *q += self.0.at(*place));
        }
        [q, all(&tape.rates), all(&tape.second_rates)]
    }
}
