//! What is said of a singular matrix.

use super::rank::{self, Singular};
use super::{Linear, SINGULAR, record};

/// Up to this size dependencies are found by complete pivoting on a dense matrix.
const DENSE: usize = 120;

/// Vectors of a null space that are looked at.
const VECTORS: usize = 16;

impl Linear {
    /// Rank and dependencies of the values as last written. Slow; for a message.
    pub(crate) fn diagnose(&mut self) -> Singular {
        if self.n <= DENSE { self.diagnose_dense() } else { self.diagnose_sparse() }
    }

    fn diagnose_dense(&self) -> Singular {
        let mut scaled = vec![0.0; self.n * self.n];
        for (entry, value) in self.entries.iter().zip(self.values()) {
            let Some((row, column)) = entry.map(|(row, column)| (row as usize, column as usize)) else { continue };
            scaled[column * self.n + row] += self.row_units[row] * value * self.column_units[column];
        }
        rank::dependencies(scaled, self.n)
    }

    /// By the null vectors of the matrix, with the elimination as far as it goes.
    fn diagnose_sparse(&mut self) -> Singular {
        match record::record(&self.input(), self.places, &mut self.memory[..=self.places.zero as usize].to_vec()) {
            Err(left) => self.complete(&left),
            Ok(_) => self.nearly(),
        }
    }

    /// The rows and columns that elimination has left over, one of each in pairs: a cell put where each pair meets makes the matrix
    /// regular, and its inverse takes the unit vectors of these rows to the null space.
    fn complete(&self, left: &[(u32, u32)]) -> Singular {
        let place = |(row, column): (u32, u32)| (row as usize, column as usize);
        let entries = self.entries.iter().copied().chain(left.iter().copied().map(Some)).map(|entry| entry.map(place));
        let mut completed = Linear::new(self.n, entries, &[]);
        let unit = |&(row, column): &(u32, u32)| (self.row_units[row as usize] * self.column_units[column as usize]).recip();
        let values = self.values().iter().copied().chain(left.iter().map(unit));
        completed.values_mut().iter_mut().zip(values).for_each(|(place, value)| *place = value);
        completed.set_sizes(&self.sizes);
        completed.measure();
        let mut found = Singular { rank: self.n - left.len(), pivot: 0.0, columns: Vec::new(), rows: Vec::new() };
        if completed.record_only().is_some() {
            let shares = |unit: &dyn Fn(&(u32, u32)) -> u32, inverse: &dyn Fn(&mut Linear, &mut [f64])| {
                let mut share = vec![0.0_f64; self.n];
                for pair in left.iter().take(VECTORS) {
                    let mut v = vec![0.0; self.n];
                    v[unit(pair) as usize] = 1.0;
                    inverse(&mut completed.clone(), &mut v);
                    rank::add_shares(&mut share, &v);
                }
                rank::shared(&share)
            };
            found.columns = shares(&|pair| pair.0, &|linear, v| linear.apply_inverse(v));
            found.rows = shares(&|pair| pair.1, &|linear, v| linear.apply_inverse_transposed(v));
        }
        found
    }

    /// The matrix is regular but for rounding: inverse iteration finds what nearly vanishes.
    fn nearly(&mut self) -> Singular {
        let mut found = Singular { rank: self.n - 1, pivot: SINGULAR, columns: Vec::new(), rows: Vec::new() };
        if self.record_only().is_some() {
            let (left, right, [largest, smallest]) = self.nearly_null();
            let shared = |v: &[f64]| {
                let mut share = vec![0.0; v.len()];
                rank::add_shares(&mut share, v);
                rank::shared(&share)
            };
            (found.columns, found.rows, found.pivot) = (shared(&right), shared(&left), smallest / largest);
        }
        found
    }
}
