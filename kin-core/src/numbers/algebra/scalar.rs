//! Defines the number types of vectors.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::numbers::real::{Dual, Real};

/// A number: `f64`, or `Real<D>` for every [`Dual`] D.
///
/// A number mixes with numbers of the same type and with `f64`. The trait is sealed.
pub trait Scalar:
    sealed::Sealed
    + Mix<Self, Mixed = Self>
    + Mix<f64, Mixed = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + Sum
    + From<f64>
    + PartialOrd
    + PartialOrd<f64>
    + Default
    + fmt::Debug
    + fmt::Display
    + Send
    + Sync
    + 'static
{
    /// Returns the real part.
    fn value(self) -> f64;

    /// Returns √x.
    fn sqrt(self) -> Self;

    /// Returns |x|.
    fn abs(self) -> Self;

    /// Returns (sin x, cos x), with x in rad.
    fn sin_cos(self) -> (Self, Self);

    /// Returns the angle of the point (`x`, `self`). \[rad\]
    fn atan2(self, x: Self) -> Self;

    /// Returns √(x² + y²) without overflow.
    fn hypot(self, y: Self) -> Self;

    /// Returns √(Σ x²), the norm of a vector. The derivative for a zero vector is singular, unless
    /// all components are constant.
    fn length<const N: usize>(components: [Self; N]) -> Self;
}

/// A number type that mixes with numbers of type `U`: each type with itself, and `f64` with
/// `Real<D>`.
///
/// The result has the type [`Mixed<Self, U>`](Mixed).
#[diagnostic::on_unimplemented(
    message = "a number cannot be both `{Self}` and `{U}`",
    note = "use `f64` or `Real<D>` for numbers; write `1.0`, not `1`"
)]
pub trait Mix<U>:
    Copy
    + Add<U, Output = <Self as Mix<U>>::Mixed>
    + Sub<U, Output = <Self as Mix<U>>::Mixed>
    + Mul<U, Output = <Self as Mix<U>>::Mixed>
    + Div<U, Output = <Self as Mix<U>>::Mixed>
{
    /// `Real<D>` if one of the two types is `Real<D>`, otherwise `f64`.
    type Mixed: Scalar + From<Self> + From<U>;
}

/// The common type of `T` and `U`: `Real<D>` if one type is `Real<D>`, otherwise `f64`.
pub type Mixed<T, U> = <T as Mix<U>>::Mixed;

impl Mix<f64> for f64 {
    type Mixed = f64;
}

impl<D: Dual> Mix<f64> for Real<D> {
    type Mixed = Real<D>;
}

impl<D: Dual> Mix<Real<D>> for f64 {
    type Mixed = Real<D>;
}

impl<D: Dual> Mix<Real<D>> for Real<D> {
    type Mixed = Real<D>;
}

pub(crate) mod sealed {
    pub trait Sealed {}
}

macro_rules! scalar {
    ([$($generics:tt)*] $number:ty, $value:expr) => {
        impl<$($generics)*> sealed::Sealed for $number {}

        impl<$($generics)*> Scalar for $number {
            #[inline]
            fn value(self) -> f64 {
                $value(self)
            }

            #[inline]
            fn sqrt(self) -> Self {
                <$number>::sqrt(self)
            }

            #[inline]
            fn abs(self) -> Self {
                <$number>::abs(self)
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                <$number>::sin_cos(self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                <$number>::atan2(self, x)
            }

            #[inline]
            fn hypot(self, y: Self) -> Self {
                <$number>::hypot(self, y)
            }

            #[inline]
            fn length<const N: usize>(components: [Self; N]) -> Self {
                sum_of_squares(components).sqrt()
            }
        }
    };
}

scalar!([] f64, |x| x);
scalar!([D: Dual] Real<D>, Real::value);

/// Returns Σ x², in the order of the components.
#[inline]
fn sum_of_squares<T: Scalar, const N: usize>(components: [T; N]) -> T {
    components.into_iter().map(|x| x * x).reduce(|a, b| a + b).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual64;

    use super::*;

    fn parabola<T: Scalar>(x: T) -> T {
        (x * x - 1.0) / T::from(2.0)
    }

    #[test]
    fn one_generic_function_serves_both_kinds() {
        assert_eq!(parabola(3.0), 4.0);
        let y = parabola(Real(Dual64::new(3.0, 1.0))).0;
        assert_eq!((y.re, y.eps), (4.0, 3.0));
    }

    #[test]
    fn length_of_zero_is_singular_only_if_it_moves() {
        let still = Real::<Dual64>::from(0.0);
        let moving = Real(Dual64::new(0.0, 1.0));
        let zero = Scalar::length([still, still]).0;
        assert_eq!((zero.re, zero.eps), (0.0, 0.0));
        assert!(Scalar::length([still, moving]).0.eps.is_nan());
        assert_eq!(f64::length([2.0, 3.0, 6.0]), 7.0);
    }
}
