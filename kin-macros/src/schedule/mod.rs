//! From the graph as mathematics to the graph as code: the same values with fewer operations, and the order in which to compute them.
//!
//! The graph that differentiation works on is canonical: powers of two and signs stand outside, sums have two terms. That is best for finding
//! equal expressions and bad for a processor. Here powers of two go back to where they cost nothing (`scale`), sums become chains of fused
//! multiply-adds (`fuse`), and operations are put in an order that needs few registers (`order`). Last bits may change; no tolerance is used.

mod edges;
mod fuse;
mod order;
mod scale;

pub use order::order;

use crate::graph::{Graph, Node, Op};

/// Nodes with the values of `outputs`, made for few operations.
pub fn prepare(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let factors = scale::Factors::new(g, outputs);
    let mut best: Option<(usize, Vec<Node>)> = None;
    for pushed in factors.choices() {
        let scaled = factors.apply(g, outputs, &pushed);
        let fused = fuse::fuse(g, &scaled);
        let cost = operations(g, &fused);
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, fused));
        }
    }
    best.map_or_else(|| outputs.to_vec(), |(_, fused)| fused)
}

/// How many operations `outputs` take; signs are free, a processor adds and subtracts alike.
fn operations(g: &Graph, outputs: &[Node]) -> usize {
    let free = |node: &Node| matches!(g.op(*node), Op::Input(_) | Op::Constant(_) | Op::Truth(_) | Op::Neg(_));
    g.reachable(outputs).iter().filter(|node| !free(node)).count()
}

/// How often each node is used, by number of the node.
fn uses(g: &Graph, outputs: &[Node]) -> Vec<usize> {
    let mut uses = vec![0; g.len()];
    for node in g.reachable(outputs) {
        for operand in g.operands(node) {
            uses[operand.index()] += 1;
        }
    }
    for output in outputs {
        uses[output.index()] += 1;
    }
    uses
}
