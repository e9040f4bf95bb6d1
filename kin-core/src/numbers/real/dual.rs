//! The operations of a number under [`Real`](super::Real): arithmetic, composition and division
//! that are right at the edges.

use std::fmt::{Debug, Display};
use std::ops::{Add, Mul, Neg, Sub};

/// A scalar of num-dual that Kin computes with: `f64`, `Dual64`, `Dual2_64`, `Dual3_64` or
/// `HyperDual64`.
///
/// Write functions for the dual route as `fn f<D: Dual>(x: Real<D>) -> Real<D>`. The trait is
/// sealed.
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
    /// True if the number notes where it ceases to be finite: only when a failure is looked into.
    #[doc(hidden)]
    const TRACED: bool = false;

    /// The real part.
    fn value(&self) -> f64;

    /// A number without derivatives.
    fn constant(x: f64) -> Self;

    /// True if nothing moves it: its derivatives are zero by structure, not by chance.
    fn is_constant(&self) -> bool;

    /// True if its first derivatives are zero, for whatever reason.
    fn is_at_rest(&self) -> bool;

    /// The same derivatives at another real part.
    fn with_value(self, x: f64) -> Self;

    /// The same value without derivatives.
    fn still(self) -> Self {
        Self::constant(self.value())
    }

    /// Composition with a scalar function (Faà di Bruno): `f` is its value and first three
    /// derivatives at the real part.
    ///
    /// A constant stays one, whatever its derivative would be; so does a number that has
    /// overflowed, where the function is finite: it is flat there.
    fn chain(self, f: [f64; 4]) -> Self;

    /// The same from f, f′, f″/f′² and f‴/f′³: of functions whose derivatives become small as their
    /// arguments become large, so that neither is too large or too small for a number.
    fn chain_scaled(self, f: [f64; 4]) -> Self;

    /// self / b by the recurrence (q b)⁽ⁿ⁾ = a⁽ⁿ⁾, with a's real part divided by b's as in `f64`. A
    /// divisor that has overflowed counts as constant.
    fn quotient(self, b: Self) -> Self;

    /// The same number, of which is noted how it grows.
    #[doc(hidden)]
    fn growing(self, growth: Growth) -> Self;
}

/// How a function grows.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Its values are small and finite, whatever the argument.
    Bounded,
    /// As an exponential or a power: it may overflow though what is made of it does not.
    Bursting,
    /// It makes what is large small, and has poles.
    Logarithmic,
    /// It is infinite at a pole.
    Pole,
    /// As a falling power: it bursts, and has poles.
    BurstingPole,
}

pub(super) mod sealed {
    pub trait Sealed {}
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
    fn is_at_rest(&self) -> bool {
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
    fn chain_scaled(self, f: [f64; 4]) -> Self {
        f[0]
    }

    #[inline]
    fn quotient(self, b: Self) -> Self {
        self / b
    }

    #[inline]
    fn growing(self, _: Growth) -> Self {
        self
    }
}
