//! The functions that a step can be, each by Kin's own number with derivatives: no rule is written twice.

use std::ops::{Add, Div, Mul, Rem, Sub};

use crate::real::{Dual, Real};

macro_rules! functions {
    ($(#[$doc:meta])* $name:ident($function:ty) { $($variant:ident => $f:expr,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs)]
        pub enum $name { $($variant),* }

        impl $name {
            /// The function of that name.
            pub(crate) fn named(name: &str) -> Option<Self> {
                match name { $(stringify!($variant) => Some($name::$variant),)* _ => None }
            }

            /// The function with as many derivatives as the numbers have.
            pub(crate) fn by_dual<D: Dual>(self) -> $function {
                match self { $($name::$variant => $f),* }
            }
        }
    };
}

functions! {
    /// A function of one number, named after f64's.
    Function(fn(Real<D>) -> Real<D>) {
        Sin => Real::sin,
        Cos => Real::cos,
        Tan => Real::tan,
        Asin => Real::asin,
        Acos => Real::acos,
        Atan => Real::atan,
        Sinh => Real::sinh,
        Cosh => Real::cosh,
        Tanh => Real::tanh,
        Asinh => Real::asinh,
        Acosh => Real::acosh,
        Atanh => Real::atanh,
        Exp => Real::exp,
        Exp2 => Real::exp2,
        ExpM1 => Real::exp_m1,
        Ln => Real::ln,
        Ln1p => Real::ln_1p,
        Log2 => Real::log2,
        Log10 => Real::log10,
        Sqrt => Real::sqrt,
        Cbrt => Real::cbrt,
        Abs => Real::abs,
        Signum => Real::signum,
        Floor => Real::floor,
        Ceil => Real::ceil,
        Round => Real::round,
        Trunc => Real::trunc,
        Fract => Real::fract,
    }
}

functions! {
    /// A function of two numbers.
    Function2(fn(Real<D>, Real<D>) -> Real<D>) {
        Sum => Add::add,
        Difference => Sub::sub,
        Product => Mul::mul,
        Quotient => Div::div,
        Atan2 => Real::atan2,
        Hypot => Real::hypot,
        Powf => Real::powf,
        Max => Real::max,
        Min => Real::min,
        Rem => Rem::rem,
        RemEuclid => Real::rem_euclid,
        DivEuclid => Real::div_euclid,
    }
}
