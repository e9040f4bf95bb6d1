//! Defines numbers that carry derivatives: [`Real<D>`] wraps the scalars of num-dual and marks the
//! directions along which a number changes.
//!
//! `Real<D>` has the operators of `f64` (with `f64` on either side), the function names of `f64`,
//! and comparisons of real parts. The real part is, bit for bit, the value of the same expression
//! in `f64`. Derivatives are correct at arguments at which num-dual 0.15 gives NaN. No function
//! panics.
//!
//! The rules for derivatives:
//! * A number knows if it is constant. A constant (also the constant side of `max`, `min`, `clamp`,
//!   `if`) has zero derivatives and remains constant in every function: √0 of a constant is a
//!   constant 0. A number whose derivative is zero at one point is not constant: x² + y² varies at
//!   x = y = 0, and its square root has no slope at this point. The symbolic route follows the same
//!   rule (`kin_graph::differentiate`), and so does the search for the cause of a singular term.
//! * At a true singularity (√ of a variable at 0) derivatives are infinite or NaN.
//! * If an exponential or a power has overflowed, Kin treats it as a constant in a function that is
//!   finite at infinity: 1/(1 + eˣ) is 0 for large x, and its slope is 0. A pole is an exception:
//!   arctan(1/x) jumps at 0.
//! * At a kink the derivative is that of the documented side.
//!   The function `abs` uses the side x ≥ 0; `max` and `min` use the side of `self`.

mod dual;
mod functions;
mod moving;
mod ops;
mod pair;
#[cfg(test)]
mod sweep;
mod traced;
mod walk;

use std::fmt;

pub use dual::Dual;
pub(crate) use dual::Growth;
pub use moving::{Dual2_64, Dual3_64, Dual64, HyperDual64, Moving};
pub(crate) use ops::{assign, by_ref};
pub(crate) use traced::{Fault, TIME, Traced, ended, fault_of};

/// A number with derivatives along one or two directions.
///
/// The type `D` selects the derivatives: `f64` (none), [`Dual64`] (first), [`Dual2_64`] (second),
/// [`Dual3_64`] (third) or [`HyperDual64`] (mixed second). The number has the unit of the quantity
/// that it represents.
#[derive(Clone, Copy, Debug)]
pub struct Real<D>(pub D);

impl<D: Dual> Real<D> {
    /// Returns the real part, without derivatives.
    #[inline]
    pub fn value(self) -> f64 {
        self.0.value()
    }

    /// Returns true if no direction moves the number.
    #[inline]
    pub fn is_constant(self) -> bool {
        self.0.is_constant()
    }

    /// Makes a number without derivatives.
    #[inline]
    fn constant(x: f64) -> Self {
        Real(D::constant(x))
    }

    /// Returns a number with the same derivatives and another real part.
    #[inline]
    fn with_value(self, x: f64) -> Self {
        Real(self.0.with_value(x))
    }

    /// Returns f(self) from f and its first three derivatives at the real part of `self`.
    ///
    /// Laws and tables that know their derivatives use this function. A constant stays constant,
    /// whatever the derivatives are. The function ignores derivatives of a higher order than `D`
    /// carries.
    #[inline]
    pub fn chain(self, f: [f64; 4]) -> Self {
        Real(self.0.chain(f))
    }

    /// Returns 0 for a zero length: the derivatives are NaN unless `self` is constant.
    #[inline]
    pub(crate) fn singular(self) -> Self {
        self.chain([0.0, f64::NAN, f64::NAN, f64::NAN])
    }
}

impl<D: Dual> From<f64> for Real<D> {
    /// Makes a number without derivatives.
    #[inline]
    fn from(x: f64) -> Self {
        Self::constant(x)
    }
}

impl<D: Dual> From<i32> for Real<D> {
    /// Makes a number without derivatives from a whole number.
    #[inline]
    fn from(n: i32) -> Self {
        Self::constant(f64::from(n))
    }
}

impl<D: Dual> From<u32> for Real<D> {
    /// Makes a number without derivatives from a whole number.
    #[inline]
    fn from(n: u32) -> Self {
        Self::constant(f64::from(n))
    }
}

impl<D: Dual> Default for Real<D> {
    /// Returns 0, without derivatives.
    #[inline]
    fn default() -> Self {
        Self::constant(0.0)
    }
}

impl<D: Dual> fmt::Display for Real<D> {
    /// Writes the number with its derivatives in the format of num-dual.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_from_f64_is_constant_and_the_default_is_zero() {
        assert!(
            Real::<Dual64>::from(2.0).is_constant() && Real::<HyperDual64>::from(2.0).is_constant()
        );
        assert_eq!(Real::<Dual2_64>::default().value(), 0.0);
        assert!(!Real(Dual3_64::new(1.0, 0.0, 0.0, 1e-300)).is_constant());
    }

    #[test]
    fn display_shows_value_and_derivative() {
        assert_eq!(Real(Dual64::new(1.5, 2.0)).to_string(), "1.5 + 2ε");
        assert_eq!(format!("{:.2}", Real(1.5)), "1.50");
    }
}
