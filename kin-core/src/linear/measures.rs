//! How large rows and columns are, and have been: by these pivots are chosen and judged.

use super::{Linear, RANK, SLACK};
use crate::numbers::padded::{self, Padded};

impl Linear {
    /// max_j |a_ij| s_j of each row, the largest since the start or [`Linear::forget`].
    pub(crate) fn norms(&self) -> &[f64] {
        &self.norms
    }

    /// One over that; 1 for a row that has been zero.
    pub(crate) fn row_units(&self) -> &Padded {
        &self.row_units
    }

    /// s_j over the largest share of each column; what a unit of the measured unknown is.
    pub(crate) fn column_units(&self) -> &[f64] {
        &self.column_units
    }

    /// True if a column is so small that only a look at the whole matrix tells it from zero.
    pub(crate) fn is_faint(&self) -> bool {
        self.faint
    }

    /// Forgets how large rows and columns have been.
    pub(crate) fn forget(&mut self) {
        if self.norms.iter().all(|norm| *norm == 0.0) {
            return;
        }
        self.norms.fill(0.0);
        self.tops.fill(0.0);
        self.provisional = false;
        self.set_units();
    }

    /// True if rows or columns have grown since they were last confirmed.
    pub(crate) fn is_provisional(&self) -> bool {
        self.provisional
    }

    /// How large rows and columns have been counts from now on.
    #[inline]
    pub(crate) fn confirm(&mut self) {
        self.provisional = false;
    }

    /// Rows and columns are what they were when they were last confirmed: what was seen of them
    /// since was not on the way.
    pub(crate) fn revoke(&mut self) {
        if std::mem::take(&mut self.provisional) {
            self.norms.copy_from_slice(&self.confirmed[0]);
            self.tops.copy_from_slice(&self.confirmed[1]);
            self.set_units();
        }
    }

    /// Measures rows and columns of the values as written, before [`Linear::factor`]; false if one
    /// of them is not finite.
    pub(crate) fn measure(&mut self) -> bool {
        padded::inside(self.memory[..self.places.rhs as usize].as_chunks().0, self.limits.whole())
            || self.measure_anew()
    }

    /// The same where something has grown, or is not finite.
    #[cold]
    fn measure_anew(&mut self) -> bool {
        if !std::mem::replace(&mut self.provisional, true) {
            self.confirmed[0].copy_from_slice(&self.norms);
            self.confirmed[1].copy_from_slice(&self.tops);
        }
        let same_place = |a: &u32, b: &u32| self.entries[*a as usize] == self.entries[*b as usize];
        let size = |same: &[u32]| {
            let (i, j) = self.entries[same[0] as usize].unwrap_or_default();
            let value: f64 = same.iter().map(|k| self.memory[*k as usize]).sum();
            (i as usize, j as usize, value.abs() * self.sizes[j as usize])
        };
        for (i, _, size) in self.sorted.chunk_by(same_place).map(size) {
            self.norms[i] = self.norms[i].max(size);
        }
        for (i, j, size) in
            self.sorted.chunk_by(same_place).map(size).filter(|(_, _, size)| *size > 0.0)
        {
            self.tops[j] = self.tops[j].max(size / self.norms[i]);
        }
        self.set_units();
        self.sorted.iter().all(|k| self.memory[*k as usize].is_finite())
    }

    pub(super) fn set_units(&mut self) {
        for (unit, norm) in self.row_units.iter_mut().zip(&self.norms) {
            *unit = if *norm > 0.0 { norm.recip() } else { 1.0 };
        }
        for ((unit, top), size) in self.column_units.iter_mut().zip(&self.tops).zip(&self.sizes) {
            *unit = if *top > 0.0 { size / top } else { *size };
        }
        for (entry, limit) in self.entries.iter().zip(self.limits.iter_mut()) {
            if let Some((i, j)) = entry.map(|(i, j)| (i as usize, j as usize)) {
                *limit = SLACK * self.norms[i] * self.tops[j].min(1.0) / self.sizes[j];
            }
        }
        self.faint = self.tops.iter().any(|top| *top <= RANK);
        (self.weighted, self.settled) = (false, false);
    }
}
