//! Functions of f64, which emitted code calls by these names: it names nothing of the standard library
//! itself.

macro_rules! of_one {
    ($($variant:ident $method:ident $written:literal;)*) => {$(
        #[doc = concat!("f64's `", $written, "`.")]
        #[inline(always)]
        pub fn $method(x: f64) -> f64 {
            (of_one!(@ $method))(x)
        }
    )*};
    (@ acosh) => { kin_graph::functions::acosh };
    (@ atanh) => { kin_graph::functions::atanh };
    (@ $method:ident) => { f64::$method };
}

macro_rules! of_two {
    ($($variant:ident $method:ident $written:literal;)*) => {$(
        #[doc = concat!("f64's `", $written, "`.")]
        #[inline(always)]
        pub fn $method(x: f64, y: f64) -> f64 {
            #[allow(unused_imports)]
            use std::ops::Rem as _;
            x.$method(y)
        }
    )*};
}

kin_graph::functions_of_one!(of_one);
kin_graph::functions_of_two!(of_two);

/// xⁿ
#[inline(always)]
pub fn powi(x: f64, n: i32) -> f64 {
    x.powi(n)
}

/// (sin x, cos x)
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    x.sin_cos()
}
