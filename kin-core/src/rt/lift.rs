//! From f64 to dual numbers.

use crate::algebra::{Mat2, Mat3, Vec2, Vec3};
use crate::real::{Dual, Real};

/// A value made of f64 as the same value made of constant `Real<D>`.
pub trait Lift<D> {
    /// The lifted type.
    type Output;
    /// Every number as a constant.
    fn lift(self) -> Self::Output;
}

impl<D: Dual> Lift<D> for f64 {
    type Output = Real<D>;
    fn lift(self) -> Real<D> {
        Real::from(self)
    }
}

macro_rules! lift_vectors {
    ($($kind:ident),*) => {$(
        impl<D: Dual> Lift<D> for $kind<f64> {
            type Output = $kind<Real<D>>;
            fn lift(self) -> Self::Output {
                self.into()
            }
        }
    )*};
}

lift_vectors!(Vec2, Vec3, Mat2, Mat3);

impl<D, T: Lift<D>, const N: usize> Lift<D> for [T; N] {
    type Output = [T::Output; N];
    fn lift(self) -> Self::Output {
        self.map(Lift::lift)
    }
}

macro_rules! lift_tuples {
    ($(($($t:ident $k:tt),*))*) => {$(
        impl<D, $($t: Lift<D>),*> Lift<D> for ($($t,)*) {
            type Output = ($($t::Output,)*);
            fn lift(self) -> Self::Output {
                ($(self.$k.lift(),)*)
            }
        }
    )*};
}

lift_tuples!((A 0) (A 0, B 1) (A 0, B 1, C 2) (A 0, B 1, C 2, E 3) (A 0, B 1, C 2, E 3, F 4) (A 0, B 1, C 2, E 3, F 4, G 5));

/// `x as f64` in the dual copy.
pub trait Cast<D> {
    /// The number.
    fn cast(self) -> Real<D>;
}

impl<D: Dual> Cast<D> for Real<D> {
    fn cast(self) -> Real<D> {
        self
    }
}

macro_rules! cast_numbers {
    ($($number:ty),*) => {$(
        impl<D: Dual> Cast<D> for $number {
            fn cast(self) -> Real<D> {
                Real::from(self as f64)
            }
        }
    )*};
}

cast_numbers!(usize, isize, u8, i8, u16, i16, u32, i32, u64, i64, f32, f64);

/// `x as f64` in the dual copy.
pub fn cast<D, T: Cast<D>>(x: T) -> Real<D> {
    x.cast()
}
