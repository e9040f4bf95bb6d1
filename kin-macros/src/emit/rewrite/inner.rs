//! Functions and closures inside of a body.

use proc_macro2::{Ident, Span};
use syn::visit_mut::{self, VisitMut};
use syn::{FnArg, ItemFn, parse_quote};

use super::scopes::{Inputs, Name, Nature, Variable};
use super::{Copy, Rewriter, lift, names};

impl Rewriter {
    /// Numbers for the arguments of a function inside the body, which are bound when it is gone
    /// through.
    pub(super) fn input_bindings(&mut self, function: &ItemFn) -> Inputs {
        let inputs = function.sig.inputs.iter().map(|input| match input {
            FnArg::Typed(typed) => names(&typed.pat).len(),
            FnArg::Receiver(_) => 0,
        });
        let counts: Vec<usize> = inputs.collect();
        counts
            .into_iter()
            .map(|count| (0..count).map(|_| self.scopes.binding(Nature::default())).collect())
            .collect()
    }

    /// A function inside the body becomes generic itself, if numbers go in or out.
    pub(super) fn inner_item(&mut self, function: &mut ItemFn) {
        let Some(Name::Function { inputs, lifted }) =
            self.scopes.get(&function.sig.ident.to_string()).cloned()
        else {
            return;
        };
        let outside = self.scopes.enter_function();
        let copy = self.copy;
        let dual = self.dual.clone();
        self.scopes.push();
        for (input, numbers) in function.sig.inputs.iter().zip(inputs) {
            if let FnArg::Typed(typed) = input {
                for (name, number) in names(&typed.pat).into_iter().zip(numbers) {
                    self.scopes.declare(
                        name,
                        Name::Variable(Variable { number, own: false, inputs: None }),
                    );
                }
            }
        }
        if lifted && copy == Copy::Dual {
            self.dual = Ident::new("__E", Span::call_site());
            visit_mut::visit_signature_mut(self, &mut function.sig);
            function.sig.generics.params.push(parse_quote!(__E: ::kin::emitted::Dual));
        } else {
            self.copy = Copy::Plain;
        }
        self.visit_block_mut(&mut function.block);
        (self.copy, self.dual) = (copy, dual);
        self.scopes.leave_function(outside);
    }

    /// A closure whose arguments are of a nature; their numbers.
    pub(super) fn closure(&mut self, closure: &mut syn::ExprClosure, nature: Nature) -> Inputs {
        self.scopes.push();
        let mut inputs = Inputs::new();
        for input in &mut closure.inputs {
            inputs.push(self.declare(input, nature));
            self.lift_pattern(input);
        }
        if let syn::ReturnType::Type(_, ty) = &mut closure.output {
            self.lift_type(ty);
        }
        self.visit_expr_mut(&mut closure.body);
        self.scopes.pop();
        inputs
    }
}

/// True if numbers go in or out.
pub(super) fn takes_numbers(function: &ItemFn) -> bool {
    let inputs = function
        .sig
        .inputs
        .iter()
        .any(|input| matches!(input, FnArg::Typed(typed) if lift::holds_numbers(&typed.ty)));
    inputs
        || matches!(&function.sig.output, syn::ReturnType::Type(_, ty) if lift::holds_numbers(ty))
}

/// True if a function is written for dual numbers by the user.
pub(super) fn is_over_duals(function: &ItemFn) -> bool {
    let bounds = quote::ToTokens::to_token_stream(&function.sig.generics).to_string();
    bounds.split(|c: char| !c.is_alphanumeric()).any(|word| word == "Dual")
}
