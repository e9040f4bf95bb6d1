//! Computes the branches at a bifurcation, where two curves of G(x) = C(q, t) = 0 cross, so that
//! G_x has rank n − 1 and two tangents exist.
//!
//! G_x has two null directions. Along these directions the curve satisfies one equation f(ξ) = 0 in
//! two unknowns (Lyapunov and Schmidt). The function f is the remaining residual of G when all
//! other equations are satisfied, in units of the combination b of rows that G_x cannot reach. The
//! matrix B = [G_x b; Φᵀ 0] is regular at the bifurcation. From B Kin computes f, its gradient and
//! its Hessian, by second-order terms along two directions. The function f has a critical point. If
//! f is zero at the critical point, two curves cross along the two null directions of the Hessian.
//! Otherwise the curves approach each other and separate again.

use nalgebra::{Matrix2, SymmetricEigen, Vector2};

use super::curve::{Curve, CurvePoint};
use crate::linear::Linear;
use crate::outcome::motion::Branch;
use crate::system::scaled::Model;

/// The largest number of Newton steps towards the critical point.
const ITERATIONS: usize = 30;

/// The search ends where a step is smaller than this. \[-\]
const TOLERANCE: f64 = 1e-12;

/// The |f| at the critical point, relative to the curvature of f, that counts as rounding. Curves
/// that part at a distance of 1e-6 thus count as crossing. \[-\]
const CROSSES: f64 = 1e-12;

/// The smooth continuation of a branch is within an angle of this cosine. \[-\]
const SMOOTH: f64 = 0.8;

/// dt/ds in scaled units below which the drivers rest on a branch. \[-\]
const STANDS: f64 = 1e-7;

/// The weight of time relative to coordinates in the distance of curves. It is not zero, so that a
/// driver at rest has a distance. \[-\]
const TIME: f64 = 1e-3;

/// Half of the step of a difference of second-order terms. \[-\]
const DIFFERENCE: f64 = 1e-3;

/// Two curves that cross.
pub(super) struct Branching {
    pub x: Vec<f64>,
    /// The tangents of the smooth continuation and of the other branch. The tangents have length 1
    /// in scaled units, and point to increasing time if time changes.
    pub tangents: [Vec<f64>; 2],
    /// The velocities and accelerations of these branches; `None` if the drivers rest.
    pub rates: [Option<Branch>; 2],
}

/// Looks for a crossing between two places of a curve, at the distance `s`.
pub(super) fn find(
    curve: &mut Curve<'_>,
    here: &CurvePoint,
    next: &CurvePoint,
    s: f64,
    sign: f64,
) -> Option<Branching> {
    let mut reduced = Reduced::new(curve, here);
    let middle = here.x.iter().zip(&next.x).zip(here.dx.iter().zip(&next.dx));
    let x = middle.map(|((a, b), (da, db))| 0.5 * (a + b) + 0.125 * s * (da - db)).collect();
    let enough = TOLERANCE.max(curve.rounding(&here.x));
    let (x, hessian) = reduced.critical(x, 2.0 * s.abs(), enough)?;
    // Time has no part in the decision, because its scale depends on where the walk along the curve
    // began.
    let rounding = curve.rounding(&x[..curve.model.n()]);
    if reduced.f.abs() > (CROSSES + rounding) * reduced.curvature(&hessian)
        || hessian.determinant() >= 0.0
    {
        return None;
    }
    let mut tangents = reduced.tangents(curve, hessian, sign);
    let along = |dx: &[f64]| curve.dot(dx, &here.dx);
    if along(&tangents[1]).abs() > along(&tangents[0]).abs() {
        tangents.swap(0, 1);
    }
    if along(&tangents[0]) < SMOOTH {
        return None;
    }
    let rates = [0, 1].map(|k| reduced.rates(curve, &x, &tangents[k]));
    Some(Branching { x, tangents, rates })
}

/// Returns the place where two curves cross, between two places of one of them at the distance
/// `s`.
pub(crate) fn crossing_between(
    curve: &mut Curve<'_>,
    here: &CurvePoint,
    next: &CurvePoint,
    s: f64,
) -> Option<Vec<f64>> {
    find(curve, here, next, s, 1.0).map(|crossing| crossing.x)
}

/// The reduced equation at the last x.
struct Reduced<'a> {
    model: Model<'a>,
    sizes: Vec<f64>,
    linear: Linear,
    b: Vec<f64>,
    /// The directions Φ, in scaled units.
    phi: [Vec<f64>; 2],
    f: f64,
    /// x′ along each direction.
    v: [Vec<f64>; 2],
}

impl<'a> Reduced<'a> {
    /// Creates the equation, reduced by the null vectors of a nearby place.
    fn new(curve: &mut Curve<'a>, near: &CurvePoint) -> Self {
        let model = curve.model;
        let n = curve.model.n();
        let (left, right, _) = curve.linear.nearly_null();
        let b: Vec<f64> =
            left.iter().zip(curve.linear.row_units()).take(n).map(|(y, unit)| y / unit).collect();
        let mut other: Vec<f64> =
            right.iter().zip(curve.linear.column_units()).map(|(v, unit)| v * unit).collect();
        let along = curve.dot(&other, &near.dx);
        other.iter_mut().zip(&near.dx).for_each(|(x, dx)| *x -= along * dx);
        let length = curve.dot(&other, &other).sqrt();
        other.iter_mut().for_each(|x| *x /= length);
        let places =
            model.equations.entries.iter().copied().chain((0..n).map(|row| Some((row, n))));
        let places = places.chain((0..n).map(|row| Some((row, n + 1))));
        let border = (0..2).flat_map(|k| (0..=n).map(move |column| Some((n + k, column))));
        let mut linear = Linear::new(n + 2, places.chain(border), &[]);
        let sizes = curve.sizes.clone();
        linear.set_sizes(&[&sizes[..], &[1.0]].concat());
        let v = [near.dx.clone(), other];
        let scaled =
            |v: &Vec<f64>| v.iter().zip(&sizes).map(|(v, size)| v / (size * size)).collect();
        let phi = [0, 1].map(|k| scaled(&v[k]));
        Reduced { model, sizes, linear, b, phi, f: f64::INFINITY, v }
    }

    /// Factors B at x and returns G.
    fn factor(&mut self, x: &[f64]) -> Option<Vec<f64>> {
        let (t, q) = x.split_last()?;
        let point = self.model.linearize(q, *t).ok()?;
        let c_t = self.model.c_t(q, *t).ok()?;
        let values =
            point.values.iter().chain(&c_t).chain(&self.b).chain(self.phi.iter().flatten());
        self.linear.values_mut().iter_mut().zip(values).for_each(|(place, value)| *place = *value);
        (self.linear.measure() && self.linear.factor()).then_some(point.c)
    }

    /// Solves B (y, m) = (r, e) and returns y and m.
    fn solve(&mut self, r: &[f64], e: [f64; 2]) -> (Vec<f64>, f64) {
        self.linear.rhs_mut().iter_mut().zip(r.iter().chain(&e)).for_each(|(place, x)| *place = *x);
        self.linear.solve();
        let (m, y) =
            self.linear.solution().split_last().map(|(m, y)| (*m, y.to_vec())).unwrap_or_default();
        (y, m)
    }

    /// Returns −(G_x v)_x v at x.
    fn second_order(&self, x: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let (t, q) = x.split_last()?;
        let (dt, dq) = v.split_last()?;
        self.model.second_order(q, *t, dq, *dt).ok()
    }

    /// Moves from x to the critical point of f, which must be within `reach`, by steps down to
    /// `enough`. Returns it with the Hessian.
    fn critical(
        &mut self,
        mut x: Vec<f64>,
        reach: f64,
        enough: f64,
    ) -> Option<(Vec<f64>, Matrix2<f64>)> {
        let (zeros, mut gone) = (vec![0.0; self.model.n()], Vector2::zeros());
        for _ in 0..ITERATIONS {
            let c = self.factor(&x)?;
            let (y, f) = self.solve(&c.iter().map(|c| -c).collect::<Vec<_>>(), [0.0; 2]);
            let off = self.length(&y);
            x.iter_mut().zip(&y).for_each(|(x, y)| *x += y);
            self.f = f;
            let mut gradient = Vector2::zeros();
            for k in 0..2 {
                let e = if k == 0 { [1.0, 0.0] } else { [0.0, 1.0] };
                (self.v[k], gradient[k]) = self.solve(&zeros, e);
            }
            let hessian = self.hessian(&x)?;
            let step = -(hessian.try_inverse()? * gradient);
            gone += step;
            let moved = gone.norm();
            if moved.is_nan() || moved > reach {
                return None;
            }
            for (x, (a, b)) in x.iter_mut().zip(self.v[0].iter().zip(&self.v[1])) {
                *x += step[0] * a + step[1] * b;
            }
            if step.norm() <= enough && off <= enough {
                return Some((x, hessian));
            }
        }
        None
    }

    /// Returns f_ij from second-order terms along v_i + v_j and v_i − v_j.
    fn hessian(&mut self, x: &[f64]) -> Option<Matrix2<f64>> {
        let combine = |a: f64, b: f64| {
            self.v[0].iter().zip(&self.v[1]).map(|(v, w)| a * v + b * w).collect::<Vec<f64>>()
        };
        let directions =
            [combine(1.0, 0.0), combine(0.0, 1.0), combine(0.5, 0.5), combine(0.5, -0.5)];
        let mut along = [0.0; 4];
        for (along, v) in along.iter_mut().zip(&directions) {
            let rhs = self.second_order(x, v)?;
            *along = self.solve(&rhs, [0.0; 2]).1;
        }
        let mixed = along[2] - along[3];
        Some(Matrix2::new(along[0], mixed, mixed, along[1]))
    }

    /// Returns the largest |f″| along a direction in which coordinates move by 1: the largest
    /// eigenvalue of the Hessian relative to lengths of coordinates, for any choice of directions.
    fn curvature(&self, hessian: &Matrix2<f64>) -> f64 {
        let n = self.model.n();
        let gram = |a: &[f64], b: &[f64]| -> f64 {
            let shares =
                a.iter().zip(b).zip(&self.sizes).map(|((a, b), size)| a / size * (b / size));
            shares
                .enumerate()
                .map(|(k, share)| if k < n { share } else { TIME * TIME * share })
                .sum()
        };
        let mixed = gram(&self.v[0], &self.v[1]);
        let lengths =
            Matrix2::new(gram(&self.v[0], &self.v[0]), mixed, mixed, gram(&self.v[1], &self.v[1]));
        let Some(by_lengths) = lengths.try_inverse().map(|inverse| inverse * hessian) else {
            return 0.0;
        };
        let middle = 0.5 * by_lengths.trace();
        middle.abs() + (middle * middle - by_lengths.determinant()).max(0.0).sqrt()
    }

    fn length(&self, v: &[f64]) -> f64 {
        v.iter().zip(&self.sizes).map(|(v, size)| (v / size).powi(2)).sum::<f64>().sqrt()
    }

    /// Returns the two null directions of an indefinite Hessian: λ₁ a² + λ₂ b² = 0 along its axes.
    /// Time moves with `sign`.
    fn tangents(&self, curve: &Curve<'_>, hessian: Matrix2<f64>, sign: f64) -> [Vec<f64>; 2] {
        let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(hessian);
        let size = eigenvalues.abs().map(f64::sqrt);
        let a = size[1];
        let b = size[0];
        [a, -a].map(|a| {
            let along = eigenvectors * Vector2::new(a, b);
            let mut dx: Vec<f64> = self.v[0]
                .iter()
                .zip(&self.v[1])
                .map(|(v, w)| along[0] * v + along[1] * w)
                .collect();
            let length = curve.dot(&dx, &dx).sqrt();
            let dt = dx.last().copied().unwrap_or_default();
            let length = if dt * sign < 0.0 { -length } else { length };
            dx.iter_mut().for_each(|dx| *dx /= length);
            dx
        })
    }

    /// Returns q̇ and q̈ on a branch at x. The terms of third order determine the part of q̈ that
    /// can move while the drivers rest.
    fn rates(&mut self, curve: &Curve<'_>, x: &[f64], dx: &[f64]) -> Option<Branch> {
        let dt = *dx.last()?;
        let time = *curve.sizes.last()?;
        let pace = (dt / time).abs();
        if pace <= STANDS {
            return None;
        }
        let v: Vec<f64> = dx.iter().map(|dx| dx / dt).collect();
        self.factor(x)?;
        let rhs = self.second_order(x, &v)?;
        let (y, _) = self.solve(&rhs, [0.0; 2]);
        let slack = *y.last()?;
        let particular: Vec<f64> = y.iter().zip(&v).map(|(y, v)| y - slack * v).collect();
        let a = *self.v[1].last()?;
        let b = -*self.v[0].last()?;
        let free: Vec<f64> = self.v[0].iter().zip(&self.v[1]).map(|(v, w)| a * v + b * w).collect();
        let share = 1.0 / self.length(&free);
        let third = |reduced: &mut Self, beta: f64| {
            let second: Vec<f64> =
                particular.iter().zip(&free).map(|(p, w)| p + beta * share * w).collect();
            let rhs = reduced.third_order(x, &v, &second)?;
            reduced.factor(x)?;
            Some((reduced.solve(&rhs, [0.0; 2]).1, second))
        };
        let unit = self.length(&v).powi(2);
        let f0 = third(self, 0.0)?.0;
        let f1 = third(self, unit)?.0;
        let (_, second) = third(self, -unit * f0 / (f1 - f0))?;
        let n = self.model.n();
        let branch = Branch { qd: v[..n].to_vec(), qdd: second[..n].to_vec() };
        branch.qd.iter().chain(&branch.qdd).all(|x| x.is_finite()).then_some(branch)
    }

    /// Returns d³/dτ³ of G(x + τ v + ½ τ² w) at τ = 0, by central differences of its second
    /// derivative (G_x v)_x v + G_x w, with Richardson extrapolation.
    fn third_order(&self, x: &[f64], v: &[f64], w: &[f64]) -> Option<Vec<f64>> {
        let unit = DIFFERENCE / self.length(v);
        let at = |tau: f64| {
            let moved: Vec<f64> =
                x.iter().zip(v).zip(w).map(|((x, v), w)| x + tau * (v + 0.5 * tau * w)).collect();
            let along: Vec<f64> = v.iter().zip(w).map(|(v, w)| v + tau * w).collect();
            let mut second: Vec<f64> =
                self.second_order(&moved, &along)?.iter().map(|x| -x).collect();
            let (t, q) = moved.split_last()?;
            let point = self.model.linearize(q, *t).ok()?;
            self.model
                .entries(&point.values)
                .for_each(|(row, column, value)| second[row] += value * w[column]);
            Some(second)
        };
        let slope = |tau: f64| {
            Some(
                at(tau)?
                    .into_iter()
                    .zip(at(-tau)?)
                    .map(|(a, b)| (a - b) / (2.0 * tau))
                    .collect::<Vec<f64>>(),
            )
        };
        let near = slope(unit)?;
        let far = slope(2.0 * unit)?;
        Some(near.iter().zip(&far).map(|(near, far)| (4.0 * near - far) / 3.0).collect())
    }
}

#[cfg(test)]
mod tests;
