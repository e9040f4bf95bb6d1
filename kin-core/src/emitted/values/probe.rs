//! Finds out if the user's function takes numbers as they are. A function of f64, or one that is
//! generic in its numbers, is called with what is there; only one that asks for numbers of another
//! kind has them converted, and says so by its signature.
//!
//! `(&Probe::new(&f, (of(&a), of(&b)))).marker()` is [`AsIs`] if `f(a, b)` is good Rust and
//! [`Converted`] if not, because a method that needs no further reference is found first.

use std::marker::PhantomData;

use super::{
    IntoConstant, IntoPlain, IntoReference, Jet, constant_argument, plain_argument,
    reference_argument,
};

/// A function, and the types of what it may be called with.
pub struct Probe<'a, F, A>(&'a F, A);

impl<'a, F, A> Probe<'a, F, A> {
    /// Of a function and arguments.
    pub fn new(function: &'a F, arguments: A) -> Self {
        Probe(function, arguments)
    }
}

/// The type of an argument.
pub fn of<A>(_: &A) -> PhantomData<A> {
    PhantomData
}

/// Arguments are handed over as they are.
#[derive(Clone, Copy)]
pub struct AsIs;

/// Arguments are converted.
#[derive(Clone, Copy)]
pub struct Converted;

/// A value that is handed over as it is.
pub struct Same<T>(T);

impl<T> Same<T> {
    /// The value itself.
    pub fn argument(self) -> T {
        self.0
    }
}

/// A function that takes what is there.
pub trait TakesAsIs {
    /// How its arguments are handed over.
    fn marker(&self) -> AsIs;
}

/// Any other function.
pub trait TakesConverted {
    /// How its arguments are handed over.
    fn marker(&self) -> Converted;
}

impl<F, A> TakesConverted for &Probe<'_, F, A> {
    fn marker(&self) -> Converted {
        Converted
    }
}

macro_rules! functions {
    ($($($a:ident)*;)*) => {$(
        impl<F, R, $($a),*> TakesAsIs for Probe<'_, F, ($(PhantomData<$a>,)*)>
        where
            F: Fn($($a),*) -> R,
        {
            fn marker(&self) -> AsIs {
                let _ = (&self.0, &self.1);
                AsIs
            }
        }
    )*};
}

functions! { A; A B; A B C; A B C D; A B C D E; A B C D E G; }

impl AsIs {
    /// An argument in plain numbers.
    pub fn plain<T>(self, value: T) -> T {
        value
    }

    /// An argument that carries no derivatives.
    pub fn constant<T>(self, value: T) -> T {
        value
    }

    /// An argument that carries derivatives.
    pub fn jet<T>(self, value: T) -> Same<T> {
        Same(value)
    }

    /// A borrowed argument, in two kinds of numbers: the first.
    pub fn reference<'a, P, R>(self, plain: &'a P, _: &'a R) -> &'a P {
        plain
    }

    /// The second.
    pub fn lifted_reference<'a, P, R>(self, _: &'a P, lifted: &'a R) -> &'a R {
        lifted
    }
}

impl Converted {
    /// An argument in plain numbers.
    pub fn plain<S: IntoPlain<T>, T>(self, value: S) -> T {
        plain_argument(value)
    }

    /// An argument that carries no derivatives.
    pub fn constant<S: IntoConstant<T>, T>(self, value: S) -> T {
        constant_argument(value)
    }

    /// An argument that carries derivatives.
    pub fn jet<S>(self, value: S) -> Jet<S> {
        Jet(value)
    }

    /// A borrowed argument, in two kinds of numbers.
    pub fn reference<'a, P, R, T>(self, plain: &'a P, lifted: &'a R) -> T
    where
        (&'a P, &'a R): IntoReference<T>,
    {
        reference_argument(plain, lifted)
    }

    /// The same.
    pub fn lifted_reference<'a, P, R, T>(self, plain: &'a P, lifted: &'a R) -> T
    where
        (&'a P, &'a R): IntoReference<T>,
    {
        reference_argument(plain, lifted)
    }
}
