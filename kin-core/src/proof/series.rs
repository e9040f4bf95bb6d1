//! Truncated Taylor series with intervals for coefficients: a function of σ, −1 ≤ σ ≤ 1, as c0 + c1 σ + c2 σ² + ….
//!
//! Run at one point, a computation gives the coefficients of its result there; run over an interval of its inputs, c_k holds f⁽ᵏ⁾/k! at every point of
//! it, which is the remainder of Taylor's formula (Moore, *Interval Analysis*, ch. 11). How many coefficients mean anything is part of the number: over
//! a kink only c0 and c1 do, over a jump none. Coefficient `len − 1` may itself jump, as long as those before it are continuous: that is all that
//! Taylor's formula asks for.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::interval::{ALL, Interval, ONE, ZERO};

/// The highest order that is carried.
pub(crate) const ORDER: usize = 6;
const FULL: usize = ORDER + 1;

/// Coefficients c0, c1, … of a function of σ.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    c: [Interval; FULL],
    len: usize,
    /// Coefficients beyond this one are zero: most of what an equation is made of does not move, or along a line.
    degree: usize,
    /// 0, or a whole number k: the function is this one up to k whole turns, k 2π n for some whole n at each point.
    turns: u32,
}

/// Nothing is known of it.
pub(crate) const UNKNOWN: Series = Series { c: [ALL; FULL], len: 0, degree: ORDER, turns: 0 };

impl Series {
    /// A number that does not change.
    pub(crate) fn constant(x: Interval) -> Self {
        let mut c = [ZERO; FULL];
        c[0] = x;
        Series { c, len: FULL, degree: 0, turns: 0 }
    }

    /// x + v σ, `len` coefficients of which are asked for.
    pub(crate) fn variable(x: Interval, v: Interval, len: usize) -> Self {
        Series::of(&[x, v], len)
    }

    /// The first `len` coefficients of a polynomial.
    pub(crate) fn of(c: &[Interval], len: usize) -> Self {
        let mut series = Series { len: len.min(FULL), ..Series::constant(ZERO) };
        series.c.iter_mut().zip(c).for_each(|(to, from)| *to = *from);
        series.degree = series.c.iter().rposition(|c| *c != ZERO).unwrap_or(0);
        series
    }

    /// Coefficients from a recurrence: each from those before it.
    pub(super) fn recurring(first: Interval, len: usize, next: impl Fn(usize, &[Interval]) -> Interval) -> Self {
        let mut c = [ZERO; FULL];
        c[0] = first;
        for k in 1..len {
            c[k] = next(k, &c);
        }
        Series { c, len, degree: len.saturating_sub(1), turns: 0 }
    }

    /// How many coefficients are known.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// The coefficients that are known.
    pub(crate) fn known(&self) -> &[Interval] {
        &self.c[..self.len]
    }

    /// Coefficient k; everything where it is not known.
    pub(crate) fn at(&self, k: usize) -> Interval {
        if k < self.len { self.c[k] } else { ALL }
    }

    /// Its values, all of them.
    pub(crate) fn value(&self) -> Interval {
        self.at(0)
    }

    /// Whether it is known not to change.
    pub(crate) fn is_constant(&self) -> bool {
        self.len == FULL && self.degree == 0
    }

    /// Coefficients beyond this one are zero.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    pub(crate) fn turns(&self) -> u32 {
        self.turns
    }

    /// The same, known up to `turns` whole turns alone.
    pub(super) fn up_to(self, turns: u32) -> Self {
        Series { turns, ..self }
    }

    /// No more than `len` coefficients of it.
    pub(super) fn cut(self, len: usize) -> Self {
        Series { len: self.len.min(len), ..self }
    }

    /// The same with other values.
    pub(super) fn with_value(mut self, x: Interval) -> Self {
        self.c[0] = x;
        self
    }

    /// Coefficient by coefficient.
    fn each(&self, other: &Self, f: impl Fn(Interval, Interval) -> Interval) -> Self {
        let (len, degree, mut c) = (self.len.min(other.len), self.degree.max(other.degree), [ZERO; FULL]);
        (0..len.min(degree + 1)).for_each(|k| c[k] = f(self.c[k], other.c[k]));
        Series { c, len, degree, turns: 0 }
    }

    /// A function that is this one somewhere and the other elsewhere.
    pub(crate) fn hull(&self, other: &Self) -> Self {
        self.each(other, Interval::hull)
    }

    /// Of how many coefficients, from the first, those of two series may be the same.
    pub(super) fn agreement(&self, other: &Self) -> usize {
        self.known().iter().zip(other.known()).take_while(|(a, b)| a.meets(**b)).count()
    }

    /// A function that goes over from this one to the other where so many coefficients of both agree: the first one that does not may jump.
    pub(super) fn joined(&self, other: &Self, agreement: usize) -> Self {
        if agreement == 0 { UNKNOWN } else { self.hull(other).cut(agreement + 1) }
    }

    /// x²
    pub(crate) fn sqr(self) -> Self {
        let square = self * self;
        if square.len > 0 { square.with_value(self.c[0].sqr()) } else { square }
    }

    /// 1/x
    pub(crate) fn recip(self) -> Self {
        Series::constant(ONE) / self
    }

    /// factor · x
    pub(crate) fn times(self, factor: f64) -> Self {
        self * Series::constant(Interval::from(factor))
    }

    /// x + c
    pub(crate) fn plus(self, c: f64) -> Self {
        self + Series::constant(Interval::from(c))
    }

    /// The function whose slope is r(x) x′ and whose values are `value`: f(x) where r(x) is f′(x).
    pub(super) fn integral(&self, value: Interval, r: &Series) -> Self {
        // without its slope no more is known of it than its values
        Series::recurring(value, self.len.min(r.len + 1), |k, _| self.slope_times(&r.c, k))
    }

    /// Σ j x_j r_(k−j) / k over j = 1 … k: coefficient k of ∫ r x′.
    pub(super) fn slope_times(&self, r: &[Interval], k: usize) -> Interval {
        let terms = (1..=k.min(self.degree)).map(|j| Interval::from(j as f64) * self.c[j] * r[k - j]);
        terms.fold(ZERO, Add::add) / Interval::from(k as f64)
    }

    /// f(self) from the coefficients of f at its values.
    pub(crate) fn compose(&self, f: &[Interval]) -> Self {
        let len = self.len.min(f.len());
        if len == 0 {
            return UNKNOWN;
        }
        if self.is_constant() {
            return Series::constant(f[0]);
        }
        let step = self.with_value(ZERO).up_to(0);
        f[..len].iter().rev().fold(Series::constant(ZERO), |sum, c| sum * step + Series::constant(*c)).cut(len)
    }
}

impl Neg for Series {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.c.iter_mut().for_each(|c| *c = -*c);
        self
    }
}

fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

impl Add for Series {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.each(&other, Add::add).up_to(divisor(self.turns, other.turns))
    }
}

impl Sub for Series {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + (-other)
    }
}

impl Mul for Series {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let turns = match (self.turns, other.turns) {
            (0, 0) => Some(0),
            // a whole multiple of whole turns
            (turns, 0) => whole(&other).and_then(|n| turns.checked_mul(n)),
            (0, turns) => whole(&self).and_then(|n| turns.checked_mul(n)),
            _ => None,
        };
        let Some(turns) = turns else { return UNKNOWN };
        let (len, degree, mut c) = (self.len.min(other.len), self.degree + other.degree, [ZERO; FULL]);
        for (k, c) in c.iter_mut().enumerate().take(len.min(degree + 1)) {
            let both = k.saturating_sub(other.degree)..=k.min(self.degree);
            *c = both.map(|j| self.c[j] * other.c[k - j]).fold(ZERO, Add::add);
        }
        Series { c, len, degree: degree.min(ORDER), turns }
    }
}

/// |n| of a constant whole number n, except 0.
fn whole(x: &Series) -> Option<u32> {
    let n = x.value().lo();
    let fits = x.is_constant() && x.value().is_thin() && n.fract() == 0.0 && n != 0.0 && n.abs() < 1e6;
    fits.then_some(n.abs() as u32)
}

impl Div for Series {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let len = self.len.min(other.len);
        if len == 0 || other.c[0].contains(0.0) || self.turns + other.turns > 0 {
            return UNKNOWN;
        }
        Series::recurring(self.c[0] / other.c[0], len, |k, q| {
            let known = (1..=k.min(other.degree)).map(|j| other.c[j] * q[k - j]).fold(ZERO, Add::add);
            (self.c[k] - known) / other.c[0]
        })
    }
}
