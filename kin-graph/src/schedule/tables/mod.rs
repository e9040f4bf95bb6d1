//! Tables of pieces: `if x < x_1 { a_1 + b_1 x } else if x < x_2 { a_2 + b_2 x } else …` is one
//! expression of numbers that are looked up, a + b x, with a = `if x < x_1 { a_1 } else …`.
//!
//! So Kin computes, emits and compiles a spline of two hundred pieces as one piece. The derivatives
//! of the spline are chains with the same conditions, so they use the same row. The pieces need not
//! have the same form: a piece that numbers such as 0, 1 or −1 have simplified also matches the
//! form of the longest piece (`fitting`). Tables are only for the computation of numbers. They do
//! not change the graph that Kin differentiates, bounds and shows.

mod chain;
mod fitting;
mod form;

#[cfg(test)]
mod tests;

use std::collections::HashMap;

pub use chain::{Chain, Test, chain, depths, is_given};

use crate::{Graph, Node};
use fitting::{Value, fitted};
use form::{Form, Kind, Term, inside};

/// So many pieces are tried as the form of all.
const CANDIDATES: usize = 3;

/// Tables in tables are seen so deep.
const ROUNDS: usize = 6;

/// Returns nodes with the values of `outputs`, in which each table of pieces is one expression.
pub fn looked_up(g: &mut Graph, outputs: &[Node]) -> Vec<Node> {
    let mut outputs = outputs.to_vec();
    for _ in 0..ROUNDS {
        let nodes = g.reachable(&outputs);
        let Some(depths) = depths(g, &nodes) else { break };
        let found = found(g, &nodes, &depths);
        if found.is_empty() {
            break;
        }
        outputs = replaced(g, &nodes, &outputs, &found);
    }
    outputs
}

/// Chains and the expressions that they are, outermost ones only.
fn found(g: &mut Graph, nodes: &[Node], depths: &[usize]) -> HashMap<Node, Node> {
    let mut covered = vec![false; g.len()];
    let mut found = HashMap::new();
    for &root in
        nodes.iter().rev().filter(|node| depths.get(node.index()).is_some_and(|&depth| depth > 0))
    {
        if covered[root.index()] {
            continue;
        }
        let Some(chain) = chain(g, root, depths) else { continue };
        cover(g, root, &chain, &mut covered);
        if let Some((expression, inside)) = as_expression(g, &chain) {
            found.insert(root, expression);
            // The nodes of the pieces are not needed any more.
            inside.into_iter().for_each(|node| covered[node.index()] = true);
        }
    }
    found
}

/// Notes the selections of a chain: what begins at one of them is a part of it.
fn cover(g: &Graph, root: Node, chain: &Chain, covered: &mut [bool]) {
    let mut node = root;
    for step in &chain.steps {
        covered[node.index()] = true;
        if let crate::Op::Select(_, a, b) = g.op(node) {
            node = if step.negated { a } else { b };
        }
    }
}

/// The outputs with expressions in the place of chains.
fn replaced(
    g: &mut Graph,
    nodes: &[Node],
    outputs: &[Node],
    found: &HashMap<Node, Node>,
) -> Vec<Node> {
    let mut built: Vec<Node> = Vec::new();
    built.resize(g.len(), Node::default());
    for &node in nodes {
        let changed = |g: &Graph, built: &[Node]| {
            let mut changed = false;
            g.each_operand(node, |operand| changed |= built[operand.index()] != operand);
            changed
        };
        built[node.index()] = match found.get(&node) {
            Some(&expression) => expression,
            None if changed(g, &built) => g.with_operands(node, |operand| built[operand.index()]),
            None => node,
        };
    }
    outputs.iter().map(|output| built[output.index()]).collect()
}

/// A chain as one expression of numbers that are looked up, and the nodes that only its pieces
/// held.
fn as_expression(g: &mut Graph, chain: &Chain) -> Option<(Node, Vec<Node>)> {
    let pieces = chain.values();
    if pieces.iter().all(|&piece| is_given(g, piece)) {
        return None;
    }
    let counts = counts(g, &pieces);
    let is_same =
        |node: Node| counts.get(node.index()).is_some_and(|&count| 2 * count > pieces.len());
    let mut longest: Vec<(usize, Node)> =
        pieces.iter().map(|&piece| (inside(g, &[piece], &is_same).len(), piece)).collect();
    longest.sort_by_key(|&(length, piece)| (std::cmp::Reverse(length), piece));
    longest.dedup();
    longest.truncate(CANDIDATES);
    longest.into_iter().find_map(|(_, template)| {
        let form = Form::new(g, template, is_same);
        let fitted: Vec<Vec<Option<Value>>> =
            pieces.iter().map(|&piece| fitted(g, &form, piece)).collect::<Option<_>>()?;
        let expression = Built::new(g, chain, &form, &fitted)?.expression(g, &form);
        Some((expression, inside(g, &pieces, &is_same)))
    })
}

/// In how many pieces each node occurs, by its number.
fn counts(g: &Graph, pieces: &[Node]) -> Vec<usize> {
    let mut counts = vec![0; g.len()];
    let mut seen = vec![0; g.len()];
    let mut open = Vec::new();
    for (turn, &piece) in pieces.iter().enumerate() {
        open.push(piece);
        while let Some(node) = open.pop() {
            if std::mem::replace(&mut seen[node.index()], turn + 1) != turn + 1 {
                counts[node.index()] += 1;
                g.each_operand(node, |operand| open.push(operand));
            }
        }
    }
    counts
}

/// A form with what is looked up in its places.
struct Built {
    /// The number in each place, and whether it differs from piece to piece.
    places: Vec<(Node, bool)>,
}

impl Built {
    /// `None` if more would be looked up than the pieces hold.
    fn new(
        g: &mut Graph,
        chain: &Chain,
        form: &Form,
        fitted: &[Vec<Option<Value>>],
    ) -> Option<Built> {
        let mut places = Vec::new();
        let mut columns: Vec<Node> = Vec::new();
        for (place, &own) in form.own.iter().enumerate() {
            let values: Vec<Node> = fitted
                .iter()
                .map(|values| match values[place] {
                    None => own,
                    Some(Value::Number(number)) => g.constant(number),
                    Some(Value::Given(node)) => node,
                })
                .collect();
            let varies = values.iter().any(|value| *value != values[0]);
            let node = if varies { chain.with(g, &values) } else { values[0] };
            if varies && !columns.contains(&node) {
                columns.push(node);
            }
            places.push((node, varies));
        }
        (columns.len() <= form.parts.len() + 1).then_some(Built { places })
    }

    fn expression(&self, g: &mut Graph, form: &Form) -> Node {
        let mut built: Vec<(Node, bool)> = Vec::new();
        for part in &form.parts {
            let terms = match &part.kind {
                Kind::Given(place) => {
                    built.push(self.places[*place]);
                    continue;
                }
                Kind::Same => vec![],
                Kind::Sum(a, b) | Kind::Product(a, b) | Kind::Quotient(a, b) => vec![*a, *b],
                Kind::Operation(operands) => operands.iter().map(|(_, term)| *term).collect(),
            };
            let terms: Vec<(Node, bool)> =
                terms.into_iter().map(|term| self.term(g, &built, term)).collect();
            let varies = terms.iter().any(|term| term.1);
            let node = match &part.kind {
                _ if !varies => part.node,
                Kind::Sum(..) => g.add(terms[0].0, terms[1].0),
                Kind::Product(..) => g.mul(terms[0].0, terms[1].0),
                Kind::Quotient(..) => g.div(terms[0].0, terms[1].0),
                _ => {
                    let operands = g.operands(part.node);
                    let of = |operand: Node| {
                        operands
                            .iter()
                            .position(|known| *known == operand)
                            .map_or(operand, |k| terms[k].0)
                    };
                    g.with_operands(part.node, of)
                }
            };
            built.push((node, varies));
        }
        self.term(g, &built, form.root).0
    }

    fn term(&self, g: &mut Graph, built: &[(Node, bool)], term: Term) -> (Node, bool) {
        let (factor, varies) = self.places[term.factor];
        match term.core {
            None => (factor, varies),
            Some(core) => (g.mul(factor, built[core].0), varies || built[core].1),
        }
    }
}
