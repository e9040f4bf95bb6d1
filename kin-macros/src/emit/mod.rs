//! Last stage: from the graph, and from the user's own body, to Rust. `quote` begins here.

pub mod constraint;
mod functions;
mod kernel;
pub mod law;
mod rewrite;
mod template;
mod variables;

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;

use crate::parse::{Argument, Kind};

/// Type of a field of the emitted struct.
fn field_type(argument: &Argument) -> TokenStream {
    match &argument.kind {
        Kind::Planar => quote!(::kin::PlanarBody),
        Kind::Spatial => quote!(::kin::SpatialBody),
        Kind::Coord => quote!(::kin::Coordinate),
        Kind::Coords(n) => {
            let n = proc_macro2::Literal::usize_unsuffixed(*n);
            quote!([::kin::Coordinate; #n])
        }
        _ => {
            let ty = &argument.ty;
            quote!(#ty)
        }
    }
}

/// `parameters` and `set_parameter`: laws and vectors know their own parts.
fn parameter_methods(arguments: &[Argument]) -> (TokenStream, TokenStream) {
    let numeric: Vec<_> = arguments.iter().filter(|a| matches!(a.kind, Kind::Numbers(_) | Kind::Law)).map(|a| &a.name).collect();
    let texts: Vec<String> = numeric.iter().map(|name| syn::ext::IdentExt::unraw(*name).to_string()).collect();
    let visit = quote! {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            #(::kin::rt::Numbers::visit(&self.#numeric, #texts, visit);)*
        }
    };
    let set = quote! {
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            false #(|| ::kin::rt::Numbers::set(&mut self.#numeric, #texts, name, value))*
        }
    };
    (visit, set)
}

/// A parameter of a type that only rustc knows must be a value of its own, and no alias of a coordinate.
fn parameter_checks(arguments: &[Argument]) -> TokenStream {
    let checks = arguments.iter().filter(|a| a.kind == Kind::Other).map(|argument| {
        let ty = &argument.ty;
        quote_spanned!(ty.span()=> ::kin::rt::require_parameter::<#ty>();)
    });
    quote!(const _: fn() = || { #(#checks)* };)
}

/// The user's name for every parameter, bound to a clone of the field.
fn plain_bindings(arguments: &[Argument]) -> Vec<TokenStream> {
    let parameters = arguments.iter().filter(|a| a.kind.is_field() && a.kind.slots() == 0);
    parameters
        .map(|argument| {
            let (name, mutable, ty) = (&argument.name, mutable(argument), &argument.ty);
            quote!(let #mutable #name: #ty = self.#name.clone();)
        })
        .collect()
}

/// The user's name for every parameter, with numbers lifted to `Real<__D>`.
fn dual_bindings(arguments: &[Argument]) -> Vec<TokenStream> {
    let parameters = arguments.iter().filter(|a| a.kind.is_field() && a.kind.slots() == 0);
    parameters
        .map(|argument| {
            let (name, mutable) = (&argument.name, mutable(argument));
            match argument.kind {
                Kind::Numbers(_) => quote!(let #mutable #name = ::kin::rt::Lift::<__D>::lift(self.#name.clone());),
                _ => quote!(let #mutable #name = self.#name.clone();),
            }
        })
        .collect()
}

fn mutable(argument: &Argument) -> TokenStream {
    if argument.mutable { quote!(mut) } else { quote!() }
}

/// Attributes of the constructor, and of the struct: its documentation says what the constructor's says.
fn documentation(attributes: &[syn::Attribute]) -> Vec<&syn::Attribute> {
    attributes.iter().filter(|a| a.path().is_ident("doc")).collect()
}
