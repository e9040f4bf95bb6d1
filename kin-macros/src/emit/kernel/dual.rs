//! The equation over dual numbers, out of the graph: for bodies whose own copy over them rustc
//! could not read.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::{Kernel, is_condition};
use crate::emit::{own, template};
use kin_graph::{Input, LeafUse, Node, Op, Part};
use kin_language::parse::{Argument, Kind};

/// Where the numbers of each state argument are read, by its slot.
pub fn places(arguments: &[Argument]) -> Vec<TokenStream> {
    let places = arguments.iter().flat_map(|argument| {
        let name = &argument.name;
        let place = |k: usize| {
            let k = Literal::usize_unsuffixed(k);
            match argument.kind {
                Kind::Coords(_) | Kind::Planars(_) | Kind::Spatials(_) => quote!(#name[#k]),
                _ => quote!(#name),
            }
        };
        (0..argument.kind.slots()).map(place).collect::<Vec<_>>()
    });
    places.collect()
}

impl Kernel<'_> {
    pub(super) fn dual_input(&mut self, input: Input) -> TokenStream {
        match input {
            Input::Time => {
                let t = own("t");
                quote!(#t)
            }
            Input::Parameter(k) => {
                let value = &self.lowered.parameters[k];
                quote!(::kin::emitted::Real::<__D>::from(#value))
            }
            Input::State(slot, part) => {
                let place = &self.places[slot];
                let bare = !matches!(self.slots[slot].kind(), Kind::Planar | Kind::Spatial);
                match part {
                    Part::R(0) => quote!(#place.r.x),
                    Part::R(1) => quote!(#place.r.y),
                    Part::R(_) => quote!(#place.r.z),
                    Part::Theta if bare => quote!(#place),
                    Part::Sin if bare => quote!(<::kin::emitted::Real<__D>>::sin(#place)),
                    Part::Cos if bare => quote!(<::kin::emitted::Real<__D>>::cos(#place)),
                    Part::Theta => quote!(#place.theta),
                    Part::Sin => quote!(#place.sin),
                    Part::Cos => quote!(#place.cos),
                    Part::P(0) => quote!(#place.p.e0),
                    Part::P(1) => quote!(#place.p.e1),
                    Part::P(2) => quote!(#place.p.e2),
                    Part::P(_) => quote!(#place.p.e3),
                }
            }
            Input::Column(_) | Input::Rate(..) | Input::TimeRate | Input::Timed(_) => {
                quote!(::kin::emitted::Real::<__D>::from(f64::NAN))
            }
        }
    }

    /// Laws, opaque values and leaves in dual numbers.
    pub(super) fn dual_evaluation(&mut self, node: Node) -> Option<TokenStream> {
        match self.graph().op(node) {
            Op::Law(law, x, order) => {
                let law = template::place(&self.lowered.laws[law]);
                let x = self.expression(x);
                Some(if order == 0 { quote!(#law.at(#x)) } else { quote!(#law.slope(#x)) })
            }
            Op::Opaque(number, component) => {
                let value = &self.lowered.opaques[number];
                let ty = template::kind_type(&value.kind);
                let name = self.evaluated(format!("opaque {number}"), "o", &ty, |kernel| {
                    template::plain(&value.template, &mut |n| {
                        let given = kernel.expression(n);
                        if is_condition(kernel.lowered, n) {
                            given
                        } else {
                            quote!(::kin::emitted::Real::value(#given))
                        }
                    })
                });
                let number = template::component(&name, &value.kind, component);
                Some(if is_condition(self.lowered, node) {
                    number
                } else {
                    quote!(::kin::emitted::Real::<__D>::from(#number))
                })
            }
            Op::Leaf(LeafUse { leaf, output, .. }) => {
                let leaf = self.graph().leaves[leaf].clone();
                let kind = &self.lowered.leaves[leaf.call].kind;
                let function = template::leaf_name(leaf.call);
                let kin_language::lower::OpaqueKind::Numbers(shape) = kind else { return None };
                let ty = template::shape_type(shape, &quote!(::kin::emitted::Real<__D>));
                let name = self.evaluated(format!("leaf {leaf:?}"), "leaf", &ty, |kernel| {
                    let values: Vec<TokenStream> =
                        leaf.arguments.iter().map(|&n| kernel.expression(n)).collect();
                    quote!(self.#function::<__D>([#(#values),*]))
                });
                Some(template::component(&name, kind, output))
            }
            _ => None,
        }
    }
}
