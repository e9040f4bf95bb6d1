//! The numbers under [`Real`](super::Real): num-dual's scalars, with composition and division that are right at the edges.

use std::fmt::{Debug, Display};
use std::ops::{Add, Mul, Neg, Sub};

use num_dual::{Dual2_64, Dual3_64, Dual64, HyperDual64};

/// A scalar of num-dual that Kin computes with: `f64`, `Dual64`, `Dual2_64`, `Dual3_64` or `HyperDual64`.
///
/// Write functions for the dual route as `fn f<D: Dual>(x: Real<D>) -> Real<D>`. The trait is sealed.
pub trait Dual:
    sealed::Sealed
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Sub<f64, Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Neg<Output = Self>
    + Debug
    + Display
    + Copy
    + Send
    + Sync
    + 'static
{
    /// Whether the number notes where it ceases to be finite: only when a failure is looked into.
    #[doc(hidden)]
    const TRACED: bool = false;

    /// The real part.
    fn value(&self) -> f64;

    /// A number without derivatives.
    fn constant(x: f64) -> Self;

    /// Whether every derivative is exactly zero.
    fn is_constant(&self) -> bool;

    /// The same derivatives at another real part.
    fn with_value(self, x: f64) -> Self;

    /// The same value without derivatives.
    fn still(self) -> Self {
        Self::constant(self.value())
    }

    /// Composition with a scalar function (Faà di Bruno): `f` is its value and first three derivatives at the real part.
    ///
    /// A zero tangent times a derivative that is not finite is zero.
    fn chain(self, f: [f64; 4]) -> Self;

    /// self / b by the recurrence (q b)⁽ⁿ⁾ = a⁽ⁿ⁾, with a's real part divided by b's as in `f64`.
    fn quotient(self, b: Self) -> Self;
}

pub(super) mod sealed {
    pub trait Sealed {}
}

/// One term of the chain rule: 0 for a zero tangent, even where the derivative is not finite.
#[inline]
fn term(tangent: f64, derivative: f64) -> f64 {
    if tangent == 0.0 { 0.0 } else { tangent * derivative }
}

/// [`Dual`] for a number with parts `re` and the listed ones, from its chain rule and its quotient, `q` being its real part
/// and `r` the divisor's reciprocal.
macro_rules! dual {
    (
        $number:ident [$($part:ident),*],
        chain |$x:ident, $f:ident| $chain:expr,
        quotient |$a:ident, $b:ident, $q:ident, $r:ident| $quotient:expr
    ) => {
        impl sealed::Sealed for $number {}

        impl Dual for $number {
            #[inline]
            fn value(&self) -> f64 {
                self.re
            }

            #[inline]
            fn constant(x: f64) -> Self {
                Self::from_re(x)
            }

            #[inline]
            fn is_constant(&self) -> bool {
                true $(&& self.$part == 0.0)*
            }

            #[inline]
            fn with_value(self, x: f64) -> Self {
                Self { re: x, ..self }
            }

            #[inline]
            fn chain(self, $f: [f64; 4]) -> Self {
                let $x = self;
                $chain
            }

            #[inline]
            fn quotient(self, $b: Self) -> Self {
                let ($a, $q, $r) = (self, self.re / $b.re, $b.re.recip());
                $quotient
            }
        }
    };
}

dual! { Dual64 [eps],
    chain |x, f| Dual64::new(f[0], term(x.eps, f[1])),
    quotient |a, b, q, r| Dual64::new(q, (a.eps - q * b.eps) * r)
}

dual! { Dual2_64 [v1, v2],
    chain |x, f| Dual2_64::new(f[0], term(x.v1, f[1]), term(x.v2, f[1]) + term(x.v1 * x.v1, f[2])),
    quotient |a, b, q, r| {
        let q1 = (a.v1 - q * b.v1) * r;
        let q2 = (a.v2 - 2.0 * q1 * b.v1 - q * b.v2) * r;
        Dual2_64::new(q, q1, q2)
    }
}

dual! { Dual3_64 [v1, v2, v3],
    chain |x, f| {
        let second = term(x.v2, f[1]) + term(x.v1 * x.v1, f[2]);
        let third = term(x.v3, f[1]) + 3.0 * term(x.v1 * x.v2, f[2]) + term(x.v1 * x.v1 * x.v1, f[3]);
        Dual3_64::new(f[0], term(x.v1, f[1]), second, third)
    },
    quotient |a, b, q, r| {
        let q1 = (a.v1 - q * b.v1) * r;
        let q2 = (a.v2 - 2.0 * q1 * b.v1 - q * b.v2) * r;
        let q3 = (a.v3 - 3.0 * (q2 * b.v1 + q1 * b.v2) - q * b.v3) * r;
        Dual3_64::new(q, q1, q2, q3)
    }
}

dual! { HyperDual64 [eps1, eps2, eps1eps2],
    chain |x, f| {
        let mixed = term(x.eps1eps2, f[1]) + term(x.eps1 * x.eps2, f[2]);
        HyperDual64::new(f[0], term(x.eps1, f[1]), term(x.eps2, f[1]), mixed)
    },
    quotient |a, b, q, r| {
        let (q1, q2) = ((a.eps1 - q * b.eps1) * r, (a.eps2 - q * b.eps2) * r);
        HyperDual64::new(q, q1, q2, (a.eps1eps2 - q1 * b.eps2 - q2 * b.eps1 - q * b.eps1eps2) * r)
    }
}

impl sealed::Sealed for f64 {}

impl Dual for f64 {
    #[inline]
    fn value(&self) -> f64 {
        *self
    }

    #[inline]
    fn constant(x: f64) -> Self {
        x
    }

    #[inline]
    fn is_constant(&self) -> bool {
        true
    }

    #[inline]
    fn with_value(self, x: f64) -> Self {
        x
    }

    #[inline]
    fn chain(self, f: [f64; 4]) -> Self {
        f[0]
    }

    #[inline]
    fn quotient(self, b: Self) -> Self {
        self / b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [f64; 4] = [8.0, 12.0, 12.0, 6.0];

    #[test]
    fn chain_is_the_composition_with_a_cube_at_two() {
        let (x, y, z) = (Dual2_64::new(2.0, 0.3, 0.7), Dual3_64::new(2.0, 0.3, 0.7, -0.2), HyperDual64::new(2.0, 0.3, 0.5, 0.1));
        let (fx, fy, fz) = (x.chain(CUBE), y.chain(CUBE), z.chain(CUBE));
        let (gx, gy, gz) = (x * x * x, y * y * y, z * z * z);
        assert!((fx.v1 - gx.v1).abs() < 1e-14 && (fx.v2 - gx.v2).abs() < 1e-14);
        assert!((fy.v2 - gy.v2).abs() < 1e-14 && (fy.v3 - gy.v3).abs() < 1e-14);
        assert!((fz.eps2 - gz.eps2).abs() < 1e-14 && (fz.eps1eps2 - gz.eps1eps2).abs() < 1e-14);
        assert_eq!(Dual64::new(2.0, 0.5).chain(CUBE).eps, 6.0);
        assert_eq!(Dual::chain(2.0, CUBE), 8.0);
    }

    #[test]
    fn a_zero_tangent_stays_zero() {
        let infinite = [0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        assert_eq!(Dual3_64::constant(0.0).chain(infinite).v3, 0.0);
        let along_t = HyperDual64::new(0.0, 0.0, 1.0, 0.0).chain(infinite);
        assert_eq!((along_t.eps1, along_t.eps2, along_t.eps1eps2), (0.0, f64::INFINITY, 0.0));
    }

    #[test]
    fn quotient_times_divisor_is_the_dividend() {
        let (a, b) = (Dual3_64::new(0.3, 1.0, -2.0, 0.5), Dual3_64::new(1.7, 0.4, 0.6, -0.8));
        let p = a.quotient(b) * b;
        assert!((p.re - a.re).abs() < 1e-15 && (p.v1 - a.v1).abs() < 1e-15 && (p.v2 - a.v2).abs() < 1e-15 && (p.v3 - a.v3).abs() < 1e-14);
        let (a, b) = (HyperDual64::new(0.3, 1.0, -2.0, 0.5), HyperDual64::new(1.7, 0.4, 0.6, -0.8));
        let p = a.quotient(b) * b;
        assert!((p.eps1 - a.eps1).abs() < 1e-15 && (p.eps2 - a.eps2).abs() < 1e-15 && (p.eps1eps2 - a.eps1eps2).abs() < 1e-15);
        let (a, b) = (Dual2_64::new(0.3, 1.0, -2.0), Dual2_64::new(1.7, 0.4, 0.6));
        let p = a.quotient(b) * b;
        assert!((p.v1 - a.v1).abs() < 1e-15 && (p.v2 - a.v2).abs() < 1e-15);
        assert_eq!(Dual64::new(1.0, 2.0).quotient(Dual64::constant(f64::INFINITY)).eps, 0.0);
    }
}
