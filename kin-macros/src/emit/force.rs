//! The constructor of a force: it takes the length or the angle in the place of coordinates, and
//! makes a load.

use proc_macro2::TokenStream;
use quote::quote;

use kin_language::parse::{Argument, ConstraintFn};

/// The arguments that its constructor takes beside x.
fn parameters(source: &ConstraintFn) -> Vec<&Argument> {
    source.arguments.iter().filter(|a| a.kind.is_field() && a.kind.slots() == 0).collect()
}

/// The inputs of the constructor: x, which is any constraint of one row or the name of a measure,
/// then the parameters.
pub fn inputs(source: &ConstraintFn) -> Vec<TokenStream> {
    let others =
        parameters(source).into_iter().map(|argument| super::constructor_input(argument).0);
    std::iter::once(quote!(impl ::kin::loads::IntoAlong)).chain(others).collect()
}

/// The body of the constructor is `prepared`, then the load that is made of x and this struct.
pub fn constructor(
    source: &ConstraintFn,
    prepared: &TokenStream,
    bindings: &TokenStream,
) -> TokenStream {
    let visibility = &source.visibility;
    let name = &source.name;
    let attributes = &source.attributes;
    let inputs = inputs(source);
    let x = super::own("x");
    let others = parameters(source);
    let silent = others.iter().map(|argument| super::warned_elsewhere(&argument.name));
    let names = others.iter().map(|argument| &argument.name);
    let names: Vec<TokenStream> = std::iter::once(quote!(#x))
        .chain(silent.zip(names).map(|(silent, name)| quote!(#silent #name)))
        .collect();
    let values = source.arguments.iter().filter(|a| a.kind.is_field()).map(|argument| {
        let name = &argument.name;
        match argument.kind.slots() {
            0 => super::constructor_input(argument).1,
            _ => quote!(#name: ::kin::check::any_coord()),
        }
    });
    quote! {
        #(#attributes)*
        #[allow(clippy::too_many_arguments)]
        #[must_use]
        #visibility fn #name(#(#names: #inputs),*) -> ::kin::Load {
            #prepared
            ::kin::Load::written(#x, #name { #(#values),* #bindings })
        }
    }
}
