//! Last stage: from the graph, and from the user's own body, to Rust. `quote` begins here.

pub mod alone;
mod attachments;
mod blame;
pub mod constraint;
mod demands;
mod described;
mod editor;
mod facts;
mod force;
mod functions;
mod kernel;
pub mod law;
mod measures;
mod probe;
mod rewrite;
mod route;
mod slots;
pub mod stand_in;
mod template;
mod timed;
mod written;

use proc_macro2::TokenStream;
use quote::{quote, quote_spanned};

use kin_language::parse::{Argument, Kind, Shape};

pub use route::DualReason;

/// Type of a field of the emitted struct.
fn field_type(argument: &Argument) -> TokenStream {
    match &argument.kind {
        Kind::Planar => quote!(::kin::PlanarBody),
        Kind::Spatial => quote!(::kin::SpatialBody),
        Kind::Coord => quote!(::kin::Coordinate),
        Kind::Coords(n) => array(&quote!(::kin::Coordinate), *n),
        Kind::Planars(n) => array(&quote!(::kin::PlanarBody), *n),
        Kind::Spatials(n) => array(&quote!(::kin::SpatialBody), *n),
        Kind::Other => written::parameter_type(&argument.ty),
        Kind::Axis => quote!(::kin::Axis),
        _ => {
            let ty = &argument.ty;
            quote!(#ty)
        }
    }
}

/// `[ty; n]`
fn array(ty: &TokenStream, n: usize) -> TokenStream {
    let n = proc_macro2::Literal::usize_unsuffixed(n);
    quote!([#ty; #n])
}

/// The input of a constructor for an argument, and the value of its field. The name stands at the
/// type in the signature, for messages.
fn constructor_input(argument: &Argument) -> (TokenStream, TokenStream) {
    let name = &argument.name;
    let ty = field_type(argument);
    let given = |word: &str, method: &str| {
        let at =
            proc_macro2::Span::call_site().located_at(syn::spanned::Spanned::span(&argument.ty));
        let word = proc_macro2::Ident::new(word, at);
        let method = own(method);
        (
            quote_spanned!(at=> impl ::kin::emitted::#word),
            quote!(#name: ::kin::emitted::#word::#method(#name)),
        )
    };
    let several = |word: &str, method: &str, n: usize| {
        let one = given(word, method).0;
        let method = own(method);
        let word = proc_macro2::Ident::new(word, proc_macro2::Span::call_site());
        (array(&one, n), quote!(#name: #name.map(::kin::emitted::#word::#method)))
    };
    match argument.kind {
        Kind::Planars(n) => several("IntoPlanarBody", "into_planar_body", n),
        Kind::Spatials(n) => several("IntoSpatialBody", "into_spatial_body", n),
        Kind::Planar => given("IntoPlanarBody", "into_planar_body"),
        Kind::Spatial => given("IntoSpatialBody", "into_spatial_body"),
        Kind::Coord => given("IntoCoordinate", "into_coordinate"),
        Kind::Axis => (given("IntoAxis", "into_axis").0, noted(name, "axis")),
        Kind::Numbers(Shape::Vector(n)) => {
            let n = proc_macro2::Literal::usize_unsuffixed(n);
            let given =
                quote!(impl ::kin::emitted::Components<#n, Scalar: ::kin::emitted::IntoNumber>);
            (given, noted(name, "vector"))
        }
        Kind::Numbers(_) => {
            let at = proc_macro2::Span::call_site()
                .located_at(syn::spanned::Spanned::span(&argument.ty));
            (quote_spanned!(at=> impl ::kin::emitted::IntoParameter<#ty>), noted(name, "parameter"))
        }
        Kind::Law => (ty, noted(name, "parameter")),
        _ => (ty, quote!(#name)),
    }
}

/// The value of a field, made of what may hang on dimensions by the function of that name.
fn noted(name: &proc_macro2::Ident, function: &str) -> TokenStream {
    let text = syn::ext::IdentExt::unraw(name).to_string();
    let function = own(function);
    let bindings = own("bindings");
    quote!(#name: ::kin::emitted::#function(#name, #text, #bindings))
}

/// True if any of them may hang on dimensions.
fn may_hang<'a>(mut arguments: impl Iterator<Item = &'a Argument>) -> bool {
    arguments.any(|argument| matches!(argument.kind, Kind::Numbers(_) | Kind::Law | Kind::Axis))
}

/// An argument that is called `L` is warned of once: in the function as it was written, not in the
/// constructor too.
fn warned_elsewhere(name: &proc_macro2::Ident) -> TokenStream {
    if name.to_string().contains(char::is_uppercase) {
        quote!(#[allow(non_snake_case)])
    } else {
        quote!()
    }
}

/// Lints do not look at code that is not the user's.
fn unlinted() -> TokenStream {
    quote!(#[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)])
}

/// `parameters`, and `set_parameter` with `set_parameter_at` and `set_law`: laws and vectors know
/// their own parts.
fn parameter_methods(arguments: &[Argument]) -> (TokenStream, TokenStream) {
    let numeric: Vec<_> = arguments
        .iter()
        .filter(|a| matches!(a.kind, Kind::Numbers(_) | Kind::Law | Kind::Axis))
        .map(|a| &a.name)
        .collect();
    let texts: Vec<String> =
        numeric.iter().map(|name| syn::ext::IdentExt::unraw(*name).to_string()).collect();
    let visit = quote! {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::emitted::visit(&[#((#texts, &self.#numeric)),*], visit);
        }
    };
    let laws: Vec<_> =
        arguments.iter().filter(|a| matches!(a.kind, Kind::Law)).map(|a| &a.name).collect();
    let law_names: Vec<String> =
        laws.iter().map(|name| syn::ext::IdentExt::unraw(*name).to_string()).collect();
    let set_law = (!laws.is_empty()).then(|| {
        quote! {
            fn set_law(&mut self, name: &str, law: &::kin::Law) -> bool {
                ::kin::emitted::set_law(&mut [#((#law_names, &mut self.#laws)),*], name, law)
            }
        }
    });
    let set = quote! {
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::emitted::set(&mut [#((#texts, &mut self.#numeric)),*], name, value)
        }
        fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
            ::kin::emitted::set_at(&mut [#(&mut self.#numeric),*], index, value)
        }
        #set_law
    };
    (visit, set)
}

/// The user's name for every parameter, with numbers lifted to `Real<__D>`.
fn dual_bindings(arguments: &[Argument]) -> Vec<TokenStream> {
    let parameters = arguments.iter().filter(|a| a.kind.is_field() && a.kind.slots() == 0);
    parameters
        .map(|argument| {
            let name = &argument.name;
            let mutable = mutable(argument);
            match argument.kind {
                Kind::Numbers(_) | Kind::Axis => {
                    let ty = rewrite::lifted_type(&argument.ty);
                    quote!(let #mutable #name: #ty = ::kin::emitted::Lift::lift(self.#name);)
                }
                Kind::Other if rewrite::is_liftable(&argument.ty) => {
                    let ty = rewrite::lifted_type(&argument.ty);
                    quote!(let #mutable #name: #ty = ::kin::emitted::Lift::<__D>::lift(self.#name.clone());)
                }
                Kind::Other => {
                    let ty = &argument.ty;
                    quote!(let #mutable #name: __Dual<#ty> = ::core::clone::Clone::clone(&self.#name);)
                }
                _ => quote!(let #mutable #name = self.#name.clone();),
            }
        })
        .collect()
}

/// `let Some([a, _, c]) = source else { return };`: the first numbers of a list by name, those that
/// have one.
fn chunk(
    names: impl Iterator<Item = Option<proc_macro2::Ident>>,
    source: TokenStream,
) -> TokenStream {
    let names = names.map(|name| name.map_or_else(|| quote!(_), |name| quote!(#name)));
    quote!(let ::core::option::Option::Some([#(#names),*]) = #source else { return };)
}

/// The kinds of the bodies and coordinates that an argument is, for the registry.
fn kinds(argument: &Argument) -> Vec<TokenStream> {
    let kind = match argument.kind {
        Kind::Planar | Kind::Planars(_) => quote!(::kin::emitted::ArgumentKind::Planar),
        Kind::Spatial | Kind::Spatials(_) => quote!(::kin::emitted::ArgumentKind::Spatial),
        _ => quote!(::kin::emitted::ArgumentKind::Coord),
    };
    vec![kind; argument.kind.slots()]
}

/// Columns of C_q.
fn columns(arguments: &[Argument]) -> usize {
    arguments.iter().map(|argument| argument.kind.columns()).sum()
}

/// A name of emitted code that no name of the user's can meet.
fn own(name: &str) -> proc_macro2::Ident {
    proc_macro2::Ident::new(name, proc_macro2::Span::mixed_site())
}

fn mutable(argument: &Argument) -> TokenStream {
    if argument.mutable { quote!(mut) } else { quote!() }
}

/// Attributes of the constructor, and of the struct: its documentation says what the constructor's
/// says.
fn documentation(attributes: &[syn::Attribute]) -> Vec<&syn::Attribute> {
    attributes.iter().filter(|a| a.path().is_ident("doc")).collect()
}
