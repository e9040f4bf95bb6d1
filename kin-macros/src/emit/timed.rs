//! What a constraint makes of the time alone: laws, sines and calls in which no coordinate stands. They are evaluated once a time
//! (`at_time`), and every other function of the constraint reads them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::{Kernel, is_condition};
use crate::graph::{Graph, Input, Node, Op};
use crate::lower::Lowered;

/// Of what `outputs` need, the largest parts that depend on t and parameters alone and call a function. Conditions are computed where they
/// are used.
pub fn select(lowered: &Lowered, outputs: &[Node]) -> Vec<Node> {
    let g = &lowered.graph;
    let order = g.reachable(outputs);
    let found = |list: &[Node], node: &Node| list.binary_search(node).is_ok();
    let (mut moving, mut calling) = (Vec::new(), Vec::new());
    for &node in &order {
        let operands = g.operands(node);
        let any = |list: &[Node]| operands.iter().any(|n| found(list, n));
        if matches!(g.op(node), Op::Input(Input::State(..) | Input::Rate(..) | Input::TimeRate | Input::Variable)) || any(&moving) {
            moving.push(node);
        } else if any(&calling) || matches!(g.op(node), Op::Call(..) | Op::Call2(..) | Op::Law(..) | Op::Opaque(..) | Op::Leaf(_)) {
            calling.push(node);
        }
    }
    let read = moving.iter().flat_map(|&node| g.operands(node)).chain(outputs.iter().copied());
    let mut timed: Vec<Node> = read.filter(|node| found(&calling, node) && !is_condition(lowered, *node)).collect();
    timed.sort_unstable();
    timed.dedup();
    timed
}

/// The outputs with what was evaluated once a time read where it stands.
pub fn read(g: &mut Graph, timed: &[Node], outputs: &[Node]) -> Vec<Node> {
    if timed.is_empty() {
        return outputs.to_vec();
    }
    let nodes = g.reachable_from(outputs, |node| timed.binary_search(&node).is_ok());
    let mut read: Vec<Option<Node>> = vec![None; g.len()];
    for node in nodes {
        let built = match timed.binary_search(&node) {
            Ok(k) => g.input(Input::Timed(k)),
            Err(_) => g.with_operands(node, |operand| read[operand.index()].unwrap_or(operand)),
        };
        read[node.index()] = Some(built);
    }
    outputs.iter().map(|output| read[output.index()].unwrap_or(*output)).collect()
}

/// `n_timed` and `at_time`; nothing where there is nothing of the kind.
pub fn functions(lowered: &Lowered, timed: &[Node]) -> TokenStream {
    if timed.is_empty() {
        return quote!();
    }
    let n = Literal::usize_unsuffixed(timed.len());
    let (code, values) = Kernel::plain(lowered, &[]).values(timed);
    let (doc, code) = (format!(" What depends on t and parameters alone: {} operations", code.operations), code.tokens);
    quote! {
        fn n_timed(&self) -> usize {
            #n
        }
        #[doc = #doc]
        fn at_time(&self, t: f64, timed: &mut [f64]) {
            let ::core::option::Option::Some(timed) = timed.first_chunk_mut() else { return };
            let at = ::kin::rt::At::new(t, &[], &[]);
            #code
            *timed = [#(#values),*];
        }
    }
}

/// What is read instead in the other functions; computed on the spot where nobody has asked before.
pub fn binding(timed: usize) -> TokenStream {
    let n = Literal::usize_unsuffixed(timed);
    quote! {
        let own: [f64; #n];
        let timed = match at.timed().first_chunk() {
            ::core::option::Option::Some(timed) => timed,
            ::core::option::Option::None => {
                own = ::kin::rt::timed(self, at.t);
                &own
            }
        };
    }
}
