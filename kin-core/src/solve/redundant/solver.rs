//! Solves more equations than coordinates: a selection of independent equations, or all equations
//! by least squares.

use crate::linear::{Independent, LeastSquares};
use crate::outcome::error::Result;
use crate::solve::explain::{Explain, Start};
use crate::solve::options::SolverOptions;
use crate::system::System;
use crate::system::scaled::{Measures, Model};

/// The solver of C_q x = b, with rows and columns of order 1.
pub(super) enum Solver {
    /// A selection of independent equations. It suffices if the equations agree, and costs half as
    /// much.
    Independent(Independent),
    /// All equations by least squares. It serves if they may contradict each other, because no
    /// equation counts more than another.
    LeastSquares(LeastSquares),
}

impl Solver {
    pub(super) fn new(model: &Model<'_>) -> Self {
        let m = model.m();
        let n = model.n();
        let places = &model.equations.entries;
        if model.misfit > 0.0 {
            Solver::LeastSquares(LeastSquares::new(m, n, places))
        } else {
            Solver::Independent(Independent::new(m, n, places))
        }
    }

    /// Factors C_q with its values in the order of the entries. Returns false if the columns depend
    /// on one another.
    pub(super) fn factor(&mut self, values: impl Iterator<Item = f64>) -> bool {
        match self {
            Solver::Independent(rows) => rows.factor(values),
            Solver::LeastSquares(least_squares) => least_squares.factor_again(values, 0.0),
        }
    }

    /// Returns x for the right side b.
    pub(super) fn solve(&mut self, b: &[f64]) -> &[f64] {
        match self {
            Solver::Independent(rows) => rows.solve(b),
            Solver::LeastSquares(least_squares) => least_squares.solve(b.iter().copied()),
        }
    }

    /// Writes b − C_q x of the last solution, row by row, into `left`, which contains b.
    pub(super) fn leave(&self, left: &mut [f64]) {
        match self {
            Solver::Independent(rows) => rows.leave(left),
            Solver::LeastSquares(least_squares) => least_squares.leave(left),
        }
    }

    /// Returns the smallest pivot of the last factoring. \[-\]
    pub(super) fn smallest_pivot(&self) -> f64 {
        match self {
            Solver::Independent(rows) => rows.smallest_pivot(),
            Solver::LeastSquares(least_squares) => least_squares.smallest_pivot(),
        }
    }
}

/// Solves C_q x = the right side at a position, by least squares.
pub(crate) fn solved(
    system: &System,
    q: &[f64],
    t: f64,
    rhs: &[f64],
    explain: Explain,
) -> Result<Vec<f64>> {
    let model = system.model();
    let measures = model.measure(q, t);
    let m = model.m();
    let n = model.n();
    let instant = || model.equations.instant_at(t, q);
    let point = model
        .linearize(q, t)
        .map_err(|bad| model.equations.not_finite(bad, model.layout, &instant()))?;
    let mut least_squares = LeastSquares::new(m, n, &model.equations.entries);
    let scaled = scales(&model, &measures)
        .into_iter()
        .zip(&point.values)
        .map(|(scale, value)| scale * value);
    if !least_squares.factor(scaled, 0.0) {
        return Err((explain.cannot_be_driven)(
            model,
            Start::Pose(q),
            t,
            &SolverOptions::default(),
        ));
    }
    let y = least_squares.solve(rhs.iter().zip(&measures.norms).map(|(rhs, norm)| rhs / norm));
    Ok(y.iter().zip(&measures.sizes).map(|(y, size)| y * size).collect())
}

/// Returns for each value of C_q the factor that scales it to order 1.
pub(super) fn scales(model: &Model<'_>, Measures { sizes, norms, .. }: &Measures) -> Vec<f64> {
    let scale = |entry: &Option<(usize, usize)>| {
        entry.map_or(0.0, |(row, column)| sizes[column] / norms[row])
    };
    model.equations.entries.iter().map(scale).collect()
}
