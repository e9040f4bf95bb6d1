//! Defines the functions of one and of two numbers from their entries in the list (`list.rs`).
//!
//! The list consists of two macros that pass their entries to another macro. So numbers of other
//! types and tests can implement exactly the functions of the list:
//! `kin_graph::functions_of_one!(callback)` expands to `callback! { /// … Sin sin "sin" { … } … }`.
//! The module `rules.rs` contains the formulas of the functions for any numbers.

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
            /// Every function of the list.
            pub const ALL: &'static [$name] = &[$($name::$variant),*];

            /// Returns the name of the method of f64.
            pub fn method(self) -> &'static str {
                match self { $($name::$variant => $written),* }
            }

            /// Returns the name of the function in the text of a graph.
            pub fn name(self) -> &'static str {
                match self { $($name::$variant => stringify!($variant)),* }
            }

            /// Returns the function with this name.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|f| f.name() == name)
            }

            /// Returns the function for the method with this name.
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
            /// Returns the function for f64.
            #[inline]
            pub const fn value(self) -> fn(f64) -> f64 {
                match self { $(Function::$variant => $value),* }
            }

            /// Returns the known facts of the function.
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
            /// Returns the function for f64.
            #[inline]
            pub const fn value(self) -> fn(f64, f64) -> f64 {
                match self { $(Function2::$variant => $value),* }
            }

            /// Returns the known facts of the function.
            #[inline]
            pub const fn facts(self) -> &'static FactsOfTwo {
                match self { $(Function2::$variant => const { &$facts }),* }
            }
        }
    };
}

crate::functions_of_one!(of_one);
crate::functions_of_two!(of_two);
