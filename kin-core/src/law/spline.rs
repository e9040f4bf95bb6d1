//! Creates cubic splines through tables.

mod wide;

use std::ops::Deref;
use std::path::Path;

use super::pieces::Pieces;
use super::points::{self, Ends, Points};
use super::{Break, Law, LawFunction, LawRange, breaks, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::{Interval, ONE, Series, piecewise, repeated};
use crate::outcome::error::Result;

impl Law {
    /// Returns a cubic spline through the points (x, y), with continuous first and second
    /// derivatives between the ends.
    ///
    /// The x values must increase. The table needs at least two points, or three with
    /// [`Ends::Periodic`]. A mechanism returns an error for a table that does not increase, or for
    /// a periodic table whose first and last y differ.
    pub fn spline(table: &[(f64, impl IntoNumber)], ends: Ends) -> Law {
        Law::hanging(|to| Spline::new(Points::new(table, ends, to)))
    }

    /// Returns a cubic spline through the first two columns of a CSV file.
    ///
    /// Kin skips a first line without numbers as a header.
    ///
    /// Errors: Kin cannot read the file; a line does not contain two numbers; the table does not
    /// increase.
    pub fn spline_from_csv(path: impl AsRef<Path>, ends: Ends) -> Result<Law> {
        points::from_csv(path.as_ref(), |table| Law::spline(table, ends))
    }
}

#[derive(Clone)]
struct Spline {
    points: Points,
    /// f″ at each x. The list is empty if the table is refused.
    curvature: Vec<f64>,
    /// A bound of the error of these curvatures.
    error: f64,
}

/// A spline dereferences to its points.
impl Deref for Spline {
    type Target = Points;

    fn deref(&self) -> &Points {
        &self.points
    }
}

impl Spline {
    fn new(points: Points) -> Self {
        let mut spline = Spline { points, curvature: Vec::new(), error: 0.0 };
        if spline.refusal().is_none() {
            spline.curvature = spline.curvatures();
            spline.error = spline.curvature_error();
        }
        spline
    }

    /// Solves for f″ at the knots, from continuity of f′: (h_(k−1) m_(k−1) + 2 (h_(k−1) + h_k) m_k
    /// + h_k m_(k+1))/6 = s_k − s_(k−1).
    fn curvatures(&self) -> Vec<f64> {
        let last = self.table.len() - 1;
        let mut rows = vec![[0.0, 1.0, 0.0, 0.0]; last + 1];
        for (k, row) in rows.iter_mut().enumerate().take(last).skip(1) {
            let (h0, s0) = self.interval(k - 1);
            let (h1, s1) = self.interval(k);
            *row = [h0, 2.0 * (h0 + h1), h1, 6.0 * (s1 - s0)];
        }
        match self.ends {
            Ends::Natural => tridiagonal(rows),
            Ends::Clamped { start, end } => {
                let (h0, s0) = self.interval(0);
                let (h1, s1) = self.interval(last - 1);
                rows[0] = [0.0, 2.0 * h0, h0, 6.0 * (s0 - start)];
                rows[last] = [h1, 2.0 * h1, 0.0, 6.0 * (end - s1)];
                tridiagonal(rows)
            }
            Ends::Periodic => {
                let (h0, s0) = self.interval(0);
                let (h1, s1) = self.interval(last - 1);
                rows[0] = [h1, 2.0 * (h0 + h1), h0, 6.0 * (s0 - s1)];
                rows.truncate(last);
                let mut m = cyclic(rows);
                m.push(m[0]);
                m
            }
        }
    }

    /// Returns the jet at x over interval k.
    fn inside(&self, k: usize, x: f64) -> [f64; 4] {
        let (h, slope) = self.interval(k);
        let m0 = self.curvature[k];
        let m1 = self.curvature[k + 1];
        let t = x - self.table[k].0;
        let j = (m1 - m0) / h;
        let v = slope - h * (2.0 * m0 + m1) / 6.0;
        [
            self.table[k].1 + t * (v + t * (m0 / 2.0 + t * j / 6.0)),
            v + t * (m0 + t * j / 2.0),
            m0 + t * j,
            j,
        ]
    }

    /// Bounds the distance of the curvatures from the exact solution of their equations. The rows
    /// are diagonally dominant: the error is at most the largest residual divided by the excess of
    /// the diagonal over the rest of its row.
    fn curvature_error(&self) -> f64 {
        let last = self.table.len() - 1;
        let number = |x: f64| Interval::from(x);
        let m = |k: usize| number(self.curvature[k]);
        let interval = |k: usize| {
            let (x0, y0) = self.table[k];
            let (x1, y1) = self.table[k + 1];
            let h = number(x1) - number(x0);
            (h, (number(y1) - number(y0)) / h)
        };
        let inner = |[a, b]: [usize; 2], [before, at, after]: [usize; 3]| {
            let (h0, s0) = interval(a);
            let (h1, s1) = interval(b);
            (h0 * m(before) + number(2.0) * (h0 + h1) * m(at) + h1 * m(after)
                - number(6.0) * (s1 - s0))
                / (h0 + h1)
        };
        let end = |k: usize, [at, beside]: [usize; 2], rise: &dyn Fn(Interval) -> Interval| {
            let (h, slope) = interval(k);
            number(2.0) * m(at) + m(beside) - number(6.0) * rise(slope) / h
        };
        let missed = |k: usize| match self.ends {
            Ends::Natural if k == 0 || k == last => m(k),
            Ends::Clamped { start, .. } if k == 0 => end(0, [0, 1], &|slope| slope - number(start)),
            Ends::Clamped { end: to, .. } if k == last => {
                end(last - 1, [last, last - 1], &|slope| number(to) - slope)
            }
            Ends::Periodic if k == 0 || k == last => inner([last - 1, 0], [last - 1, 0, 1]),
            _ => inner([k - 1, k], [k - 1, k, k + 1]),
        };
        (0..=last).map(|k| missed(k).mag()).fold(0.0, f64::max)
    }

    /// Returns the polynomial of interval k with bounds. The curvatures come from a rounded
    /// elimination, so the bounds include their error.
    fn cubic(&self, k: usize, x: &Series) -> Series {
        let number = |x: f64| Interval::from(x);
        let [m0, m1] = [k, k + 1].map(|k| number(self.curvature[k]) + Interval::ball(self.error));
        let (x0, y0) = self.table[k];
        let (x1, y1) = self.table[k + 1];
        let h = number(x1) - number(x0);
        let v = (number(y1) - number(y0)) / h - h * (number(2.0) * m0 + m1) / number(6.0);
        let half = m0 / number(2.0);
        let third = (m1 - m0) / (number(6.0) * h);
        let t = x.plus(-x0);
        Series::constant(number(y0))
            + t * (Series::constant(v) + t * (Series::constant(half) + t * Series::constant(third)))
    }

    /// Returns the straight line with the first two coefficients of an end. t counts from that end.
    fn line(&self, end: Series, t: &Series) -> Series {
        Series::constant(end.at(0)) + *t * Series::constant(end.at(1))
    }

    /// Returns the third derivative right of knot k.
    fn third(&self, k: usize) -> f64 {
        let outside = k + 1 == self.table.len() && self.ends != Ends::Periodic;
        let k = k % (self.table.len() - 1);
        if outside { 0.0 } else { (self.curvature[k + 1] - self.curvature[k]) / self.step(k).0 }
    }
}

/// Solves diagonally dominant rows \[below, diagonal, above, right side\].
fn tridiagonal(mut rows: Vec<[f64; 4]>) -> Vec<f64> {
    for k in 1..rows.len() {
        let [below, diagonal, above, right] = rows[k];
        let before = rows[k - 1];
        let share = below / before[1];
        rows[k] = [0.0, diagonal - share * before[2], above, right - share * before[3]];
    }
    let mut m = vec![0.0; rows.len()];
    for k in (0..rows.len()).rev() {
        let after = m.get(k + 1).copied().unwrap_or(0.0);
        m[k] = (rows[k][3] - rows[k][2] * after) / rows[k][1];
    }
    m
}

/// Solves such rows for a closed spline: `below` of the first row belongs to the last column,
/// `above` of the last row to the first column (Sherman and Morrison).
fn cyclic(mut rows: Vec<[f64; 4]>) -> Vec<f64> {
    let last = rows.len() - 1;
    let corner = rows[0][0];
    let other = rows[last][2];
    let gamma = -rows[0][1];
    rows[0][1] -= gamma;
    rows[last][1] -= corner * other / gamma;
    let mut border: Vec<[f64; 4]> =
        rows.iter().map(|[below, diagonal, above, _]| [*below, *diagonal, *above, 0.0]).collect();
    (border[0][3], border[last][3]) = (gamma, other);
    let x = tridiagonal(rows);
    let z = tridiagonal(border);
    let along = |v: &[f64]| v[0] + corner / gamma * v[last];
    let share = along(&x) / (1.0 + along(&z));
    x.iter().zip(&z).map(|(x, z)| x - share * z).collect()
}

impl LawFunction for Spline {
    fn jet(&self, x: f64) -> [f64; 4] {
        if self.curvature.is_empty() || x.is_nan() {
            return [f64::NAN; 4];
        }
        let last = self.table.len() - 1;
        let line = |[y, v, ..]: [f64; 4], from: f64| [y + v * (x - from), v, 0.0, 0.0];
        match self.place(x) {
            (_, 0) => line(self.inside(0, self.table[0].0), self.table[0].0),
            (_, after) if after > last => {
                line(self.inside(last - 1, self.table[last].0), self.table[last].0)
            }
            (x, after) => self.inside(after - 1, x),
        }
    }

    fn pieces(&self) -> Option<Pieces> {
        let last = self.curvature.len().checked_sub(1)?;
        let piece = |(k, (x, _)): (usize, &(f64, f64))| {
            let [f, f1, f2, f3] = self.inside(k.min(last - 1), *x);
            [f, f1, 0.5 * f2, f3 / 6.0]
        };
        Some(Pieces {
            knots: self.table.iter().map(|(x, _)| *x).collect(),
            coefficients: self.table.iter().enumerate().map(piece).collect(),
            repeats: self.ends == Ends::Periodic,
        })
    }

    fn kind(&self) -> &str {
        "spline"
    }

    fn description(&self) -> &str {
        "Cubic spline through the points of a table. Its ends are natural, clamped or periodic."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let first = self.table.first()?.0;
        let last = self.table.last()?.0;
        if self.curvature.is_empty() {
            return None;
        }
        let knots: Vec<f64> = self.table.iter().map(|(x, _)| *x).collect();
        match self.ends {
            Ends::Periodic => repeated(x, first, last - first, &|x| {
                let x = x.plus(first);
                let inner = &knots[1..knots.len() - 1];
                self.over_many(&x).or_else(|| piecewise(&x, inner, &|k, x| Some(self.cubic(k, x))))
            }),
            _ => self.over_many(x).or_else(|| {
                piecewise(x, &knots, &|k, x| {
                    Some(match k {
                        0 => self.line(
                            self.cubic(0, &Series::variable(Interval::from(first), ONE, 2)),
                            &x.plus(-first),
                        ),
                        k if k < knots.len() => self.cubic(k - 1, x),
                        k => self.line(
                            self.cubic(k - 2, &Series::variable(Interval::from(last), ONE, 2)),
                            &x.plus(-last),
                        ),
                    })
                })
            }),
        }
    }

    fn fourth(&self, _: f64) -> f64 {
        0.0
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        if self.curvature.is_empty() {
            return Vec::new();
        }
        let last = self.table.len() - 1;
        let outer = if matches!(self.ends, Ends::Clamped { .. }) { 2 } else { 3 };
        let size = (0..last).map(|k| self.third(k).abs()).fold(0.0, f64::max);
        let jumps = |before: f64, after: f64| (before - after).abs() > 1e-9 * size;
        let mut one = Vec::new();
        for k in 0..=last {
            let end = k == 0 || k == last;
            let x = self.table[k].0;
            let (order, found) = match self.ends {
                Ends::Periodic if k == last => continue,
                Ends::Periodic => (3, jumps(self.third(k + last - 1), self.third(k))),
                _ if end => (
                    outer,
                    if outer == 2 {
                        self.curvature[k] != 0.0
                    } else {
                        jumps(self.third(k.min(last - 1)), 0.0)
                    },
                ),
                _ => (3, jumps(self.third(k - 1), self.third(k))),
            };
            if found {
                one.push(Break { x, order });
            }
        }
        if self.ends == Ends::Periodic {
            let start = self.table[0].0;
            let period = self.table[last].0 - self.table[0].0;
            return breaks::repeated(&one, start, period, from, to);
        }
        one.retain(|b| (from..=to).contains(&b.x));
        one.truncate(breaks::MOST_BREAKS);
        one
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn range(&self) -> Option<LawRange> {
        self.points.range()
    }

    fn table_range(&self) -> Option<LawRange> {
        self.points.range()
    }

    fn refusal(&self) -> Option<String> {
        self.points.refusal("spline")
    }

    fn fixed_numbers(&self) -> Vec<(String, f64)> {
        self.points.fixed_numbers()
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.points.parameters(visit);
    }

    /// The spline is linear in its y and its slopes at the ends, so the derivative by one y is the
    /// spline of that y alone.
    fn by_parameter(&self, name: &str) -> Option<Law> {
        let table = self.table.iter().map(|(x, _)| (*x, 0.0)).collect();
        let ends = match self.ends {
            Ends::Clamped { .. } => Ends::Clamped { start: 0.0, end: 0.0 },
            ends => ends,
        };
        Some(Law::new(Spline::new(Points { table, ends }.with_parameter(name, 1.0)?)))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        Some(Law::new(Spline::new(self.points.with_parameter(name, value)?)))
    }
}

#[cfg(test)]
mod tests;
