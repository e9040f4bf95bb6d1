//! The functions of f64 under the names that emitted code calls; emitted code uses no name of the
//! standard library.

macro_rules! of_one {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal { value: $value:expr; $($rest:tt)* }
    )*) => {
        $(
            $(#[$doc])*
            #[inline(always)]
            pub fn $method(x: f64) -> f64 {
                $value(x)
            }
        )*

        /// The functions of one number as methods, for those that are no method of f64.
        pub trait Functions {$(
            #[doc = concat!("See [`", $written, "()`].")]
            fn $method(self) -> f64;
        )*}

        impl Functions for f64 {$(
            #[inline(always)]
            fn $method(self) -> f64 {
                $method(self)
            }
        )*}
    };
}

macro_rules! of_two {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal { value: $value:expr; $($rest:tt)* }
    )*) => {
        $(
            #[doc = concat!("f64's `", $written, "`, or the number that replaces it.")]
            #[inline(always)]
            pub fn $method(x: f64, y: f64) -> f64 {
                $value(x, y)
            }
        )*

        /// The functions of two numbers as methods; `%` is an operator.
        pub trait FunctionsOfTwo {
            $(of_two! { @ declared $method $written })*
        }

        impl FunctionsOfTwo for f64 {
            $(of_two! { @ defined $method })*
        }
    };
    (@ $part:ident rem $($rest:tt)*) => {};
    (@ declared $method:ident $written:literal) => {
        #[doc = concat!("See [`", $written, "()`].")]
        fn $method(self, other: f64) -> f64;
    };
    (@ defined $method:ident) => {
        #[inline(always)]
        fn $method(self, other: f64) -> f64 {
            $method(self, other)
        }
    };
}

kin_graph::functions_of_one!(of_one);
kin_graph::functions_of_two!(of_two);

/// Returns xⁿ.
#[inline(always)]
pub fn powi(x: f64, n: i32) -> f64 {
    x.powi(n)
}

/// Returns (sin x, cos x).
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    x.sin_cos()
}
