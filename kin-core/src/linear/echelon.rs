//! Computes the rank of a sparse matrix of any shape, and its null spaces on both sides.
//!
//! Gaussian elimination uses sparse pivots as long as good ones remain, then the largest remaining
//! entry. So large mechanisms stay sparse, and complete pivoting finds the last pivots, which
//! decide on the rank. Rows and columns must be scaled to order 1.

/// A pivot below this value usually counts as zero. Rounding ε of C moves q by ε / pivot, and so
/// the pivot by about as much; a pivot of √ε = 1.5e-8 is therefore as large as its error. Solver
/// and diagnosis share this threshold. \[-\]
pub(crate) const RANK: f64 = 1e-7;

/// A sparse pivot is at least this value, and at least [`THRESHOLD`] of the largest entry of its
/// row. \[-\]
const SAFE: f64 = 0.02;
const THRESHOLD: f64 = 0.1;

/// Entries that cancel to less than this value are removed. \[-\]
const CANCELLED: f64 = 1e-15;

/// A vector by its nonzero entries, in increasing order of the indices.
pub(crate) type Sparse = Vec<(usize, f64)>;

/// An eliminated matrix.
#[derive(Clone, Debug)]
pub(crate) struct Echelon {
    /// The pivots in order.
    steps: Vec<Step>,
    /// The rows without a pivot, in increasing order.
    pub free_rows: Vec<usize>,
    /// The columns without a pivot, in increasing order.
    pub free_columns: Vec<usize>,
    /// The smallest accepted pivot; infinite if no pivot was accepted.
    pub smallest: f64,
    /// The largest entry that Kin treated as zero.
    pub left: f64,
    /// The numbers of rows and columns.
    shape: (usize, usize),
}

/// One pivot, with its row at that time and the multipliers of the rows below.
#[derive(Clone, Debug)]
struct Step {
    row: usize,
    column: usize,
    /// The value of the pivot.
    pivot: f64,
    /// The entries of the pivot's row in U, by column.
    upper: Sparse,
    /// The multipliers of the rows below, by row.
    lower: Sparse,
}

impl Echelon {
    /// Eliminates the rows, each given by columns and values; repeated columns add up. Pivots below
    /// `least` count as zero (usually [`RANK`]).
    pub(crate) fn new(rows: Vec<Sparse>, n: usize, least: f64) -> Self {
        Self::of_rank_at_most(rows, n, least, n)
    }

    /// Eliminates the rows with at most `most` pivots, the largest first; all others count as zero.
    pub(crate) fn of_rank_at_most(rows: Vec<Sparse>, n: usize, least: f64, most: usize) -> Self {
        let m = rows.len();
        let mut work = Work::new(rows, n);
        let mut steps = Vec::new();
        while steps.len() < most
            && let Some((row, column)) = work.sparse_pivot()
        {
            steps.push(work.eliminate(row, column));
        }
        let left = loop {
            match work.largest() {
                Some((row, column, size)) if size > least && steps.len() < most => {
                    steps.push(work.eliminate(row, column))
                }
                Some((_, _, size)) => break size,
                None => break 0.0,
            }
        };
        let smallest =
            steps.iter().fold(f64::INFINITY, |least, step: &Step| least.min(step.pivot.abs()));
        let open = |open: &[bool]| (0..open.len()).filter(|k| open[*k]).collect();
        Echelon {
            free_rows: open(&work.open_rows),
            free_columns: open(&work.open_columns),
            steps,
            smallest,
            left,
            shape: (m, n),
        }
    }

    /// Returns the number of independent rows.
    pub(crate) fn rank(&self) -> usize {
        self.steps.len()
    }

    /// Returns the sign of the determinant of a square matrix; + if it is zero.
    pub(crate) fn sign(&self) -> i8 {
        let negative = self.steps.iter().filter(|step| step.pivot < 0.0).count();
        let order = |of: fn(&Step) -> usize| odd(&self.steps.iter().map(of).collect::<Vec<_>>());
        let odd = (negative % 2 == 1) ^ order(|step| step.row) ^ order(|step| step.column);
        if odd && self.free_rows.is_empty() { -1 } else { 1 }
    }

    /// Returns x with A x = 0, one for each free column. Each is 1 in its column and 0 in the other
    /// free columns.
    pub(crate) fn null_space(&self) -> Vec<Sparse> {
        self.space(&self.free_columns, self.shape.1, |step| (step.column, &step.upper, step.pivot))
    }

    /// Returns y with yᵀ A = 0, one for each free row. Each is 1 in its row and 0 in the other free
    /// rows.
    pub(crate) fn left_null_space(&self) -> Vec<Sparse> {
        self.space(&self.free_rows, self.shape.0, |step| (step.row, &step.lower, 1.0))
    }

    fn space(
        &self,
        free: &[usize],
        size: usize,
        of: fn(&Step) -> (usize, &Sparse, f64),
    ) -> Vec<Sparse> {
        let mut x = vec![0.0; size];
        let vector = |free: &usize| {
            x[*free] = 1.0;
            let mut touched = vec![*free];
            for (own, others, pivot) in self.steps.iter().rev().map(of) {
                let sum: f64 = others.iter().map(|(k, value)| value * x[*k]).sum();
                if sum != 0.0 {
                    x[own] = -sum / pivot;
                    touched.push(own);
                }
            }
            taken(&mut x, touched)
        };
        free.iter().map(vector).collect()
    }
}

/// Returns true if a permutation is odd.
fn odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut next = start;
        while let Some(known) = seen.get_mut(next).filter(|known| !**known) {
            *known = true;
            next = permutation[next];
            odd ^= next != start;
        }
    }
    odd
}

/// An entry below this share of the largest one is rounding. \[-\]
const SHARE: f64 = 1e-8;
/// Returns the entries at these indices that exceed rounding, and sets all of them to zero.
fn taken(x: &mut [f64], mut touched: Vec<usize>) -> Sparse {
    touched.sort_unstable();
    let largest = touched.iter().fold(0.0_f64, |m, k| m.max(x[*k].abs()));
    let all = touched.into_iter().map(|k| (k, std::mem::take(&mut x[k])));
    all.filter(|(_, x)| x.abs() > SHARE * largest).collect()
}

/// Returns the entries of a dense vector that exceed rounding.
fn sparse(x: &[f64]) -> Sparse {
    let largest = x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    x.iter().copied().enumerate().filter(|(_, x)| x.abs() > SHARE * largest).collect()
}

/// The part of a matrix that remains to be eliminated.
struct Work {
    rows: Vec<Sparse>,
    /// For each column the rows that have or had an entry in it.
    columns: Vec<Vec<usize>>,
    counts: Vec<usize>,
    open_rows: Vec<bool>,
    open_columns: Vec<bool>,
    /// For each row true if it had no safe pivot when it was examined and has not changed since.
    passed: Vec<bool>,
    /// Open rows by their number of entries; outdated entries are skipped.
    by_length: Vec<Vec<usize>>,
}

impl Work {
    fn new(mut rows: Vec<Sparse>, n: usize) -> Self {
        for row in &mut rows {
            row.sort_by_key(|(column, _)| *column);
            row.dedup_by(|next, kept| {
                let same = next.0 == kept.0;
                kept.1 += if same { next.1 } else { 0.0 };
                same
            });
            row.retain(|(_, value)| value.abs() > CANCELLED);
        }
        let mut columns = vec![Vec::new(); n];
        let mut by_length = vec![Vec::new(); n + 1];
        for (k, row) in rows.iter().enumerate() {
            row.iter().for_each(|(column, _)| columns[*column].push(k));
            by_length[row.len()].push(k);
        }
        let counts = columns.iter().map(Vec::len).collect();
        let m = rows.len();
        Work {
            rows,
            columns,
            counts,
            open_rows: vec![true; m],
            open_columns: vec![true; n],
            passed: vec![false; m],
            by_length,
        }
    }

    /// Returns a safe pivot in the shortest row that has one, and there in the shortest column.
    fn sparse_pivot(&mut self) -> Option<(usize, usize)> {
        for length in 1..self.by_length.len() {
            while let Some(row) = self.by_length[length].pop() {
                if !self.open_rows[row] || self.passed[row] || self.rows[row].len() != length {
                    continue;
                }
                if let Some(column) = self.safe(row) {
                    return Some((row, column));
                }
                self.passed[row] = true;
            }
        }
        None
    }

    fn safe(&self, row: usize) -> Option<usize> {
        let entries = &self.rows[row];
        let largest = entries.iter().fold(0.0_f64, |m, (_, value)| m.max(value.abs()));
        let safe = entries.iter().filter(|(_, value)| value.abs() >= SAFE.max(THRESHOLD * largest));
        safe.min_by_key(|(column, _)| self.counts[*column]).map(|(column, _)| *column)
    }

    /// Returns the largest remaining entry.
    fn largest(&self) -> Option<(usize, usize, f64)> {
        let open = (0..self.rows.len()).filter(|row| self.open_rows[*row]);
        let entries = open.flat_map(|row| {
            self.rows[row].iter().map(move |(column, value)| (row, *column, value.abs()))
        });
        entries.reduce(|best, next| if next.2 > best.2 { next } else { best })
    }

    /// Removes the pivot's row and column, and eliminates the column from all other rows.
    fn eliminate(&mut self, row: usize, column: usize) -> Step {
        let mut upper = std::mem::take(&mut self.rows[row]);
        (self.open_rows[row], self.open_columns[column]) = (false, false);
        upper.iter().for_each(|(column, _)| self.counts[*column] -= 1);
        let at = upper.iter().position(|(known, _)| *known == column).unwrap_or_default();
        let pivot = upper.remove(at).1;
        let mut lower = Vec::new();
        for other in std::mem::take(&mut self.columns[column]) {
            if !self.open_rows[other] {
                continue;
            }
            let Ok(at) = self.rows[other].binary_search_by_key(&column, |(known, _)| *known) else {
                continue;
            };
            let factor = self.rows[other].remove(at).1 / pivot;
            self.subtract(other, factor, &upper);
            lower.push((other, factor));
        }
        Step { row, column, pivot, upper, lower }
    }

    /// Subtracts a multiple: row −= factor · upper.
    fn subtract(&mut self, row: usize, factor: f64, upper: &Sparse) {
        let old = std::mem::take(&mut self.rows[row]);
        let mut new = Vec::with_capacity(old.len() + upper.len());
        let mut a = old.into_iter().peekable();
        let mut b = upper.iter().copied().peekable();
        loop {
            let (column, value, fresh) = match (a.peek().copied(), b.peek().copied()) {
                (Some((i, x)), Some((j, y))) if i == j => (i, x - factor * y, false),
                (Some((i, x)), Some((j, _))) if i < j => (i, x, false),
                (Some((i, x)), None) => (i, x, false),
                (_, Some((j, y))) => (j, -factor * y, true),
                (None, None) => break,
            };
            a.next_if(|(i, _)| *i == column);
            b.next_if(|(j, _)| *j == column);
            let kept = value.abs() > CANCELLED;
            if kept {
                new.push((column, value));
            }
            if fresh && kept {
                self.counts[column] += 1;
                self.columns[column].push(row);
            } else if !fresh && !kept {
                self.counts[column] -= 1;
            }
        }
        self.by_length[new.len()].push(row);
        self.passed[row] = false;
        self.rows[row] = new;
    }
}

/// Returns the basis of the same space in which each vector has an index where it is 1 and the
/// others are 0: the first indices in the order of preference that allow it. So the basis, and the
/// report about it, does not depend on how the space was found. Returns each index with its vector,
/// in the order of preference.
pub(crate) fn reduced(space: Vec<Sparse>, size: usize, order: &[usize]) -> Vec<(usize, Sparse)> {
    /// A larger number of vectors is returned without reduction.
    const LARGEST: usize = 300;
    /// A component below this value is no pivot. \[-\]
    const PIVOT: f64 = 1e-5;
    if space.len() > LARGEST {
        let mut places = vec![usize::MAX; size];
        order.iter().enumerate().for_each(|(place, k)| places[*k] = place);
        let first = |vector: &Sparse| vector.iter().map(|(k, _)| *k).min_by_key(|k| places[*k]);
        return space.into_iter().filter_map(|vector| Some((first(&vector)?, vector))).collect();
    }
    let mut open: Vec<Vec<f64>> = space.iter().map(|vector| dense(vector, size)).collect();
    let mut done: Vec<(usize, Vec<f64>)> = Vec::new();
    for &index in order {
        if open.is_empty() {
            break;
        }
        let share = |x: &Vec<f64>| x[index].abs() / x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let Some(best) =
            (0..open.len()).max_by(|a, b| share(&open[*a]).total_cmp(&share(&open[*b])))
        else {
            break;
        };
        if share(&open[best]).is_nan() || share(&open[best]) < PIVOT {
            continue;
        }
        let mut vector = open.swap_remove(best);
        let scale = vector[index];
        vector.iter_mut().for_each(|x| *x /= scale);
        let others = open.iter_mut().chain(done.iter_mut().map(|(_, other)| other));
        others.for_each(|other| clear(other, &vector, index));
        done.push((index, vector));
    }
    done.into_iter().map(|(index, vector)| (index, sparse(&vector))).collect()
}

/// Computes other −= other[index] · vector, exactly zero at the index.
fn clear(other: &mut [f64], vector: &[f64], index: usize) {
    let factor = other[index];
    if factor != 0.0 {
        other.iter_mut().zip(vector).for_each(|(other, x)| *other -= factor * x);
        other[index] = 0.0;
    }
}

pub(crate) fn dense(vector: &Sparse, size: usize) -> Vec<f64> {
    let mut x = vec![0.0; size];
    vector.iter().for_each(|(k, value)| x[*k] = *value);
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A = B C of inner size r, by rows, every third entry of B and C zero.
    fn product(m: usize, n: usize, r: usize, numbers: &[f64]) -> Vec<Sparse> {
        let number = |k: usize| if k % 3 == 2 { 0.0 } else { numbers[k % numbers.len()] };
        let entry = |i: usize, j: usize| {
            (0..r).map(|k| number(7 * i + 5 * k) * number(11 * j + 3 * k + 1)).sum::<f64>()
        };
        (0..m).map(|i| (0..n).map(|j| (j, entry(i, j))).collect()).collect()
    }

    fn times(rows: &[Sparse], x: &[f64]) -> f64 {
        rows.iter()
            .map(|row| row.iter().map(|(j, value)| value * x[*j]).sum::<f64>().abs())
            .fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn rank_and_null_spaces_are_those_of_singular_values(
            (m, n, r) in (1_usize..14, 1_usize..14, 1_usize..8),
            numbers in prop::collection::vec(-1.0_f64..1.0, 61),
        ) {
            let rows = product(m, n, r, &numbers);
            let matrix = nalgebra::DMatrix::from_fn(m, n, |i, j| rows[i][j].1);
            let values = matrix.clone().singular_values();
            prop_assume!(values.iter().all(|x| *x < 1e-12 || *x > 1e-4));
            let found = Echelon::new(rows.clone(), n, RANK);
            if m == n && found.rank() == n {
                prop_assert_eq!(f64::from(found.sign()), matrix.determinant().signum());
            }
            prop_assert_eq!(found.rank(), values.iter().filter(|x| **x > 1e-4).count());
            for x in found.null_space() {
                prop_assert!(times(&rows, &dense(&x, n)) < 1e-6);
            }
            for y in found.left_null_space() {
                let y = nalgebra::DVector::from_vec(dense(&y, m));
                prop_assert!((matrix.transpose() * y).amax() < 1e-6);
            }
        }
    }

    #[test]
    fn reduced_basis_does_not_depend_on_the_one_given() {
        let a = vec![vec![(0, 1.0), (2, 1.0)], vec![(1, 1.0), (2, -1.0), (3, 2.0)]];
        let b = vec![
            vec![(0, 1.0), (1, 1.0), (3, 2.0)],
            vec![(0, 2.0), (1, -1.0), (2, 3.0), (3, -2.0)],
        ];
        let order = [3, 2, 1, 0];
        let from_a = reduced(a, 4, &order);
        let from_b = reduced(b, 4, &order);
        assert_eq!(from_a.iter().map(|(k, _)| *k).collect::<Vec<_>>(), [3, 2]);
        for ((_, x), (_, y)) in from_a.iter().zip(&from_b) {
            assert!(
                x.iter().zip(y).all(|((i, x), (j, y))| i == j && (x - y).abs() < 1e-14),
                "{x:?} {y:?}"
            );
        }
    }

    #[test]
    fn nothing_is_no_panic() {
        let found = Echelon::new(Vec::new(), 3, RANK);
        assert_eq!((found.rank(), found.null_space().len()), (0, 3));
        assert_eq!(Echelon::new(vec![vec![]; 2], 0, RANK).left_null_space().len(), 2);
    }
}
