//! Handles the factors of a product.

use super::{Graph, Node, Op};

/// The factors of a product, without a place on the heap: most sums are asked for common ones.
#[derive(Default)]
pub(super) struct Factors {
    nodes: [Node; Factors::MOST],
    count: usize,
}

impl Factors {
    /// A product of more is not taken apart any further.
    const MOST: usize = 9;

    pub(super) fn as_slice(&self) -> &[Node] {
        &self.nodes[..self.count]
    }

    fn push(&mut self, node: Node) {
        self.nodes[self.count] = node;
        self.count += 1;
    }

    fn pop(&mut self) -> Option<Node> {
        self.count = self.count.checked_sub(1)?;
        Some(self.nodes[self.count])
    }

    /// Takes out what both have, each factor as often as both have it.
    pub(super) fn take_common(&mut self, other: &mut Factors) -> Factors {
        let mut common = Factors::default();
        let mut rest = Factors::default();
        for &factor in self.as_slice() {
            match other.as_slice().iter().position(|known| *known == factor) {
                Some(place) => {
                    other.nodes.copy_within(place + 1..other.count, place);
                    other.count -= 1;
                    common.push(factor);
                }
                None => rest.push(factor),
            }
        }
        *self = rest;
        common
    }
}

impl Graph {
    /// Factors of a product, a few levels deep.
    pub(super) fn factors(&self, a: Node) -> Factors {
        let mut done = Factors::default();
        let mut open = Factors::default();
        open.push(a);
        while let Some(node) = open.pop() {
            match self.op(node) {
                Op::Mul(x, y) if done.count + open.count < Factors::MOST - 1 => {
                    open.push(y);
                    open.push(x);
                }
                _ => done.push(node),
            }
        }
        done
    }
}
