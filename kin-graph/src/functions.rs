//! The vocabulary: every function of one or two scalars, with its name in Rust. Derivatives are in `differentiate/rules.rs`.

macro_rules! functions {
    ($(#[$doc:meta])* $name:ident ($value:ty) { $($variant:ident = $method:literal => $function:expr,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum $name { $($variant),* }

        impl $name {
            /// Every function, for tests that loop over the list.
            #[cfg(test)]
            pub const ALL: &'static [$name] = &[$($name::$variant),*];

            /// Name of f64's method.
            pub fn method(self) -> &'static str {
                match self { $($name::$variant => $method),* }
            }

            /// The function itself, for folding constants.
            pub fn value(self) -> $value {
                match self { $($name::$variant => $function),* }
            }

            pub fn from_method(name: &str) -> Option<Self> {
                match name { $($method => Some($name::$variant),)* _ => None }
            }
        }
    };
}

functions! {
    /// A function of one scalar.
    Function(fn(f64) -> f64) {
        Sin = "sin" => f64::sin,
        Cos = "cos" => f64::cos,
        Tan = "tan" => f64::tan,
        Asin = "asin" => f64::asin,
        Acos = "acos" => f64::acos,
        Atan = "atan" => f64::atan,
        Sinh = "sinh" => f64::sinh,
        Cosh = "cosh" => f64::cosh,
        Tanh = "tanh" => f64::tanh,
        Asinh = "asinh" => f64::asinh,
        Acosh = "acosh" => acosh,
        Atanh = "atanh" => atanh,
        Exp = "exp" => f64::exp,
        Exp2 = "exp2" => f64::exp2,
        ExpM1 = "exp_m1" => f64::exp_m1,
        Ln = "ln" => f64::ln,
        Ln1p = "ln_1p" => f64::ln_1p,
        Log2 = "log2" => f64::log2,
        Log10 = "log10" => f64::log10,
        Sqrt = "sqrt" => f64::sqrt,
        Cbrt = "cbrt" => f64::cbrt,
        Abs = "abs" => f64::abs,
        Signum = "signum" => f64::signum,
        Floor = "floor" => f64::floor,
        Ceil = "ceil" => f64::ceil,
        Round = "round" => f64::round,
        Trunc = "trunc" => f64::trunc,
        Fract = "fract" => f64::fract,
    }
}

functions! {
    /// A function of two scalars.
    Function2(fn(f64, f64) -> f64) {
        Atan2 = "atan2" => f64::atan2,
        Hypot = "hypot" => f64::hypot,
        Powf = "powf" => f64::powf,
        Max = "max" => f64::max,
        Min = "min" => f64::min,
        RemEuclid = "rem_euclid" => f64::rem_euclid,
        DivEuclid = "div_euclid" => f64::div_euclid,
        Rem = "%" => |x, y| x % y,
    }
}

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

/// arcosh x to rounding, NaN below 1. That of the standard library loses all digits near 1: it adds 1 before it takes the logarithm.
///
/// With t = x − 1 it is ln(1 + t + √(2 t + t²)); from 2 on ln(2 x − 1/(x + √(x² − 1))), and ln x + ln 2 where 1/x is below rounding.
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

/// artanh x to rounding, infinite at ±1, NaN beyond: ½ ln(1 + 2 |x|/(1 − |x|)) of the sign of x. Of a negative x the standard library takes the
/// logarithm of a difference that is nearly zero.
pub fn atanh(x: f64) -> f64 {
    let a = x.abs();
    let twice = a + a;
    let y = if a < 0.5 { twice + twice * a / (1.0 - a) } else { twice / (1.0 - a) };
    (0.5 * y.ln_1p()).copysign(x)
}
