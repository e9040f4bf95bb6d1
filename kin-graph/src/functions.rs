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
        Acosh = "acosh" => f64::acosh,
        Atanh = "atanh" => f64::atanh,
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
