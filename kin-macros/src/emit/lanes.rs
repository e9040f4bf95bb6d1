//! `#[constraint(lanes)]`: kernels over lanes, and what each lane's constraint computes for them with plain
//! numbers.
//!
//! A value that depends on parameters and time alone is *known*: it is computed by f64 code, once a case or
//! once a time. One that depends on coordinates and only f64 can do (a law, a function of the user's) is an
//! *evaluation*, called lane by lane. The rest is the same straight-line code as elsewhere, over `Wide`
//! numbers.

use std::collections::{BTreeSet, HashMap};

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::kernel::{Evaluations, Kernel, is_condition};
use super::{functions, own, timed};
use kin_graph::differentiate::Derivatives;
use kin_graph::schedule;
use kin_graph::{Graph, Input, LeafNumber, Node, Op};
use kin_language::lower::Lowered;
use kin_language::parse::Argument;

/// One evaluation: what it is computed from, and the nodes that come out of it.
struct Evaluation {
    key: String,
    inputs: Vec<Node>,
    outputs: Vec<Node>,
}

/// The values that lane kernels do not compute themselves.
struct Outside {
    /// Nodes that depend on parameters alone, and those that depend on the time too.
    known: [Vec<Node>; 2],
    evaluations: Vec<Evaluation>,
}

/// The kernels over lanes, two implementations beside `impl Constraint`.
pub fn lanes(
    name: &Ident,
    arguments: &[Argument],
    lowered: &mut Lowered,
    derived: &Derivatives,
) -> TokenStream {
    let g = &lowered.graph;
    let values: Vec<Node> = derived.jacobian.iter().map(|entry| entry.2).collect();
    let (to_c, c) = functions::outputs("c", quote!(at.rows(c)), &derived.rows, |_| true);
    // A value that is the same for good has been written before.
    let (to_c_q, c_q) = functions::outputs("c_q", quote!(at.values(c_q)), &values, |node| {
        g.constant_value(node).is_none_or(|constant| !constant.is_finite())
    });
    let both: Vec<_> = c.into_iter().chain(c_q).collect();
    let (to_rhs, rhs) = functions::outputs("rhs", quote!(at.rows(rhs)), &derived.velocity_rhs, |_| true);
    let (to_q_d, q_d) = functions::outputs("q_d", quote!(at.rows(q_d)), &derived.acceleration_rhs, |_| true);

    let all: Vec<Node> = both.iter().chain(&rhs).chain(&q_d).map(|(_, node)| *node).collect();
    let outside = Outside::new(lowered, &all);
    let mut kernel = |outputs: &[(Ident, Node)]| outside.kernel(lowered, arguments, outputs);
    let (linearize, velocity, acceleration) = (kernel(&both), kernel(&rhs), kernel(&q_d));
    let velocity = (!rhs.is_empty()).then(|| {
        quote! {
            #[inline(always)]
            fn velocity_rhs<__S: ::kin::emitted::Level>(at: &::kin::emitted::LaneAt<'_, __S>, rhs: &mut [::kin::emitted::Wide<__S>]) {
                #to_rhs
                #velocity
            }
        }
    });
    let (in_lanes, unlinted) = (outside.in_lanes(name, arguments, lowered), super::unlinted());
    quote! {
        #unlinted
        #in_lanes
        #unlinted
        impl ::kin::emitted::LaneKernel for #name {
            #[inline(always)]
            fn linearize<__S: ::kin::emitted::Level>(
                at: &::kin::emitted::LaneAt<'_, __S>,
                c: &mut [::kin::emitted::Wide<__S>],
                c_q: &mut [::kin::emitted::Wide<__S>],
            ) {
                #to_c
                #to_c_q
                #linearize
            }
            #velocity
            #[inline(always)]
            fn acceleration_rhs<__S: ::kin::emitted::Level>(
                at: &::kin::emitted::LaneAt<'_, __S>,
                qd: &::kin::emitted::LaneRates<'_, __S>,
                q_d: &mut [::kin::emitted::Wide<__S>],
            ) {
                #to_q_d
                #acceleration
            }
        }
    }
}

impl Outside {
    fn new(lowered: &Lowered, outputs: &[Node]) -> Self {
        let g = &lowered.graph;
        let mut moving: BTreeSet<Node> = BTreeSet::new();
        let mut fixed_operands: BTreeSet<Node> = BTreeSet::new();
        let mut evaluations: Vec<Evaluation> = Vec::new();
        for node in g.reachable(outputs) {
            let input = matches!(g.op(node), Op::Input(Input::State(..) | Input::Rate(..)));
            if !input && !g.operands(node).iter().any(|operand| moving.contains(operand)) {
                continue;
            }
            moving.insert(node);
            fixed_operands.extend(g.operands(node).into_iter().filter(|operand| !moving.contains(operand)));
            if let Some(key) = evaluation_key(g, node) {
                match evaluations.iter_mut().find(|known| known.key == key) {
                    Some(known) => known.outputs.push(node),
                    None => {
                        evaluations.push(Evaluation { key, inputs: g.operands(node), outputs: vec![node] })
                    }
                }
            }
        }
        fixed_operands.extend(outputs.iter().filter(|output| !moving.contains(output)));
        fixed_operands.retain(|&node| {
            !matches!(g.op(node), Op::Constant(_) | Op::Truth(_) | Op::Input(Input::TimeRate))
        });
        let (of_time, of_parameters) = fixed_operands.into_iter().partition(|&node| g.depends(node).on_t);
        Outside { known: [of_parameters, of_time], evaluations }
    }

    /// One kernel, after the scheduler has had a look at it where all that is known are numbers and nothing
    /// is an evaluation.
    fn kernel(
        &self,
        lowered: &mut Lowered,
        arguments: &[Argument],
        outputs: &[(Ident, Node)],
    ) -> TokenStream {
        let known: Vec<Node> = self.known.concat();
        let n = literal(known.len());
        let list = own("known");
        let bind = (!known.is_empty())
            .then(|| quote!(let ::core::option::Option::Some(#list) = at.known::<#n>() else { return };));
        let numbers = self.evaluations.is_empty() && !known.iter().any(|&node| is_condition(lowered, node));
        let code = if numbers {
            scheduled(&known, lowered, arguments, outputs)
        } else {
            self.as_written(&known, lowered, arguments, outputs)
        };
        quote!(#bind #code)
    }

    /// The kernel as the graph has it: what is known by its place, evaluations by their calls.
    fn as_written(
        &self,
        known: &[Node],
        lowered: &Lowered,
        arguments: &[Argument],
        outputs: &[(Ident, Node)],
    ) -> TokenStream {
        // Read where they are used: registers are few.
        let list = own("known");
        let given = known.iter().enumerate().map(|(k, &node)| {
            let k = literal(k);
            let value =
                if is_condition(lowered, node) { quote!(#list[#k].is_true()) } else { quote!(#list[#k]) };
            (node, value)
        });
        let calls: Evaluations = self
            .evaluations
            .iter()
            .enumerate()
            .flat_map(|(number, all)| {
                let count = all.outputs.len();
                all.outputs.iter().enumerate().map(move |(slot, &node)| (node, (number, slot, count)))
            })
            .collect();
        Kernel::over_lanes(lowered, arguments, given.collect(), calls).write(outputs).tokens
    }

    /// `impl InLanes`: what there is to compute.
    fn in_lanes(&self, name: &Ident, arguments: &[Argument], lowered: &Lowered) -> TokenStream {
        let [n_parameters, n_times] = [0, 1].map(|k| literal(self.known[k].len()));
        let method = |k: usize, signature: TokenStream, t: TokenStream| {
            let code = outputs("known", &self.known[k], HashMap::new(), arguments, lowered);
            (!self.known[k].is_empty()).then(|| {
                quote! {
                    fn #signature {
                        let (at, t_dot) = (&::kin::emitted::At::new(#t, &[], &[]), 1.0);
                        #code
                    }
                }
            })
        };
        let of_parameters = method(0, quote!(of_parameters(&self, known: &mut [f64])), quote!(0.0));
        let of_time = method(1, quote!(of_time(&self, t: f64, known: &mut [f64])), quote!(t));
        let arms = self.evaluations.iter().enumerate().map(|(number, evaluation)| {
            let (number, body) = (literal(number), evaluation.body(arguments, lowered));
            quote!(#number => { #body })
        });
        let evaluate = (!self.evaluations.is_empty()).then(|| {
            quote! {
                fn evaluate(&self, number: usize, x: &[f64], y: &mut [f64]) {
                    match number {
                        #(#arms)*
                        _ => {}
                    }
                }
            }
        });
        quote! {
            impl ::kin::emitted::InLanes for #name {
                fn kernels(&self) -> ::kin::emitted::LaneKernels {
                    ::kin::emitted::LaneKernels::of::<Self>()
                }
                fn n_known(&self) -> [usize; 2] {
                    [#n_parameters, #n_times]
                }
                #of_parameters
                #of_time
                #evaluate
            }
        }
    }
}

/// A kernel of fused operations that reads what is known by its place.
fn scheduled(
    known: &[Node],
    lowered: &mut Lowered,
    arguments: &[Argument],
    outputs: &[(Ident, Node)],
) -> TokenStream {
    let places: HashMap<Node, usize> = known.iter().copied().zip(0..).collect();
    let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
    let nodes = timed::read_at(&mut lowered.graph, |node| places.get(&node).copied(), &nodes);
    let nodes = schedule::prepare(&mut lowered.graph, &nodes);
    let outputs: Vec<_> = outputs.iter().zip(nodes).map(|((place, _), node)| (place.clone(), node)).collect();
    Kernel::over_lanes(lowered, arguments, HashMap::new(), Evaluations::new()).write(&outputs).tokens
}

impl Evaluation {
    /// In plain numbers, from `x` to `y`.
    fn body(&self, arguments: &[Argument], lowered: &Lowered) -> TokenStream {
        let n = literal(self.inputs.len());
        let names: Vec<Ident> = (0..self.inputs.len()).map(|k| own(&format!("known{k}"))).collect();
        let given = self.inputs.iter().zip(&names).map(|(&node, name)| {
            let value = if is_condition(lowered, node) { quote!((#name != 0.0)) } else { quote!(#name) };
            (node, value)
        });
        let code = outputs("y", &self.outputs, given.collect(), arguments, lowered);
        quote! {
            let ::core::option::Option::Some(&[#(#names),*]) = x.first_chunk::<#n>() else { return };
            #code
        }
    }
}

/// Plain code that writes nodes to a list, conditions as 1 or 0.
fn outputs(
    list: &str,
    nodes: &[Node],
    given: HashMap<Node, TokenStream>,
    arguments: &[Argument],
    lowered: &Lowered,
) -> TokenStream {
    let (code, values) = Kernel::from_given(lowered, arguments, given).values(nodes);
    let (code, list) = (code.tokens, Ident::new(list, Span::call_site()));
    quote! {
        let ::core::option::Option::Some(#list) = #list.first_chunk_mut() else { return };
        #code
        *#list = [#(#values),*];
    }
}

/// The key of an evaluation that only f64 can do; the nodes that come out of the same one have the same
/// key.
fn evaluation_key(g: &Graph, node: Node) -> Option<String> {
    match g.op(node) {
        Op::Law(law, x, _) => Some(format!("law {law} {x:?}")),
        Op::Opaque(number, _) => Some(format!("opaque {number}")),
        Op::Leaf(of) => Some(match of.what {
            LeafNumber::Value | LeafNumber::Partial(_) => format!("leaf {}", of.leaf),
            LeafNumber::First(k) | LeafNumber::Second(k) => format!("leaf {} along {k}", of.leaf),
        }),
        _ => None,
    }
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
