//! Sets driven angles first: a row in which only one angle is unknown determines this angle.

use crate::coordinates::units::Unit;
use crate::system::scaled::Model;

/// Smaller differences of angles are left to the search. \[rad\]
const TURN: f64 = 1.0;

/// Returns q with those angles set, one after the other. Rows that are nonlinear in their angle are
/// skipped.
pub(crate) fn turned(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
) -> Vec<f64> {
    /// The largest number of rounds of rows that follow one another.
    const ROUNDS: usize = 64;
    let mut q = q.to_vec();
    let mut known = vec![false; q.len()];
    for _ in 0..ROUNDS {
        let asked = asked(model, &q, t, &known, active);
        if asked.is_empty() {
            break;
        }
        for (row, column, dq) in asked {
            known[column] = true;
            if dq.abs() <= TURN {
                continue;
            }
            let before = (q[column], residual(model, &q, t, row));
            q[column] += dq;
            let met = residual(model, &q, t, row) <= 1e-6 * before.1 + f64::EPSILON * dq.abs();
            if !met {
                q[column] = before.0;
            }
        }
    }
    q
}

fn residual(model: &Model<'_>, q: &[f64], t: f64, row: usize) -> f64 {
    model.linearize(q, t).map_or(f64::INFINITY, |point| point.c[row].abs())
}

/// Returns the row, column and correction of each angle that one row determines.
fn asked(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    known: &[bool],
    active: &dyn Fn(usize) -> bool,
) -> Vec<(usize, usize, f64)> {
    let Ok(point) = model.linearize(q, t) else { return Vec::new() };
    let mut rows: Vec<Option<Vec<(usize, f64)>>> = vec![Some(Vec::new()); model.m()];
    for (row, column, value) in model.entries(&point.values).filter(|(_, _, value)| *value != 0.0) {
        match &mut rows[row] {
            Some(open) if model.layout.units[column] == Unit::Radian => {
                if !known[column] {
                    open.push((column, value));
                }
            }
            open => *open = None,
        }
    }
    let mut taken = vec![false; q.len()];
    let mut asked = Vec::new();
    for (row, open) in rows.into_iter().enumerate().filter(|(row, _)| active(*row)) {
        let Some([(column, value)]) = open.as_deref() else { continue };
        let dq = -point.c[row] / value;
        if dq.is_finite() && !std::mem::replace(&mut taken[*column], true) {
            asked.push((row, *column, dq));
        }
    }
    asked
}
