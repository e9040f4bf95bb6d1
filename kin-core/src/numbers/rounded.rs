//! Defines numbers with a bound of their rounding error.

use std::ops::{Add, Div, Mul, Neg, Sub};

use kin_graph::{Function, Function2, Number, compared_by_value, rules};

/// A number with a bound of its error to first order, from the roundings of its computation and the
/// errors of its operands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounded {
    pub x: f64,
    /// The bound, in the unit of x.
    pub off: f64,
}

/// The rounding error of one operation, and of a function of the list, as a share of the result.
/// \[-\]
const OPERATION: f64 = f64::EPSILON;
const FUNCTION: f64 = 8.0 * f64::EPSILON;

impl Rounded {
    pub(crate) fn new(x: f64, off: f64) -> Self {
        Rounded { x, off }
    }

    /// Returns f(self), from f and f′ at the value; if f′ is unknown, f counts as flat.
    pub(crate) fn through(self, f: f64, slope: f64) -> Self {
        let off = if slope.is_finite() { carried(slope, self.off) } else { 0.0 };
        Rounded::result(f, off, FUNCTION)
    }

    /// Returns the result x of an operation with the error `off` from its operands and `share` from
    /// its rounding.
    fn result(x: f64, off: f64, share: f64) -> Self {
        Rounded { x, off: off + share * x.abs() }
    }
}

/// Returns the part of the result's error that comes from an operand: 0 for an exact operand,
/// whatever the slope.
fn carried(slope: f64, off: f64) -> f64 {
    if off == 0.0 { 0.0 } else { (slope * off).abs() }
}

impl Neg for Rounded {
    type Output = Self;

    fn neg(self) -> Self {
        Rounded { x: -self.x, off: self.off }
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Rounded::result(self.x + other.x, self.off + other.off, OPERATION)
    }
}

impl Sub for Rounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let off = carried(other.x, self.off) + carried(self.x, other.off) + self.off * other.off;
        Rounded::result(self.x * other.x, off, OPERATION)
    }
}

impl Div for Rounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let x = self.x / other.x;
        let off = carried(other.x.recip(), self.off) + carried(x / other.x, other.off);
        Rounded::result(x, off, OPERATION)
    }
}

impl Number for Rounded {
    compared_by_value!(|number| number.x);

    fn constant(x: f64) -> Self {
        Rounded { x, off: 0.0 }
    }

    fn call(self, f: Function) -> Self {
        let x = f.value()(self.x);
        let off = if self.off == 0.0 { 0.0 } else { carried(rules::slope(f, self.x, x), self.off) };
        Rounded::result(x, off, if f.facts().is_exact() { 0.0 } else { FUNCTION })
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        let x = f.value()(self.x, other.x);
        let off = if self.off == 0.0 && other.off == 0.0 {
            0.0
        } else {
            let (by_self, by_other) = rules::slopes(f, self.x, other.x, x);
            carried(by_self, self.off) + carried(by_other, other.off)
        };
        Rounded::result(x, off, if f.facts().exact { 0.0 } else { FUNCTION })
    }

    fn powi(self, n: i32) -> Self {
        let slope = if n == 0 { 0.0 } else { f64::from(n) * self.x.powi(n.saturating_sub(1)) };
        Rounded::result(self.x.powi(n), carried(slope, self.off), FUNCTION)
    }
}

#[cfg(test)]
mod tests {
    use kin_graph::{Function, Function2};

    use super::*;
    use crate::numbers::real::{Dual2_64, Real};
    use crate::numbers::with_rate::WithRate;

    type Twice = WithRate<WithRate<Rounded>>;

    fn moving([x, v, a]: [f64; 3]) -> Twice {
        let still = |x| Rounded::new(x, f64::EPSILON);
        let once = |x, rate| WithRate { x: still(x), rate: Some(still(rate)) };
        WithRate { x: once(x, v), rate: Some(once(v, a)) }
    }

    #[test]
    fn derivatives_are_those_of_dual_numbers() {
        let a = [0.7, -1.3, 0.4];
        let b = [0.9, 0.2, -2.1];
        let dual = |[x, v, a]: [f64; 3]| Real(Dual2_64::new(x, v, a));
        fn made<N: Number>(x: N, y: N) -> N {
            let sum = x.clone() * y.clone() + N::constant(2.0).call2(Function2::Atan2, x.clone());
            sum.call(Function::Tanh) / (x.clone().powi(3) - y.clone().call(Function::Exp))
                - y.call2(Function2::Powf, x)
        }
        let found = made(moving(a), moving(b));
        let exact = made(dual(a), dual(b)).0;
        let rate = found.rate.expect("it moves");
        for (found, exact) in
            [(found.x.x, exact.re), (rate.x, exact.v1), (rate.rate.expect("too"), exact.v2)]
        {
            assert!((found.x - exact).abs() < 1e-13 * (1.0 + exact.abs()), "{found:?} {exact}");
            assert!(found.off > 0.0 && found.off < 1e-12);
        }
    }

    #[test]
    fn what_cancels_keeps_the_error_of_its_terms() {
        let x = Rounded::new(0.3, 1e-16);
        let s = x.call(Function::Sin);
        let c = x.call(Function::Cos);
        let nothing = s * s + c * c - Rounded::constant(1.0);
        assert!(nothing.x.abs() <= nothing.off && nothing.off > 1e-16, "{nothing:?}");
        assert_eq!(Rounded::constant(0.0).call(Function::Sqrt).off, 0.0);
    }
}
