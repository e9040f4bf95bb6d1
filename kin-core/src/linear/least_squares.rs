//! Solves any number of equations for n unknowns by least squares, with the recorded elimination.

use super::Linear;

/// Minimises |A x − b|² + λ |x|² by \[I, A; Aᵀ, −λ I\] (r, x) = (b, 0), which does not square the
/// condition of A.
///
/// Rows and columns of A should be of order 1. With λ = 0 the columns must be independent.
#[derive(Clone)]
pub(crate) struct LeastSquares {
    m: usize,
    n: usize,
    linear: Linear,
}

impl LeastSquares {
    /// Creates an m × n matrix with one value for each place; `None` belongs to no entry, and
    /// repeated places add up.
    pub(crate) fn new(m: usize, n: usize, places: &[Option<(usize, usize)>]) -> Self {
        let identity = (0..m).map(|i| Some((i, i)));
        let damping = (0..n).map(|j| Some((m + j, m + j)));
        let upper = places.iter().map(|place| place.map(|(row, column)| (row, m + column)));
        let lower = places.iter().map(|place| place.map(|(row, column)| (m + column, row)));
        LeastSquares {
            m,
            n,
            linear: Linear::new(
                m + n,
                identity.chain(damping).chain(upper).chain(lower),
                &vec![Some(1.0); m],
            ),
        }
    }

    /// Factors A with these values, in the order of the places, and λ. Returns false if the matrix
    /// is singular.
    pub(crate) fn factor(&mut self, values: impl Iterator<Item = f64>, damping: f64) -> bool {
        self.linear.forget();
        self.factor_again(values, damping)
    }

    /// Factors A with values near the last ones: it tries the recorded elimination first.
    pub(crate) fn factor_again(&mut self, values: impl Iterator<Item = f64>, damping: f64) -> bool {
        let (identity, rest) = self.linear.values_mut().split_at_mut(self.m);
        let (below, places) = rest.split_at_mut(self.n);
        identity.fill(1.0);
        below.fill(-damping);
        let (upper, lower) = places.split_at_mut(places.len() / 2);
        upper
            .iter_mut()
            .zip(lower)
            .zip(values)
            .for_each(|((upper, lower), value)| (*upper, *lower) = (value, value));
        self.linear.measure();
        self.linear.factor()
    }

    /// Returns the smallest pivot of the last factoring. \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.linear.smallest_pivot()
    }

    /// Returns x for the right side b of length m.
    pub(crate) fn solve(&mut self, b: impl Iterator<Item = f64>) -> &[f64] {
        self.linear.rhs_mut().fill(0.0);
        self.linear.rhs_mut()[..self.m].iter_mut().zip(b).for_each(|(place, b)| *place = b);
        self.linear.solve();
        &self.linear.solution()[self.m..]
    }

    /// Writes b − A x of the last solution, row by row.
    pub(crate) fn leave(&self, left: &mut [f64]) {
        left.copy_from_slice(&self.linear.solution()[..self.m]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_is_that_of_the_normal_equations() {
        let a = nalgebra::DMatrix::from_row_slice(4, 2, &[1.0, 2.0, 0.0, 1.0, 1.0, 0.0, 0.5, -1.0]);
        let b = nalgebra::DVector::from_vec(vec![1.0, -1.0, 2.0, 0.25]);
        let places: Vec<_> = (0..8).map(|k| Some((k / 2, k % 2))).collect();
        let mut least_squares = LeastSquares::new(4, 2, &places);
        for damping in [0.0, 0.5] {
            assert!(least_squares.factor((0..8).map(|k| a[(k / 2, k % 2)]), damping));
            let x = nalgebra::DVector::from_column_slice(least_squares.solve(b.iter().copied()));
            let normal = (a.transpose() * &a + nalgebra::DMatrix::identity(2, 2) * damping)
                .lu()
                .solve(&(a.transpose() * &b))
                .unwrap();
            assert!((x - normal).amax() < 1e-14);
        }
    }
}
