//! The constraint compiler of Kin: `#[constraint]` turns one Rust function C(q, t) into residual, Jacobian and right sides; `#[law]` turns a
//! function of one variable into a law with its derivatives.
//!
//! The stages, in the order data moves: `parse` → `lower` (over `graph`) → `differentiate` → `emit`.
#![forbid(unsafe_code)]

mod differentiate;
mod emit;
mod error;
mod expand;
mod graph;
mod lower;
mod parse;

use proc_macro::TokenStream;

/// Turns a function C(q, t) into a constraint with all its derivatives. See the documentation of `kin`.
#[proc_macro_attribute]
pub fn constraint(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::constraint(attribute.into(), item.into()).into()
}

/// Turns a function f(x) into a law with its derivatives to third order. See the documentation of `kin`.
#[proc_macro_attribute]
pub fn law(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::law(&attribute.into(), item.into()).into()
}
