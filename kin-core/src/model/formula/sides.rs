//! Determines the branches that a formula takes at a position: which conditions hold, and the
//! values of its integer steps.
//!
//! Newton's method, compiled programs and events all use this list of the operations that can jump.

use kin_graph::{
    Formula, Function, Function2, Graph, Input, LeafUse, Node, Op, Results, Source, evaluate,
};

use super::{Given, Outside, jet_of_law};
use crate::numbers::real::Dual3_64;

/// A choice of a node between branches, expressed as a number that is constant on each branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Choice {
    /// The node itself: a condition, or a number that is constant between its jumps.
    Own(Node),
    /// ⌊|x|⌋ with the sign of x.
    Truncated(Node),
    /// The integer quotient of the first node by the second, rounded towards zero.
    Quotient(Node, Node),
    /// The integer quotient that leaves a nonnegative remainder.
    EuclideanQuotient(Node, Node),
}

impl Choice {
    /// Returns the choice that a node of a graph makes, if it makes one.
    pub(crate) fn of(graph: &Graph, node: Node) -> Option<Choice> {
        Some(match graph.op(node) {
            Op::Select(condition, ..) => Choice::Own(condition),
            Op::Call(Function::Fract, x) => Choice::Truncated(x),
            Op::Call(f, _) if f.facts().can_jump() => Choice::Own(node),
            Op::Call2(Function2::RemEuclid, x, y) => Choice::EuclideanQuotient(x, y),
            Op::Call2(Function2::Rem, x, y) => Choice::Quotient(x, y),
            Op::Call2(f, ..) if f.facts().jumps => Choice::Own(node),
            _ => return None,
        })
    }

    /// Returns the node of this choice and creates it if it does not exist.
    pub(crate) fn node(self, graph: &mut Graph) -> Node {
        match self {
            Choice::Own(node) => node,
            Choice::Truncated(x) => graph.call(Function::Trunc, x),
            Choice::Quotient(x, y) => {
                let quotient = graph.div(x, y);
                graph.call(Function::Trunc, quotient)
            }
            Choice::EuclideanQuotient(x, y) => graph.call2(Function2::DivEuclid, x, y),
        }
    }

    /// Returns nodes that are zero where this choice changes. They measure the distance from the
    /// change.
    pub(crate) fn gaps(self, graph: &mut Graph) -> Vec<Node> {
        let of_whole_number = |graph: &mut Graph, x: Node| {
            let nearest = graph.call(Function::Round, x);
            vec![graph.sub(x, nearest)]
        };
        match self {
            Choice::Own(node) => match graph.op(node) {
                Op::Call(Function::Signum, x) => vec![x],
                Op::Call(Function::Round, x) => {
                    let below = graph.call(Function::Floor, x);
                    let half = graph.constant(0.5);
                    let above = graph.sub(x, below);
                    vec![graph.sub(above, half)]
                }
                Op::Call(_, x) => of_whole_number(graph, x),
                Op::Call2(_, x, y) => {
                    let quotient = graph.div(x, y);
                    of_whole_number(graph, quotient)
                }
                _ => {
                    let compared = graph.reachable(&[node]).into_iter().filter_map(|node| {
                        match graph.op(node) {
                            Op::Compare(_, a, b) => Some((a, b)),
                            _ => None,
                        }
                    });
                    let compared: Vec<(Node, Node)> = compared.collect();
                    compared.into_iter().map(|(a, b)| graph.sub(a, b)).collect()
                }
            },
            Choice::Truncated(x) => of_whole_number(graph, x),
            Choice::Quotient(x, y) | Choice::EuclideanQuotient(x, y) => {
                let quotient = graph.div(x, y);
                of_whole_number(graph, quotient)
            }
        }
    }

    /// Returns the number of the choice; a condition is 0 or 1.
    fn number(self, results: &Results<f64>) -> f64 {
        let of = |node: Node| {
            let condition = || results.condition(node).map(|holds| f64::from(u8::from(holds)));
            results.number(node).or_else(condition).unwrap_or(f64::NAN)
        };
        match self {
            Choice::Own(node) => of(node),
            Choice::Truncated(x) => of(x).trunc(),
            Choice::Quotient(x, y) => (of(x) / of(y)).trunc(),
            Choice::EuclideanQuotient(x, y) => of(x).div_euclid(of(y)),
        }
    }
}

/// Appends the numbers of all choices that depend on coordinates to a list.
pub(crate) fn choices(formula: &Formula, at: &Numbers<'_>, to: &mut Vec<f64>) {
    let graph = &formula.graph;
    let results = evaluate(graph, &formula.rows, at);
    let moving =
        graph.reachable(&formula.rows).into_iter().filter(|node| graph.depends(*node).on_q);
    to.extend(
        moving.filter_map(|node| Choice::of(graph, node)).map(|choice| choice.number(&results)),
    );
}

/// The sides of all kinks of a formula that move with coordinates, 0 or 1, appended to a list.
pub(crate) fn kinks(formula: &Formula, at: &Numbers<'_>, to: &mut Vec<f64>) {
    let graph = &formula.graph;
    let results = evaluate(graph, &formula.rows, at);
    let of = |node: Node| results.number(node).unwrap_or(f64::NAN);
    let moving =
        graph.reachable(&formula.rows).into_iter().filter(|node| graph.depends(*node).on_q);
    let side = |node: Node| match graph.op(node) {
        Op::Call(Function::Abs, a) => Some(of(a) >= 0.0),
        Op::Call2(Function2::Max | Function2::Min, a, b) => Some(of(a) >= of(b)),
        _ => None,
    };
    to.extend(moving.filter_map(side).map(|side| f64::from(u8::from(side))));
}

/// The arguments of one evaluation of a formula in plain numbers.
pub(crate) struct Numbers<'a> {
    /// The columns of its coordinates.
    pub q: &'a [f64],
    pub t: f64,
    pub parameters: &'a [f64],
    pub outside: Outside<'a>,
}

impl Source<f64> for Numbers<'_> {
    fn input(&self, input: Input) -> f64 {
        let given = match input {
            Input::Column(k) => self.q.get(k).copied(),
            Input::Time => Some(self.t),
            Input::Parameter(k) => self.parameters.get(k).copied(),
            _ => None,
        };
        given.unwrap_or(f64::NAN)
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        jet_of_law(self.outside, law, x, order)[0]
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<f64>) -> f64 {
        let operands: Vec<Dual3_64> = operands.into_iter().map(Dual3_64::from_re).collect();
        Given::by(self.outside, number, &operands).number(component).re
    }

    /// A formula contains calls as values of the user's program.
    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        f64::NAN
    }
}
