//! Why a constraint is on the dual route: told among its facts, and warned of where that is asked
//! for.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use kin_language::lower::{Lowered, Unreadable};

/// Why the body is not differentiated symbolically.
pub enum DualReason<'a> {
    /// `#[constraint(dual)]`, with the place of the word.
    Asked(Span),
    Unread(&'a Unreadable),
}

/// The environment variable that asks for the warning in a whole crate: the `[env]` table of
/// `.cargo/config.toml` is a good place for it.
const CRATE_WIDE: &str = "KIN_WARN_DUAL";

/// The `RouteReason` of a body that has been read, but perhaps for functions and constants that
/// only rustc knows.
pub fn read(lowered: &Lowered) -> TokenStream {
    let called = lowered.leaves.iter().flat_map(|leaf| leaf.template.called());
    let values = lowered.leaves.iter().chain(&lowered.opaques);
    let mut outside: Vec<(String, Span)> =
        called.chain(values.flat_map(|value| value.template.named())).collect();
    let mut seen = Vec::new();
    outside.retain(|(_, span)| {
        let at = (span.start().line, span.start().column);
        !seen.contains(&at) && {
            seen.push(at);
            true
        }
    });
    if outside.is_empty() {
        return quote!(::kin::extend::RouteReason::Read);
    }
    let outside = outside.iter().map(|(name, span)| {
        let source = place(*span);
        quote!((#name, #source))
    });
    quote!(::kin::extend::RouteReason::ReadBut { outside: &[#(#outside),*] })
}

impl DualReason<'_> {
    /// The `RouteReason` among the facts.
    pub fn explained(&self) -> TokenStream {
        match self {
            DualReason::Asked(span) => {
                let source = place(*span);
                quote!(::kin::extend::RouteReason::Asked { source: ::core::option::Option::Some(#source) })
            }
            DualReason::Unread(Unreadable { span, what }) => {
                let source = place(*span);
                quote!(::kin::extend::RouteReason::Unread { what: #what, source: #source })
            }
        }
    }

    /// A warning at the token that cannot be read, if the constraint or the whole crate asks for
    /// it. Stable Rust lets a macro warn in one way only: by the use of something deprecated.
    pub fn warning(&self, constraint: &Ident, asked: bool) -> TokenStream {
        let DualReason::Unread(Unreadable { span, what }) = self else { return quote!() };
        let everywhere =
            std::env::var(CRATE_WIDE).is_ok_and(|value| !matches!(value.as_str(), "" | "0"));
        let warning = (asked || everywhere).then(|| {
            let note = format!(
                "Kin cannot read {what}, so Kin differentiates `{constraint}` by dual numbers"
            );
            let name = Ident::new("dual_route", *span);
            quote! {
                #[deprecated(note = #note)]
                #[allow(non_upper_case_globals)]
                const #name: () = ();
                #[warn(deprecated)]
                let () = #name;
            }
        });
        // Cargo compiles the crate anew when the variable changes, because emitted code reads it.
        quote! {
            ::kin::emitted::outside_editor! { const _: () = {
                let _ = ::core::option_env!(#CRATE_WIDE);
                #warning
            }; }
        }
    }
}

/// A [`kin::extend::blame::Source`].
fn place(span: Span) -> TokenStream {
    let at = span.start();
    let line = Literal::usize_unsuffixed(at.line);
    let column = Literal::usize_unsuffixed(at.column + 1);
    quote!(::kin::emitted::Source { file: ::core::file!(), line: #line, column: #column })
}
