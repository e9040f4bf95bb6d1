//! A constraint as data and back: its parameters by name, its bodies in the order of the signature.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use kin_language::lower::Lowered;
use kin_language::parse::{Argument, ConstraintFn, Kind};

/// `Parameters::describe`: every parameter under its name.
pub fn describe(source: &ConstraintFn, lowered: Option<&Lowered>) -> TokenStream {
    let parameters = source
        .arguments
        .iter()
        .filter(|argument| argument.kind.is_field() && argument.kind.slots() == 0);
    let puts = parameters.map(|argument| {
        let name = &argument.name;
        let text = text(argument);
        match argument.kind {
            Kind::Other if matches!(argument.ty, syn::Type::Reference(_)) => {
                quote!(::kin::emitted::OutgoingRefused::put(&&::kin::emitted::Outgoing(&self.#name), #text, to);)
            }
            Kind::Other => quote!((&::kin::emitted::Outgoing(&self.#name)).put(#text, to);),
            _ => quote!(to.put(#text, &self.#name);),
        }
    });
    let text = match lowered {
        Some(lowered) => super::alone::describe_text(source, lowered),
        None => super::alone::unread(),
    };
    quote! {
        fn describe(&self, to: &mut ::kin::emitted::Describer) {
            use ::kin::emitted::{OutgoingBySerde as _, OutgoingConstant as _, OutgoingRefused as _, RefusedConstant as _};
            #(#puts)*
            #text
        }
    }
}

/// `Parameters::take_bindings`, where there may be any.
pub fn take(source: &ConstraintFn) -> Option<TokenStream> {
    super::may_hang(source.arguments.iter()).then(|| {
        quote! {
            fn take_bindings(&mut self) -> ::kin::emitted::Bindings {
                ::core::mem::take(&mut self.__bindings)
            }
        }
    })
}

/// `impl Described`: what a registry needs to make it anew.
pub fn described(source: &ConstraintFn, kind: &str, n: &Literal, m: &Literal) -> TokenStream {
    let name = &source.name;
    let unlinted = super::unlinted();
    let fields =
        source.arguments.iter().filter(|argument| argument.kind.is_field()).map(|argument| {
            let field = &argument.name;
            let text = text(argument);
            let ty = super::field_type(argument);
            let value = match argument.kind {
                Kind::Planar => quote!(from.planar()),
                Kind::Spatial => quote!(from.spatial()),
                Kind::Coord => quote!(from.coord()),
                Kind::Coords(n) | Kind::Planars(n) | Kind::Spatials(n) => {
                    let one = match argument.kind {
                        Kind::Planars(_) => quote!(from.planar()),
                        Kind::Spatials(_) => quote!(from.spatial()),
                        _ => quote!(from.coord()),
                    };
                    let each = std::iter::repeat_n(one, n);
                    quote!([#(#each),*])
                }
                // A value that lives as long as the program is in no file.
                Kind::Other if matches!(argument.ty, syn::Type::Reference(_)) => {
                    quote!(return ::core::option::Option::None)
                }
                Kind::Other => quote!((&::kin::emitted::Incoming::<#ty>::new()).get(#text, from)?),
                _ => quote!(from.get(#text)),
            };
            quote!(#field: #value)
        });
    let bindings = super::may_hang(source.arguments.iter())
        .then(|| quote!(, __bindings: ::kin::emitted::Bindings::NONE));
    quote! {
        #unlinted
        impl ::kin::emitted::Described for #name {
            const KIND: &'static str = #kind;
            const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = <Self as ::kin::emitted::Equation<#n, #m>>::ARGUMENTS;
            fn read(from: &mut ::kin::emitted::Reader<'_>) -> ::core::option::Option<Self> {
                use ::kin::emitted::{IncomingBySerde as _, IncomingRefused as _};
                ::core::option::Option::Some(#name { #(#fields),* #bindings })
            }
        }
    }
}

fn text(argument: &Argument) -> String {
    syn::ext::IdentExt::unraw(&argument.name).to_string()
}
