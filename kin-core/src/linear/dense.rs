//! Eliminates a small dense matrix directly.
//!
//! If each matrix differs much from the previous matrix, recording the elimination saves no time.

/// A pivot below this value is zero, for a matrix with rows and columns of order 1. \[-\]
const SINGULAR: f64 = 1e-13;

/// n equations for n unknowns, with their right side.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    n: usize,
    /// Row after row, each followed by its right side.
    rows: Vec<f64>,
    solution: Vec<f64>,
}

impl Dense {
    pub(crate) fn new(n: usize) -> Self {
        Dense { n, rows: vec![0.0; n * (n + 1)], solution: vec![0.0; n] }
    }

    /// Stores the values (row, column, value), which add up, and the right side.
    pub(crate) fn set(
        &mut self,
        entries: impl Iterator<Item = (usize, usize, f64)>,
        rhs: impl Iterator<Item = f64>,
    ) {
        let width = self.n + 1;
        self.rows.fill(0.0);
        entries.for_each(|(row, column, value)| self.rows[row * width + column] += value);
        self.rows.chunks_exact_mut(width).zip(rhs).for_each(|(row, b)| row[width - 1] = b);
    }

    /// Returns the solution, by elimination with row pivots, or `None` for a singular matrix.
    pub(crate) fn solve(&mut self) -> Option<&[f64]> {
        let n = self.n;
        let width = self.n + 1;
        for k in 0..n {
            let size = |row: &usize| self.rows[row * width + k].abs();
            let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            if size(&pivot).partial_cmp(&SINGULAR) != Some(std::cmp::Ordering::Greater) {
                return None;
            }
            if pivot != k {
                let (upper, lower) = self.rows.split_at_mut(pivot * width);
                upper[k * width..(k + 1) * width].swap_with_slice(&mut lower[..width]);
            }
            let (upper, lower) = self.rows.split_at_mut((k + 1) * width);
            let own = &upper[k * width + k..];
            for row in lower.chunks_exact_mut(width) {
                let factor = row[k] / own[0];
                if factor != 0.0 {
                    row[k..].iter_mut().zip(own).for_each(|(x, own)| *x -= factor * own);
                }
            }
        }
        for (k, row) in self.rows.chunks_exact(width).enumerate().rev() {
            let known: f64 =
                row[k + 1..n].iter().zip(&self.solution[k + 1..]).map(|(a, x)| a * x).sum();
            self.solution[k] = (row[n] - known) / row[k];
        }
        Some(&self.solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_is_that_of_another_elimination() {
        let a = nalgebra::DMatrix::from_row_slice(
            3,
            3,
            &[0.0, 2.0, 1.0, 1.0, -0.5, 0.0, 0.3, 1.0, -1.0],
        );
        let b = nalgebra::DVector::from_vec(vec![1.0, -1.0, 2.0]);
        let exact = a.clone().lu().solve(&b).unwrap();
        let entries = || (0..9).map(|k| (k / 3, k % 3, a[(k / 3, k % 3)]));
        let mut dense = Dense::new(3);
        // twice: nothing of the first elimination is left
        for _ in 0..2 {
            dense.set(entries(), b.iter().copied());
            let found = nalgebra::DVector::from_column_slice(dense.solve().unwrap());
            assert!((found - &exact).amax() < 1e-14);
        }
        dense.set(entries().map(|(row, column, _)| (row, column, 1.0)), b.iter().copied());
        assert!(dense.solve().is_none());
        dense.set(entries().map(|(row, column, x)| (row, column, x * f64::NAN)), b.iter().copied());
        assert!(dense.solve().is_none());
    }
}
