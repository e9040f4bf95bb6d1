//! Selects the part of the emitted code for the compiler or the part for an editor (rust-analyzer
//! sets `cfg(rust_analyzer)`).
//!
//! An editor needs the function as the user wrote it, and neither its derivatives nor its copies.
//!
//! This module makes the choice, and not attributes in emitted code, because the user's crate does
//! not know `cfg(rust_analyzer)`.

/// Items for the compiler alone.
#[cfg(not(rust_analyzer))]
#[doc(hidden)]
#[macro_export]
macro_rules! __outside_editor {
    ($($items:tt)*) => { $($items)* };
}

/// Items for the compiler alone.
#[cfg(rust_analyzer)]
#[doc(hidden)]
#[macro_export]
macro_rules! __outside_editor {
    ($($items:tt)*) => {};
}

/// Items for an editor alone.
#[cfg(not(rust_analyzer))]
#[doc(hidden)]
#[macro_export]
macro_rules! __inside_editor {
    ($($items:tt)*) => {};
}

/// Items for an editor alone.
#[cfg(rust_analyzer)]
#[doc(hidden)]
#[macro_export]
macro_rules! __inside_editor {
    ($($items:tt)*) => { $($items)* };
}

/// The traits of a constraint for a struct that cannot be computed with, after a mistake or in an
/// editor.
#[doc(hidden)]
#[macro_export]
macro_rules! __stand_in {
    ($name:ident) => {
        const _: () = {
            impl $crate::Constraint for $name {
                fn facts(&self) -> $crate::constraint::Facts<'_> {
                    $crate::constraint::Facts::of("")
                }
                fn arguments(&self) -> ::std::vec::Vec<$crate::emitted::Argument> {
                    ::std::vec::Vec::new()
                }
                fn residual(&self, _: &$crate::emitted::At<'_>, _: &mut [f64]) {}
                fn jacobian(&self, _: &$crate::emitted::At<'_>, _: &mut [f64]) {}
                fn velocity_rhs(&self, _: &$crate::emitted::At<'_>, _: &mut [f64]) {}
                fn acceleration_rhs(
                    &self,
                    _: &$crate::emitted::At<'_>,
                    _: &$crate::emitted::Rates<'_>,
                    _: f64,
                    _: &mut [f64],
                ) {
                }
            }
            impl $crate::emitted::Described for $name {
                const KIND: &'static str = "";
                const ARGUMENTS: &'static [$crate::emitted::ArgumentKind] = &[];
                fn read(_: &mut $crate::emitted::Reader<'_>) -> ::core::option::Option<Self> {
                    ::core::option::Option::None
                }
            }
            impl $crate::emitted::Equation<0, 0> for $name {
                const ARGUMENTS: &'static [$crate::emitted::ArgumentKind] = &[];
                fn evaluate<D: $crate::emitted::Dual>(
                    &self,
                    _: &[$crate::emitted::Real<D>; 0],
                    _: $crate::emitted::Real<D>,
                ) -> [$crate::emitted::Real<D>; 0] {
                    []
                }
                fn plain(&self, _: &[f64; 0], _: f64) -> [f64; 0] {
                    []
                }
            }
        };
    };
}
