//! Rows that are linear in the coordinates for good, as those of most drivers and of straight guides: C = C_q q + C(0, t). Their constraints
//! are asked only when the time changes.

use std::ops::Range;

/// The rows of such constraints, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearRows {
    /// The first term of each row, and the others.
    first: Vec<Term>,
    others: Vec<Term>,
}

/// A factor times a coordinate, in one of all rows.
#[derive(Clone, Copy, Debug)]
struct Term {
    row: u32,
    column: u32,
    factor: f64,
}

/// What the rows come to at one time: C(0, t), −C_t and −C_tt, which is all that Q_d has here.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    pub at_zero: Vec<f64>,
    pub velocity: Vec<f64>,
    pub acceleration: Vec<f64>,
}

impl Sides {
    /// Takes those of some rows: three numbers of each.
    pub(super) fn take(&mut self, rows: Range<usize>, told: &[f64]) {
        for (row, &[at_zero, velocity, acceleration]) in rows.zip(told.as_chunks().0) {
            (self.at_zero[row], self.velocity[row], self.acceleration[row]) = (at_zero, velocity, acceleration);
        }
    }
}

impl LinearRows {
    /// Appends rows with the entries and values of C_q in them; gives their numbers among linear rows, or nothing if they are not all known
    /// or a row has none.
    pub(super) fn append(
        &mut self,
        rows: Range<usize>,
        entries: &[Option<(usize, usize)>],
        values: &[Option<f64>],
    ) -> Option<Range<usize>> {
        let from = self.first.len();
        let own = entries.iter().zip(values).filter_map(|(entry, value)| entry.map(|entry| Some((entry, (*value)?))));
        let mut known: Vec<((usize, usize), f64)> = own.collect::<Option<_>>()?;
        known.sort_by_key(|(entry, _)| *entry);
        if !rows.clone().all(|row| known.iter().any(|((i, _), _)| *i == row)) {
            return None;
        }
        for row in known.chunk_by(|a, b| a.0.0 == b.0.0) {
            let mut terms = row.iter().map(|&((row, column), factor)| Term { row: row as u32, column: column as u32, factor });
            self.first.extend(terms.next());
            self.others.extend(terms);
        }
        Some(from..self.first.len())
    }

    /// Room for the sides of all rows.
    pub(super) fn sides(&self) -> Sides {
        let zeros = || vec![0.0; self.first.len()];
        Sides { at_zero: zeros(), velocity: zeros(), acceleration: zeros() }
    }

    /// C of these rows.
    pub(super) fn write(&self, q: &[f64], at_zero: &[f64], c: &mut [f64]) {
        for (term, at_zero) in self.first.iter().zip(at_zero) {
            c[term.row as usize] = term.factor * q[term.column as usize] + at_zero;
        }
        for term in &self.others {
            c[term.row as usize] += term.factor * q[term.column as usize];
        }
    }

    /// Their part of a right side, times a factor.
    pub(super) fn write_side(&self, side: &[f64], factor: f64, rhs: &mut [f64]) {
        for (term, x) in self.first.iter().zip(side) {
            rhs[term.row as usize] = factor * x;
        }
    }
}
