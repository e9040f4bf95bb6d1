//! Defines the traits of the numbers that constructors accept: plain numbers or expressions of
//! dimensions.

use std::ops::{Add, Div, Mul, Sub};

use super::{Bindings, Dimension, Name};
use crate::numbers::algebra::{Components, EulerParameters, Mat2, Mat3, Scalar, Vec2, Vec3};
use crate::numbers::real::by_ref;

/// A number of a mechanism: an `f64` or a [`Dimension`].
#[diagnostic::on_unimplemented(
    message = "expected a number, but found `{Self}`",
    label = "not a number",
    note = "give an `f64` with a decimal point, such as `1.0`, or a `Dimension`: the value that `m.dimension(…)` returned, or an expression of dimensions"
)]
pub trait IntoNumber: Scalar {
    /// Returns the number as a dimension; an `f64` becomes a constant.
    fn into_number(self) -> Dimension;
}

impl IntoNumber for f64 {
    #[inline]
    fn into_number(self) -> Dimension {
        self.into()
    }
}

impl IntoNumber for Dimension {
    fn into_number(self) -> Dimension {
        self
    }
}

/// A value for a parameter of type `T` of a constraint or law: a `T`, or the same type with
/// [`Dimension`]s as numbers.
#[diagnostic::on_unimplemented(
    message = "expected a `{T}`, but found `{Self}`",
    label = "not a `{T}`",
    note = "write numbers with a decimal point, such as `1.0`; where one component is a `Dimension`, convert the other components: `0.0.into()`"
)]
pub trait IntoParameter<T> {
    /// Returns the parameter and records the numbers that depend on dimensions under the
    /// parameter's name.
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> T;
}

#[diagnostic::do_not_recommend]
impl<S: IntoNumber> IntoParameter<f64> for S {
    #[inline]
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> f64 {
        to.note(name, self.into_number())
    }
}

impl<S: IntoParameter<T>, T, const N: usize> IntoParameter<[T; N]> for [S; N] {
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> [T; N] {
        let mut k = 0..N;
        self.map(|one| one.into_parameter(&Name::Index(name, k.next().unwrap_or_default()), to))
    }
}

impl<S: Scalar + IntoNumber> IntoParameter<Vec2> for Vec2<S> {
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> Vec2 {
        vector(self, name, to)
    }
}

impl<S: Scalar + IntoNumber> IntoParameter<Vec3> for Vec3<S> {
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> Vec3 {
        vector(self, name, to)
    }
}

macro_rules! tuples {
    ($(($($s:ident $t:ident $k:tt),*))*) => {$(
        impl<$($s: IntoParameter<$t>, $t),*> IntoParameter<($($t,)*)> for ($($s,)*) {
            fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> ($($t,)*) {
                ($(self.$k.into_parameter(&Name::Field(name, stringify!($k)), to),)*)
            }
        }
    )*};
}

tuples!((A P 0) (A P 0, B Q 1) (A P 0, B Q 1, C R 2) (A P 0, B Q 1, C R 2, D S 3));

/// Parameters that are constants.
macro_rules! constants {
    ($($ty:ty)*) => {$(
        impl IntoParameter<$ty> for $ty {
            fn into_parameter(self, _: &Name<'_>, _: &mut Bindings) -> $ty {
                self
            }
        }
    )*};
}

constants!(Mat2 Mat3 EulerParameters);

/// Parameters with components that are dimensions.
macro_rules! components {
    ($($ty:ident { $($c:ident),* })*) => {$(
        impl IntoParameter<$ty> for $ty<Dimension> {
            fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> $ty {
                $ty { $($c: to.note(&Name::Field(name, stringify!($c)), self.$c)),* }
            }
        }
    )*};
}

components! {
    Mat2 { m11, m12, m21, m22 }
    Mat3 { m11, m12, m13, m21, m22, m23, m31, m32, m33 }
    EulerParameters { e0, e1, e2, e3 }
}

impl<S: IntoNumber> IntoParameter<Mat3> for [[S; 3]; 3] {
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> Mat3 {
        Mat3::from_rows(self.map(|row| row.map(IntoNumber::into_number))).into_parameter(name, to)
    }
}

/// A vector `V` of a load or a mass: a [`Vec2`] or [`Vec3`], an array or a tuple of numbers or
/// [`Dimension`]s.
#[diagnostic::on_unimplemented(
    message = "expected a `{V}`, but found `{Self}`",
    label = "not a `{V}`",
    note = "write `vec2(1.0, 2.0)` for a vector in the plane and `vec3(1.0, 2.0, 3.0)` in space"
)]
pub trait IntoVector<V> {
    /// Returns the three components; the third component is zero in a plane.
    #[doc(hidden)]
    fn numbers(self) -> [Dimension; 3];
}

impl<C: Components<2, Scalar: IntoNumber>> IntoVector<Vec2> for C {
    fn numbers(self) -> [Dimension; 3] {
        let [x, y] = self.components().map(IntoNumber::into_number);
        [x, y, 0.0.into()]
    }
}

impl<C: Components<3, Scalar: IntoNumber>> IntoVector<Vec3> for C {
    fn numbers(self) -> [Dimension; 3] {
        self.components().map(IntoNumber::into_number)
    }
}

/// The acceleration of gravity: a [`Vec2`] or a [`Vec3`] of numbers or [`Dimension`]s.
#[diagnostic::on_unimplemented(
    message = "expected the acceleration of gravity, but found `{Self}`",
    label = "write `vec2(0.0, -9.81)` in the plane, or `vec3(0.0, 0.0, -9.81)` in space"
)]
pub trait IntoGravity {
    /// Returns the three components; the third component is zero in a plane.
    #[doc(hidden)]
    fn numbers(self) -> [Dimension; 3];
}

impl<S: IntoNumber> IntoGravity for Vec2<S> {
    fn numbers(self) -> [Dimension; 3] {
        IntoVector::<Vec2>::numbers(self)
    }
}

impl<S: IntoNumber> IntoGravity for Vec3<S> {
    fn numbers(self) -> [Dimension; 3] {
        IntoVector::<Vec3>::numbers(self)
    }
}

/// Converts an argument of a constructor to a vector.
pub fn vector<V: From<[f64; N]>, const N: usize>(
    components: impl Components<N, Scalar: IntoNumber>,
    name: &Name<'_>,
    to: &mut Bindings,
) -> V {
    let mut names = ["x", "y", "z"].into_iter();
    V::from(components.components().map(|one| {
        to.note(&Name::Field(name, names.next().unwrap_or_default()), one.into_number())
    }))
}

/// Pairs and triples that mix constants and dimensions.
macro_rules! mixed {
    ($n:literal: $(($($ty:ident),*))*) => {$(
        impl Components<$n> for ($($ty),*) {
            type Scalar = Dimension;

            fn components(self) -> [Dimension; $n] {
                mixed!(@ self $($ty)*)
            }
        }
    )*};
    (@ $all:ident $a:ident $b:ident) => { [$all.0.into(), $all.1.into()] };
    (@ $all:ident $a:ident $b:ident $c:ident) => { [$all.0.into(), $all.1.into(), $all.2.into()] };
}

mixed!(2: (Dimension, f64) (f64, Dimension));
mixed!(3: (Dimension, f64, f64) (f64, Dimension, f64) (f64, f64, Dimension)
    (f64, Dimension, Dimension) (Dimension, f64, Dimension) (Dimension, Dimension, f64));

/// Sums of a constant vector and a vector with dimensions.
macro_rules! sums {
    ($($ty:ident { $($c:ident),* })*) => {$(
        by_ref!([] Add::add, $ty<Dimension>, $ty<f64> => $ty<Dimension>, |a, b| $ty { $($c: a.$c + b.$c),* });
        by_ref!([] Add::add, $ty<f64>, $ty<Dimension> => $ty<Dimension>, |a, b| $ty { $($c: a.$c + b.$c),* });
        by_ref!([] Sub::sub, $ty<Dimension>, $ty<f64> => $ty<Dimension>, |a, b| $ty { $($c: a.$c - b.$c),* });
        by_ref!([] Sub::sub, $ty<f64>, $ty<Dimension> => $ty<Dimension>, |a, b| $ty { $($c: a.$c - b.$c),* });
        by_ref!([] Mul::mul, $ty<f64>, Dimension => $ty<Dimension>, |a, s| $ty { $($c: a.$c * s),* });
        by_ref!([] Mul::mul, $ty<Dimension>, f64 => $ty<Dimension>, |a, s| $ty { $($c: a.$c * s),* });
        by_ref!([] Mul::mul, f64, $ty<Dimension> => $ty<Dimension>, |s, a| $ty { $($c: s * a.$c),* });
        by_ref!([] Mul::mul, Dimension, $ty<Dimension> => $ty<Dimension>, |s, a| $ty { $($c: s * a.$c),* });
        by_ref!([] Mul::mul, Dimension, $ty<f64> => $ty<Dimension>, |s, a| $ty { $($c: s * a.$c),* });
        by_ref!([] Div::div, $ty<Dimension>, f64 => $ty<Dimension>, |a, s| $ty { $($c: a.$c / s),* });
        by_ref!([] Div::div, $ty<f64>, Dimension => $ty<Dimension>, |a, s| $ty { $($c: a.$c / s),* });
    )*};
}

sums! { Vec2 { x, y } Vec3 { x, y, z } }
