//! What is said of a singular matrix.

use super::rank::{self, Singular};
use super::Linear;

/// Up to this size dependencies are found by complete pivoting on a dense matrix.
const DENSE: usize = 400;

impl Linear {
    /// Rank and dependencies of the values as last written. Slow; for a message.
    pub(crate) fn diagnose(&mut self) -> Singular {
        if self.n > DENSE {
            return Singular { rank: self.n - 1, pivot: 0.0, columns: Vec::new(), rows: Vec::new() };
        }
        let mut scaled = vec![0.0; self.n * self.n];
        for (entry, value) in self.entries.iter().zip(self.values()) {
            let Some((row, column)) = entry.map(|(row, column)| (row as usize, column as usize)) else { continue };
            scaled[column * self.n + row] += self.row_units[row] * value * self.column_units[column];
        }
        rank::dependencies(scaled, self.n)
    }
}
