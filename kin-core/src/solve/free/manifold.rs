//! The positions C(q) = 0 of a mechanism with freedom left: as many dimensions as freedoms.
//!
//! Independent rows of C_q and one row for each free coordinate form a square matrix A. Its inverse
//! gives a correction that leaves the free coordinates as they are, and the tangents: dq = A⁻¹ e_k
//! for each free coordinate k. Lengths are in units of the sizes of the coordinates.

use nalgebra::DMatrix;

use crate::linear::{Echelon, Linear, RANK};
use crate::system::scaled::{Measures, Model};

/// A basis is chosen again if its smallest pivot has faded to this share of its largest value.
/// \[-\]
const FADED: f64 = 0.01;

/// The largest number of Newton steps of one correction.
const ITERATIONS: usize = 20;

/// A correction ends below the first value. A correction below the second value that no longer
/// shrinks is rounding. \[-\]
const TOLERANCE: f64 = 1e-13;
const ROUNDING: f64 = 1e-9;

/// A correction that converges shrinks by this factor from step to step. \[-\]
const SHRINKS: f64 = 0.5;

/// The positions of a mechanism whose inactive rows are left out.
pub(crate) struct Manifold<'a> {
    pub model: Model<'a>,
    pub t: f64,
    pub measures: &'a Measures,
    active: &'a [bool],
    basis: Option<Basis>,
}

/// Independent rows and free columns of C_q, and the recorded elimination of both.
#[derive(Clone)]
pub(crate) struct Basis {
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// The values of C_q that the matrix contains, by their numbers.
    inside: Vec<usize>,
    linear: Linear,
    /// The largest value of the smallest pivot.
    best: f64,
}

impl<'a> Manifold<'a> {
    pub(crate) fn new(
        model: Model<'a>,
        t: f64,
        measures: &'a Measures,
        active: &'a [bool],
        basis: Option<Basis>,
    ) -> Self {
        Manifold { model, t, measures, active, basis }
    }

    /// Returns the basis, for the next call.
    pub(crate) fn into_basis(self) -> Option<Basis> {
        self.basis
    }

    /// Factors the matrix at q and returns C. Returns `None` if a value is not finite, or if the
    /// rank has fallen.
    fn factor(&mut self, q: &[f64]) -> Option<Vec<f64>> {
        let point = self.model.linearize(q, self.t).ok()?;
        let fits = self.basis.as_mut().is_some_and(|basis| basis.factor(&point.values));
        if !fits {
            let mut basis = self.chosen(&point.values)?;
            if !basis.factor(&point.values) {
                return None;
            }
            self.basis = Some(basis);
        }
        Some(point.c)
    }

    /// Chooses rows and free columns from the values of C_q.
    #[cold]
    fn chosen(&self, values: &[f64]) -> Option<Basis> {
        let active = |row: usize| self.active[row];
        let n = self.model.n();
        let echelon = Echelon::new(self.model.scaled(values, self.measures, &active), n, RANK);
        if self.basis.as_ref().is_some_and(|basis| echelon.rank() < basis.rows.len()) {
            return None;
        }
        let is_free = |row: &usize| echelon.free_rows.binary_search(row).is_ok();
        let rows: Vec<usize> = (0..self.model.m()).filter(|row| !is_free(row)).collect();
        let entries = self.model.equations.entries.iter().enumerate();
        let inside: Vec<(usize, (usize, usize))> = entries
            .filter_map(|(number, entry)| {
                let (row, column) = (*entry)?;
                Some((number, (rows.binary_search(&row).ok()?, column)))
            })
            .collect();
        let columns = echelon.free_columns;
        let own = columns.iter().enumerate().map(|(k, column)| Some((rows.len() + k, *column)));
        let pattern = inside.iter().map(|(_, place)| Some(*place)).chain(own);
        let mut linear = Linear::new(n, pattern, &vec![None; inside.len() + columns.len()]);
        linear.set_sizes(&self.measures.sizes);
        let own = linear.values_mut().iter_mut().skip(inside.len());
        own.zip(&columns).for_each(|(place, column)| *place = self.measures.sizes[*column].recip());
        let inside = inside.into_iter().map(|(number, _)| number).collect();
        Some(Basis { rows, columns, inside, linear, best: 0.0 })
    }

    /// Returns orthonormal tangents at q, one column each, in units of the sizes. Returns `None`
    /// where the rank falls.
    pub(crate) fn tangents(&mut self, q: &[f64]) -> Option<DMatrix<f64>> {
        self.factor(q)?;
        let n = self.model.n();
        let basis = self.basis.as_mut()?;
        let freedoms = basis.columns.len();
        let mut tangents = DMatrix::zeros(n, freedoms);
        for k in 0..freedoms {
            let rhs = basis.linear.rhs_mut();
            rhs.fill(0.0);
            rhs[n - freedoms + k] = 1.0;
            basis.linear.solve();
            let scaled = basis.linear.solution().iter().zip(&self.measures.sizes);
            tangents.column_mut(k).iter_mut().zip(scaled).for_each(|(x, (dq, s))| *x = dq / s);
        }
        let orthonormal = tangents.qr().q();
        orthonormal.iter().all(|x| x.is_finite()).then_some(orthonormal)
    }

    /// Returns the second derivative of q along the tangent v (in units of q) at the place that was
    /// factored last: C_q a = −(C_q v)_q v.
    pub(crate) fn bend(&mut self, q: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let rhs = self.model.second_order(q, self.t, v, 0.0).ok()?;
        Some(self.basis.as_mut()?.solve(|row| rhs[row]))
    }

    /// Makes one Newton step towards C(q) = 0 with the free coordinates at rest. Returns its length
    /// in units of the sizes.
    pub(crate) fn correct(&mut self, q: &mut [f64]) -> Option<f64> {
        let c = self.factor(q)?;
        let dq = self.basis.as_mut()?.solve(|row| -c[row]);
        q.iter_mut().zip(&dq).for_each(|(q, dq)| *q += dq);
        Some(self.length(dq.iter().copied()))
    }

    /// Takes q back to C(q) = 0. After each Newton step `also` makes another step and returns its
    /// length. Returns false if the steps do not shrink, or if the position is on the wrong branch
    /// of a constraint.
    pub(crate) fn restore(
        &mut self,
        q: &mut [f64],
        mut also: impl FnMut(&mut Self, &mut [f64]) -> Option<f64>,
    ) -> bool {
        let mut before = f64::INFINITY;
        let rounding = self.rounding(q);
        for _ in 0..ITERATIONS {
            let Some(own) = self.correct(q) else { return false };
            let Some(other) = also(self, q) else { return false };
            let length = own.hypot(other);
            let shrinks = length < SHRINKS * before;
            if length <= TOLERANCE || (!shrinks && length <= ROUNDING.max(rounding)) {
                return self.is_position(q);
            }
            if !shrinks {
                return false;
            }
            before = length;
        }
        false
    }

    /// Returns true if all active rows hold at q, and no constraint is on its wrong branch.
    fn is_position(&self, q: &[f64]) -> bool {
        let equations = self.model.equations;
        let Ok(point) = self.model.linearize(q, self.t) else { return false };
        self.model.met(&point, q, self.measures, &|row| self.active[row])
            && equations.first_wrong(&equations.instant_at(self.t, q)).is_none()
    }

    /// Returns the error of a place from rounding of q in units of the sizes.
    fn rounding(&self, q: &[f64]) -> f64 {
        let shares = q.iter().zip(&self.measures.sizes).map(|(q, size)| (q / size).abs());
        64.0 * f64::EPSILON * shares.fold(1.0, f64::max)
    }

    /// Returns the length of a change of q in units of the sizes.
    pub(crate) fn length(&self, dq: impl Iterator<Item = f64>) -> f64 {
        dq.zip(&self.measures.sizes).map(|(dq, size)| (dq / size).powi(2)).sum::<f64>().sqrt()
    }
}

impl Basis {
    /// Returns the number of freedoms.
    pub(crate) fn freedoms(&self) -> usize {
        self.columns.len()
    }

    /// Factors the matrix with these values of C_q. Returns false if the rows or columns no longer
    /// serve.
    fn factor(&mut self, values: &[f64]) -> bool {
        let places = self.linear.values_mut().iter_mut().zip(&self.inside);
        places.for_each(|(place, number)| *place = values[*number]);
        if !(self.linear.measure() && self.linear.factor()) {
            return false;
        }
        let pivot = self.linear.smallest_pivot();
        self.best = self.best.max(pivot);
        pivot >= FADED * self.best
    }

    /// Returns dq for a right side of the rows, with the free coordinates at rest.
    fn solve(&mut self, rhs: impl Fn(usize) -> f64) -> Vec<f64> {
        let places = self.linear.rhs_mut();
        places.fill(0.0);
        places.iter_mut().zip(&self.rows).for_each(|(place, row)| *place = rhs(*row));
        self.linear.solve();
        self.linear.solution().to_vec()
    }
}
