//! The emitted law: a constructor of the function's name that gives a `Law`.

use proc_macro2::TokenStream;
use quote::quote;
use syn::Block;

use super::kernel::Kernel;
use super::{alone, blame, demands, editor, rewrite, template, unlinted, written};
use kin_graph::differentiate::Partial;
use kin_language::lower::Lowered;
use kin_language::parse::LawFn;

/// The law with its derivatives to third order, symbolic where the body could be read.
pub fn law(source: &LawFn, lowered: Option<Lowered>) -> TokenStream {
    let body = rewrite::plain_law(source.written(), &source.parameters, &source.variable);
    let written = written(source, &body, lowered.as_ref());
    let edited = editor::law(source, &body);
    let text = lowered.as_ref().and_then(|lowered| alone::law_text(source, lowered));
    let formula = lowered.as_ref().map(|lowered| blame::law(&source.parameters, lowered));
    let (jet, leaves) = match lowered {
        Some(lowered) => symbolic(source, lowered),
        None => (quote!(::kin::emitted::jet_by_dual(x, |x| self.evaluate(x))), vec![]),
    };
    let [formula, known] = formula.unwrap_or_default();
    let evaluate = evaluate(source);
    let own = quote!(#(#leaves)* #formula #evaluate);
    let methods = quote!(fn jet(&self, x: f64) -> [f64; 4] { #jet } #known #text);
    let emitted = emit(source, &written, &own, &methods);
    let shown = super::stand_in::law_function(source);
    quote! {
        #edited
        ::kin::emitted::outside_editor! { #emitted }
        ::kin::emitted::inside_editor! { #shown }
    }
}

/// The function as it was written; nobody calls it, but rustc reads it.
fn written(source: &LawFn, body: &Block, lowered: Option<&Lowered>) -> TokenStream {
    let variable = &source.variable;
    let mut inputs = vec![(quote!(#variable), quote!(f64))];
    inputs.extend(written::inputs(&source.parameters));
    let owner = proc_macro2::Ident::new("__Law", proc_macro2::Span::mixed_site());
    let used = demands::mentioned_by_law(&source.requirements, &source.parameters);
    let copy = written::Copy {
        inputs: &inputs,
        output: &syn::parse_quote!(f64),
        body,
        used: &used,
        attributes: &source.attributes,
    };
    written::written(&owner, &copy, &[], lowered)
}

fn symbolic(source: &LawFn, mut lowered: Lowered) -> (TokenStream, Vec<TokenStream>) {
    let g = &mut lowered.graph;
    let mut by_x = Partial::by_variable();
    let mut derivatives = kin_graph::schedule::looked_up(g, &[lowered.rows[0].node]);
    for k in 0..3 {
        let next = by_x.of(g, derivatives[k]);
        derivatives.push(next);
    }
    let (code, values) = Kernel::plain(&lowered, &source.parameters).values(&derivatives);
    let code = code.tokens;
    let leaves = lowered
        .leaves
        .iter()
        .enumerate()
        .map(|(k, leaf)| template::leaf_function(&lowered.graph, k, leaf, &lowered.items))
        .collect();
    (quote!(#code [#(#values),*]), leaves)
}

/// The user's body generic over dual numbers.
fn evaluate(source: &LawFn) -> TokenStream {
    let variable = &source.variable;
    let parameters = super::dual_bindings(&source.parameters);
    let body = rewrite::dual_law(&source.body, &source.parameters, variable);
    let x = super::own("x");
    let value = written::silent(quote! {
        #(#parameters)*
        let #variable: ::kin::emitted::Real<__D> = #x;
        (move || -> ::kin::emitted::Real<__D> #body)()
    });
    quote! {
        fn evaluate<__D: ::kin::emitted::Dual>(&self, #x: ::kin::emitted::Real<__D>) -> ::kin::emitted::Real<__D> {
            #value
        }
    }
}

fn emit(
    source: &LawFn,
    written: &TokenStream,
    own: &TokenStream,
    methods: &TokenStream,
) -> TokenStream {
    let attributes = &source.attributes;
    let visibility = &source.visibility;
    let name = &source.name;
    let names: Vec<_> = source.parameters.iter().map(|a| &a.name).collect();
    let (types, values): (Vec<_>, Vec<_>) =
        source.parameters.iter().map(super::constructor_input).unzip();
    let bindings = super::own("bindings");
    let silent = names.iter().map(|name| super::warned_elsewhere(name));
    let (visit, set) = super::parameter_methods(&source.parameters);
    let fields: Vec<_> = source.parameters.iter().map(super::field_type).collect();
    let text = syn::ext::IdentExt::unraw(name).to_string();
    let refusal = demands::law_refusal(&source.requirements, &source.parameters);
    let description = kin_language::parse::description(attributes);
    let unlinted = unlinted();
    quote! {
        #(#attributes)*
        #[allow(clippy::too_many_arguments)]
        #[must_use]
        #visibility fn #name(#(#silent #names: #types),*) -> ::kin::Law {
            #[allow(non_camel_case_types, non_snake_case)]
            #[derive(Clone)]
            struct __Law {
                #(#names: #fields),*
            }
            const _: () = {
                #written
                #unlinted
                impl __Law {
                    #own
                    #set
                }
                #unlinted
                impl ::kin::emitted::LawFunction for __Law {
                    fn kind(&self) -> &str {
                        #text
                    }
                    fn description(&self) -> &str {
                        #description
                    }
                    #methods
                    #visit
                    #refusal
                    fn with_parameter(&self, name: &str, value: f64) -> ::core::option::Option<::kin::Law> {
                        let mut changed = ::core::clone::Clone::clone(self);
                        changed.set_parameter(name, value).then(|| ::kin::Law::new(changed))
                    }
                }
            };
            ::kin::Law::hanging(|#bindings| __Law { #(#values),* })
        }
    }
}
