//! Reports on the present point: its solution, its worst row, or the reason why the point is not a
//! solution.

use super::{Failure, Newton, Outcome};
use crate::outcome::error::{Error, FailureKind};
use crate::system::{Report, Solution};

/// A position with a smallest pivot above this value is not called singular, whatever stopped
/// Newton's method. \[-\]
const REGULAR: f64 = 1e-6;

/// Where C_q is singular, a row with a residual above this share of its norm is reported as
/// unsatisfied. \[-\]
const UNMET: f64 = 1e-2;

impl Newton<'_> {
    /// Returns the equation with a large residual at the present point, if there is one.
    fn unmet(&self) -> Option<String> {
        let shares =
            self.c.iter().zip(self.linear.norms()).map(|(c, norm)| c.abs() / norm).enumerate();
        let (row, share) =
            shares.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
        (share > UNMET).then(|| self.system.equations().equation(row))
    }

    /// Returns the row with the largest |C_i|, and that value, for unscaled rows.
    pub(crate) fn worst(&self) -> (usize, f64) {
        let rows = self.c.iter().map(|c| c.abs()).enumerate();
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst })
    }

    /// Converts the present point to a solution.
    pub(crate) fn solution(self, t: f64, outcome: Outcome) -> Solution {
        let report = Report {
            iterations: self.steps,
            residual: outcome.residual,
            worst: self
                .system
                .names_of_equations()
                .get(self.worst().0)
                .cloned()
                .unwrap_or_default(),
            smallest_pivot: self.linear.smallest_pivot(),
            compiled: false,
        };
        Solution { t, q: self.q.to_vec(), qd: self.qd.to_vec(), qdd: self.qdd.to_vec(), report }
    }

    /// Converts a failure to an error with the user's names.
    pub(crate) fn error(&mut self, failure: Failure, t: f64, last: Option<f64>) -> Error {
        let equations = self.system.equations();
        match failure {
            Failure::NotFinite(bad) => {
                equations.not_finite(bad, self.system.layout(), &self.instant)
            }
            Failure::WrongBranch(block) => {
                equations.closes_wrong(block, self.system.layout(), &self.instant)
            }
            Failure::Singular => match self.system.singular(t, &self.q, self.unmet()) {
                // The singular point that stopped the iteration was not the solution: the iterates
                // were lost.
                error if is_regular(&error) => {
                    let (row, residual) = self.worst();
                    self.error(Failure::NoConvergence { row, residual }, t, last)
                }
                error => error,
            },
            Failure::NoConvergence { row, residual } => {
                let (constraint, row) = self.system.row_name(row);
                let iterations = self.steps - self.steps_before;
                FailureKind::NoConvergence { iterations, constraint, row, residual, last }
                    .at(t, self.system.unit_words())
            }
        }
    }
}

/// Returns true if an error of a singular position has a pivot far from zero.
fn is_regular(error: &Error) -> bool {
    matches!(error.kind(), Some(FailureKind::SingularAt { pivot, .. }) if *pivot > REGULAR)
}
