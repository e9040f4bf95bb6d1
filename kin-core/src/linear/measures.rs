//! Computes the scales of rows and columns, with which Kin selects and judges pivots, from present
//! and earlier sizes.

use super::{Linear, RANK, SLACK};
use crate::numbers::padded::{self, Padded};

impl Linear {
    /// Returns for each row the largest max_j |a_ij| s_j since the start or [`Linear::forget`].
    pub(crate) fn norms(&self) -> &[f64] {
        &self.norms
    }

    /// Returns one divided by the norm of each row; 1 for a row that has always been zero.
    pub(crate) fn row_units(&self) -> &Padded {
        &self.row_units
    }

    /// Returns s_j divided by the largest scaled entry of each column: one unit of the scaled
    /// unknown.
    pub(crate) fn column_units(&self) -> &[f64] {
        &self.column_units
    }

    /// Returns true if a column is so small that only the rank of the whole matrix distinguishes it
    /// from zero.
    pub(crate) fn is_faint(&self) -> bool {
        self.faint
    }

    /// Discards the earlier sizes of rows and columns.
    pub(crate) fn forget(&mut self) {
        if self.norms.iter().all(|norm| *norm == 0.0) {
            return;
        }
        self.norms.fill(0.0);
        self.tops.fill(0.0);
        self.provisional = false;
        self.set_units();
    }

    /// Returns true if rows or columns have grown since their last confirmation.
    pub(crate) fn is_provisional(&self) -> bool {
        self.provisional
    }

    /// Confirms the present scales.
    #[inline]
    pub(crate) fn confirm(&mut self) {
        self.provisional = false;
    }

    /// Restores the last confirmed scales, because the values since then did not belong to the
    /// motion.
    pub(crate) fn revoke(&mut self) {
        if std::mem::take(&mut self.provisional) {
            self.norms.copy_from_slice(&self.confirmed[0]);
            self.tops.copy_from_slice(&self.confirmed[1]);
            self.set_units();
        }
    }

    /// Scales rows and columns with the present values, before [`Linear::factor`]. Returns false if
    /// one of them is not finite.
    pub(crate) fn measure(&mut self) -> bool {
        padded::inside(self.memory[..self.places.rhs as usize].as_chunks().0, self.limits.whole())
            || self.measure_anew()
    }

    /// Scales again after something has grown or is not finite.
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
