//! Implements truncated Taylor series with intervals as coefficients: a function of σ, −1 ≤ σ ≤ 1,
//! as c0 + c1 σ + c2 σ² + ….
//!
//! A computation at one point gives the coefficients of its result at this point. A computation
//! over an interval of its inputs gives bounds c_k of f⁽ᵏ⁾/k! at every point of the interval, which
//! is the remainder of Taylor's formula (Moore, *Interval Analysis*, ch. 11). The number `len` says
//! how many coefficients have a meaning: over a kink only c0 and c1 have a meaning, over a jump no
//! coefficient has. Coefficient `len − 1` may jump if the coefficients before it are continuous,
//! because Taylor's formula demands no more.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::interval::{ALL, Interval, ONE, ZERO};

/// The highest order of a series.
pub(crate) const ORDER: usize = 6;
const FULL: usize = ORDER + 1;

/// Bounds of the values and the derivatives of a function of σ, −1 ≤ σ ≤ 1.
/// [`crate::law::LawFunction::over`] receives and returns such bounds.
///
/// The type has the operators of a number (`+`, `−`, `·`, `/`) and the functions of `f64`. The
/// results are valid for every value of the operands between their bounds, including rounding
/// errors.
#[derive(Clone, Copy, Debug)]
pub struct Series {
    c: [Interval; FULL],
    len: usize,
    /// Coefficients with a higher index are zero. Most parts of an equation do not move, or move
    /// along a line.
    degree: usize,
    turns: Turns,
}

/// The whole turns by which the value of a function may be wrong, possibly different ones at
/// different points: 2π `unit` n with a whole number n of size `most` or less. A `unit` of 0 means
/// no turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turns {
    pub unit: u32,
    pub most: u32,
}

impl Turns {
    pub const NONE: Turns = Turns { unit: 0, most: 0 };
    /// One turn either way: for an angle that may have passed its cut.
    pub const ONE: Turns = Turns { unit: 1, most: 1 };

    pub fn is_none(self) -> bool {
        self.most == 0
    }

    /// Returns the turns of a sum.
    fn and(self, other: Turns) -> Turns {
        Turns { unit: divisor(self.unit, other.unit), most: self.most.saturating_add(other.most) }
    }

    /// Returns the turns of a multiple, or `None` if they are not whole turns.
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

/// A series that gives no bounds.
pub(crate) const UNKNOWN: Series =
    Series { c: [ALL; FULL], len: 0, degree: ORDER, turns: Turns::NONE };

impl Series {
    /// Creates a constant number.
    pub fn number(x: f64) -> Self {
        Series::constant(Interval::from(x))
    }

    /// Returns the smallest and the largest value; both are infinite if the values are unknown.
    pub fn values(&self) -> [f64; 2] {
        if self.is_open() {
            [f64::NEG_INFINITY, f64::INFINITY]
        } else {
            [self.c[0].lo(), self.c[0].hi()]
        }
    }

    /// Returns f of the series, from bounds \[smallest, largest\] of f, f′, f″, … (up to the sixth
    /// derivative) over the range [`Series::values`].
    ///
    /// All derivatives in the list except the last must be continuous over this range. If the law
    /// has a break in the range, give only the bounds up to the derivative that jumps. If the law
    /// itself jumps, give no bounds.
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

    /// Makes a constant with the bounds `x`.
    pub(crate) fn constant(x: Interval) -> Self {
        let mut c = [ZERO; FULL];
        c[0] = x;
        Series { c, len: FULL, degree: 0, turns: Turns::NONE }
    }

    /// Makes x + v σ with `len` coefficients.
    pub(crate) fn variable(x: Interval, v: Interval, len: usize) -> Self {
        Series::of(&[x, v], len)
    }

    /// Makes a series from the first `len` coefficients of a polynomial.
    pub(crate) fn of(c: &[Interval], len: usize) -> Self {
        let mut series = Series { len, ..Series::constant(ZERO) };
        series.c.iter_mut().zip(c).for_each(|(to, from)| *to = *from);
        series.degree = series.c.iter().rposition(|c| *c != ZERO).unwrap_or(0);
        series
    }

    /// Makes a series by a recurrence, which gives each coefficient from those before it.
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

    /// Returns how many coefficients are known.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Returns the coefficients that are known.
    pub(crate) fn known(&self) -> &[Interval] {
        &self.c[..self.len]
    }

    /// Returns coefficient k, or the interval of all numbers if the coefficient is unknown.
    pub(crate) fn at(&self, k: usize) -> Interval {
        if k < self.len { self.c[k] } else { ALL }
    }

    /// Returns bounds of all values.
    pub(crate) fn value(&self) -> Interval {
        self.at(0)
    }

    /// Returns true if the series is known to be constant.
    pub(crate) fn is_constant(&self) -> bool {
        self.len == FULL && self.degree == 0
    }

    /// Returns the value of a constant whose bounds coincide, else `None`.
    pub(crate) fn as_number(&self) -> Option<f64> {
        (self.is_constant() && self.value().is_thin()).then_some(self.value().mid())
    }

    /// Returns the index of the last coefficient that may differ from zero.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    pub(crate) fn turns(&self) -> Turns {
        self.turns
    }

    /// Returns true if the series gives no bounds, or only bounds up to whole turns.
    pub(crate) fn is_open(&self) -> bool {
        self.len == 0 || !self.turns.is_none()
    }

    /// Returns the series with bounds that hold only up to `turns`.
    pub(crate) fn up_to(self, turns: Turns) -> Self {
        Series { turns, ..self }
    }

    /// Returns the series with `len` coefficients at most.
    pub(crate) fn cut(self, len: usize) -> Self {
        Series { len: self.len.min(len), ..self }
    }

    /// Returns the series with other bounds of the values.
    pub(crate) fn with_value(mut self, x: Interval) -> Self {
        self.c[0] = x;
        self
    }

    /// Applies f to the coefficients of both series, one by one.
    fn each(&self, other: &Self, f: impl Fn(Interval, Interval) -> Interval) -> Self {
        let len = self.len.min(other.len);
        let degree = self.degree.max(other.degree);
        let mut c = [ZERO; FULL];
        (0..len.min(degree + 1)).for_each(|k| c[k] = f(self.c[k], other.c[k]));
        Series { c, len, degree, turns: Turns::NONE }
    }

    /// Returns a series that bounds both functions at each point.
    pub(crate) fn hull(&self, other: &Self) -> Self {
        self.each(other, Interval::hull)
    }

    /// Returns bounds of a function that changes from this one to the other at a point where
    /// `agreement` coefficients of both agree. The first coefficient that does not agree may jump.
    pub(crate) fn joined(&self, other: &Self, agreement: usize) -> Self {
        if agreement == 0 { UNKNOWN } else { self.hull(other).cut(agreement + 1) }
    }

    /// Returns x².
    #[must_use]
    pub fn sqr(self) -> Self {
        (self * self).with_value(self.c[0].sqr())
    }

    /// Returns 1/x.
    #[must_use]
    pub fn recip(self) -> Self {
        Series::constant(ONE) / self
    }

    /// Returns factor · x.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        self * Series::constant(Interval::from(factor))
    }

    /// Returns x + c.
    #[must_use]
    pub fn plus(self, c: f64) -> Self {
        self + Series::constant(Interval::from(c))
    }

    /// Returns the function f(x) with values `value` and slope r(x) x′, where r(x) is f′(x).
    pub(crate) fn integral(&self, value: Interval, r: &Series) -> Self {
        // Without the slope, only the values are known.
        Series::recurring(value, self.len.min(r.len + 1), |k, _| self.slope_times(&r.c, k))
    }

    /// Returns Σ j x_j r_(k−j) / k over j = 1 … k: coefficient k of ∫ r x′.
    pub(crate) fn slope_times(&self, r: &[Interval], k: usize) -> Interval {
        let terms =
            (1..=k.min(self.degree)).map(|j| Interval::from(j as f64) * self.c[j] * r[k - j]);
        terms.fold(ZERO, Add::add) / Interval::from(k as f64)
    }

    /// Returns f(self) from the coefficients of f at the values of `self`.
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
