//! Why a matrix is singular: its rank, which unknowns are left free and which rows depend on one another.

/// Rank and dependencies of a singular matrix.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Singular {
    /// Number of independent rows.
    pub rank: usize,
    /// The largest pivot that counted as zero, relative to the largest entry of its row.   \[-\]
    pub pivot: f64,
    /// Unknowns that move in the null space.
    pub columns: Vec<usize>,
    /// Rows with a share in some vanishing combination.
    pub rows: Vec<usize>,
}

/// A complete pivot below this counts as zero in the rank.   \[-\]
const RANK: f64 = 1e-10;

/// A share of the null space below this is rounding.   \[-\]
const SHARE: f64 = 1e-6;

/// Gaussian elimination with complete pivoting of the n × n matrix `a` (columns one after the other, rows and columns scaled to order 1).
/// The rank is at most n − 1: this is asked only where a solver has found no pivot.
pub(super) fn dependencies(a: Vec<f64>, n: usize) -> Singular {
    let mut work = Elimination { a, n, rows: (0..n).collect(), columns: (0..n).collect() };
    let mut rank = 0;
    let mut pivot = work.largest(0).2;
    while rank + 1 < n && pivot > RANK {
        let (row, column, _) = work.largest(rank);
        work.step(rank, row, column);
        rank += 1;
        pivot = work.largest(rank).2;
    }
    Singular { rank, pivot, columns: work.free(rank), rows: work.dependent(rank) }
}

struct Elimination {
    a: Vec<f64>,
    n: usize,
    /// Original number of each row and column.
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Elimination {
    fn at(&self, row: usize, column: usize) -> f64 {
        self.a[column * self.n + row]
    }

    /// Row, column and size of the largest entry of what is left after `k` steps.
    fn largest(&self, k: usize) -> (usize, usize, f64) {
        let mut best = (k, k, 0.0);
        for column in k..self.n {
            for row in k..self.n {
                let size = self.at(row, column).abs();
                if size > best.2 {
                    best = (row, column, size);
                }
            }
        }
        best
    }

    fn step(&mut self, k: usize, row: usize, column: usize) {
        let n = self.n;
        self.rows.swap(k, row);
        self.columns.swap(k, column);
        (0..n).for_each(|j| self.a.swap(j * n + k, j * n + row));
        (0..n).for_each(|i| self.a.swap(k * n + i, column * n + i));
        for i in k + 1..n {
            let l = self.at(i, k) / self.at(k, k);
            self.a[k * n + i] = l;
            for j in k + 1..n {
                self.a[j * n + i] -= l * self.a[j * n + k];
            }
        }
    }

    /// Unknowns with a share in the null space: x_free = 1, U x = −u_free.
    fn free(&self, rank: usize) -> Vec<usize> {
        let mut share = vec![0.0_f64; self.n];
        for free in rank..self.n {
            let mut x: Vec<f64> = (0..rank).map(|i| -self.at(i, free)).collect();
            for k in (0..rank).rev() {
                x[k] /= self.at(k, k);
                for i in 0..k {
                    x[i] -= self.at(i, k) * x[k];
                }
            }
            x.resize(free, 0.0);
            x.push(1.0);
            add_shares(&mut share, &x);
        }
        named(&share, &self.columns)
    }

    /// Rows with a share in a vanishing combination: y_d = 1, Lᵀ y = −l_d.
    fn dependent(&self, rank: usize) -> Vec<usize> {
        let mut share = vec![0.0_f64; self.n];
        for dependent in rank..self.n {
            let mut y: Vec<f64> = (0..rank).map(|k| -self.at(dependent, k)).collect();
            for k in (0..rank).rev() {
                for i in k + 1..rank {
                    y[k] -= self.at(i, k) * y[i];
                }
            }
            y.resize(dependent, 0.0);
            y.push(1.0);
            add_shares(&mut share, &y);
        }
        named(&share, &self.rows)
    }
}

/// Raises the share of each number to what it is of the largest in a vector.
pub(super) fn add_shares(share: &mut [f64], vector: &[f64]) {
    let largest = vector.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (share, x) in share.iter_mut().zip(vector) {
        *share = share.max(x.abs() / largest);
    }
}

/// The numbers with a share.
pub(super) fn shared(share: &[f64]) -> Vec<usize> {
    (0..share.len()).filter(|k| share[*k] > SHARE).collect()
}

/// The names of the numbers with a share, sorted.
fn named(share: &[f64], names: &[usize]) -> Vec<usize> {
    let mut all: Vec<usize> = shared(share).into_iter().map(|k| names[k]).collect();
    all.sort_unstable();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_rows<const N: usize>(rows: [[f64; N]; N]) -> Singular {
        dependencies((0..N * N).map(|k| rows[k % N][k / N]).collect(), N)
    }

    #[test]
    fn dependent_rows_and_free_columns_are_found() {
        // Row 2 = row 0 + 2 row 1; the null space is (−2, 1, 0, 0)ᵀ.
        let found = of_rows([[1.0, 2.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [1.0, 2.0, 2.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
        assert_eq!(found.rank, 3);
        assert_eq!(found.columns, [0, 1]);
        assert_eq!(found.rows, [0, 1, 2]);
        assert!(found.pivot < 1e-15);
    }

    #[test]
    fn zero_matrix_has_rank_zero() {
        let found = of_rows([[0.0; 2]; 2]);
        assert_eq!((found.rank, found.columns, found.rows), (0, vec![0, 1], vec![0, 1]));
    }

    #[test]
    fn empty_matrix_is_no_panic() {
        assert_eq!(dependencies(Vec::new(), 0).rank, 0);
    }
}
