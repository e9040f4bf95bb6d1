//! Driven bodies are turned to where their drivers ask before anything else: a motor that stands at 300 turns when the run begins is no
//! reason for 300 turns' worth of careful steps.

use super::{Newton, TURN};
use crate::layout::Unit;

/// Sets angles that are far from where a row of angles alone, all but this one known, puts them: drivers, and what follows them by
/// equations between angles. A row that is not linear in its angle is left alone.
pub(super) fn turn(newton: &mut Newton<'_>, t: f64) {
    let mut known = vec![false; newton.q.len()];
    loop {
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

/// Row, column and correction of each angle that one row determines by itself.
fn asked(newton: &Newton<'_>, known: &[bool]) -> Vec<(usize, usize, f64)> {
    let units = &newton.system.layout().units;
    // Of each row its only open column and the value there; `None` after a second one.
    let mut open: Vec<Option<Option<(usize, f64)>>> = vec![Some(None); newton.c.len()];
    for (entry, &value) in newton.system.equations().entries.iter().zip(newton.linear.values()) {
        let Some((row, column)) = entry.filter(|&(_, column)| value != 0.0 && !known[column]) else { continue };
        open[row] = match open[row] {
            Some(None) if units[column] == Unit::Radian => Some(Some((column, value))),
            _ => None,
        };
    }
    let mut taken = vec![false; known.len()];
    let rows = open.into_iter().enumerate().filter_map(|(row, only)| only.flatten().map(|(column, value)| (row, column, value)));
    let corrections = rows.map(|(row, column, value)| (row, column, -newton.c[row] / value)).filter(|(_, _, dq)| dq.is_finite());
    corrections.filter(|&(_, column, _)| !std::mem::replace(&mut taken[column], true)).collect()
}

/// Takes a turn back if its row is not met by it.
fn keep_linear(newton: &mut Newton<'_>, t: f64, asked: &[(usize, usize, f64)]) {
    let before: Vec<f64> = asked.iter().map(|&(row, _, _)| newton.c[row].abs()).collect();
    let evaluated = newton.linearize(t).is_ok();
    for (&(row, column, dq), before) in asked.iter().zip(before) {
        if dq.abs() > TURN && !(evaluated && newton.c[row].abs() <= 1e-3 * before) {
            newton.q[column] -= dq;
        }
    }
}
