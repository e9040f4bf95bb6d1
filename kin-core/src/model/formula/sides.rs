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

/// An operation whose slope changes, or whose value jumps, where it changes its side.
///
/// Runs, Newton's method and events all use this list of such operations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kink {
    /// `if`, by its condition.
    Condition(Node),
    /// `abs` and `signum`, by the sign of this number.
    Sign(Node),
    /// `max` and `min`, by which of these numbers is the larger one.
    Larger(Node, Node),
}

impl Kink {
    /// The words for these operations in the text of a formula.
    pub(crate) const WORDS: [&str; 5] = ["Select", "Abs", "Signum", "Max", "Min"];

    /// Returns the kink of a node of a graph, if the node has one.
    pub(crate) fn of(graph: &Graph, node: Node) -> Option<Kink> {
        match graph.op(node) {
            Op::Select(condition, ..) => Some(Kink::Condition(condition)),
            Op::Call(Function::Abs | Function::Signum, a) => Some(Kink::Sign(a)),
            Op::Call2(Function2::Max | Function2::Min, a, b) => Some(Kink::Larger(a, b)),
            _ => None,
        }
    }

    /// Returns all kinks of a formula with their nodes, in the order of the graph.
    pub(crate) fn all(formula: &Formula) -> Vec<(Node, Kink)> {
        let graph = &formula.graph;
        let nodes = graph.reachable(&formula.rows).into_iter();
        nodes.filter_map(|node| Kink::of(graph, node).map(|kink| (node, kink))).collect()
    }

    /// Returns the side: true if the condition holds, the number is at least 0, or the first number
    /// is at least the second.
    pub(crate) fn side(self, results: &Results<f64>) -> bool {
        let of = |node: Node| results.number(node).unwrap_or(f64::NAN);
        match self {
            Kink::Condition(condition) => results.condition(condition).unwrap_or_default(),
            Kink::Sign(a) => of(a) >= 0.0,
            Kink::Larger(a, b) => of(a) >= of(b),
        }
    }

    /// Returns the distance from the kink, positive on one side and negative on the other; NaN for
    /// a condition of several comparisons.
    pub(crate) fn margin(self, graph: &Graph, results: &Results<f64>) -> f64 {
        let of = |node: Node| results.number(node).unwrap_or(f64::NAN);
        match self {
            Kink::Condition(condition) => match graph.op(condition) {
                Op::Compare(_, a, b) => of(a) - of(b),
                _ => f64::NAN,
            },
            Kink::Sign(a) => of(a),
            Kink::Larger(a, b) => of(a) - of(b),
        }
    }
}

/// Appends the sides of all kinks that depend on coordinates and are no [`Choice`], as 0 or 1.
pub(crate) fn kinks(formula: &Formula, at: &Numbers<'_>, to: &mut Vec<f64>) {
    let graph = &formula.graph;
    let results = evaluate(graph, &formula.rows, at);
    let moving = Kink::all(formula)
        .into_iter()
        .filter(|(node, _)| graph.depends(*node).on_q && Choice::of(graph, *node).is_none());
    to.extend(moving.map(|(_, kink)| f64::from(u8::from(kink.side(&results)))));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The slopes of a function on both sides of a place, if they are numbers.
    fn slopes(f: &dyn Fn(f64) -> f64, x: f64) -> Option<[f64; 2]> {
        const H: f64 = 1e-6;
        let both = [(f(x) - f(x - H)) / H, (f(x + H) - f(x)) / H];
        both.iter().all(|slope| slope.is_finite()).then_some(both)
    }

    fn is_smooth(f: &dyn Fn(f64) -> f64, places: &[f64]) -> bool {
        let is_same = |[left, right]: [f64; 2]| (left - right).abs() <= 1e-3 * (1.0 + left.abs());
        places.iter().filter_map(|x| slopes(f, *x)).all(is_same)
    }

    /// A function that is not smooth, and neither a kink nor a choice, would change its side
    /// unseen.
    #[test]
    fn every_function_that_is_not_smooth_is_a_kink_or_a_choice() {
        let places: Vec<f64> = (-8..=8).map(|k| 0.25 * f64::from(k)).collect();
        let mut graph = Graph::default();
        let [x, y] = [0, 1].map(|k| graph.input(Input::Column(k)));
        for &f in Function::ALL {
            let node = graph.call(f, x);
            let is_listed = Kink::of(&graph, node).is_some();
            assert_eq!(is_listed, Kink::WORDS.contains(&f.name()), "{f:?}");
            let is_seen = is_listed || Choice::of(&graph, node).is_some();
            assert!(is_seen || is_smooth(&f.value(), &places), "{f:?}");
        }
        for &f in Function2::ALL {
            let node = graph.call2(f, x, y);
            let is_listed = Kink::of(&graph, node).is_some();
            assert_eq!(is_listed, Kink::WORDS.contains(&f.name()), "{f:?}");
            let is_seen = is_listed || Choice::of(&graph, node).is_some();
            let away = |y: f64| move |x: f64| f.value()(x, y);
            // On the axis of x some functions begin or have a pole.
            let smooth = [0.75, 1.25, 2.0].iter().all(|y| is_smooth(&away(*y), &places));
            assert!(is_seen || smooth, "{f:?}");
        }
        let condition = graph.compare(kin_graph::Comparison::Less, x, y);
        let node = graph.select(condition, x, y);
        assert_eq!(Kink::of(&graph, node), Some(Kink::Condition(condition)));
        assert!(Kink::WORDS.contains(&"Select"));
    }
}
