//! From the graph as mathematics to the graph as code: the same values with fewer operations, and the order in which to compute them.
//!
//! The graph that differentiation works on is canonical: powers of two and signs stand outside, sums have two terms. That is best for finding
//! equal expressions and bad for a processor. Here powers of two go back to where they cost nothing (`scale`), sums become chains of fused
//! multiply-adds (`fuse`), and operations are put in an order that needs few registers (`order`). Last bits may change; no tolerance is used.
//! All of it is linear in the number of nodes: it runs whenever a user's crate is compiled, and without optimization.

mod edges;
mod fuse;
mod order;
mod scale;

#[cfg(test)]
mod tests;

pub use order::order;

use crate::graph::{Graph, Node, Op};

/// Nodes with the values of `outputs`, made for few operations.
pub fn prepare(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let outside = fuse::fuse(g, outputs);
    let Some(inwards) = scale::powers_inwards(g, outputs) else { return outside };
    let inwards = fuse::fuse(g, &inwards);
    if operations(g, &inwards) < operations(g, &outside) { inwards } else { outside }
}

/// How many operations `outputs` take; signs are free, a processor adds and subtracts alike.
fn operations(g: &Graph, outputs: &[Node]) -> usize {
    let free = |node: &Node| matches!(g.op(*node), Op::Input(_) | Op::Constant(_) | Op::Truth(_) | Op::Neg(_));
    g.reachable(outputs).iter().filter(|node| !free(node)).count()
}

/// How often each of `nodes` is used, by number of the node.
fn uses(g: &Graph, nodes: &[Node], outputs: &[Node]) -> Vec<usize> {
    let mut uses = vec![0; g.len()];
    for &node in nodes {
        g.each_operand(node, |operand| uses[operand.index()] += 1);
    }
    outputs.iter().for_each(|output| uses[output.index()] += 1);
    uses
}
