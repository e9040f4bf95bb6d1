//! From the graph as mathematics to the graph as code: the same values with fewer operations, and
//! the order in which to compute them.
//!
//! The graph that differentiation works on is canonical: powers of two and signs stand outside,
//! sums have two terms. That is best for finding equal expressions and bad for a processor. Here
//! powers of two go back to where they cost nothing (`scale`), sums become chains of fused
//! multiply-adds (`fuse`), and operations are put in an order that needs few registers (`order`),
//! of long branches only the one that is taken (`branches`). Last bits may change; no tolerance is
//! used. All of it is linear in the number of nodes: it runs whenever a user's crate is compiled,
//! and without optimization.

mod branches;
mod edges;
mod fuse;
mod lookups;
mod order;
mod scale;
mod tables;

#[cfg(test)]
mod tests;

pub use branches::{Branches, Choice};
pub use lookups::Lookup;
pub use order::{Group, order};
pub use tables::{Test, looked_up};

use crate::{Graph, Node, Op};

/// A list for some of a graph's nodes. Most have none: without optimization even an empty `Vec`
/// each takes time.
struct Lists<T> {
    /// Of each node the number of its list; 0 is the empty one.
    places: Vec<usize>,
    lists: Vec<Vec<T>>,
}

impl<T> Lists<T> {
    /// No list yet, for nodes of numbers below `nodes`.
    fn new(nodes: usize) -> Self {
        Lists { places: vec![0; nodes], lists: vec![Vec::new()] }
    }

    fn of(&self, node: Node) -> &[T] {
        &self.lists[self.places[node.index()]]
    }

    fn to(&mut self, node: Node) -> &mut Vec<T> {
        if self.places[node.index()] == 0 {
            self.places[node.index()] = self.lists.len();
            self.lists.push(Vec::new());
        }
        &mut self.lists[self.places[node.index()]]
    }
}

/// Nodes with the values of `outputs`, their sums fused: [`prepare`] without a look at powers of
/// two, of which large graphs gain nothing.
pub fn fused(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    fuse::fuse(g, outputs)
}

/// Nodes with the values of `outputs`, made for few operations.
pub fn prepare(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let outside = fuse::fuse(g, outputs);
    let Some(inwards) = scale::powers_inwards(g, outputs) else { return outside };
    let inwards = fuse::fuse(g, &inwards);
    if operations(g, &inwards) < operations(g, &outside) { inwards } else { outside }
}

/// How many operations `outputs` take; signs are free, a processor adds and subtracts alike.
pub fn operations(g: &Graph, outputs: &[Node]) -> usize {
    let free = |node: &Node| {
        matches!(
            g.op(*node),
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) | Op::Neg(_)
        )
    };
    g.reachable(outputs).iter().filter(|node| !free(node)).count()
}

/// How often each of `nodes` is used, by number of the node.
fn uses(g: &Graph, branches: &Branches, nodes: &[Node], outputs: &[Node]) -> Vec<usize> {
    let mut uses = vec![0; g.len()];
    for &node in nodes {
        branches.each_operand(g, node, |operand| uses[operand.index()] += 1);
    }
    outputs.iter().for_each(|output| uses[output.index()] += 1);
    uses
}
