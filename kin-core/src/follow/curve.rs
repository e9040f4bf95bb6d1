//! The curve of solutions through x = (q, t), by its arc length s: regular where C_q is not, as long as [C_q C_t] has full rank.
//!
//! [C_q C_t; x₀′ᵀ] x′ = (0, 1) and [C_q C_t; x₀′ᵀ] x″ = (−(G_x x′)_x x′, 0) with G(x) = C(q, t); lengths and time are measured by the sizes
//! of the coordinates and by the time in which the drivers move something of order 1. (H. B. Keller's pseudo-arclength.)

use crate::linear::Linear;
use crate::model::Model;
use crate::system::System;

/// Newton steps of one correction.
const ITERATIONS: usize = 12;

/// A correction below this is at its end, and one below the second that no longer shrinks is rounding.   \[-\]
const TOLERANCE: f64 = 1e-13;
const ROUNDING: f64 = 1e-9;

/// A prediction may be off by this share of its step, the second correction may be this share of the first, and the tangent may turn by an
/// angle of this cosine.   \[-\]
const OFF: f64 = 0.05;
const SHRINKS: f64 = 0.2;
const STRAIGHT: f64 = 0.97;

/// The curve, and the means to go along it.
pub(super) struct Curve<'a> {
    pub model: Model<'a>,
    /// s_j of each coordinate, and the measure of time.
    pub sizes: Vec<f64>,
    pub linear: Linear,
    /// For C_q alone.
    own: Linear,
}

/// A place on the curve.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// (q, t)
    pub x: Vec<f64>,
    /// The tangent x′, of length 1 by the measures.
    pub dx: Vec<f64>,
    pub ddx: Vec<f64>,
    /// Whether det [C_q C_t; x′ᵀ] is negative.
    pub negative: bool,
    /// Whether the determinant of each block of C_q is, and its smallest pivot; none where C_q is singular.
    pub blocks: Option<(Vec<bool>, f64)>,
}

impl Place {
    pub(super) fn t(&self) -> f64 {
        self.x.last().copied().unwrap_or_default()
    }

    /// dt/ds, by the measure of time or not.
    pub(super) fn dt(&self) -> f64 {
        self.dx.last().copied().unwrap_or_default()
    }

    /// q̇ = q′/t′ and q̈ = (q″ − q̇ t″)/t′²
    pub(super) fn rates(&self) -> [Vec<f64>; 2] {
        let (dt, ddt) = (self.dt(), self.ddx.last().copied().unwrap_or_default());
        let n = self.x.len() - 1;
        let qd: Vec<f64> = self.dx[..n].iter().map(|dx| dx / dt).collect();
        let qdd = self.ddx.iter().zip(&qd).map(|(ddx, qd)| (ddx - qd * ddt) / (dt * dt)).collect();
        [qd, qdd]
    }

    /// x + s x′ + ½ s² x″
    pub(super) fn ahead(&self, s: f64) -> Vec<f64> {
        self.x.iter().zip(&self.dx).zip(&self.ddx).map(|((x, dx), ddx)| x + s * (dx + 0.5 * s * ddx)).collect()
    }
}

impl<'a> Curve<'a> {
    /// The curve of a system with as many equations as coordinates.
    pub(super) fn new(system: &'a System, sizes: &[f64], time: f64) -> Self {
        let (model, mut own) = (system.model(), system.linear());
        let n = model.n();
        own.set_sizes(sizes);
        let sizes: Vec<f64> = sizes.iter().copied().chain([time]).collect();
        let c_t = (0..n).map(|row| Some((row, n)));
        let border = (0..=n).map(|column| Some((n, column)));
        let mut linear = Linear::new(n + 1, model.equations.entries.iter().copied().chain(c_t).chain(border), &[]);
        linear.set_sizes(&sizes);
        Curve { model, sizes, linear, own }
    }

    /// The place at x, which is on the curve, with a tangent on the side of `along`.
    pub(super) fn place(&mut self, x: Vec<f64>, along: &[f64]) -> Option<Place> {
        self.factor(&x, along)?;
        let mut dx = self.solve(std::iter::repeat_n(0.0, self.model.n()).chain([1.0]));
        let length = self.dot(&dx, &dx).sqrt();
        dx.iter_mut().for_each(|dx| *dx /= length);
        self.factor(&x, &dx)?;
        let negative = self.linear.is_negative();
        let blocks = self.blocks();
        let (t, q) = x.split_last()?;
        let (dt, dq) = dx.split_last()?;
        let rhs = self.model.second_order(q, *t, dq, *dt).ok()?;
        let ddx = self.solve(rhs.into_iter().chain([0.0]));
        let finite = dx.iter().chain(&ddx).all(|x| x.is_finite());
        finite.then_some(Place { x, dx, ddx, negative, blocks })
    }

    /// One step of length s, if the curve is surely followed by it.
    pub(super) fn step(&mut self, here: &Place, s: f64) -> Option<Place> {
        let (place, off) = self.at(here, s)?;
        (off <= OFF * s.abs() && self.dot(&place.dx, &here.dx) >= STRAIGHT).then_some(place)
    }

    /// The place a step s further on, and by how much the prediction was off.
    pub(super) fn at(&mut self, here: &Place, s: f64) -> Option<(Place, f64)> {
        let mut x = here.ahead(s);
        let off = self.correct(&mut x, &here.dx)?;
        Some((self.place(x, &here.dx)?, off))
    }

    /// Newton's steps across the direction `border`; gives the length of the first one.
    pub(super) fn correct(&mut self, x: &mut [f64], border: &[f64]) -> Option<f64> {
        let (mut first, mut previous) = (0.0, f64::INFINITY);
        for k in 0..ITERATIONS {
            let c = self.factor(x, border)?;
            let d = self.solve(c.into_iter().map(|c| -c).chain([0.0]));
            let size = self.dot(&d, &d).sqrt();
            if k == 0 {
                first = size;
            }
            // What is not a number does not shrink.
            let shrinks = size < if k == 1 { SHRINKS * previous } else { previous };
            let settled = size <= TOLERANCE || (size > 0.5 * previous && size <= ROUNDING);
            if !(shrinks || settled) {
                return None;
            }
            x.iter_mut().zip(&d).for_each(|(x, d)| *x += d);
            if settled {
                return Some(first);
            }
            previous = size;
        }
        None
    }

    /// [C_q C_t; borderᵀ] at x, factored; gives C.
    fn factor(&mut self, x: &[f64], border: &[f64]) -> Option<Vec<f64>> {
        let (t, q) = x.split_last()?;
        let point = self.model.linearize(q, *t).ok()?;
        let c_t = self.model.c_t(q, *t).ok()?;
        let border = border.iter().zip(&self.sizes).map(|(dx, size)| dx / (size * size));
        let values = point.values.iter().copied().chain(c_t).chain(border);
        self.linear.values_mut().iter_mut().zip(values).for_each(|(place, value)| *place = value);
        (self.linear.measure() && self.linear.factor()).then_some(point.c)
    }

    /// The signs of C_q's blocks and its smallest pivot, at the x that was factored last.
    fn blocks(&mut self) -> Option<(Vec<bool>, f64)> {
        let values = self.own.values().len();
        self.own.values_mut().copy_from_slice(&self.linear.values()[..values]);
        if !(self.own.measure() && self.own.factor()) {
            return None;
        }
        let mut blocks = Vec::new();
        self.own.orientation(&mut blocks);
        Some((blocks, self.own.smallest_pivot()))
    }

    fn solve(&mut self, rhs: impl Iterator<Item = f64>) -> Vec<f64> {
        self.linear.rhs_mut().iter_mut().zip(rhs).for_each(|(place, x)| *place = x);
        self.linear.solve();
        self.linear.solution().to_vec()
    }

    /// The product of two directions by the measures.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.sizes).map(|((a, b), size)| a / size * (b / size)).sum()
    }
}
