//! The solver on matrices of every kind.

mod condition;
mod random;
mod replayed;

use super::*;

fn dense(n: usize, rows: &[f64]) -> Linear {
    let mut linear = Linear::new(n, (0..n * n).map(|k| Some((k / n, k % n))), &[]);
    linear.values_mut().copy_from_slice(rows);
    linear
}

fn solve(linear: &mut Linear, b: &[f64]) -> Vec<f64> {
    linear.rhs_mut().copy_from_slice(b);
    linear.solve();
    linear.solution().to_vec()
}

#[test]
fn solution_satisfies_the_equations() {
    let rows = [0.0, 2.0, 1.0, 1.0, 1e-3, 4.0, -3.0, 1.0, 0.5];
    let mut linear = dense(3, &rows);
    linear.measure();
    assert!(linear.factor());
    let x = solve(&mut linear, &[1.0, -2.0, 0.25]);
    for (row, b) in rows.chunks(3).zip([1.0, -2.0, 0.25]) {
        let ax: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
        assert!((ax - b).abs() < 1e-14, "{ax} {b}");
    }
}

#[test]
fn repeated_places_add_and_the_grounds_are_dropped() {
    let mut linear = Linear::new(1, [Some((0, 0)), None, Some((0, 0))], &[]);
    linear.values_mut().copy_from_slice(&[1.5, 100.0, 0.5]);
    linear.measure();
    assert!(linear.factor());
    assert_eq!(solve(&mut linear, &[4.0]), [2.0]);
}

#[test]
fn verdict_does_not_depend_on_units() {
    // Lengths in units of `u` metres, rows of length too.
    for u in [1e-3, 1.0, 1e3, 1e9] {
        let mut good = dense(2, &[1.0, 0.3 / u, 0.0, 1e-9]);
        good.set_sizes(&[0.5 / u, 1.0]);
        good.measure();
        assert!(good.factor());
        let mut bad = dense(2, &[1.0, 0.3 / u, 2.0, 0.6 / u]);
        bad.set_sizes(&[0.5 / u, 1.0]);
        bad.measure();
        assert!(!bad.factor());
    }
}

#[test]
fn row_that_fades_is_seen_to_fade() {
    let mut linear = dense(2, &[-1.0, -1.0, 1.0, 0.0]);
    linear.measure();
    assert!(linear.factor());
    assert!(linear.smallest_pivot() > 0.9);
    linear.values_mut()[2] = 1e-8;
    linear.measure();
    assert!(linear.factor());
    assert!(linear.smallest_pivot() < 2e-8);
    linear.forget();
    linear.measure();
    assert!(linear.factor());
    assert!(linear.smallest_pivot() > 0.9);
}

#[test]
fn nothing_is_singular_about_no_coordinates() {
    let mut linear = Linear::new(0, [], &[]);
    assert!(linear.factor());
    linear.solve();
}

/// The measures of rows and columns are of order 1; the largest singular value still grows with
/// their number.
#[test]
fn condition_counts_the_largest_singular_value_and_the_smallest() {
    let mut random = crate::numbers::random::Random::new(3);
    for n in [2, 5, 12, 30] {
        for small in [1.0, 1e-3, 1e-7] {
            let rows: Vec<f64> = (0..n * n)
                .map(|k| 1.0 + small * random.number() * if k % (n + 1) == 0 { 2.0 } else { 1.0 })
                .collect();
            let mut linear = dense(n, &rows);
            linear.measure();
            assert!(linear.factor());
            let scaled = |row: usize, column: usize| {
                rows[row * n + column] * linear.row_units()[row] * linear.column_units()[column]
            };
            let exact = nalgebra::DMatrix::from_fn(n, n, scaled).singular_values();
            let [largest, smallest] = linear.singular_values();
            assert!(
                (0.99..1.0 + 1e-9).contains(&(largest / exact.max())),
                "{n} {small}: {largest} {}",
                exact.max()
            );
            assert!(
                (1.0 - 1e-6..1.1).contains(&(smallest / exact.min())),
                "{n} {small}: {smallest} {}",
                exact.min()
            );
            let condition = exact.max() / exact.min();
            assert!(
                (0.3..1.0 + 1e-6).contains(&(linear.condition() / condition)),
                "{n} {small}: {} {condition}",
                linear.condition()
            );
        }
    }
}

/// Rows that have been large only far off the way do not make later pivots look small.
#[test]
fn measures_that_were_not_confirmed_can_be_revoked() {
    let mut linear = dense(2, &[1.0, 0.0, 0.0, 1.0]);
    assert!(linear.measure() && linear.factor());
    linear.confirm();
    let pivot = linear.smallest_pivot();
    linear.values_mut().copy_from_slice(&[1.0, 0.0, 0.0, 1e9]);
    assert!(linear.measure() && linear.is_provisional());
    linear.values_mut().copy_from_slice(&[1.0, 0.0, 0.0, 1.0]);
    assert!(linear.measure() && linear.factor() && linear.smallest_pivot() < 1e-8);
    linear.revoke();
    assert!(linear.measure() && linear.factor() && !linear.is_provisional());
    assert_eq!((linear.smallest_pivot(), linear.norms()), (pivot, &[1.0, 1.0][..]));
    // Confirmed measures stay.
    linear.values_mut().copy_from_slice(&[1.0, 0.0, 0.0, 4.0]);
    assert!(linear.measure());
    linear.confirm();
    linear.revoke();
    assert_eq!(linear.norms(), &[1.0, 4.0]);
}
