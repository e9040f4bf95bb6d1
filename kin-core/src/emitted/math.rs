//! Functions of f64, which emitted code calls by these names: it names nothing of the standard
//! library itself.

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

        /// The same as methods, for those that f64 does not have itself.
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
            #[doc = concat!("f64's `", $written, "`, or what stands for it.")]
            #[inline(always)]
            pub fn $method(x: f64, y: f64) -> f64 {
                $value(x, y)
            }
        )*

        /// The same of two numbers; `%` is an operator.
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
