//! Truncated Taylor series with intervals for coefficients: a function of σ, −1 ≤ σ ≤ 1, as c0 + c1
//! σ + c2 σ²
//! + ….
//!
//! Run at one point, a computation gives the coefficients of its result there; run over an interval
//! of its inputs, c_k holds f⁽ᵏ⁾/k! at every point of it, which is the remainder of Taylor's
//! formula (Moore, *Interval Analysis*, ch. 11). How many coefficients mean anything is part of the
//! number: over a kink only c0 and c1 do, over a jump none. Coefficient `len − 1` may itself jump,
//! as long as those before it are continuous: that is all that Taylor's formula asks for.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::interval::{ALL, Interval, ONE, ZERO};

/// The highest order that is carried.
pub(crate) const ORDER: usize = 6;
const FULL: usize = ORDER + 1;

/// A function of σ, −1 ≤ σ ≤ 1, as bounds of its values and of its derivatives there: what
/// [`crate::model::law::LawFunction::over`] is asked for.
///
/// It is computed with like a number: `+`, `−`, `·`, `/`, and functions under f64's names. All
/// results hold whatever the operands may be between their bounds, rounding included.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    c: [Interval; FULL],
    len: usize,
    /// Coefficients beyond this one are zero: most of what an equation is made of does not move, or
    /// along a line.
    degree: usize,
    turns: Turns,
}

/// Whole turns that a function may be off by, other ones at other points: 2π `unit` n, n a whole
/// number,
/// |unit n| ≤ `most`. None for 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turns {
    pub unit: u32,
    pub most: u32,
}

impl Turns {
    pub const NONE: Turns = Turns { unit: 0, most: 0 };
    /// The turns up to which an angle is known that may have passed its cut.
    pub const ONE: Turns = Turns { unit: 1, most: 1 };

    pub fn is_none(self) -> bool {
        self.most == 0
    }

    /// Those of a sum.
    fn and(self, other: Turns) -> Turns {
        Turns { unit: divisor(self.unit, other.unit), most: self.most.saturating_add(other.most) }
    }

    /// Those of a multiple, if they are whole turns again.
    fn times(self, factor: f64) -> Option<Turns> {
        let times = |n: u32| {
            let product = f64::from(n) * factor.abs();
            let is_exact = f64::from(n).mul_add(factor.abs(), -product) == 0.0;
            (is_exact && product.fract() == 0.0 && (1.0..1e6).contains(&product))
                .then_some(product as u32)
        };
        Some(Turns { unit: times(self.unit)?, most: times(self.most)? })
    }
}

/// Nothing is known of it.
pub(crate) const UNKNOWN: Series =
    Series { c: [ALL; FULL], len: 0, degree: ORDER, turns: Turns::NONE };

impl Series {
    /// A number.
    pub fn number(x: f64) -> Self {
        Series::constant(Interval::from(x))
    }

    /// The least and the largest of its values; infinite where they are not known.
    pub fn values(&self) -> [f64; 2] {
        if self.is_open() {
            [f64::NEG_INFINITY, f64::INFINITY]
        } else {
            [self.c[0].lo(), self.c[0].hi()]
        }
    }

    /// f of it, from bounds \[least, largest\] of f, f′, f″, … (up to the sixth) over all of
    /// [`Series::values`].
    ///
    /// All but the last of them have to be continuous there: a law with a break between these
    /// values gives no more than those up to the derivative that jumps, none where it jumps itself.
    #[must_use]
    pub fn chain(&self, f: &[[f64; 2]]) -> Self {
        if self.is_open() {
            return UNKNOWN;
        }
        let mut factorial = 1.0;
        let coefficients = f.iter().enumerate().take(FULL).map(|(k, [lo, hi])| {
            factorial *= (k as f64).max(1.0);
            Interval::new(*lo, *hi) / Interval::from(factorial)
        });
        self.compose(&coefficients.collect::<Vec<_>>())
    }

    /// A number that does not change.
    pub(crate) fn constant(x: Interval) -> Self {
        let mut c = [ZERO; FULL];
        c[0] = x;
        Series { c, len: FULL, degree: 0, turns: Turns::NONE }
    }

    /// x + v σ, `len` coefficients of which are asked for.
    pub(crate) fn variable(x: Interval, v: Interval, len: usize) -> Self {
        Series::of(&[x, v], len)
    }

    /// The first `len` coefficients of a polynomial.
    pub(crate) fn of(c: &[Interval], len: usize) -> Self {
        let mut series = Series { len, ..Series::constant(ZERO) };
        series.c.iter_mut().zip(c).for_each(|(to, from)| *to = *from);
        series.degree = series.c.iter().rposition(|c| *c != ZERO).unwrap_or(0);
        series
    }

    /// Coefficients from a recurrence: each from those before it.
    pub(crate) fn recurring(
        first: Interval,
        len: usize,
        next: impl Fn(usize, &[Interval]) -> Interval,
    ) -> Self {
        let mut c = [ZERO; FULL];
        c[0] = first;
        for k in 1..len {
            c[k] = next(k, &c);
        }
        Series { c, len, degree: len.saturating_sub(1), turns: Turns::NONE }
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

    /// True if it is known not to change.
    pub(crate) fn is_constant(&self) -> bool {
        self.len == FULL && self.degree == 0
    }

    /// The number that it is, if it is one that is known.
    pub(crate) fn as_number(&self) -> Option<f64> {
        (self.is_constant() && self.value().is_thin()).then_some(self.value().mid())
    }

    /// Coefficients beyond this one are zero.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    pub(crate) fn turns(&self) -> Turns {
        self.turns
    }

    /// True if nothing of it is known, or it only up to whole turns.
    pub(crate) fn is_open(&self) -> bool {
        self.len == 0 || !self.turns.is_none()
    }

    /// The same, known up to whole turns alone.
    pub(crate) fn up_to(self, turns: Turns) -> Self {
        Series { turns, ..self }
    }

    /// No more than `len` coefficients of it.
    pub(crate) fn cut(self, len: usize) -> Self {
        Series { len: self.len.min(len), ..self }
    }

    /// The same with other values.
    pub(crate) fn with_value(mut self, x: Interval) -> Self {
        self.c[0] = x;
        self
    }

    /// Coefficient by coefficient.
    fn each(&self, other: &Self, f: impl Fn(Interval, Interval) -> Interval) -> Self {
        let len = self.len.min(other.len);
        let degree = self.degree.max(other.degree);
        let mut c = [ZERO; FULL];
        (0..len.min(degree + 1)).for_each(|k| c[k] = f(self.c[k], other.c[k]));
        Series { c, len, degree, turns: Turns::NONE }
    }

    /// A function that is this one somewhere and the other elsewhere.
    pub(crate) fn hull(&self, other: &Self) -> Self {
        self.each(other, Interval::hull)
    }

    /// A function that goes over from this one to the other where so many coefficients of both
    /// agree: the first one that does not may jump.
    pub(crate) fn joined(&self, other: &Self, agreement: usize) -> Self {
        if agreement == 0 { UNKNOWN } else { self.hull(other).cut(agreement + 1) }
    }

    /// x²
    #[must_use]
    pub fn sqr(self) -> Self {
        (self * self).with_value(self.c[0].sqr())
    }

    /// 1/x
    #[must_use]
    pub fn recip(self) -> Self {
        Series::constant(ONE) / self
    }

    /// factor · x
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        self * Series::constant(Interval::from(factor))
    }

    /// x + c
    #[must_use]
    pub fn plus(self, c: f64) -> Self {
        self + Series::constant(Interval::from(c))
    }

    /// The function whose slope is r(x) x′ and whose values are `value`: f(x) where r(x) is f′(x).
    pub(crate) fn integral(&self, value: Interval, r: &Series) -> Self {
        // without its slope no more is known of it than its values
        Series::recurring(value, self.len.min(r.len + 1), |k, _| self.slope_times(&r.c, k))
    }

    /// Σ j x_j r_(k−j) / k over j = 1 … k: coefficient k of ∫ r x′.
    pub(crate) fn slope_times(&self, r: &[Interval], k: usize) -> Interval {
        let terms =
            (1..=k.min(self.degree)).map(|j| Interval::from(j as f64) * self.c[j] * r[k - j]);
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
        let step = self.with_value(ZERO).up_to(Turns::NONE);
        f[..len]
            .iter()
            .rev()
            .fold(Series::constant(ZERO), |sum, c| sum * step + Series::constant(*c))
            .cut(len)
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
        self.each(&other, Add::add).up_to(self.turns.and(other.turns))
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
        let is_zero = |x: &Series| x.is_constant() && x.value() == ZERO;
        if self.len.min(other.len) > 0 && (is_zero(&self) || is_zero(&other)) {
            return Series::constant(ZERO);
        }
        let turns = match (self.turns.is_none(), other.turns.is_none()) {
            (true, true) => Some(Turns::NONE),
            (false, true) => other.as_number().and_then(|factor| self.turns.times(factor)),
            (true, false) => self.as_number().and_then(|factor| other.turns.times(factor)),
            _ => None,
        };
        let Some(turns) = turns else { return UNKNOWN };
        let len = self.len.min(other.len);
        let degree = self.degree + other.degree;
        let mut c = [ZERO; FULL];
        for (k, c) in c.iter_mut().enumerate().take(len.min(degree + 1)) {
            let both = k.saturating_sub(other.degree)..=k.min(self.degree);
            *c = both.map(|j| self.c[j] * other.c[k - j]).fold(ZERO, Add::add);
        }
        Series { c, len, degree: degree.min(ORDER), turns }
    }
}

impl Div for Series {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let len = self.len.min(other.len);
        if other.c[0].contains(0.0) || self.is_open() || other.is_open() {
            return UNKNOWN;
        }
        Series::recurring(self.c[0] / other.c[0], len, |k, q| {
            let known =
                (1..=k.min(other.degree)).map(|j| other.c[j] * q[k - j]).fold(ZERO, Add::add);
            (self.c[k] - known) / other.c[0]
        })
    }
}
