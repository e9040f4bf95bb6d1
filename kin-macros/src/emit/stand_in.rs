//! After a mistake: something of the function's name that type-checks wherever it is used, so that one mistake gives one message.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{FnArg, Ident, Item, ItemFn, Type, Visibility};

use super::functions;
use kin_language::parse::{ConstraintFn, Kind, LawFn};

/// For a constraint whose signature was understood.
pub fn constraint(source: &ConstraintFn) -> TokenStream {
    let inputs = source.arguments.iter().filter(|argument| argument.kind.is_field());
    let inputs: Vec<TokenStream> = inputs
        .map(|argument| {
            let ty = super::field_type(argument);
            match argument.kind {
                Kind::Planar | Kind::Spatial | Kind::Coord | Kind::Axis => quote!(impl ::core::convert::Into<#ty>),
                Kind::Other => anything(),
                _ => ty,
            }
        })
        .collect();
    constraint_of(&source.visibility, &source.name, &inputs)
}

/// For a law whose signature was understood.
pub fn law(source: &LawFn) -> TokenStream {
    let inputs: Vec<TokenStream> = source
        .parameters
        .iter()
        .map(|argument| if argument.kind == Kind::Other { anything() } else { super::field_type(argument) })
        .collect();
    law_of(&source.visibility, &source.name, &inputs)
}

/// For any item under `#[constraint]`.
pub fn constraint_item(item: TokenStream) -> TokenStream {
    match as_function(item) {
        Ok(function) => constraint_of(&function.vis, &function.sig.ident, &inputs(&function)),
        Err(other) => other,
    }
}

/// For any item under `#[law]`.
pub fn law_item(item: TokenStream) -> TokenStream {
    match as_function(item) {
        Ok(function) => law_of(&function.vis, &function.sig.ident, inputs(&function).get(1..).unwrap_or_default()),
        Err(other) => other,
    }
}

/// The item, if it is a function; else something to emit in its place: itself, if it is Rust.
fn as_function(item: TokenStream) -> Result<ItemFn, TokenStream> {
    match syn::parse2(item) {
        Ok(Item::Fn(function)) => Ok(function),
        Ok(other) => Err(quote!(#other)),
        Err(_) => Err(quote!()),
    }
}

/// What a constructor would take, as far as can be told from a signature with mistakes in it.
fn inputs(function: &ItemFn) -> Vec<TokenStream> {
    let is_input = |input: &&FnArg| match input {
        FnArg::Typed(typed) => !is_time(&typed.ty),
        FnArg::Receiver(_) => false,
    };
    function.sig.inputs.iter().filter(is_input).map(|_| anything()).collect()
}

fn is_time(ty: &Type) -> bool {
    match ty {
        Type::Reference(inner) => is_time(&inner.elem),
        Type::Path(path) => path.path.segments.last().is_some_and(|last| last.ident == "Time"),
        _ => false,
    }
}

fn anything() -> TokenStream {
    quote!(impl ::core::marker::Sized)
}

fn constraint_of(visibility: &Visibility, name: &Ident, inputs: &[TokenStream]) -> TokenStream {
    let nothing = functions::nothing();
    quote! {
        #[allow(non_camel_case_types, missing_docs)]
        #[derive(Clone)]
        #visibility struct #name {}

        #[allow(missing_docs)]
        #visibility fn #name(#(_: #inputs),*) -> #name {
            #name {}
        }

        const _: () = {
            impl ::kin::Constraint for #name {
                fn kind(&self) -> &str {
                    ""
                }
                fn route(&self) -> ::kin::Route {
                    ::kin::Route::Dual
                }
                fn arguments(&self) -> ::std::vec::Vec<::kin::rt::Argument> {
                    ::std::vec::Vec::new()
                }
                fn rows(&self) -> &[&str] {
                    &[]
                }
                fn pattern(&self) -> &[(usize, usize)] {
                    &[]
                }
                #nothing
            }
            impl ::kin::rt::Described for #name {
                const KIND: &'static str = "";
                const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[];
                fn read(_: &mut ::kin::rt::Reader<'_>) -> ::core::option::Option<Self> {
                    ::core::option::Option::Some(#name {})
                }
            }
            impl ::kin::rt::Equation<0, 0> for #name {
                const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[];
                fn evaluate<__D: ::kin::rt::Dual>(&self, _: &[::kin::rt::Real<__D>; 0], _: ::kin::rt::Real<__D>) -> [::kin::rt::Real<__D>; 0] {
                    []
                }
                fn plain(&self, _: &[f64; 0], _: f64) -> [f64; 0] {
                    []
                }
            }
        };
    }
}

fn law_of(visibility: &Visibility, name: &Ident, inputs: &[TokenStream]) -> TokenStream {
    quote! {
        #[allow(missing_docs)]
        #visibility fn #name(#(_: #inputs),*) -> ::kin::Law {
            ::core::unreachable!()
        }
    }
}
