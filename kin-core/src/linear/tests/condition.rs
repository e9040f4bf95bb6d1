//! The estimate of the condition number against singular values.

use nalgebra::DMatrix;

use super::super::Linear;
use crate::numbers::random::Random;

/// The condition number of the matrix by the measures of its rows and columns, estimated and exact.
fn conditions(a: &DMatrix<f64>) -> [f64; 2] {
    let n = a.nrows();
    let mut linear = Linear::new(n, (0..n * n).map(|k| Some((k / n, k % n))), &[]);
    linear.values_mut().copy_from_slice(a.transpose().as_slice());
    linear.measure();
    assert!(linear.factor());
    let measured =
        DMatrix::from_fn(n, n, |i, j| linear.row_units[i] * a[(i, j)] * linear.column_units[j]);
    let values = measured.singular_values();
    [linear.condition(), values.max() / values.min()]
}

/// The largest singular value counts as the smallest does: of ones with a unit matrix added one is
/// n + 1 times the other, and it is the largest that is large; of the inverse it is the smallest
/// that is small.
#[test]
fn large_and_small_singular_values_both_count() {
    for n in [4, 15, 60] {
        let ones = DMatrix::from_element(n, n, 1.0) + DMatrix::identity(n, n);
        let inverse = ones.clone().try_inverse().expect("regular");
        for a in [ones, inverse] {
            let [estimate, exact] = conditions(&a);
            assert!(
                (exact / (n as f64 + 1.0) - 1.0).abs() < 1e-9
                    && estimate <= 1.001 * exact
                    && estimate > 0.8 * exact,
                "{estimate} {exact}"
            );
        }
    }
}

#[test]
fn condition_is_estimated_to_a_small_factor() {
    let random = &mut Random::new(20_261_122);
    for case in 0..60 {
        let n = 3 + case % 20;
        // triangular matrices are far from symmetric ones
        let a = DMatrix::from_fn(n, n, |i, j| match (i == j, i < j) {
            (true, _) => 1.0,
            (_, true) => 2.0 * random.number(),
            _ => 0.0,
        });
        let [estimate, exact] = conditions(&a);
        assert!(
            estimate <= 1.001 * exact && estimate > exact / 3.0,
            "case {case}: {estimate} {exact}"
        );
    }
}

/// Vectors that nearly nothing is made of, and what is shown of a matrix whose two smallest
/// singular values are near one another: more rounds are needed than for a verdict.
#[test]
fn near_singular_values_are_told_apart() {
    let random = &mut Random::new(11);
    let n = 12;
    let mut turned = || DMatrix::from_fn(n, n, |_, _| random.number()).qr().q();
    let u = turned();
    let v = turned();
    let sizes = DMatrix::from_fn(n, n, |i, j| {
        if i != j {
            0.0
        } else {
            [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0101, 0.01][i]
        }
    });
    let a = u * sizes * v;
    let mut linear = Linear::new(n, (0..n * n).map(|k| Some((k / n, k % n))), &[]);
    linear.values_mut().copy_from_slice(a.transpose().as_slice());
    linear.measure();
    assert!(linear.factor());
    let measured =
        DMatrix::from_fn(n, n, |i, j| linear.row_units[i] * a[(i, j)] * linear.column_units[j]);
    let values = measured.singular_values();
    let [largest, smallest] = linear.singular_values();
    let mut sorted: Vec<f64> = values.iter().copied().collect();
    sorted.sort_by(f64::total_cmp);
    assert!(sorted[1] < 1.25 * sorted[0] && sorted[1] > 1.1 * sorted[0]);
    assert!(
        (largest / values.max() - 1.0).abs() < 1e-3 && (smallest / values.min() - 1.0).abs() < 1e-9
    );
    linear.rhs_mut().fill(3.0);
    let (left, right, [_, estimate]) = linear.nearly_null();
    assert!(linear.rhs_mut().iter().all(|b| *b == 3.0), "a right side that waits is kept");
    let [left, right] = [left, right].map(nalgebra::DVector::from_vec);
    for (vector, size) in [(&left, measured.transpose() * &left), (&right, &measured * &right)]
        .map(|(v, image)| (v.norm(), image.norm()))
    {
        assert!(
            (vector - 1.0).abs() < 1e-12 && size < 1.5 * values.min() && size <= 1.2 * estimate,
            "{vector} {size} {estimate}"
        );
    }
}
