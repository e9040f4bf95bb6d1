//! Shows by Krawczyk's test that exactly one solution exists near an approximate position, for
//! every time of an interval.

use nalgebra::{DMatrix, DVector};

use super::bounds::{Bounds, Entry, Unknown};
use crate::numbers::enclosure::interval::{Interval, ONE, ZERO, down, up};

/// Bounds around an approximate position at every time of an interval, for each coordinate.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Around {
    /// The solution is within this distance.
    pub inner: Vec<f64>,
    /// No other solution exists within this distance.
    pub outer: Vec<f64>,
    /// No other solution exists within this distance of the solution, at any one time.
    pub free: Vec<f64>,
}

impl Around {
    /// Creates the bounds of one interval of time.
    pub(super) fn new(inner: Vec<f64>, outer: Vec<f64>) -> Self {
        let free = outer.iter().zip(&inner).map(|(outer, inner)| down(outer - inner)).collect();
        Around { inner, outer, free }
    }
}

/// The reason why the test failed.
#[derive(Clone, Debug)]
pub(super) enum Fault {
    Unknown(Unknown),
    /// A row of C that is too far from zero, and its residual.
    Apart(usize, f64),
    /// C_q may be singular near this position and time.
    Singular(Vec<f64>, f64),
}

/// Approximate positions over an interval of time: the middle, all positions, and C at these
/// positions.
pub(super) struct Piece<'a> {
    pub middle: (Vec<f64>, f64),
    pub q: &'a [Interval],
    pub t: Interval,
    pub c: &'a [Interval],
}

/// The smallest radius, in characteristic sizes, within which the test excludes other solutions.
/// \[-\]
const LEAST: f64 = 1e-6;

/// The residual, in units of order 1, above which an equation counts as unsatisfied. A smaller
/// residual can be rounding. \[-\]
const MISSED: f64 = 1e-4;

/// Krawczyk's test with coordinates and rows in units of order 1. `sizes` are those of the
/// coordinates.
pub(super) struct Test<'a> {
    pub bounds: &'a Bounds<'a>,
    pub sizes: &'a [f64],
}

/// An approximation of C_q⁻¹ near the middle, and the factors that scale rows to order 1.
struct Frame {
    inverse: DMatrix<f64>,
    weights: Vec<f64>,
}

impl Test<'_> {
    /// Runs the test. A approximates C_q⁻¹, R bounds |I − A C_q| over a box of radius ρ around the
    /// positions, and b bounds |A C|. If b + R y < y ≤ ρ, a solution exists within b + R y
    /// (Brouwer). Then R has no eigenvalue of 1 or more (Collatz and Wielandt), so no mean of the
    /// C_q in the box is singular, and C has no two equal values in the box.
    pub(super) fn around(&self, place: &Piece<'_>) -> Result<Around, Fault> {
        let singular = || Fault::Singular(place.middle.0.clone(), place.middle.1);
        let frame = self.frame(place).ok_or_else(singular)?;
        let weighted: Vec<Interval> =
            place.c.iter().zip(&frame.weights).map(|(c, w)| *c * Interval::from(*w)).collect();
        let b = frame.residual(&weighted);
        let worst = b.iter().fold(0.0_f64, |m, b| m.max(*b));
        let spread =
            place.q.iter().zip(self.sizes).map(|(q, size)| q.radius() / size).fold(0.0, f64::max);
        let radius = spread.max(4.0 * worst).max(LEAST);
        let fault = || {
            let missed = (0..weighted.len())
                .max_by(|i, j| weighted[*i].mag().total_cmp(&weighted[*j].mag()));
            missed
                .filter(|row| weighted[*row].mag() > MISSED)
                .map_or_else(singular, |row| Fault::Apart(row, place.c[row].mag()))
        };
        if !radius.is_finite() {
            return Err(fault());
        }
        let reach = |j: usize| Interval::ball(up(radius * self.sizes[j]));
        let q: Vec<Interval> = place.q.iter().enumerate().map(|(j, q)| *q + reach(j)).collect();
        let entries = self.bounds.jacobian(&q, place.t).map_err(Fault::Unknown)?;
        let r = self.contraction(&frame, &entries);
        let inner = settled(&b, &r, radius).ok_or_else(fault)?;
        let scaled = |y: &[f64], outwards: fn(f64) -> f64| {
            y.iter().zip(self.sizes).map(|(y, size)| outwards(y * size)).collect()
        };
        let inner = scaled(&inner, up);
        Ok(Around::new(inner, scaled(&vec![radius; self.sizes.len()], down)))
    }

    /// Returns the frame at the middle, or `None` if C_q has no inverse or is not finite.
    fn frame(&self, place: &Piece<'_>) -> Option<Frame> {
        let n = self.sizes.len();
        let (q, t) = &place.middle;
        let model = self.bounds.system.model();
        let point = model.linearize(q, *t).ok()?;
        let mut c_q = DMatrix::<f64>::zeros(n, n);
        model
            .entries(&point.values)
            .for_each(|(row, column, value)| c_q[(row, column)] += value * self.sizes[column]);
        let weights: Vec<f64> = c_q.row_iter().map(|row| row.amax().recip()).collect();
        c_q.row_iter_mut().zip(&weights).for_each(|(mut row, w)| row *= *w);
        let inverse = c_q.lu().try_inverse()?;
        inverse.iter().all(|x| x.is_finite()).then_some(Frame { inverse, weights })
    }

    /// Returns bounds of |I − A C_q|.
    fn contraction(&self, frame: &Frame, entries: &[Entry]) -> DMatrix<f64> {
        let n = self.sizes.len();
        let mut columns = vec![vec![ZERO; n]; n];
        for (k, column) in columns.iter_mut().enumerate() {
            column[k] = -ONE;
        }
        for (row, column, value) in entries {
            let value =
                *value * Interval::from(self.sizes[*column]) * Interval::from(frame.weights[*row]);
            let products = frame.inverse.column(*row);
            for (sum, a) in columns[*column].iter_mut().zip(products.iter()) {
                *sum = *sum + Interval::from(*a) * value;
            }
        }
        DMatrix::from_fn(n, n, |row, column| columns[column][row].mag())
    }
}

impl Frame {
    /// Returns bounds of |A C|, with C in units of order 1.
    fn residual(&self, c: &[Interval]) -> Vec<f64> {
        let mut sums = vec![ZERO; c.len()];
        for (column, c) in self.inverse.column_iter().zip(c) {
            sums.iter_mut()
                .zip(column.iter())
                .for_each(|(sum, a)| *sum = *sum + Interval::from(*a) * *c);
        }
        sums.into_iter().map(Interval::mag).collect()
    }
}

/// Returns b + R y for a y that is above it and at most `radius`, with all operations rounded
/// upwards. Returns `None` if there is none.
pub(crate) fn settled(b: &[f64], r: &DMatrix<f64>, radius: f64) -> Option<Vec<f64>> {
    /// The factor by which y is above the last result, so that the next one can stay below.
    const ROOM: f64 = 1.02;
    let applied = |y: &DVector<f64>| -> Vec<f64> {
        let row = |(k, b): (usize, &f64)| {
            r.row(k).iter().zip(y.iter()).fold(*b, |sum, (r, y)| up(sum + up(r * y)))
        };
        b.iter().enumerate().map(row).collect()
    };
    let mut y = DVector::from_iterator(b.len(), b.iter().map(|b| ROOM * b + 1e-20));
    for _ in 0..200 {
        if !y.iter().all(|y| *y <= radius) {
            return None;
        }
        let z = applied(&y);
        if z.iter().zip(y.iter()).all(|(z, y)| z < y) {
            return Some(z);
        }
        y.iter_mut().zip(&z).for_each(|(y, z)| *y = ROOM * z + 1e-20);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mechanism;

    /// R y < y for some y is the same as a spectral radius below 1: matrices of one row, and one
    /// whose rows are large though it is not.
    #[test]
    fn a_map_that_does_not_shrink_its_box_proves_nothing() {
        let one = |r: f64| DMatrix::from_element(1, 1, r);
        for r in [1.0, 1.0 + 1e-9, 1.2, 1.4, 3.0, f64::INFINITY] {
            for b in [0.0, 1e-18, 1e-3] {
                assert_eq!(settled(&[b], &one(r), 1.0), None, "{r} {b}");
            }
        }
        let shear = DMatrix::from_row_slice(2, 2, &[0.5, 1e3, 0.0, 0.5]);
        assert!(settled(&[1e-12, 1e-12], &shear, 1.0).is_some());
        assert!(
            settled(&[1e-12, 1e-12], &DMatrix::from_row_slice(2, 2, &[0.0, 1e3, 2e-3, 0.0]), 1.0)
                .is_none()
        );
    }

    #[kin_macros::constraint]
    fn parabolas(x: Coord, y: Coord) -> [f64; 2] {
        [x * x - 1.0, 3.0 * y * y]
    }

    fn around(q: [f64; 2], c: [f64; 2], sizes: [f64; 2]) -> Result<Around, Fault> {
        let mut m = Mechanism::new("squares");
        let [x, y] = ["x", "y"].map(|name| m.length(name, 1.0).unwrap());
        m.add("squares", parabolas(x, y)).unwrap();
        let system = m.build().unwrap();
        let bounds = Bounds::new(&system).unwrap();
        let boxes = q.map(Interval::from);
        let c = c.map(Interval::from);
        Test { bounds: &bounds, sizes: &sizes }.around(&Piece {
            middle: (q.to_vec(), 0.0),
            q: &boxes,
            t: ZERO,
            c: &c,
        })
    }

    /// The test does not shrink the box: one that reaches over to the other root holds no
    /// proof, in whatever unit of size.
    #[test]
    fn no_box_reaches_over_to_another_solution() {
        for (sizes, proved) in [
            ([1.0, 1.0], true),
            ([1e3, 1.0], true),
            ([1e-3, 1e-3], true),
            ([1e7, 1.0], false),
            ([1.0, 1e7], false),
        ] {
            let found = around([1.0, 1.0], [0.0, 0.0], sizes);
            assert_eq!(found.is_ok(), proved, "{sizes:?}: {found:?}");
            if let Ok(Around { inner, outer, .. }) = found {
                let near = |x: f64, y: f64| (x - y).abs() < 1e-9 * y;
                assert!(
                    near(outer[0], LEAST * sizes[0])
                        && near(outer[1], LEAST * sizes[1])
                        && inner[0] < 1e-15 * sizes[0]
                );
            }
        }
    }

    /// Told is the equation that is missed most, or that nothing is missed and C_q may be singular.
    #[test]
    fn why_nothing_could_be_shown() {
        assert!(
            matches!(around([0.1, 1.0], [-0.99, 1e-9], [1.0; 2]), Err(Fault::Apart(0, by)) if (by - 0.99).abs() < 1e-9)
        );
        assert!(
            matches!(around([1.0, 0.1], [1e-9, 0.03], [1.0; 2]), Err(Fault::Apart(1, by)) if (by - 0.03).abs() < 1e-9)
        );
        for (q, c) in [
            ([1e-5, 1.0], [1e-10, 0.0]),
            ([1.0, 1e-5], [0.0, 3e-10]),
            ([1.0, 0.0], [0.0, 0.0]),
            ([0.0, 0.0], [0.0, 0.0]),
        ] {
            let found = around(q, c, [1.0; 2]);
            assert!(
                matches!(found, Err(Fault::Singular(ref at, _)) if *at == q),
                "{q:?}: {found:?}"
            );
        }
    }

    /// The radius found is at least the fixed point b/(1 − r), at most 30 % above it, and stays in
    /// the box.
    #[test]
    fn the_box_holds_the_fixed_point() {
        for (b, r) in [(1e-3, 0.0), (1e-3, 0.3), (1e-9, 0.9), (0.2, 0.5)] {
            let exact = b / (1.0 - r);
            let found = settled(&[b], &DMatrix::from_element(1, 1, r), 1.0).expect("settles")[0];
            assert!(found >= exact && found <= 1.3 * exact, "{b} {r}: {found:e} {exact:e}");
            assert_eq!(settled(&[b], &DMatrix::from_element(1, 1, r), 0.9 * exact), None);
        }
    }
}
