//! `Facts` of a constraint: what is known of it before the program runs.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::number;
use super::measures;
use kin_graph::differentiate::Promises;
use kin_language::parse::{ConstraintFn, Kind, Role, description};

/// All facts, those of its route among them.
pub fn facts(
    source: &ConstraintFn,
    kind: &str,
    (rows, pattern): (&[String], &[(usize, usize)]),
    of_route: &TokenStream,
) -> TokenStream {
    let description = description(&source.attributes);
    let measures = measures::facts(source);
    let pattern = pattern.iter().map(|(row, column)| {
        let [row, column] = [row, column].map(|k| Literal::usize_unsuffixed(*k));
        quote!(::kin::emitted::Entry::new(#row, #column))
    });
    let is_driver = source.arguments.iter().any(|argument| argument.kind == Kind::Time);
    let has_branches = !source.branches.is_empty();
    let energy = (source.role == Role::Energy).then(|| quote!(is_energy: true,));
    quote! {
        ::kin::emitted::Facts {
            description: #description,
            is_driver: #is_driver,
            rows: &[#(#rows),*],
            pattern: &[#(#pattern),*],
            #of_route
            #measures
            has_branches: #has_branches,
            #energy
            ..::kin::emitted::Facts::of(#kind)
        }
    }
}

/// The promises of the graph about the terms: `constants`, where there are any, and `dependence`.
pub fn promises(known: &Promises) -> TokenStream {
    let Promises { c_on_t, c_q_on_t, c_t, q_d, curved, constants } = known;
    let constants = constants.iter().any(Option::is_some).then(|| {
        let constants = constants.iter().map(|constant| match *constant {
            Some(constant) => {
                let constant = number(constant);
                quote!(::core::option::Option::Some(#constant))
            }
            None => quote!(::core::option::Option::None),
        });
        quote!(constants: &[#(#constants),*],)
    });
    quote! {
        #constants
        dependence: ::kin::emitted::Dependence {
            c_on_t: #c_on_t, c_q_on_t: #c_q_on_t, c_t: #c_t, q_d: #q_d, curved: #curved
        },
    }
}
