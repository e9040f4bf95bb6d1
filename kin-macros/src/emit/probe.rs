//! Calls of the user's functions whose signature is not known: arguments go as they are where the
//! function takes them so, else they are converted.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream};
use quote::{quote, quote_spanned};
use syn::spanned::Spanned;

/// An argument, with the place that messages about it belong to.
pub struct Probed {
    pub value: TokenStream,
    pub how: How,
    pub at: Span,
}

/// How an argument is handed over that is not taken as it is.
pub enum How {
    AsIs,
    Plain,
    Jet,
    Constant,
    /// A reference in plain numbers.
    Borrowed,
    /// By reference, with the same value again, which is lifted.
    Reference(TokenStream),
    /// By reference, of a value without derivatives.
    ConstantReference(TokenStream),
}

/// The call; `at` is the place of its parentheses.
pub fn call(callee: &TokenStream, arguments: Vec<Probed>, at: Span) -> TokenStream {
    let how = super::own("how");
    let names: Vec<Ident> = (0..arguments.len()).map(|k| super::own(&format!("a_{k}"))).collect();
    let mut values = Vec::new();
    let mut types = Vec::new();
    let mut handed = Vec::new();
    for (argument, name) in arguments.into_iter().zip(&names) {
        let Probed { value, how: by, at } = argument;
        let (value, ty, given) = match by {
            How::AsIs => (value, quote!(#name), quote!(#name)),
            How::Plain => (value, quote!(#name), quote_spanned!(at=> #how.plain(#name))),
            How::Jet => (value, quote!(#name), quote_spanned!(at=> #how.jet(#name).argument())),
            How::Constant => (value, quote!(#name), quote_spanned!(at=> #how.constant(#name))),
            How::Borrowed => {
                let lifted =
                    quote!(::kin::emitted::Lift::<f64>::lift(::core::clone::Clone::clone(#name)));
                (value, quote!(#name), quote_spanned!(at=> #how.reference(#name, &#lifted)))
            }
            How::Reference(again) => (
                quote!((#value, ::kin::emitted::Lift::<f64>::lift(#again))),
                quote!(&#name.0),
                quote_spanned!(at=> #how.reference(&#name.0, &#name.1)),
            ),
            How::ConstantReference(again) => (
                quote!((::kin::emitted::constants(&#value), #again)),
                quote!(&#name.1),
                quote_spanned!(at=> #how.lifted_reference(&#name.0, &#name.1)),
            ),
        };
        values.push(value);
        types.push(ty);
        handed.push(given);
    }
    let mut arguments = Group::new(Delimiter::Parenthesis, quote!(#(#handed),*));
    arguments.set_span(at);
    let function = Ident::new("f", Span::mixed_site().located_at(callee.span()));
    quote! {
        match (#(#values,)*) {
            (#(#names,)*) => {
                let #function = #callee;
                let #how = (&::kin::emitted::Probe::new(&#function, (#(::kin::emitted::of(&#types),)*))).marker();
                #function #arguments
            }
        }
    }
}
