//! The functions of one and of two numbers, by what their entries in the one list (`list.rs`) say.
//!
//! The list is two macros that hand themselves to another macro, so that whatever has to do
//! something for every function (numbers of another kind, tests) does it for exactly these:
//! `kin_graph::functions_of_one!(callback)` expands to `callback! { /// … Sin sin "sin" { … } … }`.
//! Their formulas in any numbers are in `rules.rs`.

mod entry;
mod list;
mod values;

use entry::{ABOVE_0, EXACT, LOGARITHM, OF_ANGLES, UNIT, at_quarters};
pub use entry::{ALLOWED, CONTINUOUS, Facts, FactsOfTwo, Growth, Place, SMOOTH};
pub use values::{acosh, asinh, atanh};

macro_rules! vocabulary {
    ($(#[$doc:meta])* $name:ident: $($variant:ident $written:literal;)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum $name { $($variant),* }

        impl $name {
            /// Every function.
            pub const ALL: &'static [$name] = &[$($name::$variant),*];

            /// Name of its method.
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

            /// The function that the method of that name is.
            pub fn from_method(name: &str) -> Option<Self> {
                match name { $($written => Some($name::$variant),)* _ => None }
            }
        }
    };
}

macro_rules! of_one {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal
        { value: $value:expr; $(definition: |$x:ident| $definition:expr;)? slope: |$u:tt, $y:tt| $slope:expr;
          facts: $facts:expr; }
    )*) => {
        vocabulary! { #[doc = "A function of one scalar."] Function: $($variant $written;)* }

        impl Function {
            /// The function itself.
            #[inline]
            pub const fn value(self) -> fn(f64) -> f64 {
                match self { $(Function::$variant => $value),* }
            }

            /// Facts that are known of it.
            #[inline]
            pub const fn facts(self) -> &'static Facts {
                match self { $(Function::$variant => const { &$facts }),* }
            }
        }
    };
}

macro_rules! of_two {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal
        { value: $value:expr; $(definition: |$x:ident, $y:ident| $definition:expr;)?
          slopes: |$u:tt, $v:tt, $z:tt| $slopes:expr; facts: $facts:expr; }
    )*) => {
        vocabulary! { #[doc = "A function of two scalars."] Function2: $($variant $written;)* }

        impl Function2 {
            /// The function itself.
            #[inline]
            pub const fn value(self) -> fn(f64, f64) -> f64 {
                match self { $(Function2::$variant => $value),* }
            }

            /// Facts that are known of it.
            #[inline]
            pub const fn facts(self) -> &'static FactsOfTwo {
                match self { $(Function2::$variant => const { &$facts }),* }
            }
        }
    };
}

crate::functions_of_one!(of_one);
crate::functions_of_two!(of_two);
