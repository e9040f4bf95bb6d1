//! Solves more equations than unknowns that agree with one another.
//!
//! Kin solves as many independent equations as unknowns and checks the other equations.

use std::collections::BTreeMap;

use super::{Echelon, Linear, RANK, Sparse};

/// Rows are chosen again if the smallest pivot of those in use fades to this share of its largest
/// value. \[-\]
const FADED: f64 = 0.3;

/// If a row has a larger factor than this in the sum that represents an omitted row, the omitted
/// row replaces it. \[-\]
const LARGER: f64 = 1.5;

/// Solves A x = b for an m × n matrix of rank n whose equations agree, with rows and columns of
/// order 1.
///
/// The redundant equations change along a motion. So rows with a large determinant are chosen, and
/// chosen again before those in use become dependent. This costs half as much as least squares
/// ([`super::LeastSquares`]), which contradictory equations need.
#[derive(Clone)]
pub(crate) struct Independent {
    /// The number of rows.
    m: usize,
    /// The number of columns.
    n: usize,
    /// The row and column of each value; `None` belongs to no entry.
    places: Vec<Option<(usize, usize)>>,
    /// The present values, in the order of the places.
    values: Vec<f64>,
    /// The chosen rows; `None` before the first factoring.
    chosen: Option<Chosen>,
}

/// The rows that are solved.
#[derive(Clone)]
struct Chosen {
    rows: Vec<usize>,
    /// The indices of the values in these rows.
    inside: Vec<usize>,
    /// The values in other rows, as (row, column, index).
    others: Vec<(usize, usize, usize)>,
    linear: Linear,
    /// The largest value of the smallest pivot.
    best: f64,
}

impl Independent {
    /// Creates a matrix with one value for each place; `None` belongs to no entry, and repeated
    /// places add up.
    pub(crate) fn new(m: usize, n: usize, places: &[Option<(usize, usize)>]) -> Self {
        Independent { m, n, places: places.to_vec(), values: vec![0.0; places.len()], chosen: None }
    }

    /// Factors A with these values, in the order of the places. Returns false if their rank is
    /// below n.
    pub(crate) fn factor(&mut self, values: impl Iterator<Item = f64>) -> bool {
        self.values.iter_mut().zip(values).for_each(|(place, value)| *place = value);
        self.chosen.as_mut().is_some_and(|chosen| chosen.factor(&self.values)) || self.choose()
    }

    /// Chooses rows from the present values.
    #[cold]
    fn choose(&mut self) -> bool {
        let mut rows = vec![Sparse::new(); self.m];
        for ((row, column), value) in self
            .places
            .iter()
            .zip(&self.values)
            .filter_map(|(place, value)| Some(((*place)?, *value)))
        {
            rows[row].push((column, value));
        }
        let echelon = Echelon::new(rows, self.n, RANK);
        if echelon.rank() < self.n {
            return false;
        }
        let free = exchanged(&echelon);
        let chosen: Vec<usize> = (0..self.m).filter(|row| !free.contains_key(row)).collect();
        self.chosen.insert(Chosen::new(self.n, chosen, &self.places)).factor(&self.values)
    }

    /// Returns the rows in use, in increasing order; empty before the first factoring.
    pub(crate) fn rows(&self) -> &[usize] {
        self.chosen.as_ref().map_or(&[], |chosen| &chosen.rows)
    }

    /// Returns the smallest pivot of the last factoring. \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.chosen.as_ref().map_or(0.0, |chosen| chosen.linear.smallest_pivot())
    }

    /// Returns x for the right side b of length m.
    pub(crate) fn solve(&mut self, b: &[f64]) -> &[f64] {
        let Some(Chosen { rows, linear, .. }) = &mut self.chosen else { return &[] };
        linear.rhs_mut().iter_mut().zip(rows).for_each(|(place, row)| *place = b[*row]);
        linear.solve();
        linear.solution()
    }

    /// Returns y with Aᵀ y = b that is zero in the omitted rows.
    pub(crate) fn solved_transposed(&self, b: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.m];
        if let Some(Chosen { rows, linear, .. }) = &self.chosen {
            rows.iter().zip(linear.solved_transposed(b)).for_each(|(row, value)| y[*row] = value);
        }
        y
    }

    /// Writes b − A x of the last solution, row by row, into `left`, which contains b.
    pub(crate) fn leave(&self, left: &mut [f64]) {
        let Some(Chosen { rows, linear, others, .. }) = &self.chosen else { return };
        let x = linear.solution();
        rows.iter().for_each(|row| left[*row] = 0.0);
        others
            .iter()
            .for_each(|(row, column, value)| left[*row] -= self.values[*value] * x[*column]);
    }
}

/// Returns the omitted rows, each as a sum of the others. At first they are those of the
/// elimination. Then an omitted row replaces a row of its sum as long as this increases the
/// determinant of the remaining ones.
fn exchanged(echelon: &Echelon) -> BTreeMap<usize, BTreeMap<usize, f64>> {
    let sums = echelon.free_rows.iter().zip(echelon.left_null_space()).map(|(free, vector)| {
        let others =
            vector.into_iter().filter(|(row, _)| row != free).map(|(row, factor)| (row, -factor));
        (*free, others.collect())
    });
    let mut sums: BTreeMap<usize, BTreeMap<usize, f64>> = sums.collect();
    // Each exchange multiplies the determinant, which has an upper bound.
    for _ in 0..16 * sums.len() {
        let all = sums.iter().flat_map(|(free, sum)| {
            sum.iter().map(move |(row, factor)| (*free, *row, factor.abs()))
        });
        match all.max_by(|a, b| a.2.total_cmp(&b.2)).filter(|(_, _, factor)| *factor > LARGER) {
            Some((free, row, _)) => exchange(&mut sums, free, row),
            None => break,
        }
    }
    sums
}

/// Exchanges an omitted row with one of its sum.
fn exchange(sums: &mut BTreeMap<usize, BTreeMap<usize, f64>>, free: usize, row: usize) {
    let Some(mut sum) = sums.remove(&free) else { return };
    let Some(factor) = sum.remove(&row) else { return };
    // row = (free − the rest of the sum) / factor
    let mut instead: BTreeMap<usize, f64> =
        sum.into_iter().map(|(other, share)| (other, -share / factor)).collect();
    instead.insert(free, factor.recip());
    for sum in sums.values_mut() {
        if let Some(share) = sum.remove(&row) {
            instead
                .iter()
                .for_each(|(other, part)| *sum.entry(*other).or_insert(0.0) += share * part);
        }
    }
    sums.insert(row, instead);
}

impl Chosen {
    fn new(n: usize, rows: Vec<usize>, places: &[Option<(usize, usize)>]) -> Self {
        let mut inside = Vec::new();
        let mut pattern = Vec::new();
        let mut others = Vec::new();
        for (number, (row, column)) in
            places.iter().enumerate().filter_map(|(number, place)| Some((number, (*place)?)))
        {
            match rows.binary_search(&row) {
                Ok(row) => {
                    inside.push(number);
                    pattern.push(Some((row, column)));
                }
                Err(_) => others.push((row, column, number)),
            }
        }
        let constants = vec![None; pattern.len()];
        Chosen { rows, inside, others, linear: Linear::new(n, pattern, &constants), best: 0.0 }
    }

    /// Factors the rows. Returns false if they have faded.
    fn factor(&mut self, values: &[f64]) -> bool {
        let linear = &mut self.linear;
        linear
            .values_mut()
            .iter_mut()
            .zip(&self.inside)
            .for_each(|(place, number)| *place = values[*number]);
        if !(linear.measure() && linear.factor()) {
            return false;
        }
        let pivot = linear.smallest_pivot();
        self.best = self.best.max(pivot);
        pivot >= FADED * self.best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows (cos s, sin s), (−sin s, cos s) and their sum: any two of them will do, and each is the
    /// one to leave out somewhere.
    fn turned(s: f64) -> ([f64; 6], [f64; 3]) {
        let (sin, cos) = s.sin_cos();
        let x = [0.3, -2.0];
        let rows = [[cos, sin], [0.1 - sin, cos], [cos + 0.1 - sin, sin + cos]];
        (rows.as_flattened().try_into().unwrap(), rows.map(|[a, b]| a * x[0] + b * x[1]))
    }

    #[test]
    fn equations_that_agree_are_solved_whichever_are_superfluous() {
        let places: Vec<_> = (0..6).map(|k| Some((k / 2, k % 2))).collect();
        let mut independent = Independent::new(3, 2, &places);
        for k in 0..200 {
            let (a, b) = turned(0.1 * f64::from(k));
            assert!(independent.factor(a.iter().copied()));
            assert!(independent.smallest_pivot() > 0.1);
            let x = independent.solve(&b);
            assert!((x[0] - 0.3).abs() < 1e-14 && (x[1] + 2.0).abs() < 1e-14, "{x:?}");
            let mut left = b;
            independent.leave(&mut left);
            assert!(left.iter().all(|left| left.abs() < 1e-14), "{left:?}");
        }
    }

    #[test]
    fn equations_that_do_not_agree_are_seen() {
        let places: Vec<_> = (0..6).map(|k| Some((k / 2, k % 2))).collect();
        let mut independent = Independent::new(3, 2, &places);
        let (a, mut b) = turned(0.4);
        assert!(independent.factor(a.iter().copied()));
        b[2] += 1e-3;
        independent.solve(&b);
        independent.leave(&mut b);
        assert!(b.iter().fold(0.0_f64, |m, left| m.max(left.abs())) > 3e-4);
    }

    #[test]
    fn too_few_independent_rows_are_told() {
        let places: Vec<_> = (0..6).map(|k| Some((k / 2, k % 2))).collect();
        assert!(
            !Independent::new(3, 2, &places).factor([1.0, 2.0, 2.0, 4.0, -0.5, -1.0].into_iter())
        );
    }
}
