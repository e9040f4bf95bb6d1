//! Builds the errors of a mechanism with more equations than coordinates that cannot be solved at a
//! time.

use crate::outcome::error::{Error, FailureKind};
use crate::system::System;

/// Returns the error without a diagnosis: it names the equation with the largest residual.
pub(super) fn unmet(
    system: &System,
    q: &[f64],
    t: f64,
    iterations: usize,
    last: Option<f64>,
) -> Error {
    let model = system.model();
    let instant = system.equations().instant_at(t, q);
    match model.linearize(q, t) {
        Err(bad) => system.equations().not_finite(bad, system.layout(), &instant),
        Ok(point) => {
            let rows = point.c.iter().map(|c| c.abs()).enumerate();
            let (worst, residual) =
                rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
            let (constraint, row) = system.row_name(worst);
            FailureKind::NoConvergence { iterations, constraint, row, residual, last }
                .at(t, &system.layout().words)
        }
    }
}
