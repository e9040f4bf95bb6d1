//! Measures of a joint, asked beside its equations, with their rates by dual numbers:
//! `#[measure(…)]`.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Block, parse_quote};

use super::{demands, rewrite, written};
use kin_language::parse::{ConstraintFn, Measure};

/// `measures` of `Facts`; nothing where there is none.
pub fn facts(source: &ConstraintFn) -> TokenStream {
    let told = source.measures.iter().map(|Measure { name, unit, turns, .. }| {
        let name = syn::ext::IdentExt::unraw(name).to_string();
        quote!(::kin::emitted::Measured { name: #name, unit: #unit, turns: #turns })
    });
    if source.measures.is_empty() { quote!() } else { quote!(measures: &[#(#told),*],) }
}

/// `ends` of `impl Parameters`; nothing where no measure has any.
pub fn ends(source: &ConstraintFn) -> TokenStream {
    let mentioned = source
        .measures
        .iter()
        .filter_map(|measure| measure.ends.as_ref())
        .flat_map(|(from, to)| [from, to]);
    let bindings = demands::bindings(&source.arguments, mentioned);
    let number = super::own("number");
    let ends = numbered(source).filter_map(|(k, measure)| {
        measure.ends.as_ref().map(|(from, to)| quote!(#k => [#from, #to],))
    });
    let ends: Vec<TokenStream> = ends.collect();
    if ends.is_empty() {
        return quote!();
    }
    quote! {
        fn ends(&self, #number: usize) -> ::core::option::Option<[f64; 2]> {
            #(#bindings)*
            let ends: [f64; 2] = match #number {
                #(#ends)*
                _ => return ::core::option::Option::None,
            };
            ::core::option::Option::Some(ends)
        }
    }
}

/// `measure` of `impl Constraint`; nothing where there is none.
pub fn measure(source: &ConstraintFn) -> TokenStream {
    if source.measures.is_empty() {
        return quote!();
    }
    quote! {
        #[cold]
        fn measure(&self, k: usize, at: &::kin::emitted::At<'_>, rates: &[::kin::emitted::Rates<'_>; 3]) -> [f64; 4] {
            ::kin::extend::dual_route::measure(self, k, at, rates)
        }
    }
}

/// `measured` of `impl Equation`, where `prepared` binds the names of the signature for dual
/// numbers.
pub fn evaluation(
    source: &ConstraintFn,
    n: &Literal,
    [q, t]: [&Ident; 2],
    prepared: &TokenStream,
) -> TokenStream {
    if source.measures.is_empty() {
        return quote!();
    }
    let k = super::own("k");
    let value = super::own("value");
    let arms = numbered(source).map(|(number, measure)| {
        let body = rewrite::dual(&block(measure), &source.arguments);
        quote!(#number => (move || -> ::kin::emitted::Real<__D> #body)(),)
    });
    let evaluation = written::silent(quote! {
        #prepared
        let #value: ::kin::emitted::Real<__D> = match #k {
            #(#arms)*
            _ => ::core::convert::From::from(0.0),
        };
    });
    quote! {
        fn measured<__D: ::kin::emitted::Dual>(&self, #k: usize, #q: &[::kin::emitted::Real<__D>; #n], #t: ::kin::emitted::Real<__D>) -> ::kin::emitted::Real<__D> {
            #evaluation
            #value
        }
    }
}

/// The measures as they were written, in f64: their mistakes are found here, once. Each is of the
/// type of a function.
pub fn written(source: &ConstraintFn) -> Vec<TokenStream> {
    let (names, types): (Vec<_>, Vec<_>) = written::inputs(&source.arguments).into_iter().unzip();
    let copy = |measure: &Measure| {
        let body = rewrite::plain(&block(measure), &source.arguments);
        quote!({
            const __MEASURED: fn(#(#types),*) -> f64 = |#(#names),*| #body;
            __MEASURED
        })
    };
    source.measures.iter().map(copy).collect()
}

fn numbered(source: &ConstraintFn) -> impl Iterator<Item = (Literal, &Measure)> {
    source.measures.iter().enumerate().map(|(k, measure)| (Literal::usize_unsuffixed(k), measure))
}

fn block(measure: &Measure) -> Block {
    let value = &measure.value;
    parse_quote!({ #value })
}
