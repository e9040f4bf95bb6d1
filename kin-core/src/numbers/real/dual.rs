//! Implements the operations of the number in a [`Real`](super::Real), with correct results at
//! singular arguments.

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
    /// True if the number records where it ceases to be finite. Only the search for the cause of a
    /// failure uses such a number.
    #[doc(hidden)]
    const TRACED: bool = false;

    /// Returns the real part.
    fn value(&self) -> f64;

    /// Makes a number without derivatives.
    fn constant(x: f64) -> Self;

    /// Returns true if no direction moves the number: its derivatives are zero by structure, not by
    /// chance.
    fn is_constant(&self) -> bool;

    /// Returns true if the first derivatives are zero, by structure or by chance.
    fn is_at_rest(&self) -> bool;

    /// Returns a number with the same derivatives and another real part.
    fn with_value(self, x: f64) -> Self;

    /// Returns a constant of the same value.
    fn still(self) -> Self {
        Self::constant(self.value())
    }

    /// Composes a scalar function with the number (Faà di Bruno).
    ///
    /// `f` holds the value and the first three derivatives of the function at the real part. A
    /// constant stays constant, whatever the derivatives are. A number that has overflowed gives a
    /// constant where the function is finite, because the function is flat there.
    fn chain(self, f: [f64; 4]) -> Self;

    /// Composes a scalar function given by f, f′, f″/f′² and f‴/f′³.
    ///
    /// The scaled form is for functions whose derivatives become small for large arguments: the
    /// scaled derivatives neither overflow nor underflow.
    fn chain_scaled(self, f: [f64; 4]) -> Self;

    /// Returns self / b by the recurrence (q b)⁽ⁿ⁾ = a⁽ⁿ⁾, a being `self`; the real part is the
    /// quotient in `f64`. A divisor that has overflowed counts as constant.
    fn quotient(self, b: Self) -> Self;

    /// Returns the number with a mark of its growth.
    #[doc(hidden)]
    fn growing(self, growth: Growth) -> Self;
}

/// Describes how the values of a function grow.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// The values are small and finite for every argument.
    Bounded,
    /// The values grow like an exponential or a power, so a value may overflow although a function
    /// of the value is finite.
    Bursting,
    /// The function maps large arguments to small values, and has poles.
    Logarithmic,
    /// The function is infinite at a pole.
    Pole,
    /// The values grow like a power with a negative exponent: they may overflow, and the function
    /// has poles.
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
