//! Estimates how close a factored matrix is to a singular matrix, by inverse iteration with the
//! recorded program and its transpose.

use super::Linear;
use crate::numbers::random::Random;

/// The number of iterations with A⁻¹, then A⁻ᵀ, for a verdict, and for numbers that a user sees.
const ROUNDS: usize = 3;
const ROUNDS_SHOWN: usize = 30;

impl Linear {
    /// Returns an estimate of the 2-norm condition number of the scaled matrix, from below and
    /// rarely by more than a factor of 2. It is not finite if it overflows. \[-\]
    pub(crate) fn condition(&mut self) -> f64 {
        let [largest, smallest] = self.nearly_null_after(ROUNDS).2;
        largest / smallest
    }

    /// Returns estimates of the largest singular value of the scaled matrix (from below) and of the
    /// smallest (from above). \[-\]
    pub(crate) fn singular_values(&mut self) -> [f64; 2] {
        self.nearly_null_after(ROUNDS_SHOWN).2
    }

    /// Returns nearly null vectors of the transpose and of the matrix, scaled, and the largest and
    /// the smallest singular value.
    pub(crate) fn nearly_null(&mut self) -> (Vec<f64>, Vec<f64>, [f64; 2]) {
        self.nearly_null_after(ROUNDS)
    }

    fn nearly_null_after(&mut self, rounds: usize) -> (Vec<f64>, Vec<f64>, [f64; 2]) {
        let rhs = self.rhs_mut().to_vec();
        let mut random = Random::new(0);
        let mut left: Vec<f64> = (0..self.n).map(|_| sign_and_size(&mut random)).collect();
        let mut inverse = 0.0_f64;
        let mut direct = 0.0_f64;
        let mut v = left.clone();
        let mut right = Vec::new();
        // Each length is at least the one before it.
        for _ in 0..rounds {
            self.apply_inverse(&mut left);
            normalise(&mut left);
            right.clone_from(&left);
            self.apply_inverse_transposed(&mut left);
            inverse = normalise(&mut left);
        }
        for _ in 0..rounds {
            v = self.apply(&v, false);
            normalise(&mut v);
            v = self.apply(&v, true);
            direct = normalise(&mut v);
        }
        // The right side may belong to a solve that waits for this verdict, so it is restored.
        self.rhs_mut().copy_from_slice(&rhs);
        (left, right, [direct, inverse.recip()])
    }

    /// Replaces v by the inverse of the scaled matrix times v.
    fn apply_inverse(&mut self, v: &mut [f64]) {
        let units = self.row_units.clone();
        for ((b, v), unit) in self.rhs_mut().iter_mut().zip(v.iter()).zip(units.iter()) {
            *b = v / unit;
        }
        self.solve();
        for ((v, x), unit) in v.iter_mut().zip(self.solution()).zip(&self.column_units) {
            *v = x / unit;
        }
    }

    /// Replaces v by the inverse transpose of the scaled matrix times v.
    fn apply_inverse_transposed(&mut self, v: &mut [f64]) {
        v.iter_mut().zip(&self.column_units).for_each(|(v, unit)| *v /= unit);
        let x = self.solved_transposed(v);
        for ((v, x), unit) in v.iter_mut().zip(x).zip(self.row_units.iter()) {
            *v = x / unit;
        }
    }

    /// Returns the solution of Aᵀ x = b with the present factors.
    pub(crate) fn solved_transposed(&self, b: &[f64]) -> Vec<f64> {
        let mut adjoint = vec![0.0; self.memory.len()];
        let rhs = self.places.rhs as usize;
        let solution = self.places.solution as usize;
        adjoint[solution..][..self.n].copy_from_slice(&b[..self.n]);
        if let Some(recording) = &self.recording {
            recording.solve.run_transposed(&self.memory, &mut adjoint);
        }
        adjoint[rhs..][..self.n].to_vec()
    }

    /// Returns the scaled matrix, or its transpose, times v.
    fn apply(&self, v: &[f64], transposed: bool) -> Vec<f64> {
        let mut product = vec![0.0; self.n];
        for (entry, value) in self.entries.iter().zip(self.values()) {
            let Some((row, column)) = entry.map(|(row, column)| (row as usize, column as usize))
            else {
                continue;
            };
            let value = self.row_units[row] * value * self.column_units[column];
            let (to, from) = if transposed { (column, row) } else { (row, column) };
            product[to] += value * v[from];
        }
        product
    }
}

/// Normalises v to |v| = 1 and returns the old norm; a norm that is not finite counts as infinite.
fn normalise(v: &mut [f64]) -> f64 {
    let largest =
        v.iter().fold(0.0_f64, |m, x| if x.is_nan() { f64::INFINITY } else { m.max(x.abs()) });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    v.iter_mut().for_each(|x| *x /= largest);
    let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.iter_mut().for_each(|x| *x /= norm);
    largest * norm
}

/// Draws numbers of either sign between ½ and 1. They are the same in every run.
fn sign_and_size(random: &mut Random) -> f64 {
    let x = random.number();
    0.5 * x + 0.5_f64.copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_is_made_a_unit_vector_unless_it_is_none() {
        let normalised = |v: [f64; 2]| {
            let mut unit = v;
            (normalise(&mut unit), unit)
        };
        assert_eq!(normalised([3.0, -4.0]), (5.0, [0.6, -0.8]));
        let (size, unit) = normalised([3e200, -4e200]);
        assert!((size / 5e200 - 1.0).abs() < 1e-15 && unit == [0.6, -0.8]);
        assert_eq!(normalised([0.0, 0.0]), (0.0, [0.0, 0.0]));
        assert_eq!(normalised([1.0, f64::NEG_INFINITY]), (f64::INFINITY, [1.0, f64::NEG_INFINITY]));
        assert_eq!(
            (normalised([f64::NAN, 1.0]).0, normalised([1.0, f64::NAN]).0),
            (f64::INFINITY, f64::INFINITY)
        );
    }

    #[test]
    fn a_search_begins_with_numbers_of_either_sign_and_of_one_size() {
        let mut random = Random::new(0);
        let all: Vec<f64> = (0..200).map(|_| sign_and_size(&mut random)).collect();
        assert!(all.iter().all(|x| (0.5..=1.0).contains(&x.abs())));
        let above = all.iter().filter(|x| **x > 0.0).count();
        let large = all.iter().filter(|x| x.abs() > 0.75).count();
        assert!((60..140).contains(&above) && (60..140).contains(&large), "{above} {large}");
    }
}
