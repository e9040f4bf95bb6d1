//! The demands of a constraint or a law: of its parameters (`#[require]`), and of the pose it is
//! meant in (`#[branch]`).

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};

use super::written;
use kin_language::parse::{Argument, ConstraintFn, Demand, Kind};

/// `refusal`: what the parameters themselves refuse, then the first requirement that does not hold.
/// Laws of a constraint with time in it drive the motion.
pub fn refusal(source: &ConstraintFn) -> TokenStream {
    method(&source.requirements, &source.arguments, |argument| {
        matches!(argument.kind, Kind::Law | Kind::Axis)
    })
}

/// `refusal` of a law.
pub fn law_refusal(requirements: &[Demand], parameters: &[Argument]) -> TokenStream {
    method(requirements, parameters, |argument| argument.kind == Kind::Law)
}

fn method(
    requirements: &[Demand],
    arguments: &[Argument],
    can_refuse: impl Fn(&Argument) -> bool,
) -> TokenStream {
    let own: Vec<TokenStream> = arguments
        .iter()
        .filter(|argument| can_refuse(argument))
        .map(|argument| {
            let name = &argument.name;
            let text = argument.name.to_string();
            quote!((#text, &self.#name))
        })
        .collect();
    if requirements.is_empty() && own.is_empty() {
        return quote!();
    }
    let own = (!own.is_empty()).then(|| {
        quote!(if let ::core::option::Option::Some(why) = ::kin::emitted::refusal(&[#(#own),*]) {
            return ::core::option::Option::Some(why);
        })
    });
    let parameters = parameters(arguments);
    let checks = requirements.iter().map(|demand| {
        let condition = &demand.condition;
        let text = &demand.text;
        let shown = parameters.iter().filter(|argument| {
            matches!(argument.kind, Kind::Numbers(_) | Kind::Axis)
                && mentions(condition, &argument.name)
        });
        let shown = shown.map(|argument| {
            let name = &argument.name;
            let text = argument.name.to_string();
            quote!((#text, &self.#name))
        });
        quote!(let holds: bool = #condition; if !holds {
            return ::core::option::Option::Some(::kin::emitted::refused(#text, &[#(#shown),*]));
        })
    });
    let bindings = bindings(arguments, requirements.iter().map(|demand| &demand.condition));
    quote! {
        #[cold]
        fn refusal(&self) -> ::core::option::Option<::std::string::String> {
            #own
            #(#bindings)*
            #(#checks)*
            ::core::option::Option::None
        }
    }
}

fn parameters(arguments: &[Argument]) -> Vec<&Argument> {
    arguments
        .iter()
        .filter(|argument| argument.kind.slots() == 0 && argument.kind.is_field())
        .collect()
}

/// The user's names for the parameters that stand in some expressions, in plain f64.
pub fn bindings<'a>(
    arguments: &[Argument],
    expressions: impl Iterator<Item = &'a syn::Expr>,
) -> Vec<TokenStream> {
    let expressions: Vec<&syn::Expr> = expressions.collect();
    let bound = parameters(arguments)
        .into_iter()
        .filter(|argument| expressions.iter().any(|e| mentions(e, &argument.name)));
    bound
        .map(|argument| {
            let name = &argument.name;
            match argument.kind {
                Kind::Numbers(_) | Kind::Axis => quote!(let #name = self.#name;),
                _ => quote!(let #name = ::core::clone::Clone::clone(&self.#name);),
            }
        })
        .collect()
}

/// The arguments that attributes speak of: a parameter may be there for a requirement, or for the
/// end of a measure, alone.
pub fn mentioned(source: &ConstraintFn) -> Vec<Ident> {
    let demands =
        source.requirements.iter().chain(&source.branches).map(|demand| &demand.condition);
    let measures = source.measures.iter().flat_map(|measure| {
        let ends = measure.ends.iter().flat_map(|(from, to)| [from, to]);
        std::iter::once(&measure.value).chain(ends)
    });
    let expressions: Vec<&syn::Expr> = demands.chain(measures).collect();
    named(&source.arguments, &expressions)
}

/// The parameters that the requirements of a law speak of.
pub fn mentioned_by_law(requirements: &[Demand], parameters: &[Argument]) -> Vec<Ident> {
    named(parameters, &requirements.iter().map(|demand| &demand.condition).collect::<Vec<_>>())
}

fn named(arguments: &[Argument], expressions: &[&syn::Expr]) -> Vec<Ident> {
    let names = arguments.iter().map(|argument| &argument.name);
    names
        .filter(|name| expressions.iter().any(|expression| mentions(expression, name)))
        .cloned()
        .collect()
}

/// True if a name stands in an expression.
fn mentions(expression: &impl ToTokens, name: &Ident) -> bool {
    fn within(tokens: TokenStream, name: &Ident) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Ident(word) => word == *name,
            TokenTree::Group(group) => within(group.stream(), name),
            _ => false,
        })
    }
    within(expression.to_token_stream(), name)
}

/// `wrong_branch`: the first condition on the pose that does not hold; nothing where there is none.
pub fn branch(source: &ConstraintFn) -> TokenStream {
    if source.branches.is_empty() {
        return quote!();
    }
    let inputs = written::inputs(&source.arguments);
    let (names, types): (Vec<_>, Vec<_>) = inputs.into_iter().unzip();
    let mut slot = 0;
    let values: Vec<TokenStream> = source
        .arguments
        .iter()
        .map(|argument| {
            let name = &argument.name;
            let at = proc_macro2::Literal::usize_unsuffixed(slot);
            slot += argument.kind.slots();
            match argument.kind {
                Kind::Planar => quote!(at.planar(#at)),
                Kind::Spatial => quote!(at.spatial(#at)),
                Kind::Coord => quote!(at.coord(#at).value),
                Kind::Planars(_) => quote!(::core::array::from_fn(|k| at.planar(#at + k))),
                Kind::Spatials(_) => quote!(::core::array::from_fn(|k| at.spatial(#at + k))),
                Kind::Coords(_) => quote!(::core::array::from_fn(|k| at.coord(#at + k).value)),
                Kind::Time => quote!(at.t),
                _ => quote!(::core::clone::Clone::clone(&self.#name)),
            }
        })
        .collect();
    let ty = quote!(fn(#(#types),*) -> bool);
    let names = quote!(#(#names),*);
    let values = quote!(#(#values),*);
    let conditions = source.branches.iter().map(|demand| &demand.condition);
    let texts = source.branches.iter().map(|demand| &demand.text);
    quote! {
        #[cold]
        fn wrong_branch(&self, at: &::kin::emitted::At<'_>) -> ::core::option::Option<&str> {
            #({
                const MEANT: #ty = |#names| #conditions;
                if !MEANT(#values) {
                    return ::core::option::Option::Some(#texts);
                }
            })*
            ::core::option::Option::None
        }
    }
}
