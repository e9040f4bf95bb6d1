//! Solves one time from given torn coordinates.

use std::sync::Arc;

use pulp::NullaryFnOnce;

use super::Tape;
use super::newton::{Checked, Solver};
use super::times::Limits;
use crate::numbers::lanes::Level;
use crate::program::gather::Case;

/// The largest ratio of the second step to the first one. Then the position is near, and no other
/// one is as near. \[-\]
const SHRINKING: f64 = 0.125;

/// A tape with a memory of single numbers.
pub(crate) struct Alone(Solver<f64>);

/// The result at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    pub steps: usize,
    pub residual: f64,
    /// The row with that residual.
    pub worst: usize,
    /// The smallest ratio of a pivot or determinant to its value at the mark, without signs.
    pub pivot: f64,
}

/// A time, passed to the function that uses the machine's SIMD instructions.
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

    /// Solves at one time, with torn coordinates from `q`. Returns `None` if Newton's steps do not
    /// shrink quickly, if C = 0 as written does not hold, or if a pivot is small.
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
        // A branch that rounding decides is NaN.
        let decided = solver.tape.sides.iter().all(|place| !solver.at(*place).is_nan());
        (met && decided && shrinks && pivot >= limits.pivot).then_some(Found {
            steps,
            residual,
            worst,
            pivot,
        })
    }

    /// Makes the pivots and determinants of the last time the marks.
    pub(crate) fn mark(&mut self) {
        let _ = self.0.mark();
    }

    /// Returns q with its last correction, and q̇ and q̈ of the last time. If an equation may jump
    /// with the last correction, the correction is omitted.
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
