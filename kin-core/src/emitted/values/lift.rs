//! Between f64 and numbers that carry derivatives, for anything that is made of numbers.

use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3};
use crate::numbers::real::{Dual, Real};

/// A value made of f64 as the same value made of constant `Real<D>`. A value that holds no f64
/// stays as it is.
pub trait Lift<D> {
    /// The lifted type.
    type Output;
    /// Every number as a constant.
    fn lift(self) -> Self::Output;
}

/// A value made of `Real<f64>` as the same value made of f64. What holds none stays as it is.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not made of numbers",
    label = "expected numbers"
)]
pub trait Lower {
    /// The plain type.
    type Output;
    /// Every number in plain f64.
    fn lower(self) -> Self::Output;
}

/// A value made of `Real<D>` as the same value made of f64, without derivatives. What holds none
/// stays as it is.
pub trait Constants {
    /// The plain type.
    type Output;
    /// Every number in plain f64.
    fn constants(&self) -> Self::Output;
}

/// A result of the user's function in plain numbers.
pub fn lowered<T: Lower>(value: T) -> T::Output {
    value.lower()
}

/// A value without its derivatives.
pub fn constants<T: Constants>(value: &T) -> T::Output {
    value.constants()
}

/// The stand-in for a value that is not computed, because the branch that needs it is not taken.
pub trait Absent {
    /// Not a number.
    fn absent() -> Self;
}

/// The stand-in for a value that is not computed.
pub fn absent<T: Absent>() -> T {
    T::absent()
}

impl Absent for f64 {
    fn absent() -> f64 {
        f64::NAN
    }
}

impl<D: Dual> Absent for Real<D> {
    fn absent() -> Self {
        Real::from(f64::NAN)
    }
}

impl Absent for bool {
    fn absent() -> bool {
        false
    }
}

impl<T: Absent, const N: usize> Absent for [T; N] {
    fn absent() -> Self {
        std::array::from_fn(|_| T::absent())
    }
}

impl<D: Dual> Lift<D> for f64 {
    type Output = Real<D>;
    fn lift(self) -> Real<D> {
        Real::from(self)
    }
}

impl<D: Dual> Lift<D> for Axis {
    type Output = Axis<Real<D>>;
    fn lift(self) -> Axis<Real<D>> {
        self.map(|v| v.lift())
    }
}

impl<D: Dual> Lift<D> for PlanarState {
    type Output = PlanarState<Real<D>>;
    fn lift(self) -> Self::Output {
        PlanarState {
            r: self.r.lift(),
            theta: self.theta.lift(),
            sin: self.sin.lift(),
            cos: self.cos.lift(),
        }
    }
}

impl<D: Dual> Lift<D> for SpatialState {
    type Output = SpatialState<Real<D>>;
    fn lift(self) -> Self::Output {
        SpatialState { r: self.r.lift(), p: self.p.lift(), a: self.a.lift() }
    }
}

impl Lower for f64 {
    type Output = f64;
    fn lower(self) -> f64 {
        self
    }
}

impl Lower for Real<f64> {
    type Output = f64;
    fn lower(self) -> f64 {
        self.0
    }
}

impl<D: Dual> Constants for Real<D> {
    type Output = f64;
    fn constants(&self) -> f64 {
        self.value()
    }
}

macro_rules! components {
    ($($kind:ident { $($c:ident),* })*) => {$(
        impl<D: Dual> Lift<D> for $kind<f64> {
            type Output = $kind<Real<D>>;
            fn lift(self) -> Self::Output {
                self.into()
            }
        }

        impl<T: Lower<Output = f64>> Lower for $kind<T> {
            type Output = $kind;
            fn lower(self) -> Self::Output {
                $kind::new($(self.$c.lower()),*)
            }
        }

        impl<T: Absent> Absent for $kind<T> {
            fn absent() -> Self {
                $kind { $($c: T::absent()),* }
            }
        }

        impl<D: Dual> Constants for $kind<Real<D>> {
            type Output = $kind;
            fn constants(&self) -> Self::Output {
                $kind::new($(self.$c.value()),*)
            }
        }
    )*};
}

components! {
    Vec2 { x, y }
    Vec3 { x, y, z }
    EulerParameters { e0, e1, e2, e3 }
    Mat2 { m11, m12, m21, m22 }
    Mat3 { m11, m12, m13, m21, m22, m23, m31, m32, m33 }
}

/// Containers, each with how a function goes over its elements.
macro_rules! containers {
    ($([$($generics:tt)*] $kind:ty => $output:ty, $all:ident => $lift:expr, $lower:expr, $constants:expr;)*) => {$(
        impl<D, T: Lift<D>, $($generics)*> Lift<D> for $kind {
            type Output = $output;
            fn lift(self) -> Self::Output {
                let $all = self;
                $lift
            }
        }

        impl<T: Lower, $($generics)*> Lower for $kind {
            type Output = $output;
            fn lower(self) -> Self::Output {
                let $all = self;
                $lower
            }
        }

        impl<T: Constants, $($generics)*> Constants for $kind {
            type Output = $output;
            fn constants(&self) -> Self::Output {
                let $all = self;
                $constants
            }
        }
    )*};
}

containers! {
    [const N: usize] [T; N] => [T::Output; N], all => all.map(T::lift), all.map(T::lower), all.each_ref().map(T::constants);
    [] Vec<T> => Vec<T::Output>, all => all.into_iter().map(T::lift).collect(), all.into_iter().map(T::lower).collect(), all.iter().map(T::constants).collect();
    [] Option<T> => Option<T::Output>, all => all.map(T::lift), all.map(T::lower), all.as_ref().map(T::constants);
}

macro_rules! tuples {
    ($(($($t:ident $k:tt),*))*) => {$(
        impl<D, $($t: Lift<D>),*> Lift<D> for ($($t,)*) {
            type Output = ($($t::Output,)*);
            fn lift(self) -> Self::Output {
                ($(self.$k.lift(),)*)
            }
        }

        impl<$($t: Lower),*> Lower for ($($t,)*) {
            type Output = ($($t::Output,)*);
            fn lower(self) -> Self::Output {
                ($(self.$k.lower(),)*)
            }
        }

        impl<$($t: Absent),*> Absent for ($($t,)*) {
            fn absent() -> Self {
                ($($t::absent(),)*)
            }
        }

        impl<$($t: Constants),*> Constants for ($($t,)*) {
            type Output = ($($t::Output,)*);
            fn constants(&self) -> Self::Output {
                ($(self.$k.constants(),)*)
            }
        }
    )*};
}

tuples!((A 0) (A 0, B 1) (A 0, B 1, C 2) (A 0, B 1, C 2, E 3) (A 0, B 1, C 2, E 3, F 4) (A 0, B 1, C 2, E 3, F 4, G 5));

macro_rules! without_numbers {
    ($($ty:ty),*) => {$(
        impl<D> Lift<D> for $ty {
            type Output = $ty;
            fn lift(self) -> $ty {
                self
            }
        }

        impl Lower for $ty {
            type Output = $ty;
            fn lower(self) -> $ty {
                self
            }
        }

        impl Constants for $ty {
            type Output = $ty;
            fn constants(&self) -> $ty {
                self.clone()
            }
        }
    )*};
}

without_numbers!(
    (),
    bool,
    char,
    usize,
    isize,
    u8,
    i8,
    u16,
    i16,
    u32,
    i32,
    u64,
    i64,
    u128,
    i128,
    String,
    &'static str
);
