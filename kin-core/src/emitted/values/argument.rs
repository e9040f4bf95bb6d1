//! Numbers on their way into the user's own functions: as f64 or as `Real<D>`, whichever the
//! function asks for.
//!
//! Each trait has several implementations for one type: with one only, rustc would take it for
//! granted, and speak of mismatched types where the function asks for something else.

use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{EulerParameters, Mat2, Mat3, Vec2, Vec3};
use crate::numbers::real::{Dual, Real};

use super::{Constants, Lift};

/// A plain value as what the user's function asks for: as it is, or as `Real<f64>`.
#[diagnostic::on_unimplemented(
    message = "this function takes `{T}`, but the argument has the type `{Self}`",
    label = "is of type `{Self}`"
)]
pub trait IntoPlain<T> {
    /// The converted value.
    fn into_plain(self) -> T;
}

/// A value without derivatives as what the user's function asks for: as it is, as f64, or as
/// `Real<D>`.
pub trait IntoConstant<T> {
    /// The converted value.
    fn into_constant(self) -> T;
}

/// A value that carries derivatives as what the user's function asks for: it must ask for dual
/// numbers.
#[diagnostic::on_unimplemented(
    message = "this function takes f64 only, so Kin does not know its derivative",
    label = "depends on coordinates or time",
    note = "make the function generic, `fn f<D: Dual>(x: Real<D>) -> Real<D>`, or pass a `Law` and call `law.at(x)`"
)]
pub trait IntoJet<T> {
    /// The converted value.
    fn into_jet(self) -> T;
}

/// A value that carries derivatives as what a field of the user's struct asks for: it must ask for
/// dual numbers.
#[diagnostic::on_unimplemented(
    message = "this field holds f64 only, so Kin would lose the derivative of the value",
    label = "depends on coordinates or time",
    note = "keep numbers that depend on coordinates or time in variables, a tuple or an array, or make the type generic: `struct S<T> {{ x: T }}`, `let s: S<f64> = S {{ x }}`"
)]
pub trait IntoField<T> {
    /// The converted value.
    fn into_field(self) -> T;
}

#[diagnostic::do_not_recommend]
impl<S: IntoJet<T>, T> IntoField<T> for S {
    fn into_field(self) -> T {
        self.into_jet()
    }
}

/// A value and the same value in the other kind of numbers, by reference, as the reference that the
/// user's function asks for.
#[diagnostic::on_unimplemented(
    message = "this function takes `{T}`, but the argument has another type",
    label = "not a `{T}`"
)]
pub trait IntoReference<T> {
    /// The reference.
    fn into_reference(self) -> T;
}

impl<T> IntoPlain<T> for T {
    fn into_plain(self) -> T {
        self
    }
}

impl<T> IntoConstant<T> for T {
    fn into_constant(self) -> T {
        self
    }
}

impl<T> IntoJet<T> for T {
    fn into_jet(self) -> T {
        self
    }
}

/// Nobody asks for this. With one implementation of `IntoJet` for each kind of numbers, rustc would
/// take what it gives for granted and speak of mismatched types instead of the message above.
pub struct Nothing;

type Scalar<T> = T;
type Pair<T> = (T, T);
type Triple<T> = (T, T, T);
type Quadruple<T> = (T, T, T, T);
type Array<T, const N: usize> = [T; N];
type Table<T, const N: usize, const M: usize> = [[T; M]; N];
type Points2<T, const N: usize> = [Vec2<T>; N];
type Points3<T, const N: usize> = [Vec3<T>; N];
type Pairs<T, const N: usize> = [(T, T); N];
type Triples<T, const N: usize> = [(T, T, T); N];
type Quadruples<T, const N: usize> = [(T, T, T, T); N];
type List<T> = Vec<T>;
type ListOfPairs<T> = Vec<(T, T)>;
type ListOfTriples<T> = Vec<(T, T, T)>;
type ListOfQuadruples<T> = Vec<(T, T, T, T)>;
type ListOfArrays<T, const N: usize> = Vec<[T; N]>;
type List2<T> = Vec<Vec2<T>>;
type List3<T> = Vec<Vec3<T>>;

/// Everything made of numbers that a function may ask for, with its lengths.
macro_rules! conversions {
    ($($kind:ident $([$($n:ident),*])?;)*) => {$(
        impl$(<$(const $n: usize),*>)? IntoPlain<$kind<Real<f64>, $($($n),*)?>> for $kind<f64, $($($n),*)?> {
            fn into_plain(self) -> $kind<Real<f64>, $($($n),*)?> {
                self.lift()
            }
        }

        impl<D: Dual, $($(const $n: usize),*)?> IntoConstant<$kind<f64, $($($n),*)?>> for $kind<Real<D>, $($($n),*)?> {
            fn into_constant(self) -> $kind<f64, $($($n),*)?> {
                self.constants()
            }
        }

        impl<D: Dual, $($(const $n: usize),*)?> IntoConstant<$kind<Real<D>, $($($n),*)?>> for $kind<f64, $($($n),*)?> {
            fn into_constant(self) -> $kind<Real<D>, $($($n),*)?> {
                self.lift()
            }
        }

        #[diagnostic::do_not_recommend]
        impl<D: Dual, $($(const $n: usize),*)?> IntoJet<Nothing> for $kind<Real<D>, $($($n),*)?> {
            fn into_jet(self) -> Nothing {
                Nothing
            }
        }

        impl<'a, D: Dual, $($(const $n: usize),*)?> IntoReference<&'a $kind<f64, $($($n),*)?>>
            for (&'a $kind<f64, $($($n),*)?>, &'a $kind<Real<D>, $($($n),*)?>)
        {
            fn into_reference(self) -> &'a $kind<f64, $($($n),*)?> {
                self.0
            }
        }

        impl<'a, D: Dual, $($(const $n: usize),*)?> IntoReference<&'a $kind<Real<D>, $($($n),*)?>>
            for (&'a $kind<f64, $($($n),*)?>, &'a $kind<Real<D>, $($($n),*)?>)
        {
            fn into_reference(self) -> &'a $kind<Real<D>, $($($n),*)?> {
                self.1
            }
        }
    )*};
}

conversions! {
    Scalar; Vec2; Vec3; EulerParameters; Mat2; Mat3; Pair; Triple; Quadruple; Option; List; List2; List3;
    Array[N]; Table[N, M]; Points2[N]; Points3[N];
    Pairs[N]; Triples[N]; Quadruples[N]; ListOfPairs; ListOfTriples; ListOfQuadruples; ListOfArrays[N];
}

/// Arguments that a function takes as a slice.
macro_rules! slices {
    ($($kind:ident $([$n:ident])? of $part:ident;)*) => {$(
        impl<'a, D: Dual, $(const $n: usize)?> IntoReference<&'a [$part<f64>]> for (&'a $kind<f64, $($n)?>, &'a $kind<Real<D>, $($n)?>) {
            fn into_reference(self) -> &'a [$part<f64>] {
                self.0
            }
        }

        impl<'a, D: Dual, $(const $n: usize)?> IntoReference<&'a [$part<Real<D>>]> for (&'a $kind<f64, $($n)?>, &'a $kind<Real<D>, $($n)?>) {
            fn into_reference(self) -> &'a [$part<Real<D>>] {
                self.1
            }
        }

        impl<'a, D: Dual, $(const $n: usize)?> IntoJet<&'a [$part<Real<D>>]> for &'a $kind<Real<D>, $($n)?> {
            fn into_jet(self) -> &'a [$part<Real<D>>] {
                self
            }
        }
    )*};
}

slices! {
    Array[N] of Scalar; Points2[N] of Vec2; Points3[N] of Vec3; List of Scalar; List2 of Vec2; List3 of Vec3;
    Pairs[N] of Pair; Triples[N] of Triple; Quadruples[N] of Quadruple;
    ListOfPairs of Pair; ListOfTriples of Triple; ListOfQuadruples of Quadruple;
}

impl<'a, D: Dual, const N: usize, const M: usize> IntoReference<&'a [[f64; M]]>
    for (&'a Table<f64, N, M>, &'a Table<Real<D>, N, M>)
{
    fn into_reference(self) -> &'a [[f64; M]] {
        self.0
    }
}

impl<'a, D: Dual, const N: usize, const M: usize> IntoReference<&'a [[Real<D>; M]]>
    for (&'a Table<f64, N, M>, &'a Table<Real<D>, N, M>)
{
    fn into_reference(self) -> &'a [[Real<D>; M]] {
        self.1
    }
}

macro_rules! states {
    ($($kind:ident)*) => {$(
        impl<'a, D: Dual> IntoReference<&'a $kind> for (&'a $kind, &'a $kind<Real<D>>) {
            fn into_reference(self) -> &'a $kind {
                self.0
            }
        }

        impl<'a, D: Dual> IntoReference<&'a $kind<Real<D>>> for (&'a $kind, &'a $kind<Real<D>>) {
            fn into_reference(self) -> &'a $kind<Real<D>> {
                self.1
            }
        }
    )*};
}

states! { PlanarState SpatialState }

impl IntoPlain<PlanarState<Real<f64>>> for PlanarState {
    fn into_plain(self) -> PlanarState<Real<f64>> {
        PlanarState {
            r: self.r.into(),
            theta: Real(self.theta),
            sin: Real(self.sin),
            cos: Real(self.cos),
        }
    }
}

impl IntoPlain<SpatialState<Real<f64>>> for SpatialState {
    fn into_plain(self) -> SpatialState<Real<f64>> {
        SpatialState { r: self.r.into(), p: self.p.into(), a: self.a.into() }
    }
}

/// An argument of the user's function in plain numbers.
pub fn plain_argument<S: IntoPlain<T>, T>(value: S) -> T {
    value.into_plain()
}

/// An argument of the user's function that depends on no coordinate and not on time.
pub fn constant_argument<S: IntoConstant<T>, T>(value: S) -> T {
    value.into_constant()
}

/// An argument of the user's function that carries derivatives. A method, so that its own type is
/// known before the one asked for: rustc then gives the message of [`IntoJet`] instead of speaking
/// of mismatched types.
pub struct Jet<S>(pub S);

impl<S> Jet<S> {
    /// The converted value.
    pub fn argument<T>(self) -> T
    where
        S: IntoJet<T>,
    {
        self.0.into_jet()
    }

    /// The converted value, for a field.
    pub fn field<T>(self) -> T
    where
        S: IntoField<T>,
    {
        self.0.into_field()
    }
}

/// A borrowed argument of the user's function that depends on no coordinate and not on time, from
/// both kinds of numbers.
pub fn reference_argument<'a, P, R, T>(plain: &'a P, lifted: &'a R) -> T
where
    (&'a P, &'a R): IntoReference<T>,
{
    (plain, lifted).into_reference()
}

/// `place += x` of an f64 in a struct of the user's. No value that carries derivatives is
/// [`IntoField<f64>`], so that the message is the one of a field; without these, rustc would speak
/// of operators.
macro_rules! no_place_in_f64 {
    ($($operator:ident :: $method:ident),*) => {$(
        #[doc(hidden)]
        impl<D: Dual> std::ops::$operator<Real<D>> for f64
        where
            Real<D>: IntoField<f64>,
        {
            fn $method(&mut self, other: Real<D>) {
                std::ops::$operator::$method(self, other.into_field());
            }
        }
    )*};
}

no_place_in_f64!(
    AddAssign::add_assign,
    SubAssign::sub_assign,
    MulAssign::mul_assign,
    DivAssign::div_assign,
    RemAssign::rem_assign
);
