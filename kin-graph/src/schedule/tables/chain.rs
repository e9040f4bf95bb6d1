//! Finds chains `if … else if …` over one number: selections whose conditions are the same test
//! with other numbers.

use std::cmp::Ordering;

use crate::{Comparison, Graph, Input, Node, Op};

/// Chains of fewer pieces stay as they are.
const FEWEST: usize = 4;

/// A comparison of a node with a number that is known before the program runs.
#[derive(Clone, Copy, PartialEq)]
pub struct Test {
    /// True if the comparison must be false.
    pub negated: bool,
    pub comparison: Comparison,
    /// The other side, which is the same one for every piece, and whether it stands on the left.
    pub of: Node,
    pub on_the_left: bool,
}

/// A condition as tests that must hold together, each with its number.
pub type Tests = Vec<(Test, Node)>;

/// One selection of a chain.
#[derive(Clone)]
pub struct Step {
    pub condition: Node,
    /// True if the piece is taken where the condition does not hold.
    pub negated: bool,
    pub tests: Tests,
    pub value: Node,
}

/// A chain: the value of the first step whose tests hold, else the last one.
#[derive(Clone)]
pub struct Chain {
    pub steps: Vec<Step>,
    pub last: Node,
}

impl Chain {
    /// Returns the values of all pieces.
    pub fn values(&self) -> Vec<Node> {
        self.steps.iter().map(|step| step.value).chain([self.last]).collect()
    }

    /// Builds a chain with the same conditions and other values.
    pub fn with(&self, g: &mut Graph, values: &[Node]) -> Node {
        let Some((&last, values)) = values.split_last() else { return self.last };
        self.steps.iter().zip(values).rev().fold(last, |rest, (step, &value)| {
            let (a, b) = if step.negated { (rest, value) } else { (value, rest) };
            g.select(step.condition, a, b)
        })
    }
}

/// Returns the number of nested selections below each node, or `None` if no chain is long enough.
pub fn depths(g: &Graph, nodes: &[Node]) -> Option<Vec<usize>> {
    let mut depths: Vec<usize> = Vec::new();
    let mut deepest = 0;
    for &node in nodes {
        if let Op::Select(_, a, b) = g.op(node) {
            depths.resize(depths.len().max(g.len()), 0);
            depths[node.index()] = 1 + depths[a.index()].max(depths[b.index()]);
            deepest = deepest.max(depths[node.index()]);
        }
    }
    (deepest + 1 >= FEWEST).then_some(depths)
}

/// Returns the chain that begins with a node, if the chain is long enough.
pub fn chain(g: &Graph, root: Node, depths: &[usize]) -> Option<Chain> {
    let mut chain = Chain { steps: Vec::new(), last: root };
    while let Op::Select(condition, a, b) = g.op(chain.last) {
        // The last selection goes the way of the others.
        let before = chain.steps.last().is_some_and(|step: &Step| step.negated);
        let negated = match depths[a.index()].cmp(&depths[b.index()]) {
            Ordering::Less => false,
            Ordering::Greater => true,
            Ordering::Equal => before,
        };
        let (value, rest) = if negated { (b, a) } else { (a, b) };
        let Some(tests) = tests(g, condition, negated) else { break };
        if chain.steps.first().is_some_and(|first| !alike(&first.tests, &tests)) {
            break;
        }
        chain.steps.push(Step { condition, negated, tests, value });
        chain.last = rest;
    }
    (chain.steps.len() + 1 >= FEWEST).then_some(chain)
}

fn alike(a: &Tests, b: &Tests) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0)
}

fn tests(g: &Graph, condition: Node, negated: bool) -> Option<Tests> {
    match g.op(condition) {
        Op::Compare(comparison, a, b) if is_given(g, b) => {
            Some(vec![(Test { negated, comparison, of: a, on_the_left: true }, b)])
        }
        Op::Compare(comparison, a, b) if is_given(g, a) => {
            Some(vec![(Test { negated, comparison, of: b, on_the_left: false }, a)])
        }
        Op::Not(a) => tests(g, a, !negated),
        Op::And(a, b) if !negated => Some([tests(g, a, negated)?, tests(g, b, negated)?].concat()),
        Op::Or(a, b) if negated => Some([tests(g, a, negated)?, tests(g, b, negated)?].concat()),
        _ => None,
    }
}

/// Returns true if a node is a number that is known before the program runs.
pub fn is_given(g: &Graph, node: Node) -> bool {
    matches!(g.op(node), Op::Constant(_) | Op::Input(Input::Parameter(_) | Input::Timed(_)))
}
