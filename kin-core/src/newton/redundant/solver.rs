//! More equations than coordinates, solved for as many of them or in the sense of least squares.

use crate::linear::{Independent, Tall};
use crate::model::Model;

/// The means to solve C_q x = b; rows and columns of order 1.
pub(super) enum Solver {
    /// Where equations agree, which half the work does for.
    Independent(Independent),
    /// Where they may contradict one another a little: no equation is to be believed more than another.
    LeastSquares(Tall),
}

impl Solver {
    pub(super) fn new(model: &Model<'_>) -> Self {
        let (m, n, places) = (model.m(), model.n(), &model.equations.entries);
        if model.closure > 0.0 {
            Solver::LeastSquares(Tall::new(m, n, places))
        } else {
            Solver::Independent(Independent::new(m, n, places))
        }
    }

    /// Takes the values of C_q in the order of its entries; false if the columns depend on one another.
    pub(super) fn factor(&mut self, values: impl Iterator<Item = f64>) -> bool {
        match self {
            Solver::Independent(rows) => rows.factor(values),
            Solver::LeastSquares(tall) => tall.factor_again(values, 0.0),
        }
    }

    /// x for the right side b.
    pub(super) fn solve(&mut self, b: &[f64]) -> &[f64] {
        match self {
            Solver::Independent(rows) => rows.solve(b),
            Solver::LeastSquares(tall) => tall.solve(b.iter().copied()),
        }
    }

    /// b − C_q x of the last solution, row by row, into `left`, which holds b.
    pub(super) fn leave(&self, left: &mut [f64]) {
        match self {
            Solver::Independent(rows) => rows.leave(left),
            Solver::LeastSquares(tall) => tall.leave(left),
        }
    }

    /// The smallest pivot of the last factoring.   \[-\]
    pub(super) fn smallest_pivot(&self) -> f64 {
        match self {
            Solver::Independent(rows) => rows.smallest_pivot(),
            Solver::LeastSquares(tall) => tall.smallest_pivot(),
        }
    }
}
