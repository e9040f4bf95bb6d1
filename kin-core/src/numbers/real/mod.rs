//! Numbers that carry derivatives: [`Real<D>`], Kin's own layer over num-dual's scalars, marked by
//! what moves them.
//!
//! `Real<D>` reads like an `f64`: the same operators with `f64` on either side, the same function
//! names, comparisons of real parts. Its real part is, bit for bit, what the same expression gives
//! in `f64`. Its derivatives are right at the edges, where num-dual 0.15 has NaN traps; no function
//! panics. The rules:
//!
//! * A number knows whether it moves. One that does not (a constant, or the side taken of `max`,
//!   `min`, `clamp`, `if`) has tangents that are zero by structure, and stays constant, whatever
//!   derivative it meets: √0 of a constant is a constant 0. A tangent that happens to be zero is a
//!   number like any other: x² + y² at x = y = 0 moves, and its square root has no slope there. The
//!   symbolic route keeps to the same rule (`kin_graph::differentiate`), and so does the search for
//!   what is to blame.
//! * At a true singularity (√ of a variable at 0) derivatives are infinite or NaN.
//! * An exponential or power that has overflowed is as good as a constant to a function that is
//!   finite there: 1/(1 + eˣ) is 0 for large x, and so is its slope. Not so at a pole: arctan(1/x)
//!   jumps at 0.
//! * At a kink the documented side is taken: `abs` that of x ≥ 0, `max` and `min` that of `self`.

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

/// A number with derivatives along one or two directions; `D` says which: `f64` (none), [`Dual64`]
/// (first), [`Dual2_64`] (second), [`Dual3_64`] (third) or [`HyperDual64`] (mixed second). Same
/// unit as the quantity it stands for.
#[derive(Clone, Copy, Debug)]
pub struct Real<D>(pub D);

impl<D: Dual> Real<D> {
    /// The real part, without derivatives.
    #[inline]
    pub fn value(self) -> f64 {
        self.0.value()
    }

    /// True if nothing moves it.
    #[inline]
    pub fn is_constant(self) -> bool {
        self.0.is_constant()
    }

    /// A number without derivatives.
    #[inline]
    fn constant(x: f64) -> Self {
        Real(D::constant(x))
    }

    /// The same derivatives at another real part.
    #[inline]
    fn with_value(self, x: f64) -> Self {
        Real(self.0.with_value(x))
    }

    /// f(self), from f and its first three derivatives at the real part: for laws and tables that
    /// know their own derivatives. A constant stays one, whatever its derivatives; those beyond the
    /// ones of `D` are not used.
    #[inline]
    pub fn chain(self, f: [f64; 4]) -> Self {
        Real(self.0.chain(f))
    }

    /// 0 with no derivative: a zero length, singular unless `self` is constant.
    #[inline]
    pub(crate) fn singular(self) -> Self {
        self.chain([0.0, f64::NAN, f64::NAN, f64::NAN])
    }
}

impl<D: Dual> From<f64> for Real<D> {
    /// A number without derivatives.
    #[inline]
    fn from(x: f64) -> Self {
        Self::constant(x)
    }
}

impl<D: Dual> From<i32> for Real<D> {
    /// A whole number, without derivatives.
    #[inline]
    fn from(n: i32) -> Self {
        Self::constant(f64::from(n))
    }
}

impl<D: Dual> From<u32> for Real<D> {
    /// A whole number, without derivatives.
    #[inline]
    fn from(n: u32) -> Self {
        Self::constant(f64::from(n))
    }
}

impl<D: Dual> Default for Real<D> {
    /// 0, without derivatives.
    #[inline]
    fn default() -> Self {
        Self::constant(0.0)
    }
}

impl<D: Dual> fmt::Display for Real<D> {
    /// The number with its derivatives, as num-dual writes them.
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
