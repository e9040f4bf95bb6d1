//! Defines numbers with a separate exponent, for intermediate results that are too large or too
//! small for an f64.

use std::f64::consts::{LN_2, LOG2_E};
use std::ops::{Add, Div, Mul, Neg, Sub};

use kin_graph::{Comparison, Function, Function2, Number};

/// x · 2ᵉ, with 1 ≤ |x| < 2 unless x is zero or not finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    x: f64,
    e: i64,
}

/// ln 2 in two parts. The first part has so few digits that its multiples by exponents are exact.
const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// The largest argument for which f64 can hold a value that grows like an exponential.
const ORDINARY: f64 = 700.0;

/// The distance of two exponents beyond which the smaller number does not change the sum.
const APART: i64 = 200;

impl Wide {
    pub(crate) fn new(x: f64) -> Self {
        Wide { x, e: 0 }.normal()
    }

    /// Returns the nearest f64: infinite if the number is too large, zero if it is too small.
    pub(crate) fn value(self) -> f64 {
        let e = self.e.clamp(-2200, 2200) as i32;
        let half = e / 2;
        // The product takes two steps, because 2^e alone may overflow where the product does not.
        self.x * f64::powi(2.0, half) * f64::powi(2.0, e - half)
    }

    fn normal(self) -> Self {
        if self.x == 0.0 || !self.x.is_finite() {
            return Wide { x: self.x, e: 0 };
        }
        let tiny = self.x.abs() < f64::MIN_POSITIVE;
        let (x, e) =
            if tiny { (self.x * f64::powi(2.0, 64), self.e - 64) } else { (self.x, self.e) };
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i64 - 1023;
        let x = f64::from_bits(bits & !(0x7ff << 52) | 1023 << 52);
        Wide { x, e: e.saturating_add(exponent) }
    }

    /// Returns true if f64 can hold the number.
    fn is_ordinary(self) -> bool {
        self.e.abs() < 1000
    }

    fn exponential(self) -> Self {
        let u = self.value();
        if !(u.abs() > ORDINARY && u.abs() < 1e15) {
            return Wide::new(u.exp());
        }
        let k = (u * LOG2_E).round();
        let rest = (u - k * LN_2_HIGH) - k * LN_2_LOW;
        Wide { x: rest.exp(), e: k as i64 }.normal()
    }

    fn logarithm(self) -> Self {
        if self.is_ordinary() {
            return Wide::new(self.value().ln());
        }
        Wide::new(self.x.ln() + self.e as f64 * LN_2)
    }

    /// Returns the root of degree n of a number that f64 cannot hold.
    fn root(self, n: i64, root: fn(f64) -> f64) -> Self {
        let left = self.e.rem_euclid(n);
        Wide { x: root(self.x * f64::powi(2.0, left as i32)), e: (self.e - left) / n }.normal()
    }

    /// Returns a function of a number that f64 cannot hold.
    fn call_beyond(self, f: Function) -> Self {
        match f {
            Function::Ln => self.logarithm(),
            Function::Ln1p if self.e > 0 => self.logarithm(),
            Function::Log2 => Wide::new(self.x.log2() + self.e as f64),
            Function::Log10 => Wide::new(self.logarithm().value() / std::f64::consts::LN_10),
            Function::Sqrt => self.root(2, f64::sqrt),
            Function::Cbrt => self.root(3, f64::cbrt),
            Function::Asinh if self.e > 0 => {
                Wide::new(self.twice().logarithm().value().copysign(self.x))
            }
            Function::Acosh if self.e > 0 && self.x > 0.0 => self.twice().logarithm(),
            _ => Wide::new(f.value()(self.value())),
        }
    }

    /// Returns 2 |x|, whose logarithm is arcosh, and with the sign arsinh, of a large number.
    fn twice(self) -> Self {
        Wide { x: self.x.abs(), e: self.e.saturating_add(1) }
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Wide { x: -self.x, e: self.e }
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if !self.x.is_finite() || !other.x.is_finite() {
            return Wide::new(self.value() + other.value());
        }
        if self.x == 0.0 || other.x == 0.0 {
            return if self.x == 0.0 && other.x == 0.0 {
                Wide::new(self.x + other.x)
            } else if self.x == 0.0 {
                other
            } else {
                self
            };
        }
        let (large, small) = if self.e >= other.e { (self, other) } else { (other, self) };
        match large.e.saturating_sub(small.e) {
            apart if apart > APART => large,
            apart => {
                Wide { x: large.x + small.x * f64::powi(2.0, -(apart as i32)), e: large.e }.normal()
            }
        }
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Wide { x: self.x * other.x, e: self.e.saturating_add(other.e) }.normal()
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Wide { x: self.x / other.x, e: self.e.saturating_sub(other.e) }.normal()
    }
}

impl Number for Wide {
    type Condition = bool;

    fn constant(x: f64) -> Self {
        Wide::new(x)
    }

    fn call(self, f: Function) -> Self {
        let u = self.value();
        let large = |sign: f64, e: Wide| Wide { x: 0.5 * sign * e.x, e: e.e }.normal();
        match f {
            Function::Exp => self.exponential(),
            Function::Exp2 if u.abs() > ORDINARY && u.abs() < 1e15 => {
                Wide { x: (u - u.floor()).exp2(), e: u.floor() as i64 }.normal()
            }
            Function::ExpM1 if u > ORDINARY => self.exponential(),
            Function::Sinh if u.abs() > ORDINARY => {
                large(u.signum(), Wide::new(u.abs()).exponential())
            }
            Function::Cosh if u.abs() > ORDINARY => large(1.0, Wide::new(u.abs()).exponential()),
            Function::Abs => Wide { x: self.x.abs(), e: self.e },
            _ if self.is_ordinary() => Wide::new(f.value()(u)),
            _ => self.call_beyond(f),
        }
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        let u = self.value();
        let v = other.value();
        let plain = f.value()(u, v);
        let is_exact =
            self.is_ordinary() && other.is_ordinary() && plain.is_finite() && plain != 0.0;
        match f {
            _ if is_exact => Wide::new(plain),
            Function2::Powf if self.x > 0.0 && self.x.is_finite() => {
                (other * self.logarithm()).exponential()
            }
            Function2::Hypot => (self * self + other * other).call(Function::Sqrt),
            Function2::Max if Self::compare(Comparison::GreaterEqual, &self, &other) => self,
            Function2::Max if Self::compare(Comparison::Less, &self, &other) => other,
            Function2::Min if Self::compare(Comparison::LessEqual, &self, &other) => self,
            Function2::Min if Self::compare(Comparison::Greater, &self, &other) => other,
            Function2::Atan2 if self.x.is_finite() && other.x.is_finite() => {
                let e = self.e.max(other.e);
                let near = |wide: Wide| Wide { e: wide.e.saturating_sub(e), ..wide }.value();
                Wide::new(near(self).atan2(near(other)))
            }
            _ => Wide::new(plain),
        }
    }

    fn powi(self, n: i32) -> Self {
        let mut power = Wide::new(1.0);
        let mut square = self;
        let mut left = n.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                power = power * square;
            }
            square = square * square;
            left >>= 1;
        }
        if n < 0 { Wide::new(1.0) / power } else { power }
    }

    fn compare(comparison: Comparison, a: &Self, b: &Self) -> bool {
        if a.is_ordinary() && b.is_ordinary() {
            return comparison.holds(&a.value(), &b.value());
        }
        comparison.holds(&(*a - *b).x, &0.0)
    }

    fn select(condition: &bool, a: Self, b: Self) -> Self {
        if *condition { a } else { b }
    }

    fn of_condition(condition: &bool) -> Self {
        Wide::new(if *condition { 1.0 } else { 0.0 })
    }

    fn holds(&self) -> bool {
        self.x != 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: Wide, exact: f64) {
        assert!((found.value() - exact).abs() <= 4e-15 * exact.abs(), "{found:?} {exact}");
    }

    #[test]
    fn numbers_are_those_of_f64_and_go_beyond() {
        for x in [1.0, -0.75, 3e300, 5e-324, -1e-310, 0.0] {
            assert_eq!(Wide::new(x).value(), x);
        }
        let large = Wide::new(2000.0).call(Function::Exp);
        assert!(large.value().is_infinite());
        near(large.call(Function::Ln), 2000.0);
        near(large / Wide::new(1999.0).call(Function::Exp), std::f64::consts::E);
        near((large * large).call(Function::Sqrt) / large, 1.0);
        near(large.powi(3).call(Function::Cbrt) / large, 1.0);
        near((large - large * Wide::new(0.5)) / large, 0.5);
        near(
            large.call2(Function2::Powf, Wide::new(-0.5))
                * large.call2(Function2::Powf, Wide::new(0.5)),
            1.0,
        );
        near(large.call2(Function2::Atan2, large), std::f64::consts::FRAC_PI_4);
        near(Wide::new(-900.0).call(Function::Sinh) / Wide::new(900.0).call(Function::Cosh), -1.0);
        assert!(Wide::compare(Comparison::Less, &large, &(large + large)));
        assert!(Wide::new(0.0).call(Function::Ln).value() == f64::NEG_INFINITY);
        assert!((Wide::new(0.0) / Wide::new(0.0)).value().is_nan());
    }
}
