//! Lengths that the attribute gives, for a const generic or for a constant outside the function,
//! whose value no macro sees.

use quote::ToTokens;
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, GenericParam, Ident, ItemFn, Lifetime, LitInt, parse_quote};

use crate::error::Mistakes;

/// Inserts the lengths into the signature. A const generic becomes a constant of the body. The
/// function returns the other lengths; emitted code compares them with the constants.
pub fn put(
    function: &mut ItemFn,
    lengths: &[(Ident, LitInt)],
    mistakes: &mut Mistakes,
) -> Vec<(Ident, LitInt)> {
    for input in &mut function.sig.inputs {
        Put(lengths).visit_fn_arg_mut(input);
    }
    Put(lengths).visit_return_type_mut(&mut function.sig.output);
    let mut outside: Vec<(Ident, LitInt)> = lengths.to_vec();
    let generics = std::mem::take(&mut function.sig.generics.params);
    for parameter in generics {
        match &parameter {
            GenericParam::Const(length) => {
                match lengths.iter().find(|(name, _)| *name == length.ident) {
                    Some((name, value)) => {
                        let ty = &length.ty;
                        function.block.stmts.insert(
                            0,
                            parse_quote!(#[allow(dead_code)] const #name: #ty = #value;),
                        );
                        outside.retain(|(other, _)| other != name);
                    }
                    None => {
                        let name = &length.ident;
                        mistakes.add(
                        &length.ident,
                        format!("the macro must know the number of columns of C_q: state the value of `{name}`, `#[constraint({name} = 6)]`"),
                    );
                        let some = [(name.clone(), LitInt::new("1", name.span()))];
                        function
                            .sig
                            .inputs
                            .iter_mut()
                            .for_each(|input| Put(&some).visit_fn_arg_mut(input));
                        Put(&some).visit_return_type_mut(&mut function.sig.output);
                    }
                }
            }
            GenericParam::Lifetime(lifetime) => {
                mistakes.add(
                    lifetime,
                    "a constraint stores its parameters: write `'static`, or owned types",
                );
                let inputs = function.sig.inputs.iter_mut();
                inputs.for_each(|input| {
                    AsLongAsTheProgram(&lifetime.lifetime).visit_fn_arg_mut(input)
                });
            }
            GenericParam::Type(_) => function.sig.generics.params.push(parameter),
        }
    }
    outside
}

/// The visitor that replaces a refused lifetime by `'static`, so that one mistake gives one
/// message.
struct AsLongAsTheProgram<'a>(&'a Lifetime);

impl VisitMut for AsLongAsTheProgram<'_> {
    fn visit_lifetime_mut(&mut self, lifetime: &mut Lifetime) {
        if lifetime.ident == self.0.ident {
            lifetime.ident = Ident::new("static", lifetime.ident.span());
        }
    }
}

struct Put<'a>(&'a [(Ident, LitInt)]);

impl VisitMut for Put<'_> {
    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        let text = expression.to_token_stream().to_string();
        match self.0.iter().find(|(name, _)| *name == text) {
            Some((_, length)) => *expression = parse_quote!(#length),
            None => visit_mut::visit_expr_mut(self, expression),
        }
    }
}
