//! `as` where one side carries derivatives.

use crate::numbers::real::{Dual, Real};

/// `x as f64` and `f64::from(x)` in the dual copy.
pub trait Cast<D> {
    /// The number.
    fn cast(self) -> Real<D>;
}

/// `x as usize`, and as the other whole numbers, in the dual copy.
pub trait Whole<T> {
    /// The whole number.
    fn whole(self) -> T;
}

/// `x as f64` in the dual copy.
pub fn cast<D, T: Cast<D>>(x: T) -> Real<D> {
    x.cast()
}

/// `x as T` in the dual copy, T being a kind of whole number. A derivative is lost, as it is for
/// any step.
pub fn whole<T, S: Whole<T>>(x: S) -> T {
    x.whole()
}

impl<D: Dual> Cast<D> for Real<D> {
    fn cast(self) -> Real<D> {
        self
    }
}

macro_rules! cast {
    ($($number:ty),*) => {$(
        impl<D: Dual> Cast<D> for $number {
            fn cast(self) -> Real<D> {
                Real::from(self as f64)
            }
        }
    )*};
}

cast!(usize, isize, u8, i8, u16, i16, u32, i32, u64, i64, u128, i128, f32, f64);

impl<D: Dual> Cast<D> for bool {
    fn cast(self) -> Real<D> {
        Real::from(f64::from(self))
    }
}

/// Each kind of whole number from all of the others.
macro_rules! whole {
    ($($to:ty),*) => {$(
        whole!(@from $to: usize, isize, u8, i8, u16, i16, u32, i32, u64, i64, u128, i128, f32, f64, bool);

        impl<D: Dual> Whole<$to> for Real<D> {
            fn whole(self) -> $to {
                self.value() as $to
            }
        }
    )*};
    (@from $to:ty: $($from:ty),*) => {$(
        impl Whole<$to> for $from {
            #[allow(clippy::unnecessary_cast)]
            fn whole(self) -> $to {
                self as $to
            }
        }
    )*};
}

whole!(usize, isize, u8, i8, u16, i16, u32, i32, u64, i64, u128, i128);
