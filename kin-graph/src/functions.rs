//! The vocabulary: every function of one or two scalars, one line each, with its name in Rust. Derivatives
//! are in `differentiate/rules.rs`.
//!
//! The two lists are macros that hand themselves to another macro, so that whatever has to do something for
//! every function (numbers of another kind, tests) does it for exactly these:
//! `kin_graph::functions_of_one!(callback)` expands to `callback! { Sin sin "sin"; … }`.

/// Hands every function of one scalar to a macro: its name, f64's method, and the method's name as it is
/// written.
#[macro_export]
macro_rules! functions_of_one {
    ($to:ident) => {
        $to! {
            Sin sin "sin";
            Cos cos "cos";
            Tan tan "tan";
            Asin asin "asin";
            Acos acos "acos";
            Atan atan "atan";
            Sinh sinh "sinh";
            Cosh cosh "cosh";
            Tanh tanh "tanh";
            Asinh asinh "asinh";
            Acosh acosh "acosh";
            Atanh atanh "atanh";
            Exp exp "exp";
            Exp2 exp2 "exp2";
            ExpM1 exp_m1 "exp_m1";
            Ln ln "ln";
            Ln1p ln_1p "ln_1p";
            Log2 log2 "log2";
            Log10 log10 "log10";
            Sqrt sqrt "sqrt";
            Cbrt cbrt "cbrt";
            Abs abs "abs";
            Signum signum "signum";
            Floor floor "floor";
            Ceil ceil "ceil";
            Round round "round";
            Trunc trunc "trunc";
            Fract fract "fract";
        }
    };
}

/// Hands every function of two scalars to a macro, as [`functions_of_one`] does; the operator `%` is a method
/// of [`std::ops::Rem`].
#[macro_export]
macro_rules! functions_of_two {
    ($to:ident) => {
        $to! {
            Atan2 atan2 "atan2";
            Hypot hypot "hypot";
            Powf powf "powf";
            Max max "max";
            Min min "min";
            RemEuclid rem_euclid "rem_euclid";
            DivEuclid div_euclid "div_euclid";
            Rem rem "%";
        }
    };
}

macro_rules! vocabulary {
    ($(#[$doc:meta])* $name:ident: $($variant:ident $method:ident $written:literal;)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum $name { $($variant),* }

        impl $name {
            /// Every function.
            pub const ALL: &'static [$name] = &[$($name::$variant),*];

            /// Name of f64's method.
            pub fn method(self) -> &'static str {
                match self { $($name::$variant => $written),* }
            }

            /// Its name in the text of a graph.
            pub fn name(self) -> &'static str {
                match self { $($name::$variant => stringify!($variant)),* }
            }

            /// The function of that name.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|f| f.name() == name)
            }

            /// The function that f64's method of that name is.
            pub fn from_method(name: &str) -> Option<Self> {
                match name { $($written => Some($name::$variant),)* _ => None }
            }
        }
    };
}

macro_rules! of_one {
    ($($variant:ident $method:ident $written:literal;)*) => {
        vocabulary! { #[doc = "A function of one scalar."] Function: $($variant $method $written;)* }

        impl Function {
            /// The function itself, for folding constants.
            pub fn value(self) -> fn(f64) -> f64 {
                match self {
                    // Of these two the standard library loses digits.
                    Function::Acosh => return acosh,
                    Function::Atanh => return atanh,
                    _ => {}
                }
                match self { $(Function::$variant => f64::$method),* }
            }
        }
    };
}

macro_rules! of_two {
    ($($variant:ident $method:ident $written:literal;)*) => {
        vocabulary! { #[doc = "A function of two scalars."] Function2: $($variant $method $written;)* }

        impl Function2 {
            /// The function itself, for folding constants.
            pub fn value(self) -> fn(f64, f64) -> f64 {
                use std::ops::Rem;
                match self { $(Function2::$variant => |x, y| x.$method(y)),* }
            }
        }
    };
}

functions_of_one!(of_one);
functions_of_two!(of_two);

impl Function {
    /// Whether f64 has the value of it exactly.
    pub fn is_exact(self) -> bool {
        use Function::*;
        matches!(self, Abs | Signum | Floor | Ceil | Round | Trunc | Fract)
    }
}

impl Function2 {
    /// Whether f64 has the value of it exactly.
    pub fn is_exact(self) -> bool {
        matches!(self, Function2::Max | Function2::Min | Function2::Rem)
    }
}

/// arcosh x to rounding, NaN below 1. That of the standard library loses all digits near 1: it adds 1 before
/// it takes the logarithm.
///
/// With t = x − 1 it is ln(1 + t + √(2 t + t²)); from 2 on ln(2 x − 1/(x + √(x² − 1))), and ln x + ln 2 where
/// 1/x is below rounding.
pub fn acosh(x: f64) -> f64 {
    if x < 1.0 {
        f64::NAN
    } else if x > 1e9 {
        x.ln() + std::f64::consts::LN_2
    } else if x > 2.0 {
        (2.0 * x - (x + (x * x - 1.0).sqrt()).recip()).ln()
    } else {
        let t = x - 1.0;
        (t + (t * (2.0 + t)).sqrt()).ln_1p()
    }
}

/// artanh x to rounding, infinite at ±1, NaN beyond: ½ ln(1 + 2 |x|/(1 − |x|)) of the sign of x. Of a
/// negative x the standard library takes the logarithm of a difference that is nearly zero.
pub fn atanh(x: f64) -> f64 {
    let a = x.abs();
    let twice = a + a;
    let y = if a < 0.5 { twice + twice * a / (1.0 - a) } else { twice / (1.0 - a) };
    (0.5 * y.ln_1p()).copysign(x)
}

impl Function {
    /// Whether its values are small and finite, whatever the argument.
    pub fn is_bounded(self) -> bool {
        use Function::{Acos, Asin, Atan, Cos, Fract, Signum, Sin, Tanh};
        matches!(self, Sin | Cos | Tanh | Asin | Acos | Atan | Fract | Signum)
    }

    /// Whether it makes what is large small.
    pub fn is_logarithmic(self) -> bool {
        use Function::{Acosh, Asinh, Atanh, Ln, Ln1p, Log2, Log10};
        matches!(self, Asinh | Acosh | Atanh | Ln | Ln1p | Log2 | Log10)
    }

    /// Whether it is infinite at some finite argument.
    pub fn has_poles(self) -> bool {
        use Function::{Atanh, Ln, Ln1p, Log2, Log10, Tan};
        matches!(self, Tan | Atanh | Ln | Ln1p | Log2 | Log10)
    }

    /// Whether it grows as an exponential does.
    pub fn bursts(self) -> bool {
        matches!(self, Function::Exp | Function::Exp2 | Function::ExpM1 | Function::Sinh | Function::Cosh)
    }

    /// Whether its slope is finite wherever its value is.
    pub fn is_tame(self) -> bool {
        use Function::{
            Abs, Asinh, Atan, Ceil, Cos, Cosh, Exp, Exp2, ExpM1, Floor, Fract, Round, Signum, Sin, Sinh, Tan,
            Tanh, Trunc,
        };
        let curved = matches!(self, Sin | Cos | Tan | Sinh | Cosh | Tanh | Asinh | Atan | Exp | Exp2 | ExpM1);
        curved || matches!(self, Abs | Fract | Signum | Floor | Ceil | Round | Trunc)
    }
}
