//! After a mistake: something of the function's name that type-checks wherever it is used, so that
//! one mistake gives one message. An editor is shown the function all the same.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::quote;
use syn::{FnArg, Ident, Item, ItemFn, Type, Visibility};

use super::{editor, rewrite};
use kin_language::parse::{Argument, ConstraintFn, Kind, LawFn, Role};

/// For a constraint whose signature was understood.
pub fn constraint(source: &ConstraintFn) -> TokenStream {
    let inputs = source.arguments.iter().filter(|argument| argument.kind.is_field());
    let inputs: Vec<TokenStream> = inputs.map(input).collect();
    let stand_in = match source.role {
        Role::Force => force_of(&source.visibility, &source.name, &super::force::inputs(source)),
        _ => constraint_of(&source.visibility, &source.name, &inputs),
    };
    let declaration = super::constraint::declaration(source);
    let edited = editor::constraint(source, &rewrite::plain(source.written(), &source.arguments));
    quote! {
        #edited
        ::kin::emitted::outside_editor! { #stand_in }
        ::kin::emitted::inside_editor! { #declaration }
    }
}

/// For a law whose signature was understood.
pub fn law(source: &LawFn) -> TokenStream {
    let inputs: Vec<TokenStream> = source.parameters.iter().map(input).collect();
    let stand_in = law_of(&source.visibility, &source.name, &inputs);
    let shown = law_function(source);
    let edited = editor::law(
        source,
        &rewrite::plain_law(source.written(), &source.parameters, &source.variable),
    );
    quote! {
        #edited
        ::kin::emitted::outside_editor! { #stand_in }
        ::kin::emitted::inside_editor! { #shown }
    }
}

/// The constructor of a law that is never called.
pub fn law_function(source: &LawFn) -> TokenStream {
    let attributes = &source.attributes;
    let visibility = &source.visibility;
    let name = &source.name;
    let inputs = source.parameters.iter().map(|argument| {
        let name = &argument.name;
        let ty = &argument.ty;
        quote!(#name: #ty)
    });
    quote! {
        #(#attributes)*
        #visibility fn #name(#(#inputs),*) -> ::kin::Law {
            ::core::unreachable!()
        }
    }
}

/// For any item under `#[constraint]`.
pub fn constraint_item(item: TokenStream) -> TokenStream {
    let (item, body) = without_body(item);
    match as_function(item) {
        Ok(function) => {
            let stand_in = constraint_of(&function.vis, &function.sig.ident, &inputs(&function));
            let edited = editor::unread(&function.sig, &body);
            quote!(#edited #stand_in)
        }
        Err(other) => other,
    }
}

/// For any item under `#[force]`.
pub fn force_item(item: TokenStream) -> TokenStream {
    let (item, body) = without_body(item);
    match as_function(item) {
        Ok(function) => {
            let stand_in = force_of(&function.vis, &function.sig.ident, &inputs(&function));
            let edited = editor::unread(&function.sig, &body);
            quote!(#edited #stand_in)
        }
        Err(other) => other,
    }
}

/// For any item under `#[law]`.
pub fn law_item(item: TokenStream) -> TokenStream {
    let (item, body) = without_body(item);
    match as_function(item) {
        Ok(function) => {
            let parameters = inputs(&function);
            let stand_in =
                law_of(&function.vis, &function.sig.ident, parameters.get(1..).unwrap_or_default());
            let edited = editor::unread(&function.sig, &body);
            quote!(#edited #stand_in)
        }
        Err(other) => other,
    }
}

/// The item with an empty body, and the body, which may be what is wrong with it.
fn without_body(item: TokenStream) -> (TokenStream, TokenStream) {
    let mut tokens: Vec<TokenTree> = item.into_iter().collect();
    let is_function =
        tokens.iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "fn"));
    let body = match tokens.pop() {
        Some(TokenTree::Group(body)) if is_function && body.delimiter() == Delimiter::Brace => {
            tokens.push(Group::new(Delimiter::Brace, TokenStream::new()).into());
            TokenTree::from(body).into()
        }
        last => {
            tokens.extend(last);
            quote!({})
        }
    };
    (tokens.into_iter().collect(), body)
}

/// The item, if it is a function; else something to emit in its place: itself, if it is Rust.
fn as_function(item: TokenStream) -> Result<ItemFn, TokenStream> {
    match syn::parse2(item) {
        Ok(Item::Fn(function)) => Ok(function),
        Ok(other) => Err(quote!(#other)),
        Err(_) => Err(quote!()),
    }
}

fn input(argument: &Argument) -> TokenStream {
    if argument.kind == Kind::Other { anything() } else { super::constructor_input(argument).0 }
}

/// The inputs that a constructor would take, as far as can be told from a signature with mistakes
/// in it.
fn inputs(function: &ItemFn) -> Vec<TokenStream> {
    let is_input = |input: &&FnArg| match input {
        FnArg::Typed(typed) => !is_time(&typed.ty),
        FnArg::Receiver(_) => false,
    };
    function.sig.inputs.iter().filter(is_input).map(|_| anything()).collect()
}

/// True of what no constructor takes: the time, and the rate of a force's length or angle.
fn is_time(ty: &Type) -> bool {
    match ty {
        Type::Reference(inner) => is_time(&inner.elem),
        Type::Path(path) => path
            .path
            .segments
            .last()
            .is_some_and(|last| last.ident == "Time" || last.ident == "Rate"),
        _ => false,
    }
}

fn anything() -> TokenStream {
    quote!(impl ::core::marker::Sized)
}

fn constraint_of(visibility: &Visibility, name: &Ident, inputs: &[TokenStream]) -> TokenStream {
    quote! {
        #[allow(non_camel_case_types, missing_docs)]
        #[derive(Clone)]
        #visibility struct #name {}

        #[allow(missing_docs)]
        #visibility fn #name(#(_: #inputs),*) -> #name {
            #name {}
        }

        ::kin::emitted::stand_in!(#name);
    }
}

fn force_of(visibility: &Visibility, name: &Ident, inputs: &[TokenStream]) -> TokenStream {
    quote! {
        #[allow(missing_docs)]
        #visibility fn #name(#(_: #inputs),*) -> ::kin::Load {
            ::core::unreachable!()
        }
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
