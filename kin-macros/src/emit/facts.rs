//! `Facts` of a constraint: what is known of it before the program runs.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::number;
use super::measures;
use crate::derivatives::Derivatives;
use kin_graph::{Graph, Node};
use kin_language::parse::{ConstraintFn, Kind};

/// All facts, those of its route among them.
pub fn facts(
    source: &ConstraintFn,
    kind: &str,
    (rows, pattern): (&[String], &[(usize, usize)]),
    of_route: &TokenStream,
) -> TokenStream {
    let (description, measures) = (super::description(&source.attributes), measures::facts(source));
    let pattern = pattern.iter().map(|(row, column)| {
        let [row, column] = [row, column].map(|k| Literal::usize_unsuffixed(*k));
        quote!(::kin::emitted::Entry::new(#row, #column))
    });
    let is_driver = source.arguments.iter().any(|argument| argument.kind == Kind::Time);
    let has_branches = !source.branches.is_empty();
    quote! {
        ::kin::emitted::Facts {
            description: #description,
            is_driver: #is_driver,
            rows: &[#(#rows),*],
            pattern: &[#(#pattern),*],
            #of_route
            #measures
            has_branches: #has_branches,
            ..::kin::emitted::Facts::of(#kind)
        }
    }
}

/// The promises of the graph about the terms: `constants` and `dependence`.
pub fn promises(g: &Graph, rows: &[Node], derived: &Derivatives, linear: bool) -> TokenStream {
    let (constants, dependence) = (constants(g, derived), dependence(g, rows, derived, linear));
    quote!(#constants #dependence)
}

/// `constants` of `Facts`: the entries of C_q that are numbers for good; nothing where there are none.
fn constants(g: &Graph, derived: &Derivatives) -> TokenStream {
    let known: Vec<Option<f64>> =
        derived.jacobian.iter().map(|entry| g.constant_value(entry.2).filter(|c| c.is_finite())).collect();
    if known.iter().all(Option::is_none) {
        return quote!();
    }
    let known = known.into_iter().map(|constant| match constant {
        Some(constant) => {
            let constant = number(constant);
            quote!(::core::option::Option::Some(#constant))
        }
        None => quote!(::core::option::Option::None),
    });
    quote!(constants: &[#(#known),*],)
}

/// `dependence` of `Facts`: the terms that can change with t or be other than zero.
fn dependence(g: &Graph, rows: &[Node], derived: &Derivatives, linear: bool) -> TokenStream {
    let on_t = |n: &Node| g.depends(*n).on_t;
    let (c, c_q) = (rows.iter().any(on_t), derived.jacobian.iter().any(|entry| on_t(&entry.2)));
    let [c_t, q_d] =
        [&derived.velocity_rhs, &derived.acceleration_rhs].map(|side| side.iter().any(|&n| !g.is_zero(n)));
    let curved = !linear;
    quote! {
        dependence: ::kin::emitted::Dependence {
            c_on_t: #c, c_q_on_t: #c_q, c_t: #c_t, q_d: #q_d, curved: #curved
        },
    }
}
