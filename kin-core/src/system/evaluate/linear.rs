//! Evaluates rows that are always linear in the coordinates: C = C_q q + C(0, t).
//!
//! Examples are the rows of most drivers and of straight guides. Kin evaluates these constraints
//! only when the time changes.

use std::ops::Range;

/// The rows of such constraints, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearRows {
    rows: Vec<Row>,
    /// The terms after the first one of each row, row by row.
    others: Vec<Term>,
}

/// A row with its first term and the number of its other terms.
#[derive(Clone, Copy, Debug)]
struct Row {
    row: u32,
    others: u32,
    first: Term,
    /// The index of C(0, t) among the numbers of the time. −C_t and −C_tt follow at the stride of
    /// the constraint; −C_tt is all of Q_d here.
    sides: u32,
    step: u32,
}

/// A factor times a coordinate.
#[derive(Clone, Copy, Debug)]
struct Term {
    column: u32,
    factor: f64,
}

impl Term {
    #[inline(always)]
    fn at(self, q: &[f64]) -> f64 {
        self.factor * q[self.column as usize]
    }
}

/// The right side to write: −C_t or Q_d.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Velocity = 1,
    Acceleration,
}

impl LinearRows {
    /// Appends rows with their entries and values of C_q. Their numbers of the time begin at
    /// `sides`: C(0, t) of all rows, then −C_t, then −C_tt. Returns false if a value is not
    /// constant or a row has no entry.
    pub(super) fn append(
        &mut self,
        rows: Range<usize>,
        entries: &[Option<(usize, usize)>],
        values: &[Option<f64>],
        sides: usize,
    ) -> bool {
        let own = entries
            .iter()
            .zip(values)
            .filter_map(|(entry, value)| entry.map(|entry| Some((entry, (*value)?))));
        let Some(mut known) = own.collect::<Option<Vec<((usize, usize), f64)>>>() else {
            return false;
        };
        known.sort_by_key(|(entry, _)| *entry);
        if !rows.clone().all(|row| known.iter().any(|((i, _), _)| *i == row)) {
            return false;
        }
        let step = rows.len() as u32;
        for (k, terms) in known.chunk_by(|a, b| a.0.0 == b.0.0).enumerate() {
            let row = terms[0].0.0 as u32;
            let sides = (sides + k) as u32;
            let mut terms =
                terms.iter().map(|&((_, column), factor)| Term { column: column as u32, factor });
            let first = terms.next();
            self.rows.extend(first.map(|first| Row {
                row,
                others: terms.len() as u32,
                first,
                sides,
                step,
            }));
            self.others.extend(terms);
        }
        true
    }

    /// Writes C of these rows from the coordinates and the numbers of the time.
    #[inline]
    pub(super) fn write(&self, q: &[f64], timed: &[f64], c: &mut [f64]) {
        let mut others = self.others.iter();
        for row in &self.rows {
            let mut sum = row.first.at(q);
            // Coordinates are added first: the difference of two angles is small, and so is its
            // rounding.
            for _ in 0..row.others {
                sum += others.next().map_or(0.0, |term| term.at(q));
            }
            c[row.row as usize] = sum + timed[row.sides as usize];
        }
    }

    /// Writes the rows of these constraints in a right side, times a factor.
    #[inline]
    pub(super) fn write_side(&self, side: Side, timed: &[f64], factor: f64, rhs: &mut [f64]) {
        for row in &self.rows {
            rhs[row.row as usize] =
                factor * timed[row.sides as usize + side as usize * row.step as usize];
        }
    }
}
