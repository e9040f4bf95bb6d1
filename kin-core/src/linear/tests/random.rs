//! Thousands of random sparse systems against their singular values.

use nalgebra::DMatrix;

use super::*;
use crate::numbers::random::Random;

impl Random {
    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn permutation(&mut self, n: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..n).collect();
        (1..n).for_each(|k| all.swap(k, self.below(k + 1)));
        all
    }
}

/// How a random system is made awkward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Plain,
    /// Nothing on the diagonal.
    Hollow,
    /// Triangular but for its order.
    Permuted,
    /// Rows and columns of sizes 1e-8 to 1e8.
    Scaled,
    /// One row is made of others.
    Dependent,
    /// One row is almost made of others.
    NearlyDependent,
    /// One column is empty.
    Empty,
    /// Two columns have all their cells in one row.
    Structural,
}

const KINDS: [Kind; 8] = [
    Kind::Plain,
    Kind::Hollow,
    Kind::Permuted,
    Kind::Scaled,
    Kind::Dependent,
    Kind::NearlyDependent,
    Kind::Empty,
    Kind::Structural,
];

pub(super) struct Sparse {
    pub n: usize,
    pub entries: Vec<(usize, usize)>,
    pub values: Vec<f64>,
    pub constants: Vec<Option<f64>>,
}

impl Sparse {
    pub(super) fn random(n: usize, kind: Kind, random: &mut Random) -> Sparse {
        let rows = random.permutation(n);
        let mut a = Sparse { n, entries: Vec::new(), values: Vec::new(), constants: Vec::new() };
        let shift = usize::from(kind == Kind::Hollow);
        for (k, row) in rows.iter().enumerate() {
            a.add(*row, (k + shift) % n, random);
        }
        let extra = if n == 1 { 0 } else { n * (1 + random.below(3)) };
        for _ in 0..extra {
            let i = random.below(n);
            let j = random.below(n);
            match kind {
                Kind::Hollow if i == j => {}
                Kind::Permuted => a.add(rows[i.min(j)], i.max(j), random),
                _ => a.add(rows[i], j, random),
            }
        }
        a.spoil(kind, random);
        a
    }

    fn add(&mut self, row: usize, column: usize, random: &mut Random) {
        let constant = (random.below(3) == 0).then(|| [1.0, -1.0, 1.0, -1.0, 0.5][random.below(5)]);
        self.entries.push((row, column));
        self.values.push(constant.unwrap_or_else(|| random.number()));
        self.constants.push(constant);
    }

    fn spoil(&mut self, kind: Kind, random: &mut Random) {
        let n = self.n;
        match kind {
            Kind::Scaled => {
                let sizes: Vec<f64> =
                    (0..2 * n).map(|_| 10.0_f64.powf(8.0 * random.number())).collect();
                self.constants.fill(None);
                self.values
                    .iter_mut()
                    .zip(&self.entries)
                    .for_each(|(value, (i, j))| *value *= sizes[*i] * sizes[n + j]);
            }
            Kind::Dependent | Kind::NearlyDependent if n > 2 => {
                let [row, a, b] = [0, 1, 2].map(|k| k * (n / 3));
                let small = if kind == Kind::NearlyDependent {
                    10.0_f64.powf(-7.0 + 7.0 * random.number())
                } else {
                    0.0
                };
                let mut old = std::mem::take(&mut self.entries)
                    .into_iter()
                    .zip(std::mem::take(&mut self.values))
                    .collect::<Vec<_>>();
                old.retain(|((i, _), _)| *i != row);
                let copies: Vec<_> = old
                    .iter()
                    .filter(|((i, _), _)| *i == a || *i == b)
                    .map(|((i, j), v)| ((row, *j), if *i == a { *v } else { -0.7 * v }))
                    .collect();
                old.extend(copies);
                old.push(((row, random.below(n)), small));
                (self.entries, self.values) = old.into_iter().unzip();
                self.constants = vec![None; self.values.len()];
            }
            Kind::Empty => self
                .values
                .iter_mut()
                .zip(&self.entries)
                .zip(&mut self.constants)
                .filter(|((_, (_, j)), _)| *j == n / 2)
                .for_each(|((value, _), constant)| {
                    (*value, *constant) = (0.0, None);
                }),
            Kind::Structural if n > 2 => {
                let kept = |(i, j): &(usize, usize)| *i == 0 || (*j != 1 && *j != 2);
                for k in (0..self.entries.len())
                    .rev()
                    .filter(|k| !kept(&self.entries[*k]))
                    .collect::<Vec<_>>()
                {
                    self.entries.swap_remove(k);
                    self.values.swap_remove(k);
                    self.constants.swap_remove(k);
                }
            }
            _ => {}
        }
    }

    pub(super) fn linear(&self) -> Linear {
        Linear::new(self.n, self.entries.iter().copied().map(Some), &self.constants)
    }

    fn dense(&self) -> DMatrix<f64> {
        let mut a = DMatrix::zeros(self.n, self.n);
        self.entries.iter().zip(&self.values).for_each(|(place, value)| a[*place] += value);
        a
    }

    /// |b − A x| / (|A| |x| + |b|) in largest norms, rows and columns by the measures of the
    /// solver.
    fn backward_error(&self, linear: &Linear, x: &[f64], b: &[f64]) -> f64 {
        let mut r: Vec<f64> =
            b.iter().zip(linear.row_units.iter()).map(|(b, unit)| b * unit).collect();
        let largest =
            |all: &[f64]| all.iter().fold(0.0_f64, |m, x| if x.abs() <= m { m } else { x.abs() });
        let b_norm = largest(&r);
        let mut rows = vec![0.0; self.n];
        let x: Vec<f64> = x.iter().zip(&linear.column_units).map(|(x, unit)| x / unit).collect();
        for (&(i, j), value) in self.entries.iter().zip(&self.values) {
            let value = value * linear.row_units[i] * linear.column_units[j];
            r[i] -= value * x[j];
            rows[i] += value.abs();
        }
        largest(&r) / (largest(&rows) * largest(&x) + b_norm)
    }
}

/// The condition number of a matrix with rows, then columns scaled to order 1.
fn condition(mut a: DMatrix<f64>) -> f64 {
    let largest = |m: f64, x: &f64| m.max(x.abs());
    for mut row in a.row_iter_mut() {
        let top = row.iter().fold(0.0, largest);
        row /= if top > 0.0 { top } else { 1.0 };
    }
    for mut column in a.column_iter_mut() {
        let top = column.iter().fold(0.0, largest);
        column /= if top > 0.0 { top } else { 1.0 };
    }
    let values = a.singular_values();
    if values.max() == 0.0 { f64::INFINITY } else { values.max() / values.min() }
}

/// Solves, and checks what must hold; what happened.
fn check(a: &Sparse, linear: &mut Linear, random: &mut Random, what: &str) -> bool {
    linear.values_mut().copy_from_slice(&a.values);
    linear.forget();
    assert!(linear.measure());
    let condition = condition(a.dense());
    if !linear.factor() {
        assert!(condition > 1e12, "{what}: called singular at condition {condition:.1e}");
        return false;
    }
    assert!(
        condition < 1e15,
        "{what}: condition {condition:.1e} not seen, estimated {:.1e}",
        linear.condition()
    );
    let b: Vec<f64> = (0..a.n).map(|_| random.number()).collect();
    let x = solve(linear, &b);
    let error = a.backward_error(linear, &x, &b);
    assert!(
        condition > 1e12 || error <= 1e-12,
        "{what}: backward error {error:.1e}, condition {condition:.1e}"
    );
    true
}

/// Systems of all kinds, one in `rare` of them with up to 300 unknowns.
fn check_many(cases: usize, rare: usize) {
    let random = &mut Random::new(20_261_121);
    let mut counts = [0; 2];
    for case in 0..cases {
        let kind = KINDS[case % KINDS.len()];
        let n = if case % rare < KINDS.len() && case >= rare {
            100 + random.below(201)
        } else {
            1 + random.below(24)
        };
        let mut a = Sparse::random(n, kind, random);
        let mut linear = a.linear();
        let what = format!("case {case}, n = {n}, {kind:?}");
        counts[usize::from(check(&a, &mut linear, random, &what))] += 1;
        // The same pattern with numbers near these, by the same recording if it will do; then with
        // any.
        for (value, constant) in a.values.iter_mut().zip(&a.constants) {
            *value = constant.unwrap_or(*value * (1.0 + 0.3 * random.number()));
        }
        counts[usize::from(check(&a, &mut linear, random, &format!("{what}, replayed")))] += 1;
        if n < 100 {
            a.values
                .iter_mut()
                .zip(&a.constants)
                .for_each(|(value, constant)| *value = constant.unwrap_or(random.number()));
            counts
                [usize::from(check(&a, &mut linear, random, &format!("{what}, other numbers")))] +=
                1;
        }
    }
    assert!(counts.iter().all(|count| *count > cases / 2), "{counts:?}");
}

#[test]
fn random_sparse_systems_are_solved_or_called_singular() {
    check_many(3000, usize::MAX);
}

/// Singular values of 300 unknowns take their time; `KIN_SYSTEMS=40000` does forty times as many.
#[test]
#[ignore = "slow without optimisation"]
fn random_sparse_systems_of_up_to_300_unknowns() {
    let asked = std::env::var("KIN_SYSTEMS").ok().and_then(|n| n.parse().ok());
    check_many(asked.unwrap_or(1000), 100);
}
