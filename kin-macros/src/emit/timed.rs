//! What a constraint makes of the time alone: laws, sines and calls in which no coordinate stands. They are evaluated once a time
//! (`at_time`), and every other function of the constraint reads them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::{Kernel, is_condition};
use crate::graph::{Input, Node, Op};
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

/// `n_timed` and `at_time`; nothing where there is nothing of the kind.
pub fn functions(lowered: &Lowered, timed: &[Node]) -> TokenStream {
    if timed.is_empty() {
        return quote!();
    }
    let n = Literal::usize_unsuffixed(timed.len());
    let place = |k: usize| {
        let k = Literal::usize_unsuffixed(k);
        quote!(timed[#k])
    };
    let outputs: Vec<(TokenStream, Node)> = timed.iter().enumerate().map(|(k, &node)| (place(k), node)).collect();
    let code = Kernel::emit(lowered, &[], &[], &outputs);
    let (doc, code) = (format!(" What depends on t and parameters alone: {} operations", code.operations), code.tokens);
    quote! {
        fn n_timed(&self) -> usize {
            #n
        }
        #[doc = #doc]
        fn at_time(&self, t: f64, timed: &mut [f64]) {
            let ::core::option::Option::Some(timed) = timed.first_chunk_mut::<#n>() else { return };
            let at = ::kin::rt::At::new(t, &[], &[]);
            #code
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
