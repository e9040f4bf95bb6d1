//! Quintic splines against their conditions, solved as one dense system, and against curves that
//! they must give exactly.

use kin::prelude::*;
use nalgebra::{DMatrix, DVector};

use crate::sample::Random;

/// x^p and its derivatives, up to the fourth.
fn power(p: usize, x: f64, order: usize) -> f64 {
    let factor: f64 = (0..order).map(|k| p as f64 - k as f64).product();
    if order > p { 0.0 } else { factor * x.powi((p - order) as i32) }
}

/// Coefficients of the pieces, six each in powers of x − x_k, from all conditions at once.
fn dense(table: &[(f64, f64)], ends: Ends) -> DVector<f64> {
    let n = table.len() - 1;
    let mut a = DMatrix::zeros(6 * n, 6 * n);
    let mut b = DVector::zeros(6 * n);
    let mut row = 0;
    let h = |k: usize| table[k + 1].0 - table[k].0;
    let mut put = |terms: &[(usize, f64, usize, f64)], right: f64| {
        for &(piece, x, order, factor) in terms {
            (0..6).for_each(|p| a[(row, 6 * piece + p)] += factor * power(p, x, order));
        }
        b[row] = right;
        row += 1;
    };
    for k in 0..n {
        put(&[(k, 0.0, 0, 1.0)], table[k].1);
        put(&[(k, h(k), 0, 1.0)], table[k + 1].1);
    }
    for k in 1..n {
        (1..5).for_each(|order| put(&[(k - 1, h(k - 1), order, 1.0), (k, 0.0, order, -1.0)], 0.0));
    }
    let first = |order| (0, 0.0, order, 1.0);
    let last = |order| (n - 1, h(n - 1), order, 1.0);
    match ends {
        Ends::Periodic => (1..5).for_each(|order| put(&[last(order), (0, 0.0, order, -1.0)], 0.0)),
        Ends::Natural => [2, 4].into_iter().for_each(|order| {
            put(&[first(order)], 0.0);
            put(&[last(order)], 0.0);
        }),
        Ends::Clamped { start, end } => {
            put(&[first(1)], start);
            put(&[last(1)], end);
            put(&[first(2)], 0.0);
            put(&[last(2)], 0.0);
        }
    }
    assert_eq!(row, 6 * n);
    a.full_piv_lu().solve(&b).expect("a spline")
}

#[test]
fn quintic_splines_are_what_their_conditions_say() {
    let mut random = Random::new(31);
    for round in 0..30 {
        let points = if round < 6 { 2 + round / 2 } else { 12 };
        for ends in [
            Ends::Natural,
            Ends::Clamped { start: random.number(), end: random.number() },
            Ends::Periodic,
        ] {
            let points = if ends == Ends::Periodic { points.max(3) } else { points };
            let mut x = random.number();
            let mut table: Vec<(f64, f64)> = Vec::new();
            for _ in 0..points {
                table.push((x, random.number()));
                x += random.between(0.1, 1.5);
            }
            if ends == Ends::Periodic {
                table.last_mut().expect("a point").1 = table[0].1;
            }
            let law = Law::quintic_spline(&table, ends);
            let exact = dense(&table, ends);
            for (k, pair) in table.windows(2).enumerate() {
                for u in [0.0, 0.21, 0.5, 0.83] {
                    let t = u * (pair[1].0 - pair[0].0);
                    let [f, f1, f2, f3] = law.jet(pair[0].0 + t);
                    for (order, found) in
                        [f, f1, f2, f3, law.fourth(pair[0].0 + t)].into_iter().enumerate()
                    {
                        let value: f64 =
                            (0..6).map(|p| exact[6 * k + p] * power(p, t, order)).sum();
                        let size = exact.amax();
                        assert!(
                            (found - value).abs() < 1e-8 * (1.0 + size),
                            "{ends:?}, derivative {order} at {t} of piece {k}: {found} {value}"
                        );
                    }
                }
            }
        }
    }
}

/// A closed law has no break, goes through its points, and nears a smooth periodic curve with the
/// sixth power of the distance of its points.
#[test]
fn closed_quintic_laws_have_a_smooth_jerk_and_follow_smooth_curves() {
    let curve =
        |x: f64| (2.0 + (x.sin() + 0.3 * (2.0 * x).cos()).exp(), x.cos() - 0.6 * (2.0 * x).sin());
    let mut errors = Vec::new();
    for n in [20_u32, 40] {
        let table: Vec<(f64, f64)> = (0..=n)
            .map(|k| TAU * f64::from(k % n) / f64::from(n))
            .map(|x| (x, curve(x).0))
            .collect();
        let mut table = table;
        table.last_mut().expect("a point").0 = TAU;
        let law = Law::quintic_spline(&table, Ends::Periodic);
        assert!(
            law.refusal().is_none()
                && law.is_smooth()
                && law.is_periodic(TAU)
                && law.breaks(-10.0, 10.0).is_empty()
        );
        for &(x, y) in &table {
            assert!((law.at(x - TAU) - y).abs() < 1e-12);
            let step = 1e-9;
            let before = law.jet(x - step);
            let after = law.jet(x + step);
            let jump = (0..4).map(|k| (after[k] - before[k]).abs()).fold(0.0, f64::max);
            assert!(
                jump < 1e-4 && (law.fourth(x + step) - law.fourth(x - step)).abs() < 1e-3,
                "at {x}: {before:?} {after:?}"
            );
        }
        let worst = |order: usize| {
            let error = |x: f64| match order {
                0 => law.at(x) - curve(x).0,
                _ => law.slope(x) - (curve(x).0 - 2.0) * curve(x).1,
            };
            (0..500).map(|k| error(f64::from(k) * TAU / 500.0).abs()).fold(0.0, f64::max)
        };
        errors.push([worst(0), worst(1)]);
    }
    println!("20 and 40 points: errors {errors:?}");
    assert!(errors[1][0] < errors[0][0] / 30.0 && errors[1][1] < errors[0][1] / 15.0, "{errors:?}");
}

/// The 3-4-5 rise has no slope and no curvature at its ends: whatever points of it the table has,
/// the clamped spline is that rise.
#[test]
fn a_clamped_quintic_spline_through_a_345_rise_is_that_rise() {
    let rise = Law::polynomial_345(0.7, 2.0);
    let table: Vec<(f64, f64)> = [0.0, 0.15, 0.9, 1.0, 1.75, 2.0].map(|x| (x, rise.at(x))).to_vec();
    let law = Law::quintic_spline(&table, Ends::Clamped { start: 0.0, end: 0.0 });
    for k in -10..60 {
        let x = 0.05 * f64::from(k) + 1e-3;
        for (order, (found, exact)) in law.jet(x).into_iter().zip(rise.jet(x)).enumerate() {
            assert!((found - exact).abs() < 1e-10, "derivative {order} at {x}: {found} {exact}");
        }
    }
    assert_eq!(
        law.breaks(-1.0, 3.0).iter().map(|b| (b.x, b.order)).collect::<Vec<_>>(),
        [(0.0, 3), (2.0, 3)]
    );
}

#[test]
fn tables_through_which_no_quintic_spline_goes() {
    let refusal =
        |table: &[(f64, f64)], ends| Law::quintic_spline(table, ends).refusal().expect("refused");
    assert!(
        refusal(&[(0.0, 1.0)], Ends::Natural)
            .contains("quintic_spline: the table has 1 point. Give at least 2 points")
    );
    assert!(
        refusal(&[(0.0, 1.0), (0.0, 2.0)], Ends::Natural)
            .contains("the values of x must increase, but x = 0 is followed by 0 (point 2)")
    );
    assert!(
        refusal(&[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)], Ends::Periodic)
            .contains("first and the last y of a periodic table must be equal")
    );
    assert!(
        Law::quintic_spline(&[(0.0, 0.0); 0], Ends::Periodic).jet(0.3).iter().all(|x| x.is_nan())
    );
}

/// Many points cost no more than a few each: a table of 20 000 is made at once, and is right.
#[test]
fn large_tables() {
    let n = 20_000;
    let table: Vec<(f64, f64)> =
        (0..=n).map(|k| (f64::from(k), (TAU * f64::from(k % n) / f64::from(n)).sin())).collect();
    let law = Law::quintic_spline(&table, Ends::Periodic);
    for x in [0.3, 7000.5, 19_999.9] {
        assert!((law.at(x) - (TAU * x / f64::from(n)).sin()).abs() < 1e-12);
    }
}
