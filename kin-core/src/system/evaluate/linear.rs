//! Rows that are linear in the coordinates for good, as those of most drivers and of straight guides: C = C_q q + C(0, t). Their constraints
//! are asked only when the time changes.

use std::ops::Range;

/// The rows of such constraints, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearRows {
    /// Which one each is among all rows.
    rows: Vec<u32>,
    /// The first term of each row, and the others.
    first: Vec<Term>,
    others: Vec<Term>,
}

/// A factor times a coordinate, in a row by its number among linear ones.
#[derive(Clone, Copy, Debug)]
struct Term {
    row: u32,
    column: u32,
    factor: f64,
}

/// What the rows come to at one instant.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    /// C(0, t), −C_t and −C_tt, which is all that Q_d has here.
    pub at_zero: Vec<f64>,
    pub velocity: Vec<f64>,
    pub acceleration: Vec<f64>,
    /// C_q q
    products: Vec<f64>,
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
        let from = self.rows.len();
        let own = entries.iter().zip(values).filter_map(|(entry, value)| entry.map(|entry| Some((entry, (*value)?))));
        let mut known: Vec<((usize, usize), f64)> = own.collect::<Option<_>>()?;
        known.sort_by_key(|(entry, _)| *entry);
        if !rows.clone().all(|row| known.iter().any(|((i, _), _)| *i == row)) {
            return None;
        }
        for row in known.chunk_by(|a, b| a.0.0 == b.0.0) {
            let number = self.rows.len() as u32;
            self.rows.push(row[0].0.0 as u32);
            let mut terms = row.iter().map(|&((_, column), factor)| Term { row: number, column: column as u32, factor });
            self.first.extend(terms.next());
            self.others.extend(terms);
        }
        Some(from..self.rows.len())
    }

    /// Room for an instant, all coordinates at zero.
    pub(super) fn sums(&self) -> Sums {
        let zeros = || vec![0.0; self.rows.len()];
        Sums { at_zero: zeros(), velocity: zeros(), acceleration: zeros(), products: zeros() }
    }

    pub(super) fn set_position(&self, q: &[f64], sums: &mut Sums) {
        for (product, term) in sums.products.iter_mut().zip(&self.first) {
            *product = term.factor * q[term.column as usize];
        }
        for term in &self.others {
            sums.products[term.row as usize] += term.factor * q[term.column as usize];
        }
    }

    /// C of these rows.
    pub(super) fn write(&self, sums: &Sums, c: &mut [f64]) {
        for ((row, at_zero), product) in self.rows.iter().zip(&sums.at_zero).zip(&sums.products) {
            c[*row as usize] = product + at_zero;
        }
    }

    /// Their part of a right side, times a factor.
    pub(super) fn write_side(&self, side: &[f64], factor: f64, rhs: &mut [f64]) {
        for (row, x) in self.rows.iter().zip(side) {
            rhs[*row as usize] = factor * x;
        }
    }
}
