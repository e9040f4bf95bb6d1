//! Rows that are linear in the coordinates for good, as those of most drivers and of straight guides: C = C_q q + C(0, t). Their constraints
//! are asked only when the time changes.

use std::ops::Range;

/// The rows of such constraints, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearRows {
    rows: Vec<Row>,
    /// Terms after the first one of each row.
    others: Vec<Term>,
}

/// One of all rows with its first term.
#[derive(Clone, Copy, Debug)]
struct Row {
    first: Term,
    /// Where what it comes to at one time stands among the numbers of the time: C(0, t), and so much further on each −C_t and −C_tt, which is
    /// all that Q_d has here.
    sides: u32,
    step: u32,
}

/// A factor times a coordinate, in one of all rows.
#[derive(Clone, Copy, Debug)]
struct Term {
    row: u32,
    column: u32,
    factor: f64,
}

/// Which right side: −C_t, or Q_d.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Velocity = 1,
    Acceleration,
}

impl LinearRows {
    /// Appends rows with the entries and values of C_q in them, whose numbers of the time begin at `sides`: C(0, t) of all rows, −C_t, −C_tt; false if
    /// the values are not all known or a row has none.
    pub(super) fn append(
        &mut self,
        rows: Range<usize>,
        entries: &[Option<(usize, usize)>],
        values: &[Option<f64>],
        sides: usize,
    ) -> bool {
        let own = entries.iter().zip(values).filter_map(|(entry, value)| entry.map(|entry| Some((entry, (*value)?))));
        let Some(mut known) = own.collect::<Option<Vec<((usize, usize), f64)>>>() else { return false };
        known.sort_by_key(|(entry, _)| *entry);
        if !rows.clone().all(|row| known.iter().any(|((i, _), _)| *i == row)) {
            return false;
        }
        for (k, row) in known.chunk_by(|a, b| a.0.0 == b.0.0).enumerate() {
            let mut terms = row.iter().map(|&((row, column), factor)| Term { row: row as u32, column: column as u32, factor });
            self.rows.extend(terms.next().map(|first| Row { first, sides: (sides + k) as u32, step: rows.len() as u32 }));
            self.others.extend(terms);
        }
        true
    }

    /// C of these rows, with the numbers of the time.
    #[inline]
    pub(super) fn write(&self, q: &[f64], timed: &[f64], c: &mut [f64]) {
        for Row { first, sides, .. } in &self.rows {
            c[first.row as usize] = first.factor * q[first.column as usize] + timed[*sides as usize];
        }
        for term in &self.others {
            c[term.row as usize] += term.factor * q[term.column as usize];
        }
    }

    /// Their part of a right side, times a factor.
    #[inline]
    pub(super) fn write_side(&self, side: Side, timed: &[f64], factor: f64, rhs: &mut [f64]) {
        for Row { first, sides, step } in &self.rows {
            rhs[first.row as usize] = factor * timed[*sides as usize + side as usize * *step as usize];
        }
    }
}
