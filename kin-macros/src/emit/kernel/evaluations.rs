//! Laws, opaque values and leaves: one evaluation gives several numbers.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::{Kernel, number};
use crate::emit::template;
use kin_graph::{Direction, Leaf, LeafNumber, LeafUse, Node, Op};
use kin_language::lower::OpaqueKind;

impl Kernel<'_> {
    /// Nodes that come out of an evaluation with several results: laws, opaque values, leaves.
    pub(super) fn evaluation(&mut self, node: Node) -> Option<TokenStream> {
        if self.numbers == super::Numbers::Dual {
            return self.dual_evaluation(node);
        }
        if let Some(value) = self.looked_up(node) {
            return Some(value);
        }
        match self.graph().op(node) {
            Op::Law(law, x, order) => {
                let law_place = template::place(&self.lowered.laws[law]);
                let x_value = self.expression(x);
                let key = format!("law {law} {x:?}");
                let name = self.evaluated(
                    key,
                    "law",
                    &quote!([f64; 4]),
                    |_| quote!(#law_place.jet(#x_value)),
                );
                let order = Literal::usize_unsuffixed(usize::from(order));
                Some(quote!(#name[#order]))
            }
            Op::Opaque(number, component) => {
                let value = &self.lowered.opaques[number];
                // The type is what the macro took the value for: where that is wrong, rustc says so
                // at the user's token.
                let ty = template::kind_type(&value.kind);
                let ty = quote!(::kin::emitted::If<__SOUND, #ty>);
                let key = format!("opaque {number}");
                let name = self.evaluated(key, "o", &ty, |kernel| {
                    template::plain(&value.template, &mut |n| kernel.expression(n))
                });
                Some(template::component(&name, &value.kind, component))
            }
            Op::Leaf(of) => Some(self.leaf(of)),
            _ => None,
        }
    }

    /// The name of an evaluation of a type, the same one each time.
    pub(super) fn evaluated(
        &mut self,
        key: String,
        prefix: &str,
        ty: &TokenStream,
        value: impl FnOnce(&mut Self) -> TokenStream,
    ) -> Ident {
        if let Some(name) = self.evaluations.get(&key) {
            return name.clone();
        }
        self.operations += 1;
        let name = Ident::new(&format!("{prefix}{}", self.evaluations.len()), Span::mixed_site());
        let value = value(self);
        self.statements.push(quote!(let #name: #ty = #value;));
        self.evaluations.insert(key, name.clone());
        name
    }

    fn leaf(&mut self, of: LeafUse) -> TokenStream {
        let Leaf { call, arguments } = self.graph().leaves[of.leaf].clone();
        let leaf = &self.lowered.leaves[call];
        let function = template::leaf_name(call);
        let directions = &self.graph().directions;
        let (key, field) = match of.what {
            LeafNumber::Value => (format!("leaf {} value", of.leaf), quote!(.0)),
            LeafNumber::Partial(k) => (format!("leaf {} by {k}", of.leaf), quote!(.0.eps)),
            LeafNumber::First(d) => (format!("leaf {} along {d}", of.leaf), quote!(.0.v1)),
            LeafNumber::Second(d) => (format!("leaf {} along {d}", of.leaf), quote!(.0.v2)),
        };
        let scalar = match of.what {
            LeafNumber::Value => quote!(::kin::emitted::Real<f64>),
            LeafNumber::Partial(_) => quote!(::kin::emitted::Real<::kin::emitted::Dual64>),
            LeafNumber::First(_) | LeafNumber::Second(_) => {
                quote!(::kin::emitted::Real<::kin::emitted::Dual2_64>)
            }
        };
        let OpaqueKind::Numbers(shape) = &leaf.kind else { return quote!(f64::NAN) };
        let name = self.evaluated(key, "leaf", &template::shape_type(shape, &scalar), |kernel| {
            let values: Vec<TokenStream> = arguments
                .iter()
                .enumerate()
                .map(|(k, &a)| {
                    let x = kernel.expression(a);
                    match of.what {
                        LeafNumber::Value => quote!(::kin::emitted::Real(#x)),
                        LeafNumber::Partial(by) if by == k => {
                            let seed = number(1.0);
                            quote!(::kin::emitted::Real(::kin::emitted::Dual64::new(#x, #seed)))
                        }
                        LeafNumber::Partial(_) => quote!(::kin::emitted::Real::from(#x)),
                        LeafNumber::First(d) | LeafNumber::Second(d) => {
                            along(kernel, &directions[d], k, &x)
                        }
                    }
                })
                .collect();
            quote!(self.#function([#(#values),*]))
        });
        let component = template::component(&name, &leaf.kind, of.output);
        quote!(#component #field)
    }
}

/// Argument k of a leaf along a direction.
fn along(kernel: &mut Kernel, direction: &Direction, k: usize, x: &TokenStream) -> TokenStream {
    let graph = kernel.graph();
    if graph.is_zero(direction.first[k]) && graph.is_zero(direction.second[k]) {
        return quote!(::kin::emitted::Real::from(#x));
    }
    let first = kernel.expression(direction.first[k]);
    let second = kernel.expression(direction.second[k]);
    match direction.moves[k] {
        None => quote!(::kin::emitted::Real(::kin::emitted::Dual2_64::new(#x, #first, #second))),
        Some(moves) => {
            let moves = kernel.expression(moves);
            quote!(::kin::emitted::Real(::kin::emitted::Dual2_64::moving_where(#moves, #x, #first, #second)))
        }
    }
}
