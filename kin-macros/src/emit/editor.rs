//! The code that an editor is shown of a constraint or a law: an ordinary function with the user's
//! body in it. The expressions of attributes stand before the body, so that renaming an argument
//! finds it there too.
//!
//! It is the first that is emitted, with or without mistakes: rust-analyzer completes a word by two
//! expansions, one of the text as it is and one with a word put in, which may be a mistake, and
//! looks in both at the same place.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::{Block, FnArg, ReturnType, Signature, Type};

use super::written;
use kin_language::parse::{self, Argument, ConstraintFn, Kind, LawFn};

/// For a constraint whose signature was understood: its plain copy with this body, and traits that
/// compute nothing.
pub fn constraint(source: &ConstraintFn, body: &Block) -> TokenStream {
    let name = &source.name;
    let conditions =
        source.requirements.iter().chain(&source.branches).map(|demand| &demand.condition);
    let values = source.measures.iter().map(|measure| &measure.value);
    let ends = source
        .measures
        .iter()
        .filter_map(|measure| measure.ends.as_ref())
        .flat_map(|(from, to)| [from, to]);
    let values = values.chain(ends);
    let attributes = quote!(#(let _: bool = #conditions;)* #(let _: f64 = #values;)*);
    let inputs: Vec<TokenStream> = source.arguments.iter().map(input).collect();
    let copy = copy(&inputs, &written::known(&source.output_type), &attributes, body);
    quote!(::kin::emitted::inside_editor! { #copy ::kin::emitted::stand_in!(#name); })
}

/// For a law whose signature was understood: its plain copy with this body.
pub fn law(source: &LawFn, body: &Block) -> TokenStream {
    let variable = &source.variable;
    let inputs: Vec<TokenStream> = std::iter::once(quote!(#variable: f64))
        .chain(source.parameters.iter().map(input))
        .collect();
    let conditions = source.requirements.iter().map(|demand| &demand.condition);
    let attributes = quote!(#(let _: bool = #conditions;)*);
    let copy = copy(&inputs, &syn::parse_quote!(f64), &attributes, body);
    quote!(::kin::emitted::inside_editor! { #copy })
}

/// For a signature with mistakes in it, or a body that is no Rust yet: the function with what its
/// types stand for, as far as that is known.
pub fn unread(signature: &Signature, body: &TokenStream) -> TokenStream {
    let inputs: Vec<TokenStream> = signature
        .inputs
        .iter()
        .map(|input| match input {
            FnArg::Typed(typed) => {
                let pattern = &typed.pat;
                let ty = parse::kind(&typed.ty).ok().map(|kind| plain_type(&kind, &typed.ty));
                let ty = ty.unwrap_or_else(|| typed.ty.to_token_stream());
                quote!(#pattern: #ty)
            }
            FnArg::Receiver(_) => quote!(),
        })
        .filter(|input| !input.is_empty())
        .collect();
    let output = match &signature.output {
        ReturnType::Type(_, ty) => written::known(ty),
        ReturnType::Default => syn::parse_quote!(()),
    };
    let copy = copy(&inputs, &output, &quote!(), body);
    quote!(::kin::emitted::inside_editor! { #copy })
}

fn copy(
    inputs: &[TokenStream],
    output: &Type,
    attributes: &TokenStream,
    body: &dyn ToTokens,
) -> TokenStream {
    let written: Ident = super::own("written");
    quote! {
        const _: () = {
            use ::kin::emitted::{LiftAny as _, LiftNumbers as _, LowerAny as _, LowerReal as _};
            use ::kin::emitted::{ReceiveAny as _, ReceiveNumbers as _, ReceiveReference as _};
            use ::kin::emitted::{TakesAsIs as _, TakesConverted as _};
            fn #written(#(#inputs),*) -> #output {
                #attributes
                #body
            }
        };
    }
}

fn input(argument: &Argument) -> TokenStream {
    let name = &argument.name;
    let mutable = super::mutable(argument);
    let ty = plain_type(&argument.kind, &argument.ty);
    quote!(#mutable #name: #ty)
}

/// The type of an argument inside of the body; a parameter of the user's is taken as it is.
fn plain_type(kind: &Kind, ty: &Type) -> TokenStream {
    match kind {
        Kind::Other => ty.to_token_stream(),
        kind => written::plain_type(kind, ty),
    }
}
