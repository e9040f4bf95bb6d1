//! Creates quintic splines through tables, with continuous derivatives up to the fourth.

use std::path::Path;

use nalgebra::{Matrix2, Matrix2x3, Vector2};

use super::points::{self, Ends, Points};
use super::{Break, Law, LawFunction, LawRange, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::{Interval, ONE, Series, piecewise, repeated};
use crate::outcome::error::Result;

impl Law {
    /// Returns a quintic spline through the points (x, y), with continuous derivatives up to the
    /// fourth between the ends.
    ///
    /// The x values must increase. The table needs at least two points, or three with
    /// [`Ends::Periodic`]. A periodic spline has continuous derivatives up to the fourth
    /// everywhere, which suits the profile of a cam or a closed path. With [`Ends::Clamped`] and
    /// [`Ends::Natural`] the curvature is zero at the ends, and the spline continues as a straight
    /// line. [`Ends::Clamped`] gives the slope of the line. With [`Ends::Natural`] the line has the
    /// slope of least bending (f⁗ = 0).
    ///
    /// A mechanism returns an error for a table that does not increase, or for a periodic table
    /// whose first and last y differ. Source: C. de Boor, *A Practical Guide to Splines*.
    pub fn quintic_spline(table: &[(f64, impl IntoNumber)], ends: Ends) -> Law {
        Law::hanging(|to| Quintic::new(Points::new(table, ends, to)))
    }

    /// Returns a quintic spline through the first two columns of a CSV file.
    ///
    /// Kin skips a first line without numbers as a header.
    ///
    /// Errors: those of [`Law::spline_from_csv`].
    pub fn quintic_spline_from_csv(path: impl AsRef<Path>, ends: Ends) -> Result<Law> {
        points::from_csv(path.as_ref(), |table| Law::quintic_spline(table, ends))
    }
}

#[derive(Clone)]
struct Quintic {
    points: Points,
    /// f′ and f″ at each x. The list is empty if the table is refused.
    slopes: Vec<[f64; 2]>,
}

impl Quintic {
    fn new(points: Points) -> Self {
        let slopes = if points.refusal("").is_none() { slopes(&points) } else { Vec::new() };
        Quintic { points, slopes }
    }

    /// Returns the width of interval k and its polynomial in u = (x − x_k)/h from 0 to 1.
    fn piece(&self, k: usize) -> (f64, [f64; 6]) {
        let (h, rise) = self.points.step(k);
        let [v0, a0] = self.slopes[k];
        let [v1, a1] = self.slopes[k + 1];
        (h, hermite(self.points.table[k].1, rise, [h * v0, h * v1], [h * h * a0, h * h * a1]))
    }

    /// Returns f and its derivatives up to the fourth at x, over interval k.
    fn inside(&self, k: usize, x: f64) -> [f64; 5] {
        let (h, mut c) = self.piece(k);
        let u = (x - self.points.table[k].0) / h;
        let mut unit = 1.0;
        std::array::from_fn(|order| {
            let value = c[..6 - order].iter().rev().fold(0.0, |sum, c| sum * u + c) / unit;
            (0..5 - order).for_each(|j| c[j] = (j + 1) as f64 * c[j + 1]);
            unit *= h;
            value
        })
    }

    fn all(&self, x: f64) -> [f64; 5] {
        if self.slopes.is_empty() || x.is_nan() {
            return [f64::NAN; 5];
        }
        let last = self.points.table.len() - 1;
        let line = |k: usize, from: f64| {
            let [y, v, ..] = self.inside(k, from);
            [y + v * (x - from), v, 0.0, 0.0, 0.0]
        };
        match self.points.place(x) {
            (_, 0) => line(0, self.points.table[0].0),
            (_, after) if after > last => line(last - 1, self.points.table[last].0),
            (x, after) => self.inside(after - 1, x),
        }
    }

    /// Returns the polynomial of interval k with bounds. The computed slopes define the law. With
    /// them all pieces meet in value, slope and curvature, so rounding of the slopes needs no
    /// bound.
    fn bounded(&self, k: usize, x: &Series) -> Series {
        let number = |x: f64| Interval::from(x);
        let (x0, y0) = self.points.table[k];
        let (x1, y1) = self.points.table[k + 1];
        let [[v0, a0], [v1, a1]] =
            [self.slopes[k], self.slopes[k + 1]].map(|slopes| slopes.map(number));
        let h = number(x1) - number(x0);
        let rise = number(y1) - number(y0);
        let u = x.plus(-x0) * Series::constant(number(1.0) / h);
        let w = (-u).plus(1.0);
        let times = |c: Interval, p: Series| Series::constant(c) * p;
        let square = u * u;
        let cube = u * u * u;
        let rest = w * w;
        let rest_cube = w * w * w;
        // Each number occurs once, multiplied by a factored polynomial. This keeps rounding and
        // ranges small.
        Series::constant(number(y0))
            + times(rise, cube * (u * (times(number(6.0), u).plus(-15.0))).plus(10.0))
            + times(v0 * h, u * rest_cube * times(number(3.0), u).plus(1.0))
            + times(v1 * h, cube * w * times(number(3.0), u).plus(-4.0))
            + times(a0 * h * h * number(0.5), square * rest_cube)
            + times(a1 * h * h * number(0.5), cube * rest)
    }

    /// Returns the straight line with the first two coefficients of an end. t counts from that end.
    fn line(&self, end: &Series, t: &Series) -> Series {
        Series::constant(end.at(0)) + *t * Series::constant(end.at(1))
    }
}

/// Returns the polynomial of degree five in u with the value y at 0 and y + rise at 1, and with the
/// given first and second derivatives by u at both ends.
fn hermite(y: f64, rise: f64, [v0, v1]: [f64; 2], [a0, a1]: [f64; 2]) -> [f64; 6] {
    let x = rise - v0 - 0.5 * a0;
    let v = v1 - v0 - a0;
    let a = a1 - a0;
    [
        y,
        v0,
        0.5 * a0,
        10.0 * x - 4.0 * v + 0.5 * a,
        7.0 * v - 15.0 * x - a,
        6.0 * x - 3.0 * v + 0.5 * a,
    ]
}

/// Two conditions on (f′, f″) of a knot and of its two neighbours.
#[derive(Clone, Copy)]
struct Row {
    below: Matrix2<f64>,
    diagonal: Matrix2<f64>,
    above: Matrix2<f64>,
    right: Vector2<f64>,
}

/// Solves for f′ and f″ at the knots, from continuity of f‴ and f⁗. p and n are the widths before
/// and after a knot, Δ the rises. The conditions are:
///
/// −24 v₋/p² − 3 a₋/p + 36 (1/n² − 1/p²) v + 9 (1/n + 1/p) a + 24 v₊/n² − 3 a₊/n = 60 (Δn/n³ −
/// Δp/p³),
///
/// 168 v₋/p³ + 24 a₋/p² + 192 (1/n³ + 1/p³) v + 36 (1/n² − 1/p²) a + 168 v₊/n³ − 24 a₊/n² = 360
/// (Δn/n⁴ + Δp/p⁴).
fn slopes(points: &Points) -> Vec<[f64; 2]> {
    let last = points.table.len() - 1;
    let inner =
        |k: usize| row(Some(points.step((k + last - 1) % last)), Some(points.step(k % last)));
    let rows: Vec<Row> = match points.ends {
        Ends::Periodic => (0..last).map(inner).collect(),
        _ => {
            let before = end(points, row(None, Some(points.step(0))), |ends| ends.0);
            let after = end(points, row(Some(points.step(last - 1)), None), |ends| ends.1);
            std::iter::once(before).chain((1..last).map(inner)).chain([after]).collect()
        }
    };
    // The last knot of a table that repeats equals the first knot.
    let found = solved(&rows);
    (0..=last).map(|k| found[k % found.len()]).map(|x| [x.x, x.y]).collect()
}

/// Returns the conditions of a knot between two intervals, each given as (width, rise). A knot at
/// an end has only one interval.
fn row(before: Option<(f64, f64)>, after: Option<(f64, f64)>) -> Row {
    let mut below = Matrix2::zeros();
    let mut diagonal = Matrix2::zeros();
    let mut above = Matrix2::zeros();
    let mut right = Vector2::zeros();
    if let Some((p, rise)) = before {
        // The first row is in units of 1/p², the second in units of 1/p³.
        below += Matrix2::new(-24.0 / (p * p), -3.0 / p, 168.0 / p.powi(3), 24.0 / (p * p));
        diagonal += Matrix2::new(-36.0 / (p * p), 9.0 / p, 192.0 / p.powi(3), -36.0 / (p * p));
        right += Vector2::new(-60.0 * rise / p.powi(3), 360.0 * rise / p.powi(4));
    }
    if let Some((n, rise)) = after {
        diagonal += Matrix2::new(36.0 / (n * n), 9.0 / n, 192.0 / n.powi(3), 36.0 / (n * n));
        above += Matrix2::new(24.0 / (n * n), -3.0 / n, 168.0 / n.powi(3), -24.0 / (n * n));
        right += Vector2::new(60.0 * rise / n.powi(3), 360.0 * rise / n.powi(4));
    }
    Row { below, diagonal, above, right }
}

/// Returns the conditions of an end without curvature: the given slope, or f⁗ = 0, which is the
/// second condition there.
fn end(points: &Points, row: Row, slope: impl Fn((f64, f64)) -> f64) -> Row {
    let mut row = row;
    let mut first = [0.0, 1.0];
    let mut value = 0.0;
    if let Ends::Clamped { start, end } = points.ends {
        (first, value) = ([1.0, 0.0], slope((start, end)));
        row.diagonal.set_row(1, &nalgebra::RowVector2::new(0.0, 1.0));
        [&mut row.below, &mut row.above].into_iter().for_each(|m| m.fill_row(1, 0.0));
        row.right.y = 0.0;
    }
    row.diagonal.set_row(0, &nalgebra::RowVector2::from(first));
    [&mut row.below, &mut row.above].into_iter().for_each(|m| m.fill_row(0, 0.0));
    row.right.x = value;
    row
}

/// Solves block rows that are connected in a circle. `below` of the first row multiplies the last
/// unknown, `above` of the last row the first unknown; both are zero if the spline is not closed.
/// The elimination expresses all unknowns by the first one and solves for the first one at the end.
fn solved(rows: &[Row]) -> Vec<Vector2<f64>> {
    let with = |v: Vector2<f64>, m: Matrix2<f64>| {
        Matrix2x3::from_columns(&[v, m.column(0).into(), m.column(1).into()])
    };
    let inverse = |m: Matrix2<f64>| m.try_inverse().unwrap_or_else(|| Matrix2::repeat(f64::NAN));
    let Some((first, others)) = rows.split_first() else { return Vec::new() };
    // Right sides: one without the first unknown, and one for each of its two components.
    let mut rights: Vec<Matrix2x3<f64>> =
        others.iter().map(|row| with(row.right, Matrix2::zeros())).collect();
    let share = |m: &Matrix2<f64>| with(Vector2::zeros(), -m);
    if let (Some(right), Some(row)) = (rights.first_mut(), others.first()) {
        *right += share(&row.below);
    }
    if let (Some(right), Some(row)) = (rights.last_mut(), others.last()) {
        *right += share(&row.above);
    }
    let mut pivots: Vec<Matrix2<f64>> = others.iter().map(|row| row.diagonal).collect();
    for k in 1..others.len() {
        let factor = others[k].below * inverse(pivots[k - 1]);
        pivots[k] -= factor * others[k - 1].above;
        let before = rights[k - 1];
        rights[k] -= factor * before;
    }
    for k in (0..others.len()).rev() {
        if let Some(after) = rights.get(k + 1).copied() {
            rights[k] -= others[k].above * after;
        }
        rights[k] = inverse(pivots[k]) * rights[k];
    }
    let mut own = first.diagonal;
    let mut right = first.right;
    for (factor, neighbour) in [(first.below, rights.last()), (first.above, rights.first())] {
        if let Some(neighbour) = neighbour {
            own += factor * neighbour.fixed_columns::<2>(1);
            right -= factor * neighbour.column(0);
        }
    }
    let x = inverse(own) * right;
    std::iter::once(x)
        .chain(rights.iter().map(|right| right.column(0) + right.fixed_columns::<2>(1) * x))
        .collect()
}

impl LawFunction for Quintic {
    fn jet(&self, x: f64) -> [f64; 4] {
        let [f, f1, f2, f3, _] = self.all(x);
        [f, f1, f2, f3]
    }

    fn kind(&self) -> &str {
        "quintic_spline"
    }

    fn description(&self) -> &str {
        "Quintic spline through the points of a table. Its ends are natural, clamped or periodic. The spline is C⁴, so acceleration and jerk are smooth."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let first = self.points.table.first()?.0;
        let last = self.points.table.last()?.0;
        let knots: Vec<f64> = self.points.table.iter().map(|(x, _)| *x).collect();
        let at = |x: f64| Series::variable(Interval::from(x), ONE, 2);
        match self.points.ends {
            _ if self.slopes.is_empty() => None,
            Ends::Periodic => repeated(x, first, last - first, &|x| {
                let inner = &knots[1..knots.len() - 1];
                piecewise(&x.plus(first), inner, &|k, x| Some(self.bounded(k, x)))
            }),
            _ => piecewise(x, &knots, &|k, x| {
                Some(match k {
                    0 => self.line(&self.bounded(0, &at(first)), &x.plus(-first)),
                    k if k < knots.len() => self.bounded(k - 1, x),
                    k => self.line(&self.bounded(k - 2, &at(last)), &x.plus(-last)),
                })
            }),
        }
    }

    fn fourth(&self, x: f64) -> f64 {
        self.all(x)[4]
    }

    /// f‴ jumps at the ends, where the spline becomes a straight line. Between the ends no
    /// derivative up to f⁗ jumps.
    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        if self.slopes.is_empty() || self.points.ends == Ends::Periodic {
            return Vec::new();
        }
        let last = self.points.table.len() - 1;
        let size =
            (0..last).map(|k| self.inside(k, self.points.table[k].0)[3].abs()).fold(0.0, f64::max);
        let ends = [(0, 0), (last - 1, last)].map(|(k, knot)| {
            (self.points.table[knot].0, self.inside(k, self.points.table[knot].0)[3])
        });
        let jumps = ends
            .into_iter()
            .filter(|(x, third)| (from..=to).contains(x) && third.abs() > 1e-9 * size);
        jumps.map(|(x, _)| Break { x, order: 3 }).collect()
    }

    fn is_smooth(&self) -> bool {
        self.points.ends == Ends::Periodic
    }

    fn range(&self) -> Option<LawRange> {
        self.points.range()
    }

    fn table_range(&self) -> Option<LawRange> {
        self.points.range()
    }

    fn refusal(&self) -> Option<String> {
        self.points.refusal("quintic_spline")
    }

    fn fixed_numbers(&self) -> Vec<(String, f64)> {
        self.points.fixed_numbers()
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.points.parameters(visit);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        Some(Law::new(Quintic::new(self.points.with_parameter(name, value)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::tests::{bounded, listed, near};

    const TABLE: [(f64, f64); 6] =
        [(-0.5, 1.0), (0.5, 1.8), (1.25, 0.2), (2.0, -0.7), (3.5, 0.4), (4.0, 1.0)];
    const CLAMPED: Ends = Ends::Clamped { start: -1.0, end: 2.0 };

    #[test]
    fn bounds_of_quintic_splines() {
        for ends in [Ends::Natural, CLAMPED, Ends::Periodic] {
            let law = Law::quintic_spline(&TABLE, ends);
            let points: Vec<(f64, f64)> =
                (0..40).map(|k| -3.0 + 0.23 * f64::from(k)).map(|x| (x, x)).collect();
            bounded(&law, &points, 1.0);
            // all up to the fourth go on at each point inside
            for (x, y) in &TABLE[1..5] {
                let left = x.next_down();
                let right = *x;
                near(law.at(right), *y, 1e-12);
                law.jet(left)
                    .into_iter()
                    .zip(law.jet(right))
                    .for_each(|(left, right)| near(left, right, 1e-10));
                near(law.fourth(left), law.fourth(right), 1e-9);
            }
            bounded(
                &law,
                &[
                    (0.6, 0.61),
                    (1.2, 1.3),
                    (-0.6, -0.4),
                    (3.9, 4.1),
                    (-3.0, -2.0),
                    (5.0, 6.0),
                    (2.1, 2.2),
                ],
                1e6,
            );
            assert_eq!(
                (law.kind(), law.is_smooth(), law.trusted().len()),
                ("quintic_spline", ends == Ends::Periodic, 0)
            );
            assert!(law.jet(f64::NAN).iter().all(|f| f.is_nan()) && law.fourth(f64::NAN).is_nan());
        }
        let refused = Law::quintic_spline(&TABLE[..1], Ends::Natural);
        assert!(
            refused.over(&Series::number(0.0)).is_none()
                && refused.jet(0.0).iter().all(|f| f.is_nan())
                && listed(&refused, -9.0, 9.0).is_empty()
        );
        assert!(
            Law::quintic_spline(&[(0.0, 0.0); 0], Ends::Natural)
                .over(&Series::number(0.0))
                .is_none()
        );
    }

    /// Where it becomes a line its third derivative jumps, unless that is nothing beside the
    /// others.
    #[test]
    fn breaks_at_the_ends() {
        let ends = |law: &Law| listed(law, -9.0, 9.0);
        assert_eq!(
            (
                ends(&Law::quintic_spline(&TABLE, Ends::Natural)),
                ends(&Law::quintic_spline(&TABLE, CLAMPED))
            ),
            (vec![(-0.5, 3), (4.0, 3)], vec![(-0.5, 3), (4.0, 3)])
        );
        assert_eq!(
            (
                listed(&Law::quintic_spline(&TABLE, CLAMPED), 0.0, 9.0),
                ends(&Law::quintic_spline(&TABLE, Ends::Periodic))
            ),
            (vec![(4.0, 3)], vec![])
        );
        for ends in [Ends::Natural, Ends::Clamped { start: 0.0, end: 0.0 }] {
            assert_eq!(
                listed(
                    &Law::quintic_spline(&[(0.0, 1.0), (1.0, 1.0), (3.0, 1.0)], ends),
                    -9.0,
                    9.0
                ),
                []
            );
        }
        // The third derivative at the beginning is linear in the point in the middle: it is made a
        // share of that in the middle.
        for sign in [1.0, -1.0] {
            let law = |y: f64| {
                Law::quintic_spline(
                    &[(0.0, 0.0), (1.0, y), (2.0, sign)],
                    Ends::Clamped { start: 0.0, end: 0.0 },
                )
            };
            let third = |y: f64, x: f64| law(y).jet(x)[3];
            let zero = third(0.0, 0.0) / (third(0.0, 0.0) - third(1.0, 0.0));
            for (share, count) in [(0.8e-9, 1), (1.2e-9, 2), (-0.8e-9, 1), (-1.2e-9, 2)] {
                let y = zero + share * third(zero, 1.0).abs() / (third(1.0, 0.0) - third(0.0, 0.0));
                near(third(y, 0.0) / third(y, 1.0).abs() * 1e9, share * 1e9, 1e-3);
                assert_eq!(ends(&law(y)).len(), count, "{share}");
            }
        }
    }
}
