//! Where emitted code meets what only rustc knows: constants, fields of the user's types, results
//! of the user's functions.
//!
//! One method name stands for several traits; rustc picks the first whose receiver fits.
//! `(&Foreign(x)).lifted(…)` is [`LiftNumbers`] if x is made of f64 and [`LiftAny`] if not, because
//! a method that needs no further reference is found first. `returned(x).lowered()` works the same
//! way on results of the user's functions.

use std::marker::PhantomData;

use super::{Lift, Lower};

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

/// The receiver of a method of numbers: `(&&Foreign(x)).receiver(…)` lifts behind a reference too.
/// First choice: x is made of f64.
pub trait ReceiveNumbers<D> {
    /// The lifted type.
    type Output;
    /// The value, lifted.
    fn receiver(&self, _: PhantomData<D>) -> Self::Output;
}

impl<D, T: Lift<D> + Clone> ReceiveNumbers<D> for &Foreign<T> {
    type Output = T::Output;
    fn receiver(&self, _: PhantomData<D>) -> T::Output {
        self.0.clone().lift()
    }
}

/// Second choice: x is a reference to something made of f64.
pub trait ReceiveReference<D> {
    /// The lifted type.
    type Output;
    /// The value, lifted.
    fn receiver(&self, _: PhantomData<D>) -> Self::Output;
}

impl<D, T: Lift<D> + Clone> ReceiveReference<D> for &&Foreign<&T> {
    type Output = T::Output;
    fn receiver(&self, _: PhantomData<D>) -> T::Output {
        self.0.clone().lift()
    }
}

/// A value of any other type, as it is.
pub trait ReceiveAny<D> {
    /// The type itself.
    type Output;
    /// The value itself.
    fn receiver(&self, _: PhantomData<D>) -> Self::Output;
}

impl<D, T: Clone> ReceiveAny<D> for Foreign<T> {
    type Output = T;
    fn receiver(&self, _: PhantomData<D>) -> T {
        self.0.clone()
    }
}

/// A result of the user's function. It is taken out once, so it need not be `Clone`.
pub struct Returned<T>(Option<T>);

/// A result of the user's function, for `lowered`.
pub fn returned<T>(value: T) -> Returned<T> {
    Returned(Some(value))
}

/// A result of the user's generic function as plain numbers.
pub trait LowerReal {
    /// The plain type.
    type Output;
    /// The value, in plain numbers.
    fn lowered(self) -> Self::Output;
}

impl<T: Lower> LowerReal for Returned<T> {
    type Output = T::Output;
    fn lowered(self) -> T::Output {
        taken(self.0).lower()
    }
}

/// Any other result as it is.
pub trait LowerAny {
    /// The type itself.
    type Output;
    /// The value itself.
    fn lowered(self) -> Self::Output;
}

impl<T> LowerAny for &mut Returned<T> {
    type Output = T;
    fn lowered(self) -> T {
        taken(self.0.take())
    }
}

fn taken<T>(value: Option<T>) -> T {
    value.unwrap_or_else(|| unreachable!("take a result once, where it is created"))
}
