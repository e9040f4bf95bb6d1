//! Converts sums to chains of fused multiply-adds: a b + c d + e becomes fma(a, b, fma(c, d, e)).
//!
//! If a sum can begin with a product that several sums share, Kin computes the product once, which
//! saves the sum a multiplication. Otherwise each sum contains the product, because a fused product
//! needs no extra operation.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::{Branches, Lists, edges};
use crate::{Graph, Node, Op};

/// A longer sum is left in parts: a chain is computed one term after the other.
const MOST_TERMS: usize = 8;

/// A term of a sum and whether it is subtracted.
type Term = (bool, Node);

/// Returns the outputs with fused sums.
pub fn fuse(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let nodes = g.reachable(outputs);
    let mut fusion = Fusion::new(g, outputs, &nodes);
    fusion.share_beginnings(&nodes);
    let negated = fusion.negated(g, outputs, &nodes);
    fusion.built = vec![(false, Node::default()); g.len()];
    for node in nodes {
        let is_value = fusion.values[node.index()];
        fusion.built[node.index()] =
            if is_value { fusion.build(g, node, negated[node.index()]) } else { (false, node) };
    }
    outputs.iter().map(|&output| fusion.plain(g, output)).collect()
}

/// The findings about each node, by its number.
struct Fusion {
    /// True if it is needed as such.
    values: Vec<bool>,
    /// The terms of a sum that is needed; else none.
    sums: Lists<Term>,
    /// The node that stands for it.
    built: Vec<Signed>,
}

/// A node, and true if it is subtracted.
type Signed = (bool, Node);

/// A term as it is written: a number, or a product made on the way.
#[derive(Clone, Copy)]
enum Written {
    Value(Node),
    Product(Node, Node),
}

impl Fusion {
    fn new(g: &Graph, outputs: &[Node], nodes: &[Node]) -> Self {
        let uses = super::uses(g, &Branches::none(), nodes, outputs);
        let exact = edges::exact(g, nodes);
        let is_free = |node: Node| !exact[node.index()];
        let is_alone = |node: Node| is_free(node) && uses[node.index()] == 1;
        let mut values = vec![false; g.len()];
        let mut products = vec![false; g.len()];
        let mut sums = Lists::new(g.len());
        outputs.iter().for_each(|output| values[output.index()] = true);
        for &node in nodes.iter().rev() {
            let needed = values[node.index()];
            if needed && is_free(node) && is_sum(g, node, &is_alone) {
                let terms = flattened(g, node, &is_alone);
                for &(_, term) in &terms {
                    let kind = if matches!(g.op(term), Op::Mul(..)) && is_free(term) {
                        &mut products
                    } else {
                        &mut values
                    };
                    kind[term.index()] = true;
                }
                *sums.to(node) = terms;
            } else if needed || products[node.index()] {
                g.each_operand(node, |operand| values[operand.index()] = true);
            }
        }
        Fusion { values, sums, built: Vec::new() }
    }

    fn is_sum(&self, node: Node) -> bool {
        !self.sums.of(node).is_empty()
    }

    /// Products to compute once, because sums without a better beginning share them: those that
    /// most sums share first, of equal ones the earliest.
    fn share_beginnings(&mut self, nodes: &[Node]) {
        let is_open = |terms: &&[Term]| {
            !terms.is_empty() && !terms.iter().any(|(_, term)| self.values[term.index()])
        };
        let open: Vec<&[Term]> =
            nodes.iter().map(|node| self.sums.of(*node)).filter(is_open).collect();
        let mut counts = vec![0_usize; self.values.len()];
        open.iter()
            .flat_map(|terms| terms.iter())
            .for_each(|(_, product)| counts[product.index()] += 1);
        let shared = nodes.iter().enumerate().filter(|(_, node)| counts[node.index()] > 1);
        let mut waiting: BinaryHeap<(usize, Reverse<usize>)> =
            shared.map(|(place, node)| (counts[node.index()], Reverse(place))).collect();
        let mut sums_with = Lists::<usize>::new(self.values.len());
        for (sum, terms) in open.iter().enumerate() {
            let shared = terms.iter().filter(|(_, product)| counts[product.index()] > 1);
            shared.for_each(|(_, product)| sums_with.to(*product).push(sum));
        }
        let mut begun = vec![false; open.len()];
        let mut chosen = Vec::new();
        while let Some((count, place)) = waiting.pop() {
            let product = nodes[place.0];
            // A count falls when another product begins a sum of it: then it waits again.
            let left = counts[product.index()];
            if left < count {
                waiting.extend((left > 1).then_some((left, place)));
                continue;
            }
            for &sum in sums_with
                .of(product)
                .iter()
                .filter(|sum| !std::mem::replace(&mut begun[**sum], true))
            {
                open[sum].iter().for_each(|(_, product)| counts[product.index()] -= 1);
            }
            chosen.push(product);
        }
        chosen.into_iter().for_each(|product: Node| self.values[product.index()] = true);
    }

    /// Which sums and multiples are better computed with the other sign, by number of the node:
    /// where more outputs ask for that. Sums take either sign of their terms.
    fn negated(&self, g: &Graph, outputs: &[Node], nodes: &[Node]) -> Vec<bool> {
        let mut votes = vec![0; g.len()];
        let mut negated = vec![false; g.len()];
        outputs.iter().for_each(|output| votes[output.index()] += 1);
        let turns = |n: Node| self.is_sum(n) || is_multiple(g, n);
        for &node in nodes.iter().rev().filter(|node| self.values[node.index()]) {
            let vote = votes[node.index()];
            negated[node.index()] = vote < 0 && turns(node);
            if self.is_sum(node) {
                let terms = self.sums.of(node);
                // Only minuses and no product to fuse them with: one of the terms had better turn.
                let all_minus = terms.iter().all(|(minus, term)| {
                    *minus != negated[node.index()] && self.values[term.index()]
                });
                if let (true, Some((_, term))) =
                    (all_minus, terms.iter().find(|(_, term)| turns(*term)))
                {
                    votes[term.index()] -= 1;
                }
                continue;
            }
            match g.op(node) {
                Op::Neg(a) => votes[a.index()] -= vote,
                Op::Mul(..) if turns(node) => {}
                Op::Mul(a, b) => votes[if turns(a) { a } else { b }.index()] += vote,
                Op::Div(a, _) => votes[a.index()] += vote,
                _ => g.each_operand(node, |operand| votes[operand.index()] += 1),
            }
        }
        negated
    }

    fn build(&self, g: &mut Graph, node: Node, negated: bool) -> Signed {
        if self.is_sum(node) {
            return (negated, self.sum(g, self.sums.of(node), negated));
        }
        match g.op(node) {
            Op::Neg(a) => {
                let (minus, a) = self.built[a.index()];
                (!minus, a)
            }
            Op::Mul(c, a) if is_multiple(g, node) => {
                let (minus, a) = self.built[a.index()];
                let c = g.constant_value(c).unwrap_or(1.0);
                let c = g.constant(if negated { -c } else { c });
                (minus != negated, g.raw(Op::Mul(c, a)))
            }
            Op::Mul(a, b) => {
                let (minus_a, a) = self.built[a.index()];
                let (minus_b, b) = self.built[b.index()];
                (minus_a != minus_b, g.raw(Op::Mul(a, b)))
            }
            Op::Div(a, b) => {
                let (minus_a, a) = self.built[a.index()];
                let (minus_b, b) = self.built[b.index()];
                (minus_a != minus_b, g.raw(Op::Div(a, b)))
            }
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) | Op::Opaque(..) => {
                (false, node)
            }
            _ => {
                let plain: Vec<(Node, Node)> = g
                    .operands(node)
                    .into_iter()
                    .map(|operand| (operand, self.plain(g, operand)))
                    .collect();
                (
                    false,
                    g.with_operands(node, |operand| {
                        plain
                            .iter()
                            .find(|(of, _)| *of == operand)
                            .map_or(operand, |(_, node)| *node)
                    }),
                )
            }
        }
    }

    /// The node that stands for `node`, with its sign.
    fn plain(&self, g: &mut Graph, node: Node) -> Node {
        let (minus, built) = self.built[node.index()];
        if minus { g.raw(Op::Neg(built)) } else { built }
    }

    /// Begins with a number, if there is one, and adds the other terms in the order in which they
    /// were built.
    fn sum(&self, g: &mut Graph, terms: &[Term], negated: bool) -> Node {
        let mut terms: Vec<(bool, Written)> =
            terms.iter().map(|&term| self.written(g, term, negated)).collect();
        let is_product = |term: &(bool, Written)| matches!(term.1, Written::Product(..));
        let fused = terms.iter().any(is_product);
        // A minus is free in a fused operation and in a subtraction, but not in front of the first
        // number.
        let rank = |term: &(bool, Written)| match (is_product(term), term.0) {
            (false, false) => 0,
            (false, true) if fused => 1,
            (true, false) => 2,
            _ => 3,
        };
        let first = (0..terms.len()).min_by_key(|&k| (rank(&terms[k]), k)).unwrap_or(0);
        let (minus, first) = terms.remove(first);
        terms.sort_by_key(|term| !is_product(term));
        let turned = minus && !fused;
        let mut sum = match first {
            Written::Value(node) => node,
            Written::Product(a, b) => g.raw(Op::Mul(a, b)),
        };
        if minus && fused {
            sum = g.raw(Op::Neg(sum));
        }
        for (minus, term) in terms {
            sum = plus(g, sum, minus != turned, term);
        }
        if turned { g.raw(Op::Neg(sum)) } else { sum }
    }

    fn written(&self, g: &Graph, (minus, term): Term, negated: bool) -> (bool, Written) {
        match g.op(term) {
            Op::Mul(a, b) if !self.values[term.index()] => {
                let (minus_a, a) = self.built[a.index()];
                let (minus_b, b) = self.built[b.index()];
                (minus ^ negated ^ minus_a ^ minus_b, Written::Product(a, b))
            }
            _ => {
                let (turned, value) = self.built[term.index()];
                (minus ^ negated ^ turned, Written::Value(value))
            }
        }
    }
}

/// sum ± term
fn plus(g: &mut Graph, sum: Node, minus: bool, term: Written) -> Node {
    match term {
        Written::Product(a, b) => {
            let a = match g.constant_value(a) {
                Some(c) if minus => g.constant(-c),
                _ if minus => g.raw(Op::Neg(a)),
                _ => a,
            };
            g.raw(Op::Fma(a, b, sum))
        }
        Written::Value(value) if minus => g.raw(Op::Sub(sum, value)),
        Written::Value(value) => g.raw(Op::Add(sum, value)),
    }
}

/// c x, whose sign the constant takes.
fn is_multiple(g: &Graph, node: Node) -> bool {
    matches!(g.op(node), Op::Mul(c, _) if g.constant_value(c).is_some())
}

/// A sum, or minus a sum that nothing else uses.
fn is_sum(g: &Graph, node: Node, alone: &dyn Fn(Node) -> bool) -> bool {
    match g.op(node) {
        Op::Add(..) | Op::Sub(..) => true,
        Op::Neg(a) => matches!(g.op(a), Op::Add(..) | Op::Sub(..)) && alone(a),
        _ => false,
    }
}

/// The terms of a sum, those of inner sums that stand `alone` among them, in order of creation.
fn flattened(g: &Graph, node: Node, alone: &dyn Fn(Node) -> bool) -> Vec<Term> {
    let mut done: Vec<Term> = Vec::new();
    let mut open: Vec<Term> = vec![(false, node)];
    while let Some((minus, term)) = open.pop() {
        let opened = term == node || (alone(term) && done.len() + open.len() < MOST_TERMS);
        match g.op(term) {
            Op::Add(a, b) if opened => open.extend([(minus, b), (minus, a)]),
            Op::Sub(a, b) if opened => open.extend([(!minus, b), (minus, a)]),
            Op::Neg(a) if opened => open.push((!minus, a)),
            Op::Neg(a) => done.push((!minus, a)),
            _ => done.push((minus, term)),
        }
    }
    done.sort_by_key(|(_, term)| *term);
    done
}
