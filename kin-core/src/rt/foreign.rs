//! Where emitted code meets what only rustc knows: constants, fields of the user's types, the user's functions.
//!
//! `(&Foreign(x)).lifted(…)` picks [`LiftNumbers`] if x is made of f64 and [`LiftAny`] if not, because a method that needs no further
//! reference is found first. `lowered` works the same way on results of the user's generic functions.

use std::marker::PhantomData;

use super::Lift;
use crate::algebra::{Mat2, Mat3, Vec2, Vec3};
use crate::real::Real;

/// A value of a type that the macro does not know.
pub struct Foreign<T>(pub T);

/// f64 comes in as a constant of the dual copy.
pub trait LiftNumbers<D> {
    /// The lifted type.
    type Output;
    /// The value, lifted.
    fn lifted(&self, _: PhantomData<D>) -> Self::Output;
}

impl<D, T: Lift<D> + Clone> LiftNumbers<D> for Foreign<T> {
    type Output = T::Output;
    fn lifted(&self, _: PhantomData<D>) -> T::Output {
        self.0.clone().lift()
    }
}

/// Anything else comes in as it is.
pub trait LiftAny<D> {
    /// The type itself.
    type Output;
    /// The value itself.
    fn lifted(&self, _: PhantomData<D>) -> Self::Output;
}

impl<D, T: Clone> LiftAny<D> for &Foreign<T> {
    type Output = T;
    fn lifted(&self, _: PhantomData<D>) -> T {
        self.0.clone()
    }
}

/// A result of the user's generic function as plain numbers.
pub trait LowerReal {
    /// The plain type.
    type Output;
    /// The value, in plain numbers.
    fn lowered(&self) -> Self::Output;
}

impl LowerReal for Foreign<Real<f64>> {
    type Output = f64;
    fn lowered(&self) -> f64 {
        self.0.0
    }
}

/// Any other result as it is.
pub trait LowerAny {
    /// The type itself.
    type Output;
    /// The value itself.
    fn lowered(&self) -> Self::Output;
}

impl<T: Clone> LowerAny for &Foreign<T> {
    type Output = T;
    fn lowered(&self) -> T {
        self.0.clone()
    }
}

/// A plain value as what the user's function asks for.
pub trait IntoPlain<T> {
    /// The converted value.
    fn into_plain(self) -> T;
}

impl<T> IntoPlain<T> for T {
    fn into_plain(self) -> T {
        self
    }
}

impl IntoPlain<Real<f64>> for f64 {
    fn into_plain(self) -> Real<f64> {
        Real(self)
    }
}

/// A constant of the dual copy as what the user's function asks for: dual, or plain f64.
pub trait IntoConstant<T> {
    /// The converted value.
    fn into_constant(self) -> T;
}

impl<T> IntoConstant<T> for T {
    fn into_constant(self) -> T {
        self
    }
}

impl<D: crate::real::Dual> IntoConstant<f64> for Real<D> {
    fn into_constant(self) -> f64 {
        self.value()
    }
}

/// A value that carries derivatives as what the user's function asks for: it must ask for dual numbers.
#[diagnostic::on_unimplemented(
    message = "this function takes f64 only, so its derivative is not known",
    label = "depends on coordinates or time",
    note = "make the function generic, `fn f<D: Dual>(x: Real<D>) -> Real<D>`, or pass a `Law` and ask it with `law.at(x)`"
)]
pub trait IntoJet<T> {
    /// The converted value.
    fn into_jet(self) -> T;
}

impl<T> IntoJet<T> for T {
    fn into_jet(self) -> T {
        self
    }
}

/// With one implementation only, rustc would take it for granted and speak of mismatched types instead of the message above.
pub enum Never {}

impl IntoJet<()> for Never {
    fn into_jet(self) {
        match self {}
    }
}

macro_rules! vectors {
    ($($kind:ident { $($c:ident),* })*) => {$(
        impl LowerReal for Foreign<$kind<Real<f64>>> {
            type Output = $kind<f64>;
            fn lowered(&self) -> $kind<f64> {
                $kind::new($(self.0.$c.0),*)
            }
        }

        impl IntoPlain<$kind<Real<f64>>> for $kind<f64> {
            fn into_plain(self) -> $kind<Real<f64>> {
                self.into()
            }
        }

        impl<D: crate::real::Dual> IntoConstant<$kind<f64>> for $kind<Real<D>> {
            fn into_constant(self) -> $kind<f64> {
                $kind::new($(self.$c.value()),*)
            }
        }
    )*};
}

vectors! {
    Vec2 { x, y }
    Vec3 { x, y, z }
    Mat2 { m11, m12, m21, m22 }
    Mat3 { m11, m12, m13, m21, m22, m23, m31, m32, m33 }
}

/// An argument of the user's function in plain numbers.
pub fn plain_argument<S: IntoPlain<T>, T>(value: S) -> T {
    value.into_plain()
}

/// An argument of the user's function that depends on no coordinate and not on time.
pub fn constant_argument<S: IntoConstant<T>, T>(value: S) -> T {
    value.into_constant()
}

/// An argument of the user's function that carries derivatives.
pub fn jet_argument<S: IntoJet<T>, T>(value: S) -> T {
    value.into_jet()
}
