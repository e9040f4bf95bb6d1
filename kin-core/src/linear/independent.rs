//! More equations than unknowns that agree with one another: as many independent ones are solved,
//! the others are met or they are not.

use std::collections::BTreeMap;

use super::{Echelon, Linear, RANK, Sparse};

/// Rows are chosen anew where the smallest pivot of those in use has faded to this share of what it
/// has been.   \[-\]
const FADED: f64 = 0.3;

/// A row that is this many times another one in the sum that makes it takes its place.   \[-\]
const LARGER: f64 = 1.5;

/// A x = b for an m × n matrix of rank n whose equations agree, rows and columns of order 1.
///
/// Which equations are superfluous changes on the way: rows are chosen whose determinant is large,
/// and chosen anew before those in use become dependent. Half the work of least squares
/// ([`super::LeastSquares`]), which equations that contradict one another need.
#[derive(Clone)]
pub(crate) struct Independent {
    m: usize,
    n: usize,
    places: Vec<Option<(usize, usize)>>,
    /// The values in hand, in the order of the places.
    values: Vec<f64>,
    chosen: Option<Chosen>,
}

/// Rows that are solved.
#[derive(Clone)]
struct Chosen {
    rows: Vec<usize>,
    /// Numbers of the values in these rows; and row, column and number of those in others.
    inside: Vec<usize>,
    others: Vec<(usize, usize, usize)>,
    linear: Linear,
    /// The largest that the smallest pivot has been.
    best: f64,
}

impl Independent {
    /// One value for each place; `None` stands nowhere, repeated places add up.
    pub(crate) fn new(m: usize, n: usize, places: &[Option<(usize, usize)>]) -> Self {
        Independent { m, n, places: places.to_vec(), values: vec![0.0; places.len()], chosen: None }
    }

    /// Takes the values, in the order of the places; false if their rank is below n.
    pub(crate) fn factor(&mut self, values: impl Iterator<Item = f64>) -> bool {
        self.values.iter_mut().zip(values).for_each(|(place, value)| *place = value);
        self.chosen.as_mut().is_some_and(|chosen| chosen.factor(&self.values)) || self.choose()
    }

    /// Chooses rows by the values in hand.
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

    /// The rows in use, in increasing order; none before the first factoring.
    pub(crate) fn rows(&self) -> &[usize] {
        self.chosen.as_ref().map_or(&[], |chosen| &chosen.rows)
    }

    /// The smallest pivot of the last factoring.   \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.chosen.as_ref().map_or(0.0, |chosen| chosen.linear.smallest_pivot())
    }

    /// x for the right side b, of length m.
    pub(crate) fn solve(&mut self, b: &[f64]) -> &[f64] {
        let Some(Chosen { rows, linear, .. }) = &mut self.chosen else { return &[] };
        linear.rhs_mut().iter_mut().zip(rows).for_each(|(place, row)| *place = b[*row]);
        linear.solve();
        linear.solution()
    }

    /// The y with Aᵀ y = b that is zero in the rows that are left out.
    pub(crate) fn solved_transposed(&self, b: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.m];
        if let Some(Chosen { rows, linear, .. }) = &self.chosen {
            rows.iter().zip(linear.solved_transposed(b)).for_each(|(row, value)| y[*row] = value);
        }
        y
    }

    /// b − A x of the last solution, row by row, into `left`, which holds b.
    pub(crate) fn leave(&self, left: &mut [f64]) {
        let Some(Chosen { rows, linear, others, .. }) = &self.chosen else { return };
        let x = linear.solution();
        rows.iter().for_each(|row| left[*row] = 0.0);
        others
            .iter()
            .for_each(|(row, column, value)| left[*row] -= self.values[*value] * x[*column]);
    }
}

/// The rows that are left out, each with the sum of the others that it is: first as the elimination
/// has left them, then exchanged with a row of their sum as long as that makes the determinant of
/// those that stay larger.
fn exchanged(echelon: &Echelon) -> BTreeMap<usize, BTreeMap<usize, f64>> {
    let sums = echelon.free_rows.iter().zip(echelon.left_null_space()).map(|(free, vector)| {
        let others =
            vector.into_iter().filter(|(row, _)| row != free).map(|(row, factor)| (row, -factor));
        (*free, others.collect())
    });
    let mut sums: BTreeMap<usize, BTreeMap<usize, f64>> = sums.collect();
    // Each exchange multiplies the determinant, whose largest value is bounded.
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

/// A row that was left out takes the place of one that is in its sum.
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

    /// Factors the rows; false if they have faded.
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
