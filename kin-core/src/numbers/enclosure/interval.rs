//! Implements interval arithmetic with outward rounding: the result of an operation contains the
//! exact result for all real numbers in the operands.
//!
//! The five operations of IEEE 754 (+, −, ×, /, √) round to the nearest number, so the number next
//! to the result is beyond the exact result. For the other functions of the platform
//! (`elementary.rs`), Kin relies on the error in units of the last place that the list of functions
//! gives.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers from `lo` to `hi`; a bound may be infinite, and is never NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// All real numbers: the interval that says nothing.
pub(crate) const ALL: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
pub(crate) const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };
pub(crate) const ONE: Interval = Interval { lo: 1.0, hi: 1.0 };
/// The interval from −1 to 1.
#[cfg(test)]
pub(crate) const UNIT: Interval = Interval { lo: -1.0, hi: 1.0 };
/// Bounds of π, which is above the nearest f64.
pub(crate) const PI: Interval =
    Interval { lo: std::f64::consts::PI, hi: std::f64::consts::PI.next_up() };

/// Returns a lower bound of a number that was rounded to x.
pub(crate) fn down(x: f64) -> f64 {
    x.next_down()
}

/// Returns an upper bound of a number that was rounded to x.
pub(crate) fn up(x: f64) -> f64 {
    x.next_up()
}

impl Interval {
    /// Makes an interval from its bounds, or [`ALL`] if they are in the wrong order or not numbers.
    pub(crate) fn new(lo: f64, hi: f64) -> Self {
        if lo <= hi { Interval { lo, hi } } else { ALL }
    }

    /// Makes the interval from −r to r.
    pub(crate) fn ball(r: f64) -> Self {
        Interval::new(-r.abs(), r.abs())
    }

    /// Returns π times a number.
    pub(crate) fn pi(factor: f64) -> Self {
        PI * Interval::from(factor)
    }

    pub(crate) fn lo(self) -> f64 {
        self.lo
    }

    pub(crate) fn hi(self) -> f64 {
        self.hi
    }

    /// Returns a number in the middle of a bounded interval.
    pub(crate) fn mid(self) -> f64 {
        let mid = 0.5 * self.lo + 0.5 * self.hi;
        if mid.is_nan() { 0.0 } else { mid.clamp(self.lo, self.hi) }
    }

    /// Returns the largest |x| in the interval.
    pub(crate) fn mag(self) -> f64 {
        (-self.lo).max(self.hi)
    }

    /// Returns half the width, rounded up.
    pub(crate) fn radius(self) -> f64 {
        0.5 * up(self.hi - self.lo)
    }

    /// Returns true if the interval is a single number.
    pub(crate) fn is_thin(self) -> bool {
        self.lo == self.hi
    }

    pub(crate) fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    pub(crate) fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    pub(crate) fn meets(self, other: Self) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }

    /// Returns the smallest interval around both.
    pub(crate) fn hull(self, other: Self) -> Self {
        Interval { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Returns the intersection, or `None` if it is empty.
    pub(crate) fn common(self, other: Self) -> Option<Self> {
        let lo = self.lo.max(other.lo);
        let hi = self.hi.min(other.hi);
        (lo <= hi).then_some(Interval { lo, hi })
    }

    /// Returns the squares of the numbers in the interval; the product of the interval with itself
    /// may be wider.
    pub(crate) fn sqr(self) -> Self {
        let Interval { lo: least, hi: most } = self.abs();
        Interval::new(down(least * least).max(0.0), if most == 0.0 { 0.0 } else { up(most * most) })
    }

    /// |x|
    pub(crate) fn abs(self) -> Self {
        Interval { lo: self.lo.max(-self.hi).max(0.0), hi: self.mag() }
    }

    /// Returns √x of the numbers ≥ 0 in the interval, or [`ALL`] if all are negative.
    pub(crate) fn sqrt(self) -> Self {
        if self.hi < 0.0 {
            return ALL;
        }
        let root =
            |x: f64, outwards: fn(f64) -> f64| if x <= 0.0 { 0.0 } else { outwards(x.sqrt()) };
        Interval::new(root(self.lo, down), root(self.hi, up))
    }
}

impl From<f64> for Interval {
    /// Makes the interval of one number, or [`ALL`] for a number that is not finite.
    fn from(x: f64) -> Self {
        if x.is_finite() { Interval { lo: x, hi: x } } else { ALL }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Interval { lo: -self.hi, hi: -self.lo }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self == ZERO {
            return other;
        }
        if other == ZERO {
            return self;
        }
        Interval::new(down(self.lo + other.lo), up(self.hi + other.hi))
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + (-other)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self == ZERO || other == ZERO {
            return ZERO;
        }
        if self == ONE {
            return other;
        }
        if other == ONE {
            return self;
        }
        // An infinite bound means numbers without limit: 0 · ∞ counts as 0, which lies between the
        // other products.
        around([self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi])
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return ALL;
        }
        if self == ZERO || other == ONE {
            return self;
        }
        // The divisor has one sign, so the bounds of the quotient are at its ends. A quotient ∞/∞
        // lies between the other quotients.
        around([self.lo / other.lo, self.lo / other.hi, self.hi / other.lo, self.hi / other.hi])
    }
}

/// Returns bounds around the exact values of these rounded numbers, ignoring NaN.
fn around(all: [f64; 4]) -> Interval {
    let (lo, hi) = all
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
    Interval::new(down(lo), up(hi))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_an_interval() {
        let x = Interval::new(-1.0, 3.0);
        assert_eq!((x.mid(), x.mag(), (-x).mag(), x.radius()), (1.0, 3.0, 3.0, 2.0_f64.next_up()));
        assert_eq!(
            (ALL.mid(), Interval::from(5e-324).mid(), Interval::new(-f64::MAX, f64::MAX).mid()),
            (0.0, 5e-324, 0.0)
        );
        assert_eq!((Interval::new(-5.0, -3.0).mag(), ZERO.mag()), (5.0, 0.0));
        // The radius includes the rounding error of the width.
        assert!(Interval::new(-1.0, 1e-17).radius() > 0.5);
        let half = [Interval::new(0.0, f64::INFINITY), Interval::new(f64::NEG_INFINITY, 0.0)];
        assert!(!half[0].is_finite() && !half[1].is_finite() && x.is_finite());
    }

    #[test]
    fn what_two_intervals_have_in_common() {
        let common = |a: [f64; 2], b: [f64; 2]| {
            Interval::new(a[0], a[1]).common(Interval::new(b[0], b[1])).map(|x| [x.lo, x.hi])
        };
        for (a, b, expected) in [
            ([0.0, 2.0], [1.0, 1.5], Some([1.0, 1.5])),
            ([0.0, 2.0], [-1.0, 1.0], Some([0.0, 1.0])),
            ([0.0, 1.0], [1.0, 2.0], Some([1.0, 1.0])),
            ([0.0, 1.0], [1.5, 2.0], None),
        ] {
            assert_eq!((common(a, b), common(b, a)), (expected, expected));
        }
    }

    /// Zeros and ones are exact, because equations contain many of them.
    #[test]
    fn zeros_and_ones_are_exact() {
        let x = Interval::new(-0.3, 0.7);
        assert_eq!([x + ZERO, ZERO + x, x - ZERO, x * ONE, ONE * x, x / ONE], [x; 6]);
        assert_eq!(
            [
                x * ZERO,
                ZERO * x,
                ALL * ZERO,
                ZERO * ALL,
                ZERO / Interval::new(1.0, 2.0),
                ZERO.sqrt(),
                ZERO.sqr(),
                ZERO.abs()
            ],
            [ZERO; 8]
        );
        assert_eq!((ONE.sqr().lo, ONE.sqrt().contains(1.0)), (1.0_f64.next_down(), true));
    }

    #[test]
    fn bounds_without_limit() {
        let up = Interval::new(1.0, f64::INFINITY);
        let down = Interval::new(f64::NEG_INFINITY, -1.0);
        let is = |found: Interval, lo: f64, hi: f64| {
            let near = |x: f64, y: f64| x == y || (x - y).abs() < 1e-15;
            assert!(
                near(found.lo, lo) && near(found.hi, hi) && found.lo <= lo && found.hi >= hi,
                "{found:?} {lo} {hi}"
            );
        };
        is(up / up, 0.0, f64::INFINITY);
        is(down / up, f64::NEG_INFINITY, 0.0);
        is(ALL / up, f64::NEG_INFINITY, f64::INFINITY);
        is(Interval::new(-2.0, 3.0) / up, -2.0, 3.0);
        is(Interval::new(0.0, 1.0) * up, 0.0, f64::INFINITY);
        is(Interval::new(-1.0, 0.0) * up, f64::NEG_INFINITY, 0.0);
        is(
            Interval::new(0.0, f64::INFINITY) * Interval::new(0.0, f64::INFINITY),
            0.0,
            f64::INFINITY,
        );
        is(Interval::new(0.0, 1.0) * ALL, f64::NEG_INFINITY, f64::INFINITY);
        is(up * down, f64::NEG_INFINITY, -1.0);
    }
}
