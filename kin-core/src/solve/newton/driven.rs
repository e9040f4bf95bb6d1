//! Rotates driven bodies to their drivers before the search for the first position.
//!
//! If a motor has made 300 revolutions when the run begins, Kin does not follow the 300 revolutions
//! in small steps.

use super::{Newton, TURN};
use crate::coordinates::units::Unit;

/// The largest number of rounds in which rows that are nonlinear in their angles are excluded.
const ROUNDS: usize = 64;

/// Sets angles that are far from the value that a row of angles alone determines, if all its other
/// angles are known: drivers, and angles that follow them. A row that is nonlinear in its angle is
/// skipped.
pub(super) fn turn(newton: &mut Newton<'_>, t: f64) {
    if newton.linearize(t).is_err() || follow(newton, t) {
        return;
    }
    let mut known = vec![false; newton.q.len()];
    for _ in 0..ROUNDS {
        if newton.linearize(t).is_err() {
            return;
        }
        let asked = asked(newton, &known);
        if asked.is_empty() {
            return;
        }
        for &(_, column, dq) in &asked {
            known[column] = true;
            newton.q[column] += if dq.abs() > TURN { dq } else { 0.0 };
        }
        if asked.iter().any(|(_, _, dq)| dq.abs() > TURN) {
            keep_linear(newton, t, &asked);
        }
    }
}

/// Sets all angles at once, with every row taken as linear. Returns false and changes nothing if
/// one is not linear.
fn follow(newton: &mut Newton<'_>, t: f64) -> bool {
    if all_are_near(newton) {
        return true;
    }
    let mut rows = Rows::new(newton);
    let mut turned = Vec::new();
    let mut queue: Vec<usize> =
        (0..rows.open.len()).rev().filter(|row| rows.open[*row] == 1).collect();
    while let Some(row) = queue.pop() {
        let Some((column, value)) = rows.only(row) else { continue };
        let dq = -rows.c[row] / value;
        if !dq.is_finite() {
            continue;
        }
        let dq = if dq.abs() > TURN { dq } else { 0.0 };
        if dq != 0.0 {
            turned.push((row, column, dq));
        }
        queue.extend(rows.settle(column, dq));
    }
    if turned.is_empty() {
        return true;
    }
    let before: Vec<f64> = turned
        .iter()
        .map(|&(row, column, dq)| newton.c[row].abs().max((dq * rows.value(row, column)).abs()))
        .collect();
    let start = newton.q.clone();
    turned.iter().for_each(|&(_, column, dq)| newton.q[column] += dq);
    let evaluated = newton.linearize(t).is_ok();
    let linear = evaluated
        && turned
            .iter()
            .zip(before)
            .all(|(&(row, _, _), before)| newton.c[row].abs() <= 1e-3 * before);
    if !linear {
        newton.q = start;
    }
    linear
}

/// Returns true if no row of angles alone has a residual that could rotate one of them by [`TURN`].
/// The residual of the first such row does not depend on other rotations.
fn all_are_near(newton: &Newton<'_>) -> bool {
    let equations = newton.system.equations();
    let units = &newton.system.layout().units;
    equations.blocks.iter().all(|block| {
        let entries = equations.entries.get(block.values()).unwrap_or_default();
        let values = newton.linear.values().get(block.values()).unwrap_or_default();
        let own =
            || entries.iter().zip(values).filter_map(|(entry, value)| Some(((*entry)?, *value)));
        let own = || own().filter(|(_, value)| *value != 0.0);
        let is_of_angles = |row: usize| {
            own().all(|((other, column), _)| other != row || units[column] == Unit::Radian)
        };
        !own()
            .any(|((row, _), value)| newton.c[row].abs() > TURN * value.abs() && is_of_angles(row))
    })
}

/// The rows of angles alone, while their angles become known one after the other.
struct Rows {
    c: Vec<f64>,
    /// The number of unknown angles of each row, and the sum of their indices; 0 for rows with
    /// other coordinates.
    open: Vec<usize>,
    sum: Vec<usize>,
    /// The rows and values of each angle.
    columns: Vec<Vec<(usize, f64)>>,
}

impl Rows {
    fn new(newton: &Newton<'_>) -> Self {
        let units = &newton.system.layout().units;
        let entries = newton.system.equations().entries.iter().zip(newton.linear.values());
        let entries: Vec<_> = entries
            .filter_map(|(entry, value)| {
                entry.filter(|_| *value != 0.0).map(|(i, j)| (i, j, *value))
            })
            .collect();
        let mut angles = vec![true; newton.c.len()];
        entries.iter().for_each(|&(row, column, _)| angles[row] &= units[column] == Unit::Radian);
        let open = vec![0; newton.c.len()];
        let columns = vec![Vec::new(); newton.q.len()];
        let mut rows = Rows { c: newton.c.to_vec(), sum: open.clone(), open, columns };
        for &(row, column, value) in entries.iter().filter(|(row, _, _)| angles[*row]) {
            rows.open[row] += 1;
            rows.sum[row] += column;
            rows.columns[column].push((row, value));
        }
        rows
    }

    /// Returns the only unknown angle of a row, and its value there.
    fn only(&self, row: usize) -> Option<(usize, f64)> {
        (self.open[row] == 1).then(|| (self.sum[row], self.value(row, self.sum[row])))
    }

    fn value(&self, row: usize, column: usize) -> f64 {
        self.columns[column].iter().find(|known| known.0 == row).map_or(0.0, |known| known.1)
    }

    /// Records that an angle is known and has rotated. Returns the rows with only one unknown angle
    /// left.
    fn settle(&mut self, column: usize, dq: f64) -> Vec<usize> {
        for &(row, value) in &self.columns[column] {
            self.c[row] += value * dq;
            self.open[row] -= 1;
            self.sum[row] -= column;
        }
        self.columns[column]
            .iter()
            .map(|known| known.0)
            .filter(|row| self.open[*row] == 1)
            .collect()
    }
}

/// Returns the row, column and correction of each angle that one row determines.
fn asked(newton: &Newton<'_>, known: &[bool]) -> Vec<(usize, usize, f64)> {
    let units = &newton.system.layout().units;
    // For each row its only open column and the value there; `None` after a second one.
    let mut open: Vec<Option<Option<(usize, f64)>>> = vec![Some(None); newton.c.len()];
    for (entry, &value) in newton.system.equations().entries.iter().zip(newton.linear.values()) {
        let Some((row, column)) = entry.filter(|&(_, column)| value != 0.0 && !known[column])
        else {
            continue;
        };
        open[row] = match open[row] {
            Some(None) if units[column] == Unit::Radian => Some(Some((column, value))),
            _ => None,
        };
    }
    let mut taken = vec![false; known.len()];
    let rows = open
        .into_iter()
        .enumerate()
        .filter_map(|(row, only)| only.flatten().map(|(column, value)| (row, column, value)));
    let corrections = rows
        .map(|(row, column, value)| (row, column, -newton.c[row] / value))
        .filter(|(_, _, dq)| dq.is_finite());
    corrections.filter(|&(_, column, _)| !std::mem::replace(&mut taken[column], true)).collect()
}

/// Undoes a rotation if its row is not satisfied by it.
fn keep_linear(newton: &mut Newton<'_>, t: f64, asked: &[(usize, usize, f64)]) {
    let before: Vec<f64> = asked.iter().map(|&(row, _, _)| newton.c[row].abs()).collect();
    let evaluated = newton.linearize(t).is_ok();
    for (&(row, column, dq), before) in asked.iter().zip(before) {
        if dq.abs() > TURN && !(evaluated && newton.c[row].abs() <= 1e-3 * before) {
            newton.q[column] -= dq;
        }
    }
}
