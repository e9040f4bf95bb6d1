//! Prepares a graph for code: computes the same values with fewer operations, and chooses the order
//! of computation.
//!
//! Differentiation uses a canonical graph: powers of two and signs are outside of products, and
//! sums have two terms. The canonical form is good for finding equal expressions and bad for a
//! processor. This module moves powers of two to places at which they cost nothing (`scale`) and
//! converts sums to chains of fused multiply-adds (`fuse`). It also chooses an order that needs few
//! registers (`order`), and code that runs only the selected branch of a long choice (`branches`).
//! The last bits of results may change; no pass uses a tolerance. The time of all passes is linear
//! in the number of nodes, because the passes run without optimization whenever a user's crate is
//! compiled.

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

/// Returns nodes with the values of `outputs` and fused sums.
///
/// Unlike [`prepare`], the function does not move powers of two, because large graphs gain nothing
/// from that.
pub fn fused(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    fuse::fuse(g, outputs)
}

/// Returns nodes that compute the values of `outputs` with few operations.
pub fn prepare(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let outside = fuse::fuse(g, outputs);
    let Some(inwards) = scale::powers_inwards(g, outputs) else { return outside };
    let inwards = fuse::fuse(g, &inwards);
    if operations(g, &inwards) < operations(g, &outside) { inwards } else { outside }
}

/// Returns the number of operations of `outputs`.
///
/// Signs are free, because a processor adds and subtracts at the same cost.
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
