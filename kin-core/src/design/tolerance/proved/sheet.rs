//! Computes a sheet: the positions of a mechanism over a box of its dimensions and a span of time,
//! as one function.

use nalgebra::DMatrix;

use super::equations::{Equations, Region, Slopes};
use crate::ask::proof::{Entry, Unknown, settled};
use crate::numbers::enclosure::interval::{Interval, ZERO, up};

/// The smallest radius, in characteristic sizes, within which other solutions are excluded. \[-\]
const LEAST: f64 = 1e-6;

/// Over a box of dimensions and time (the last side) there is exactly one solution of C = 0 in
/// `alone`, at each point of the box. It is continuous, and at c + Δ it is q + S Δ + `off`.
pub(super) struct Sheet {
    pub region: Vec<Interval>,
    /// c, the centre of the box.
    pub centre: Vec<f64>,
    pub q: Vec<f64>,
    /// S, an approximation of the derivatives of the solution at c.
    pub slopes: DMatrix<f64>,
    pub off: Vec<Interval>,
    /// Bounds of the distance of the derivatives from S, over the whole box.
    pub bent: DMatrix<f64>,
    alone: Vec<Interval>,
}

/// The reason why there is no sheet.
pub(super) enum Fault {
    Unknown(Unknown),
    /// C_q may be singular.
    Singular,
}

/// A, an approximation of C_q⁻¹ at the centre, for rows and columns of order 1.
struct Frame<'a> {
    inverse: DMatrix<f64>,
    weights: Vec<f64>,
    sizes: &'a [f64],
}

/// Computes the sheet over a box around a position at its centre.
///
/// Along q + S Δ the rows of C are, by the mean value theorem, C(q, c) + (C_q S + C_d) Δ with
/// derivatives within their bounds over the box. Multiplied by A this is small of second order: b.
/// Let R ≥ |I − A C_q| over positions within ρ of that plane. If y satisfies b + R y < y ≤ ρ, there
/// is a solution at each Δ, the only one within ρ (as in `ask/proof/krawczyk.rs`). Its derivatives
/// are S + e with
///
/// ```text
/// C_q (S + e) = −C_d      |e| ≤ |A (C_q S + C_d)| + R |e|
/// ```
pub(super) fn sheet(
    equations: &Equations<'_>,
    sizes: &[f64],
    region: &[Interval],
    q: &[f64],
) -> Result<Sheet, Fault> {
    let centre: Vec<f64> = region.iter().map(|x| x.mid()).collect();
    let thin = |all: &[f64]| all.iter().map(|x| Interval::from(*x)).collect::<Vec<_>>();
    let here = thin(q);
    let at = thin(&centre);
    let place = Region { q: &here, d: &at };
    let c = equations.residual(&place).map_err(Fault::Unknown)?;
    let first = equations.slopes(&place).map_err(Fault::Unknown)?;
    let frame = Frame::new(&first.by_q, sizes).ok_or(Fault::Singular)?;
    let slopes = frame.slopes(&first.by_d, centre.len());
    let moved: Vec<Interval> = region.iter().zip(&at).map(|(x, c)| *x - *c).collect();
    let n = sizes.len();
    let plane: Vec<Interval> = (0..n).map(|j| along(here[j], &slopes, j, &moved)).collect();

    let over = equations.slopes(&Region { q: &plane, d: region }).map_err(Fault::Unknown)?;
    let missed = frame.missed(&over, &slopes);
    let mut b = frame.applied(&c);
    for (column, moved) in missed.iter().zip(&moved) {
        b.iter_mut().zip(column).for_each(|(b, m)| *b = *b + *m * *moved);
    }
    let b_size: Vec<f64> = b.iter().map(|b| b.mag()).collect();
    let radius = b_size.iter().fold(LEAST, |m, b| m.max(4.0 * b));
    if !radius.is_finite() {
        return Err(Fault::Singular);
    }
    let around = |(j, x): (usize, &Interval)| *x + Interval::ball(up(radius * sizes[j]));
    let alone: Vec<Interval> = plane.iter().enumerate().map(around).collect();
    let over = equations.slopes(&Region { q: &alone, d: region }).map_err(Fault::Unknown)?;
    let r = frame.contraction(&over.by_q);
    let inner = settled(&b_size, &r, radius).ok_or(Fault::Singular)?;
    let off = (0..n).map(|j| {
        let rest = (0..n).fold(0.0, |sum, k| up(sum + up(r[(j, k)] * inner[k])));
        (-b[j] + Interval::ball(rest)) * Interval::from(sizes[j])
    });
    let off = off.collect();
    let mut bent = DMatrix::zeros(n, centre.len());
    for (k, column) in frame.missed(&over, &slopes).iter().enumerate() {
        let size: Vec<f64> = column.iter().map(|m| m.mag()).collect();
        let e = settled(&size, &r, f64::INFINITY).ok_or(Fault::Singular)?;
        (0..n).for_each(|j| bent[(j, k)] = up(e[j] * sizes[j]));
    }
    Ok(Sheet { region: region.to_vec(), centre, q: q.to_vec(), slopes, off, bent, alone })
}

/// Returns x + S_j Δ.
fn along(x: Interval, slopes: &DMatrix<f64>, j: usize, moved: &[Interval]) -> Interval {
    moved
        .iter()
        .enumerate()
        .fold(x, |sum, (k, moved)| sum + Interval::from(slopes[(j, k)]) * *moved)
}

impl Sheet {
    /// Returns bounds of the solution at a point of the box.
    fn at(&self, point: &[f64]) -> Vec<Interval> {
        let moved =
            point.iter().zip(&self.centre).map(|(x, c)| Interval::from(*x) - Interval::from(*c));
        let moved: Vec<Interval> = moved.collect();
        let of = |(j, q): (usize, &f64)| {
            along(Interval::from(*q) + self.off[j], &self.slopes, j, &moved)
        };
        self.q.iter().enumerate().map(of).collect()
    }

    /// Returns true if the point is in the box.
    pub(super) fn holds(&self, point: &[f64]) -> bool {
        self.region.iter().zip(point).all(|(region, x)| region.contains(*x))
    }

    /// Returns true if only the solution of this sheet can be near a position.
    pub(super) fn is_near(&self, q: &[f64]) -> bool {
        self.alone.iter().zip(q).all(|(alone, q)| alone.contains(*q))
    }

    /// Returns true if two sheets are equal at a point of both: the solution of one is in the
    /// region in which the other has no second solution.
    pub(super) fn is_joined(&self, other: &Sheet, point: &[f64]) -> bool {
        let inside = |a: &Sheet, b: &Sheet| {
            a.at(point).iter().zip(&b.alone).all(|(x, b)| b.contains(x.lo()) && b.contains(x.hi()))
        };
        self.holds(point) && other.holds(point) && (inside(self, other) || inside(other, self))
    }

    /// Returns bounds of the derivative of coordinate j by side k of the box.
    pub(super) fn slope(&self, j: usize, k: usize) -> Interval {
        Interval::from(self.slopes[(j, k)]) + Interval::ball(self.bent[(j, k)])
    }
}

impl<'a> Frame<'a> {
    fn new(by_q: &[Entry], sizes: &'a [f64]) -> Option<Self> {
        let n = sizes.len();
        let mut c_q = DMatrix::<f64>::zeros(n, n);
        by_q.iter().for_each(|(row, column, x)| c_q[(*row, *column)] += x.mid() * sizes[*column]);
        let weights: Vec<f64> = c_q.row_iter().map(|row| row.amax().recip()).collect();
        c_q.row_iter_mut().zip(&weights).for_each(|(mut row, w)| row *= *w);
        let inverse = c_q.lu().try_inverse()?;
        inverse.iter().all(|x| x.is_finite()).then_some(Frame { inverse, weights, sizes })
    }

    /// Returns S = −C_q⁻¹ C_d, rounded.
    fn slopes(&self, by_d: &[Entry], count: usize) -> DMatrix<f64> {
        let mut c_d = DMatrix::<f64>::zeros(self.sizes.len(), count);
        by_d.iter().for_each(|(row, k, x)| c_d[(*row, *k)] -= x.mid() * self.weights[*row]);
        let mut slopes = &self.inverse * c_d;
        slopes.row_iter_mut().zip(self.sizes).for_each(|(mut row, size)| row *= *size);
        slopes
    }

    /// Returns A C, for unscaled rows.
    fn applied(&self, c: &[Interval]) -> Vec<Interval> {
        let mut sums = vec![ZERO; c.len()];
        for (row, c) in c.iter().enumerate().filter(|(_, c)| **c != ZERO) {
            let c = *c * Interval::from(self.weights[row]);
            sums.iter_mut()
                .zip(self.inverse.column(row).iter())
                .for_each(|(sum, a)| *sum = *sum + Interval::from(*a) * c);
        }
        sums
    }

    /// Returns A (C_q S + C_d), column by column.
    fn missed(&self, over: &Slopes, slopes: &DMatrix<f64>) -> Vec<Vec<Interval>> {
        let column = |k: usize| {
            let mut rows = vec![ZERO; self.sizes.len()];
            for (row, column, x) in &over.by_q {
                rows[*row] = rows[*row] + *x * Interval::from(slopes[(*column, k)]);
            }
            let own = over.by_d.iter().filter(|(_, known, _)| *known == k);
            own.for_each(|(row, _, x)| rows[*row] = rows[*row] + *x);
            self.applied(&rows)
        };
        (0..slopes.ncols()).map(column).collect()
    }

    /// Returns bounds of |I − A C_q|.
    fn contraction(&self, by_q: &[Entry]) -> DMatrix<f64> {
        let n = self.sizes.len();
        let mut columns = vec![vec![ZERO; n]; n];
        (0..n).for_each(|k| columns[k][k] = Interval::from(-1.0));
        for (row, column, x) in by_q {
            let x = *x * Interval::from(self.sizes[*column]) * Interval::from(self.weights[*row]);
            columns[*column]
                .iter_mut()
                .zip(self.inverse.column(*row).iter())
                .for_each(|(sum, a)| *sum = *sum + Interval::from(*a) * x);
        }
        DMatrix::from_fn(n, n, |row, column| columns[column][row].mag())
    }
}
