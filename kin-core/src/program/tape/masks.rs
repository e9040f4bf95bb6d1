//! Masks hide the structure of a node.
//!
//! A graph moves signs and powers of two to the outside of every product, so that it finds equal
//! expressions. The results of long expressions then carry factors into later expressions, and no
//! sum can be fused with them. A mask represents a node while later expressions are built. At the
//! end the node replaces its mask, and nothing else is simplified.

use std::collections::HashMap;

use kin_graph::{Graph, Input, Node, Op};

/// The nodes behind masks. A mask is [`Input::Timed`] with the index of its node.
#[derive(Default)]
pub(crate) struct Masks {
    behind: Vec<Node>,
    numbers: HashMap<Node, usize>,
}

impl Masks {
    /// Returns the mask of a node; constants and inputs need none.
    pub(crate) fn of(&mut self, graph: &mut Graph, node: Node) -> Node {
        if matches!(graph.op(node), Op::Constant(_) | Op::Input(_)) {
            return node;
        }
        let number = *self.numbers.entry(node).or_insert_with(|| {
            self.behind.push(node);
            self.behind.len() - 1
        });
        graph.input(Input::Timed(number))
    }

    /// Returns the masks of several nodes.
    pub(crate) fn all(&mut self, graph: &mut Graph, nodes: &[Node]) -> Vec<Node> {
        nodes.iter().map(|node| self.of(graph, *node)).collect()
    }

    /// Returns the nodes behind all masks, in order.
    pub(in crate::program) fn behind(&self) -> &[Node] {
        &self.behind
    }

    /// Returns the outputs with nodes in place of their masks.
    pub(in crate::program) fn removed(&self, graph: &mut Graph, outputs: &[Node]) -> Vec<Node> {
        let mut needed = vec![false; graph.len()];
        outputs.iter().for_each(|output| needed[output.index()] = true);
        let nodes: Vec<Node> = graph.nodes().collect();
        // A node is older than its mask, and the mask is older than its results.
        for &node in nodes.iter().rev() {
            if needed[node.index()] {
                self.each_operand(graph, node, |operand| needed[operand.index()] = true);
            }
        }
        let mut places = nodes.clone();
        for &node in nodes.iter().filter(|node| needed[node.index()]) {
            let of = |operand: Node| places.get(operand.index()).copied().unwrap_or(operand);
            let place = match graph.op(node) {
                Op::Input(Input::Timed(number)) => of(self.behind[number]),
                _ => {
                    let mut same = true;
                    graph.each_operand(node, |operand| same &= of(operand) == operand);
                    if same { node } else { graph.with_operands(node, of) }
                }
            };
            places[node.index()] = place;
        }
        outputs.iter().map(|output| places[output.index()]).collect()
    }

    fn each_operand(&self, graph: &Graph, node: Node, mut show: impl FnMut(Node)) {
        match graph.op(node) {
            Op::Input(Input::Timed(number)) => show(self.behind[number]),
            _ => graph.each_operand(node, show),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 a · 2 b stays what it is where a mask stands for each factor, and masks of masks are
    /// found.
    #[test]
    fn nodes_take_the_places_of_their_masks() {
        let mut graph = Graph::default();
        let mut masks = Masks::default();
        let [x, y] = [0, 1].map(|k| graph.input(Input::Column(k)));
        let two = graph.constant(2.0);
        let a = graph.mul(two, x);
        let b = graph.mul(two, y);
        let own = masks.all(&mut graph, &[a, b, two, x]);
        assert_eq!(own[2..], [two, x]);
        let product = graph.mul(own[0], own[1]);
        let again = masks.of(&mut graph, product);
        let sum = graph.sub(again, own[0]);
        let found = masks.removed(&mut graph, &[sum, product, y]);
        let expected = graph.raw(Op::Mul(a.min(b), a.max(b)));
        assert_eq!(found, [graph.raw(Op::Sub(expected, a)), expected, y]);
    }
}
