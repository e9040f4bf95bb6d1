//! Computes the curve of solutions through x = (q, t) by its arc length s.
//!
//! The curve is regular even where C_q is singular, if [C_q C_t] has full rank.
//!
//! The equations are [C_q C_t; x₀′ᵀ] x′ = (0, 1) and [C_q C_t; x₀′ᵀ] x″ = (−(G_x x′)_x x′, 0) with
//! G(x) = C(q, t). Lengths are in units of the sizes of the coordinates. Time is in units of the
//! time in which the drivers move something of order 1. (H. B. Keller's pseudo-arclength.)

use crate::linear::Linear;
use crate::system::System;
use crate::system::evaluate::{Instant, finite};
use crate::system::scaled::Model;

/// The largest number of Newton steps of one correction.
const ITERATIONS: usize = 12;

/// The iteration ends at a correction below the first value. A correction below the second value
/// that no longer shrinks is rounding. \[-\]
const TOLERANCE: f64 = 1e-13;
const ROUNDING: f64 = 1e-9;

/// At a singular place each correction is about half of the one before; rounding shrinks by less
/// than this factor. \[-\]
const STILL: f64 = 0.6;

/// Smaller pivots count as this one in the estimate of rounding. \[-\]
const SMALLEST: f64 = 1e-3;

/// The permitted error of a prediction as a share of its step, the permitted ratio of the second
/// correction to the first, and the cosine of the permitted rotation of the tangent. \[-\]
const OFF: f64 = 0.05;
const SHRINKS: f64 = 0.2;
const STRAIGHT: f64 = 0.97;

/// The curve, with workspace buffers.
pub(crate) struct Curve<'a> {
    pub model: Model<'a>,
    /// s_j of each coordinate, and the scale of time.
    pub sizes: Vec<f64>,
    pub linear: Linear,
    /// The solver for C_q alone; `None` if the signs of its blocks are not needed.
    own: Option<Linear>,
    /// The last place at which the equations were evaluated, with C, C_t and the values of C_q
    /// there.
    instant: Instant,
    c: Vec<f64>,
    c_t: Vec<f64>,
    values: Vec<f64>,
}

/// A place on the curve.
#[derive(Clone, Debug)]
pub(crate) struct CurvePoint {
    /// The point (q, t).
    pub x: Vec<f64>,
    /// The tangent x′, of length 1 in scaled units.
    pub dx: Vec<f64>,
    pub ddx: Vec<f64>,
    /// True if det [C_q C_t; x′ᵀ] is negative.
    pub negative: bool,
    /// For each block of C_q whether its determinant is negative, and the smallest pivot; `None`
    /// where C_q is singular, or if the curve does not compute them.
    pub blocks: Option<(Vec<bool>, f64)>,
}

impl CurvePoint {
    pub(crate) fn t(&self) -> f64 {
        self.x.last().copied().unwrap_or_default()
    }

    /// Returns dt/ds.
    pub(crate) fn dt(&self) -> f64 {
        self.dx.last().copied().unwrap_or_default()
    }

    /// Returns q̇ = q′/t′ and q̈ = (q″ − q̇ t″)/t′².
    pub(crate) fn rates(&self) -> [Vec<f64>; 2] {
        let dt = self.dt();
        let ddt = self.ddx.last().copied().unwrap_or_default();
        let n = self.x.len() - 1;
        let qd: Vec<f64> = self.dx[..n].iter().map(|dx| dx / dt).collect();
        let qdd = self.ddx.iter().zip(&qd).map(|(ddx, qd)| (ddx - qd * ddt) / (dt * dt)).collect();
        [qd, qdd]
    }

    /// Returns x + s x′ + ½ s² x″.
    pub(crate) fn ahead(&self, s: f64) -> Vec<f64> {
        self.x
            .iter()
            .zip(&self.dx)
            .zip(&self.ddx)
            .map(|((x, dx), ddx)| x + s * (dx + 0.5 * s * ddx))
            .collect()
    }
}

impl<'a> Curve<'a> {
    /// Creates the curve of a system with as many equations as coordinates.
    pub(crate) fn new(system: &'a System, sizes: &[f64], time: f64) -> Self {
        let model = system.model();
        let mut own = system.linear();
        let n = model.n();
        own.set_sizes(sizes);
        let sizes: Vec<f64> = sizes.iter().copied().chain([time]).collect();
        let c_t = (0..n).map(|row| Some((row, n)));
        let border = (0..=n).map(|column| Some((n, column)));
        let mut linear = Linear::new(
            n + 1,
            model.equations.entries.iter().copied().chain(c_t).chain(border),
            &[],
        );
        linear.set_sizes(&sizes);
        let instant = model.equations.instant();
        let mut values = vec![0.0; model.equations.entries.len()];
        model.equations.set_constants(&mut values);
        let [c, c_t] = [0; 2].map(|_| vec![0.0; n]);
        Curve { model, sizes, linear, own: Some(own), instant, c, c_t, values }
    }

    /// Returns the curve without the signs of the blocks of C_q at its places.
    pub(crate) fn without_blocks(self) -> Self {
        Curve { own: None, ..self }
    }

    /// Returns the place at x, which is on the curve, with a tangent on the side of `along`.
    pub(crate) fn place(&mut self, x: Vec<f64>, along: &[f64]) -> Option<CurvePoint> {
        self.factor(&x, along)?;
        let mut dx = self.solve(std::iter::repeat_n(0.0, self.model.n()).chain([1.0]));
        let length = self.dot(&dx, &dx).sqrt();
        dx.iter_mut().for_each(|dx| *dx /= length);
        self.factor(&x, &dx)?;
        let negative = self.linear.is_negative();
        let blocks = self.blocks();
        let (dt, dq) = dx.split_last()?;
        let equations = self.model.equations;
        equations.set_rates(dq, &mut self.instant);
        let mut rhs = vec![0.0; dq.len() + 1];
        equations.second_order(&self.instant, *dt, &mut rhs[..dq.len()]);
        finite(&rhs, "Q_d").ok()?;
        let ddx = self.solve(rhs.into_iter());
        let finite = dx.iter().chain(&ddx).all(|x| x.is_finite());
        finite.then_some(CurvePoint { x, dx, ddx, negative, blocks })
    }

    /// Makes one step of length s, if it certainly follows the curve.
    pub(crate) fn step(&mut self, here: &CurvePoint, s: f64) -> Option<CurvePoint> {
        let (place, off) = self.at(here, s)?;
        (off <= OFF * s.abs() && self.dot(&place.dx, &here.dx) >= STRAIGHT).then_some(place)
    }

    /// Returns the place a step s further on, and the error of the prediction.
    pub(crate) fn at(&mut self, here: &CurvePoint, s: f64) -> Option<(CurvePoint, f64)> {
        let mut x = here.ahead(s);
        let off = self.correct(&mut x, &here.dx)?;
        Some((self.place(x, &here.dx)?, off))
    }

    /// Corrects x by Newton's steps across the direction `border`, and returns the length of the
    /// first step.
    pub(crate) fn correct(&mut self, x: &mut [f64], border: &[f64]) -> Option<f64> {
        let mut first = 0.0;
        let mut previous = f64::INFINITY;
        let mut still = 0.5;
        let rounding = self.rounding(x);
        for k in 0..ITERATIONS {
            self.factor(x, border)?;
            self.linear.rhs_mut().iter_mut().zip(&self.c).for_each(|(place, c)| *place = -c);
            self.linear.rhs_mut()[self.c.len()] = 0.0;
            self.linear.solve();
            let d = self.linear.solution().to_vec();
            let size = self.dot(&d, &d).sqrt();
            if k == 0 {
                first = size;
            }
            // A small pivot magnifies rounding far from the origin.
            let allowed =
                ROUNDING.max(rounding / self.linear.smallest_pivot().clamp(SMALLEST, 1.0));
            // A size that is NaN does not count as smaller.
            let mut shrinks = size < if k == 1 { SHRINKS * previous } else { previous };
            if k == 1 && !shrinks && size <= 0.5 * previous && size <= allowed {
                // Either rounding, which does not shrink, or a singular place, where each step is
                // half of the one before.
                (shrinks, still) = (true, STILL);
            }
            let settled = (size <= TOLERANCE && still < STILL)
                || (size > still * previous && size <= allowed);
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

    /// Evaluates the equations at x and factors [C_q C_t; borderᵀ] there.
    fn factor(&mut self, x: &[f64], border: &[f64]) -> Option<()> {
        let (t, q) = x.split_last()?;
        let Curve { model, instant, c, c_t, values, .. } = self;
        let equations = model.equations;
        if instant.t() != *t {
            equations.set_time(*t, instant);
        }
        equations.set_position(q, instant);
        equations.linearize(q, instant, c, values);
        equations.finite(c, values).ok()?;
        equations.velocity_rhs(instant, c_t);
        finite(c_t, "C_t").ok()?;
        let border = border.iter().zip(&self.sizes).map(|(dx, size)| dx / (size * size));
        let by_time = self.c_t.iter().map(|rhs| 0.0 - rhs);
        let values = self.values.iter().copied().chain(by_time).chain(border);
        self.linear.values_mut().iter_mut().zip(values).for_each(|(place, value)| *place = value);
        (self.linear.measure() && self.linear.factor()).then_some(())
    }

    /// Returns the signs of C_q's blocks and its smallest pivot at the x that was factored last.
    fn blocks(&mut self) -> Option<(Vec<bool>, f64)> {
        let own = self.own.as_mut()?;
        let values = own.values().len();
        own.values_mut().copy_from_slice(&self.linear.values()[..values]);
        if !(own.measure() && own.factor()) {
            return None;
        }
        let mut blocks = Vec::new();
        own.orientation(&mut blocks);
        Some((blocks, own.smallest_pivot()))
    }

    fn solve(&mut self, rhs: impl Iterator<Item = f64>) -> Vec<f64> {
        self.linear.rhs_mut().iter_mut().zip(rhs).for_each(|(place, x)| *place = x);
        self.linear.solve();
        self.linear.solution().to_vec()
    }

    /// Returns the error of a place from rounding of x in scaled units. It is large far from the
    /// origin.
    pub(crate) fn rounding(&self, x: &[f64]) -> f64 {
        let shares = x.iter().zip(&self.sizes).map(|(x, size)| (x / size).abs());
        64.0 * f64::EPSILON * shares.fold(1.0, f64::max)
    }

    /// Returns the product of two directions in scaled units.
    pub(crate) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.sizes).map(|((a, b), size)| a / size * (b / size)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mechanism, constraint};

    /// A circle of radius 1 about (x0, 0), and y beside it.
    #[constraint]
    fn circle(x: Coord, y: Coord, t: Time, x0: f64, k: f64) -> [f64; 2] {
        [(x - x0) * (x - x0) + t * t - 1.0, y - k * (x - x0)]
    }

    #[constraint]
    fn cube(x: Coord, t: Time) -> f64 {
        x * x * x - 1.0 - t
    }

    /// A wave, in time of order 1.
    #[constraint]
    fn wave(x: Coord, t: Time) -> f64 {
        x - 0.01 * (10.0 * std::f64::consts::PI * t).sin()
    }

    fn system(x0: f64, k: f64) -> System {
        let mut m = Mechanism::new("circle");
        let [x, y] = ["x", "y"].map(|name| m.length(name, 0.8).expect("a new name"));
        m.add("c", circle(x, y, x0, k)).expect("adds");
        m.build().expect("builds")
    }

    fn of_one(add: impl FnOnce(&mut Mechanism, crate::coordinates::Coordinate)) -> System {
        let mut m = Mechanism::new("one");
        let x = m.length("x", 1.0).expect("a new name");
        add(&mut m, x);
        m.build().expect("builds")
    }

    /// Tangent, curvature, rates and pivots of a place, by measures that are not 1; the direction
    /// asked along need not be that of the curve.
    #[test]
    fn a_place_on_a_circle() {
        let system = system(0.0, 3.0);
        let sizes = [2.0, 5.0];
        let mut curve = Curve::new(&system, &sizes, 0.5);
        for sign in [1.0, -1.0] {
            let place =
                curve.place(vec![0.8, 2.4, 0.6], &[0.0, 0.3 * sign, sign]).expect("is regular");
            assert!(
                (curve.dot(&place.dx, &place.dx) - 1.0).abs() < 1e-14
                    && curve.dot(&place.dx, &place.ddx).abs() < 1e-13
            );
            assert!(
                place.dt() * sign > 0.0
                    && place.t() == 0.6
                    && place.negative == curve.linear.is_negative()
            );
            let [qd, qdd] = place.rates();
            let v = -0.75;
            let a = -1.0 / 0.512;
            for (found, exact) in qd.iter().zip([v, 3.0 * v]).chain(qdd.iter().zip([a, 3.0 * a])) {
                assert!((found - exact).abs() < 1e-12, "{qd:?} {qdd:?}");
            }
            assert_eq!((qd.len(), qdd.len()), (2, 2));
            let ahead = place.ahead(0.1);
            let off = (0..3)
                .map(|k| (ahead[k] - place.x[k] - 0.1 * place.dx[k] - 0.005 * place.ddx[k]).abs())
                .fold(0.0, f64::max);
            assert!(off < 1e-15);
            assert_eq!(place.blocks.expect("is regular").0.len(), 1);
        }
    }

    /// A step is as good as its prediction, and goes no further than the curve is straight; either
    /// way along.
    #[test]
    fn steps_along_a_circle() {
        let system = system(0.0, 0.0);
        let mut curve = Curve::new(&system, &[1.0, 1.0], 1.0);
        let here = curve.place(vec![0.8, 0.0, 0.6], &[0.0, 0.0, 1.0]).expect("is regular");
        for s in [0.01, 0.2, -0.2, 0.05] {
            let (place, off) = curve.at(&here, s).expect("settles");
            assert!((off - s.powi(4) / 8.0).abs() < s.abs().powi(5), "{off}");
            assert!(
                (place.x[0].hypot(place.x[2]) - 1.0).abs() < 1e-15
                    && curve.step(&here, s).is_some()
            );
            assert!(
                (place.x[2].atan2(place.x[0]) - 0.6_f64.atan2(0.8) - s).abs() < s.abs().powi(3)
            );
        }
        assert!(curve.step(&here, 0.5).is_none() && curve.at(&here, 0.5).is_some());

        let system = of_one(|m, x| assert!(m.add("c", wave(x)).is_ok()));
        let mut curve = Curve::new(&system, &[1.0], 1.0);
        let here = curve.place(vec![0.0, 0.0], &[0.0, 1.0]).expect("is regular");
        let (_, off) = curve.at(&here, 0.02).expect("settles");
        assert!(off > 0.01 * 0.02 && off < 0.04 * 0.02 && curve.step(&here, 0.02).is_some());
        let s = 0.2 * (1.0 + (0.1 * std::f64::consts::PI).powi(2)).sqrt();
        let (place, off) = curve.at(&here, s).expect("settles");
        assert!(
            off > 0.05
                && off < 0.08
                && curve.dot(&place.dx, &here.dx) > 0.99
                && curve.step(&here, s).is_none()
        );
    }

    /// Newton's method has to converge from the first: what shrinks slowly may end anywhere.
    #[test]
    fn corrections_that_shrink() {
        let system = system(0.0, 0.0);
        let mut curve = Curve::new(&system, &[1.0, 1.0], 1.0);
        let mut from = |radius: f64| {
            let mut x = [0.8 * radius, 0.0, 0.6 * radius];
            let first = curve.correct(&mut x, &[-0.6, 0.0, 0.8])?;
            assert!((x[0] - 0.8).abs() < 1e-14 && (x[2] - 0.6).abs() < 1e-14, "{x:?}");
            Some(first)
        };
        assert!(
            (from(1.3).expect("settles") - 0.69 / 2.6).abs() < 1e-14
                && from(2.0).is_none()
                && from(0.7).is_some()
        );

        let system = of_one(|m, x| assert!(m.add("c", cube(x)).is_ok()));
        assert!(Curve::new(&system, &[1.0], 1.0).correct(&mut [10.0, 0.0], &[0.0, 1.0]).is_none());
    }

    /// x and −x by turns, never nearer: no rounding, however small it is.
    #[constraint]
    fn to_and_fro(x: Coord, t: Time) -> f64 {
        if x >= t { (x - t).sqrt() } else { -(t - x).sqrt() }
    }

    #[test]
    fn corrections_that_go_to_and_fro_do_not_end() {
        let system = of_one(|m, x| assert!(m.add("c", to_and_fro(x)).is_ok()));
        for x in [1e-5, -1e-7] {
            assert!(Curve::new(&system, &[1.0], 1.0).correct(&mut [x, 0.0], &[0.0, 1.0]).is_none());
        }
    }

    /// x² + y = 2 + t, 3 x = y + 2, the first one times a factor.
    #[constraint]
    fn in_units(x: Coord, y: Coord, t: Time, factor: f64) -> [f64; 2] {
        [factor * (x * x + y - 2.0 - t), 3.0 * x - y - 2.0]
    }

    /// Pivots are those of order 1, whatever units equations come to have after a system was built.
    #[test]
    fn pivots_do_not_depend_on_units() {
        let pivot = |factor: f64| {
            let mut m = Mechanism::new("units");
            let [x, y] = ["x", "y"].map(|name| m.length(name, 1.0).expect("a new name"));
            m.add("c", in_units(x, y, 1.0)).expect("adds");
            let mut system = m.build().expect("builds");
            system.set("c.factor", factor).expect("sets");
            let place = Curve::new(&system, &[1.0, 1.0], 1.0)
                .place(vec![1.0, 1.0, 0.0], &[1.0, 3.0, 5.0])
                .expect("is regular");
            place.blocks.expect("is regular").1
        };
        let exact = pivot(1.0);
        assert!(exact > 0.1 && exact < 10.0);
        for factor in [1e6, 1e12] {
            assert!(
                (pivot(factor) / exact - 1.0).abs() < 1e-9,
                "{factor}: {} {exact}",
                pivot(factor)
            );
        }
    }

    /// Far from zero corrections end where rounding does.
    #[test]
    fn corrections_end_in_rounding() {
        let system = system(1e5, 0.0);
        let mut curve = Curve::new(&system, &[1.0, 1.0], 1.0);
        for k in 0..40 {
            let angle = 0.1 + 0.03 * f64::from(k);
            let mut x = [1e5 + 1.1 * angle.cos(), 0.0, 1.1 * angle.sin()];
            assert!(curve.correct(&mut x, &[-angle.sin(), 0.0, angle.cos()]).is_some(), "{angle}");
            assert!(((x[0] - 1e5).hypot(x[2]) - 1.0).abs() < 1e-10);
        }
    }
}
