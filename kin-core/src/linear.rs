//! The linear solver: a square matrix of fixed pattern comes in as values, solutions go out. Nothing else of Kin eliminates.
//!
//! Dense inside: LU with scaled partial pivoting, in storage that is reused. Each pivot is measured by the largest entries that its row
//! and its column have had so far, lengths in units of the model's own length: so the verdict "singular" does not depend on units (mm, m
//! or km), and a row that fades on the way to a toggle is seen to fade. The measures only choose and judge pivots, they never touch the
//! numbers.

mod rank;

pub(crate) use rank::{Singular, of_rectangle};

/// A pivot below this measure is zero; the rounding of an elimination of moderate size stays below.   \[-\]
const SINGULAR: f64 = 1e-13;

/// Marks a value that stands on a coordinate of the ground, and so in no column.
const DROPPED: usize = usize::MAX;

/// A square matrix of fixed pattern, its factors, and the space to make them in.
pub(crate) struct Linear {
    n: usize,
    /// Place of each value in `a`, or `DROPPED`.
    places: Vec<usize>,
    values: Vec<f64>,
    /// s_j, the characteristic size of unknown j.
    sizes: Vec<f64>,
    /// Row and column of each value.
    entries: Vec<Option<(usize, usize)>>,
    /// max_j |a_ij| s_j of each row, the largest so far.
    norms: Vec<f64>,
    /// max_i |a_ij| s_j / norm_i of each column, the largest so far.
    tops: Vec<f64>,
    /// Columns one after the other; after `factor` L below the diagonal and U from it upwards.
    a: Vec<f64>,
    swaps: Vec<usize>,
    /// The norms in the order of the rows swapped so far.
    ordered: Vec<f64>,
    smallest: f64,
}

impl Linear {
    /// An n × n matrix with one value for each (row, column) of the pattern, in its order; repeated places add up, `None` stands nowhere.
    pub(crate) fn new(n: usize, pattern: impl IntoIterator<Item = Option<(usize, usize)>>) -> Self {
        let entries: Vec<_> = pattern.into_iter().map(|entry| entry.filter(|(row, column)| *row < n && *column < n)).collect();
        let places: Vec<usize> = entries.iter().map(|entry| entry.map_or(DROPPED, |(row, column)| column * n + row)).collect();
        let values = vec![0.0; places.len()];
        Linear {
            n,
            places,
            values,
            sizes: vec![1.0; n],
            entries,
            norms: vec![0.0; n],
            tops: vec![0.0; n],
            a: vec![0.0; n * n],
            swaps: vec![0; n],
            ordered: vec![0.0; n],
            smallest: 0.0,
        }
    }

    /// The characteristic size of each unknown: 1 for an angle, a typical length for a length.
    pub(crate) fn set_sizes(&mut self, sizes: &[f64]) {
        self.sizes.copy_from_slice(sizes);
    }

    /// The values, to be written before [`Linear::factor`].
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The values as last written.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// max_j |a_ij| s_j of each row, the largest since the start or [`Linear::forget`].
    pub(crate) fn norms(&self) -> &[f64] {
        &self.norms
    }

    /// Forgets how large rows and columns have been.
    pub(crate) fn forget(&mut self) {
        self.norms.fill(0.0);
        self.tops.fill(0.0);
    }

    /// Measures rows and columns of the values as written; before [`Linear::factor`].
    pub(crate) fn measure(&mut self) {
        let own = || self.entries.iter().zip(&self.values).filter_map(|(entry, value)| entry.map(|(i, j)| (i, j, value.abs())));
        for (i, j, value) in own() {
            self.norms[i] = self.norms[i].max(value * self.sizes[j]);
        }
        for (i, j, value) in own().filter(|(_, _, value)| *value > 0.0) {
            self.tops[j] = self.tops[j].max(value * self.sizes[j] / self.norms[i]);
        }
    }

    /// The smallest pivot of the last factoring, by the measures of its row and column.   \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.smallest
    }

    /// P A = L U. The values must be finite and measured.
    pub(crate) fn factor(&mut self) -> Result<(), Singular> {
        self.assemble();
        self.ordered.copy_from_slice(&self.norms);
        self.smallest = f64::INFINITY;
        for k in 0..self.n {
            let (pivot, share) = self.pivot(k);
            if share.is_nan() || share <= SINGULAR {
                return Err(self.diagnose());
            }
            self.smallest = self.smallest.min(share);
            self.swap(k, pivot);
            self.eliminate(k);
        }
        Ok(())
    }

    /// A x = b with the factors at hand; `b` becomes x.
    pub(crate) fn solve(&self, b: &mut [f64]) {
        for (k, &pivot) in self.swaps.iter().enumerate() {
            b.swap(k, pivot);
        }
        for (k, column) in self.a.chunks_exact(self.n.max(1)).enumerate() {
            let x = b[k];
            if x != 0.0 {
                subtract(&mut b[k + 1..], x, &column[k + 1..]);
            }
        }
        for (k, column) in self.a.chunks_exact(self.n.max(1)).enumerate().rev() {
            let x = b[k] / column[k];
            b[k] = x;
            if x != 0.0 {
                subtract(&mut b[..k], x, &column[..k]);
            }
        }
    }

    /// Writes the values into the dense matrix.
    fn assemble(&mut self) {
        self.a.fill(0.0);
        for (&place, &value) in self.places.iter().zip(&self.values) {
            if place != DROPPED {
                self.a[place] += value;
            }
        }
    }

    /// The row of the largest entry of column k by its measures, and that.
    fn pivot(&self, k: usize) -> (usize, f64) {
        let column = &self.a[k * self.n..(k + 1) * self.n];
        let unit = self.sizes[k] / self.tops[k];
        let mut best = (k, 0.0);
        for (row, (value, norm)) in column.iter().zip(&self.ordered).enumerate().skip(k) {
            let share = value.abs() * unit / norm;
            if share > best.1 {
                best = (row, share);
            }
        }
        best
    }

    fn swap(&mut self, k: usize, pivot: usize) {
        self.swaps[k] = pivot;
        if pivot != k {
            self.ordered.swap(k, pivot);
            self.a.chunks_exact_mut(self.n).for_each(|column| column.swap(k, pivot));
        }
    }

    /// Column k of L, then a_ij −= l_ik u_kj on what is left.
    fn eliminate(&mut self, k: usize) {
        let (done, rest) = self.a.split_at_mut((k + 1) * self.n);
        let column = &mut done[k * self.n..];
        let reciprocal = 1.0 / column[k];
        column[k + 1..].iter_mut().for_each(|l| *l *= reciprocal);
        for other in rest.chunks_exact_mut(self.n) {
            let u = other[k];
            if u != 0.0 {
                subtract(&mut other[k + 1..], u, &column[k + 1..]);
            }
        }
    }

    /// Rank and dependencies of the values as last written. Slow; for a message.
    pub(crate) fn diagnose(&mut self) -> Singular {
        self.assemble();
        let mut scaled = self.a.clone();
        for (column, (size, top)) in scaled.chunks_exact_mut(self.n.max(1)).zip(self.sizes.iter().zip(&self.tops)) {
            for (value, norm) in column.iter_mut().zip(&self.norms) {
                let measure = norm * top;
                *value = if measure > 0.0 { *value * size / measure } else { 0.0 };
            }
        }
        rank::dependencies(scaled, self.n)
    }
}

/// y −= x · column
fn subtract(y: &mut [f64], x: f64, column: &[f64]) {
    for (y, l) in y.iter_mut().zip(column) {
        *y -= x * l;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dense(n: usize, rows: &[f64]) -> Linear {
        let mut linear = Linear::new(n, (0..n * n).map(|k| Some((k / n, k % n))));
        linear.values_mut().copy_from_slice(rows);
        linear
    }

    #[test]
    fn solution_satisfies_the_equations() {
        let rows = [0.0, 2.0, 1.0, 1.0, 1e-3, 4.0, -3.0, 1.0, 0.5];
        let mut linear = dense(3, &rows);
        linear.measure();
        linear.factor().unwrap();
        let mut x = [1.0, -2.0, 0.25];
        linear.solve(&mut x);
        for (row, b) in rows.chunks(3).zip([1.0, -2.0, 0.25]) {
            let ax: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            assert!((ax - b).abs() < 1e-14, "{ax} {b}");
        }
    }

    #[test]
    fn repeated_places_add_and_the_grounds_are_dropped() {
        let mut linear = Linear::new(1, [Some((0, 0)), None, Some((0, 0))]);
        linear.values_mut().copy_from_slice(&[1.5, 100.0, 0.5]);
        linear.measure();
        linear.factor().unwrap();
        let mut x = [4.0];
        linear.solve(&mut x);
        assert_eq!(x, [2.0]);
    }

    #[test]
    fn verdict_does_not_depend_on_units() {
        // Lengths in units of `u` metres, rows of length too.
        for u in [1e-3, 1.0, 1e3, 1e9] {
            let mut good = dense(2, &[1.0, 0.3 / u, 0.0, 1e-9]);
            good.set_sizes(&[0.5 / u, 1.0]);
            good.measure();
            assert!(good.factor().is_ok());
            let mut bad = dense(2, &[1.0, 0.3 / u, 2.0, 0.6 / u]);
            bad.set_sizes(&[0.5 / u, 1.0]);
            bad.measure();
            assert_eq!(bad.factor().unwrap_err().rank, 1);
        }
    }

    #[test]
    fn row_that_fades_is_seen_to_fade() {
        let mut linear = dense(2, &[-1.0, -1.0, 1.0, 0.0]);
        linear.measure();
        linear.factor().unwrap();
        assert!(linear.smallest_pivot() > 0.9);
        linear.values_mut()[2] = 1e-8;
        linear.measure();
        linear.factor().unwrap();
        assert!(linear.smallest_pivot() < 2e-8);
        linear.forget();
        linear.measure();
        linear.factor().unwrap();
        assert!(linear.smallest_pivot() > 0.9);
    }

    #[test]
    fn nothing_is_singular_about_no_coordinates() {
        let mut linear = Linear::new(0, []);
        assert!(linear.factor().is_ok());
        linear.solve(&mut []);
    }
}
