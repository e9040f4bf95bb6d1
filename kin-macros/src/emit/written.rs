//! The function as it was written, in plain f64, and what makes one slip one message: where rustc
//! finds a mistake in it, or in what was taken for a number, the type [`kin::emitted::If`] of
//! everything made from it is unknown, and of unknown types rustc says nothing.

use proc_macro2::{Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Type};

use super::template;
use kin_language::lower::Lowered;
use kin_language::parse::{Argument, Kind};

/// The function as it was written.
pub struct Copy<'a> {
    /// Patterns and types of its arguments.
    pub inputs: &'a [(TokenStream, TokenStream)],
    pub output: &'a Type,
    pub body: &'a Block,
    /// Arguments that are used outside of the body, in attributes.
    pub used: &'a [Ident],
    /// The user's attributes, of which those for lints are of use here.
    pub attributes: &'a [syn::Attribute],
}

/// Constants and types for the other copies to stand on: `__WRITTEN` is the function, `__SOUND`
/// whether it compiles, `__Dual` and `__Real` are types that stand if it does. Lints look at the
/// function as at any other.
pub fn written(
    owner: &Ident,
    copy: &Copy,
    measures: &[TokenStream],
    lowered: Option<&Lowered>,
) -> TokenStream {
    let constants = lowered.map(|lowered| constants(owner, lowered)).unwrap_or_default();
    let names = copy.inputs.iter().map(|(name, _)| name);
    let types = copy.inputs.iter().map(|(_, ty)| {
        if constants.is_empty() { ty.clone() } else { quote!(::kin::emitted::If<__CONSTANTS, #ty>) }
    });
    let lints = copy.attributes.iter().filter(|attribute| {
        ["allow", "warn", "deny", "forbid"].iter().any(|word| attribute.path().is_ident(word))
    });
    let output = known(copy.output);
    let body = using(copy.body, copy.used);
    let unlinted = super::unlinted();
    quote! {
        #[allow(unused_imports)]
        use ::kin::emitted::{LiftAny as _, LiftNumbers as _, LowerAny as _, LowerReal as _};
        #[allow(unused_imports)]
        use ::kin::emitted::{ReceiveAny as _, ReceiveNumbers as _, ReceiveReference as _, TakesAsIs as _, TakesConverted as _};
        #constants
        /// The function as it was written.
        #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
        #(#lints)*
        const __WRITTEN: fn(#(#types),*) -> #output = |#(#names),*| #body;
        #unlinted
        const __SOUND: bool = { let _ = __WRITTEN; #(let _ = #measures;)* true };
        #[allow(dead_code)]
        type __Dual<D> = ::kin::emitted::If<__SOUND, D>;
        #[allow(dead_code)]
        type __Real<D> = ::kin::emitted::Real<__Dual<D>>;
    }
}

/// A returned type without `_`, which stands for a number.
pub fn known(output: &Type) -> Type {
    let mut output = output.clone();
    Known.visit_type_mut(&mut output);
    output
}

/// The body with a statement before it that uses some of its arguments.
fn using(body: &Block, used: &[Ident]) -> Block {
    let mut body = body.clone();
    if !used.is_empty() {
        body.stmts.insert(0, syn::parse_quote!(let _ = (#(&#used,)*);));
    }
    body
}

/// `__CONSTANTS`: whether constants and the user's parameters are of the types they were taken for.
/// A wrong one is blamed at its token.
fn constants(owner: &Ident, lowered: &Lowered) -> TokenStream {
    let constant = |value: &&kin_language::lower::OpaqueValue| value.template.nodes().is_empty();
    let checks: Vec<TokenStream> = lowered
        .opaques
        .iter()
        .filter(constant)
        .map(|value| {
            let ty = template::kind_type(&value.kind);
            let value = template::check(&value.template);
            quote_spanned!(value.span()=> let _: #ty = #value;)
        })
        .collect();
    if checks.is_empty() {
        return quote!();
    }
    let items = &lowered.items;
    let unlinted = super::unlinted();
    quote! {
        /// Constants and parameters are of the types they were taken for.
        #unlinted
        const __CONSTANTS: bool = {
            let _ = |__self: &#owner| { #(#items)* #(#checks)* };
            true
        };
    }
}

/// The arguments of the function as it was written: pattern and type.
pub fn inputs(arguments: &[Argument]) -> Vec<(TokenStream, TokenStream)> {
    arguments
        .iter()
        .map(|argument| (pattern(argument), plain_type(&argument.kind, &argument.ty)))
        .collect()
}

fn pattern(argument: &Argument) -> TokenStream {
    let name = &argument.name;
    let mutable = super::mutable(argument);
    quote!(#mutable #name)
}

/// The type of an argument inside of the body.
pub fn plain_type(kind: &Kind, ty: &Type) -> TokenStream {
    match kind {
        Kind::Planar => quote!(::kin::emitted::PlanarState),
        Kind::Spatial => quote!(::kin::emitted::SpatialState),
        Kind::Coord | Kind::Time => quote!(f64),
        Kind::Coords(n) => super::array(&quote!(f64), *n),
        Kind::Planars(n) => super::array(&quote!(::kin::emitted::PlanarState), *n),
        Kind::Spatials(n) => super::array(&quote!(::kin::emitted::SpatialState), *n),
        Kind::Other => parameter_type(ty),
        Kind::Numbers(_) | Kind::Law | Kind::Axis => ty.to_token_stream(),
    }
}

/// A type that only rustc knows, if it is one of a parameter: a value of its own, and no alias of a
/// coordinate.
pub fn parameter_type(ty: &Type) -> TokenStream {
    let is_parameter = quote_spanned!(ty.span()=> { ::kin::emitted::is_parameter::<#ty>() });
    quote!(::kin::emitted::If<#is_parameter, #ty>)
}

struct Known;

impl VisitMut for Known {
    fn visit_type_mut(&mut self, ty: &mut Type) {
        match ty {
            Type::Infer(place) => *ty = syn::parse_quote_spanned!(place.span()=> f64),
            other => visit_mut::visit_type_mut(self, other),
        }
    }
}

/// Code over `__D` that is silent where the written function does not compile:
/// `::kin::emitted::Real` becomes `__Real`, and `__D` by itself `__Dual<__D>`.
pub fn silent(tokens: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut out: Vec<TokenTree> = Vec::new();
    let mut of_real = false;
    let mut k = 0;
    while k < tokens.len() {
        if let Some(length) = real_path(&tokens[k..]) {
            out.push(
                Ident::new("__Real", tokens[k + length - 1].span().resolved_at(Span::mixed_site()))
                    .into(),
            );
            of_real = true;
            k += length;
            continue;
        }
        match &tokens[k] {
            TokenTree::Ident(name) if name == "__D" && !of_real => {
                out.extend(quote_spanned!(name.span()=> __Dual<__D>))
            }
            TokenTree::Group(group) => {
                let mut inner = proc_macro2::Group::new(group.delimiter(), silent(group.stream()));
                inner.set_span(group.span());
                out.push(inner.into());
            }
            token => out.push(token.clone()),
        }
        of_real &=
            matches!(&tokens[k], TokenTree::Punct(punct) if matches!(punct.as_char(), '<' | ':'));
        k += 1;
    }
    out.into_iter().collect()
}

/// How many of the first tokens are `::kin::emitted::Real`.
fn real_path(tokens: &[TokenTree]) -> Option<usize> {
    const PATH: [&str; 9] = [":", ":", "kin", ":", ":", "emitted", ":", ":", "Real"];
    let matches =
        tokens.len() >= PATH.len() && tokens.iter().zip(PATH).all(|(token, text)| is(token, text));
    matches.then_some(PATH.len())
}

fn is(token: &TokenTree, text: &str) -> bool {
    match token {
        TokenTree::Ident(name) => name == text,
        TokenTree::Punct(punct) => text.len() == 1 && text.starts_with(punct.as_char()),
        _ => false,
    }
}

/// The code at a place of the user's, where rustc says what is wrong with it; its names stay the
/// macro's.
pub fn located(tokens: TokenStream, at: Span) -> TokenStream {
    let moved = |token: TokenTree| {
        let mut token = match token {
            TokenTree::Group(group) => {
                TokenTree::Group(Group::new(group.delimiter(), located(group.stream(), at)))
            }
            other => other,
        };
        token.set_span(token.span().located_at(at));
        token
    };
    tokens.into_iter().map(moved).collect()
}
