//! Sums become chains of fused multiply-adds: a b + c d + e is fma(a, b, fma(c, d, e)).
//!
//! A product that several sums share is computed once where a sum can begin with it, which saves that sum a multiplication; elsewhere each sum
//! multiplies for itself, since a fused product costs nothing.

use std::collections::{BTreeMap, HashMap};

use super::edges;
use crate::graph::{Graph, Node, Op};

/// A longer sum is left in parts: a chain is computed one term after the other.
const MOST_TERMS: usize = 10;

/// A term of a sum and whether it is subtracted.
type Term = (bool, Node);

/// The outputs with fused sums.
pub fn fuse(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let mut fusion = Fusion::new(g, outputs);
    let begins = fusion.shared_beginnings(g);
    fusion.values.extend(begins);
    for node in g.reachable(outputs) {
        if fusion.values.contains(&node) {
            let built = fusion.build(g, node);
            fusion.built.insert(node, built);
        }
    }
    outputs.iter().map(|output| fusion.built[output]).collect()
}

#[derive(Default)]
struct Fusion {
    /// Nodes that are needed as such.
    values: std::collections::HashSet<Node>,
    /// The terms of each sum among them.
    sums: BTreeMap<Node, Vec<Term>>,
    built: HashMap<Node, Node>,
}

impl Fusion {
    fn new(g: &Graph, outputs: &[Node]) -> Self {
        let nodes = g.reachable(outputs);
        let (uses, exact) = (super::uses(g, outputs), edges::exact(g, &nodes));
        let is_free = |node: Node| !exact[node.index()];
        let mut fusion = Fusion::default();
        fusion.values.extend(outputs);
        let mut products = std::collections::HashSet::new();
        for &node in nodes.iter().rev() {
            let needed = fusion.values.contains(&node);
            if needed && is_free(node) && is_sum(g, node, &|n| is_free(n) && uses[n.index()] == 1) {
                let terms = flattened(g, node, &|n| is_free(n) && uses[n.index()] == 1);
                for &(_, term) in &terms {
                    let product = matches!(g.op(term), Op::Mul(..)) && is_free(term);
                    if product { products.insert(term) } else { fusion.values.insert(term) };
                }
                fusion.sums.insert(node, terms);
            } else if needed || products.contains(&node) {
                fusion.values.extend(g.operands(node));
            }
        }
        fusion
    }

    /// Whether a term needs no operation of its own to begin a sum with.
    fn is_value(&self, term: &Term) -> bool {
        self.values.contains(&term.1)
    }

    /// Products to compute once, because sums without a better beginning share them: those that most sums share first.
    fn shared_beginnings(&self, g: &Graph) -> Vec<Node> {
        let mut open: Vec<&Vec<Term>> = self.sums.values().filter(|terms| !terms.iter().any(|term| self.is_value(term))).collect();
        let mut chosen = Vec::new();
        loop {
            let mut counts: BTreeMap<Node, usize> = BTreeMap::new();
            for terms in &open {
                terms.iter().for_each(|(_, product)| *counts.entry(*product).or_default() += 1);
            }
            let best = counts.into_iter().filter(|(_, count)| *count > 1).max_by_key(|(node, count)| (*count, std::cmp::Reverse(*node)));
            let Some((product, _)) = best else { return chosen };
            debug_assert!(matches!(g.op(product), Op::Mul(..)));
            open.retain(|terms| !terms.iter().any(|(_, other)| *other == product));
            chosen.push(product);
        }
    }

    fn build(&self, g: &mut Graph, node: Node) -> Node {
        match self.sums.get(&node) {
            Some(terms) => self.sum(g, terms),
            None => g.with_operands(node, |operand| self.built.get(&operand).copied().unwrap_or(operand)),
        }
    }

    /// Begins with a value, if there is one, and adds the other terms in the order in which they were built.
    fn sum(&self, g: &mut Graph, terms: &[Term]) -> Node {
        let has_product = terms.iter().any(|term| !self.is_value(term));
        let first = terms
            .iter()
            .enumerate()
            .min_by_key(|(k, term)| match (self.is_value(term), term.0) {
                (true, false) => (0, *k),
                (true, true) if has_product => (1, *k),
                (false, false) => (2, *k),
                _ => (3, *k),
            })
            .map_or(0, |(k, _)| k);
        let mut rest: Vec<Term> = terms.iter().enumerate().filter(|(k, _)| *k != first).map(|(_, term)| *term).collect();
        // A sign in front of a product is free in a fused operation, and one in front of a value in a subtraction.
        rest.sort_by_key(|term| self.is_value(term));
        let flipped = terms[first].0 && !has_product;
        let mut sum = self.operand(g, terms[first].1);
        if terms[first].0 && !flipped {
            sum = g.raw(Op::Neg(sum));
        }
        for (minus, term) in rest {
            sum = self.plus(g, sum, (minus != flipped, term));
        }
        if flipped { g.raw(Op::Neg(sum)) } else { sum }
    }

    fn operand(&self, g: &mut Graph, node: Node) -> Node {
        match self.built.get(&node) {
            Some(&built) => built,
            None => g.with_operands(node, |operand| self.built[&operand]),
        }
    }

    fn plus(&self, g: &mut Graph, sum: Node, (minus, term): Term) -> Node {
        match g.op(term) {
            Op::Mul(a, b) if !self.is_value(&(minus, term)) => {
                let (a, b) = (self.built[&a], self.built[&b]);
                let a = match g.constant_value(a) {
                    Some(c) if minus => g.constant(-c),
                    _ if minus => g.raw(Op::Neg(a)),
                    _ => a,
                };
                g.raw(Op::Fma(a, b, sum))
            }
            _ if minus => g.raw(Op::Sub(sum, self.built[&term])),
            _ => g.raw(Op::Add(sum, self.built[&term])),
        }
    }
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
