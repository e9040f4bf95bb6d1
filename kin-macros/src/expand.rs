//! The driver: the stages as a chain, and what happens when one of them finds a mistake.

use proc_macro2::TokenStream;
use quote::quote;

use crate::lower::{Failure, Unreadable};
use crate::parse::Choice;
use crate::{emit, lower, parse};

/// `#[constraint]`
pub fn constraint(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let source = match parse::constraint(attribute, item) {
        Ok(source) => source,
        Err(mistakes) => return mistakes.to_compile_error(),
    };
    match (source.choice, lower::constraint(&source)) {
        (_, Err(Failure::Mistakes(mistakes))) => with_dummy(&mistakes, &emit::constraint::dummy(&source)),
        (Choice::Dual, _) | (Choice::Best, Err(Failure::Unreadable(_))) => emit::constraint::dual(&source),
        (Choice::Symbolic, Err(Failure::Unreadable(why))) => with_dummy(&refusal(&why, &source.name), &emit::constraint::dummy(&source)),
        (_, Ok(lowered)) => emit::constraint::symbolic(&source, lowered),
    }
}

/// `#[law]`
pub fn law(attribute: &TokenStream, item: TokenStream) -> TokenStream {
    let source = match parse::law(attribute, item) {
        Ok(source) => source,
        Err(mistakes) => return mistakes.to_compile_error(),
    };
    match lower::law(&source.variable, &source.parameters, &source.body) {
        Err(Failure::Mistakes(mistakes)) => with_dummy(&mistakes, &emit::law::dummy(&source)),
        Err(Failure::Unreadable(_)) => emit::law::law(&source, None),
        Ok(lowered) => emit::law::law(&source, Some(lowered)),
    }
}

/// The messages, and something that type-checks, so that no further message follows from the first.
fn with_dummy(mistakes: &syn::Error, dummy: &TokenStream) -> TokenStream {
    let messages = mistakes.to_compile_error();
    quote!(#messages #dummy)
}

/// `#[constraint(symbolic)]` on a body that cannot be read.
fn refusal(why: &Unreadable, name: &syn::Ident) -> syn::Error {
    let text = format!(
        "{} cannot be read by the compiler, so `{name}` would be differentiated by dual numbers; `#[constraint(symbolic)]` asks otherwise",
        why.what
    );
    syn::Error::new(why.span, text)
}
