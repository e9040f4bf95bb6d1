//! Evaluates a graph with any type of [`Number`].

use crate::number::{Condition, Number};
use crate::{Graph, Input, LeafUse, Node, Op};

/// The values that a graph does not contain: its inputs, and the values that only the user's
/// program can compute.
pub trait Source<N: Number> {
    /// Returns the number of an input.
    fn input(&self, input: Input) -> N;

    /// Returns the derivative of order `order` at x of the law with index `law`.
    fn law(&self, law: usize, x: N, order: u8) -> N;

    /// Returns component `component` of a value that only the user's program can compute from
    /// `operands`.
    fn opaque(&self, number: usize, component: usize, operands: Vec<N>) -> N;

    /// Returns an output of a call of the user's generic function.
    fn leaf(&self, used: LeafUse, operands: Vec<N>) -> N;
}

/// The result of a node.
#[derive(Clone)]
enum Result<N: Number> {
    Number(N),
    Condition(N::Condition),
}

/// The results of the requested nodes, and of the nodes on which they depend.
#[derive(Clone)]
pub struct Results<N: Number>(Vec<Option<Result<N>>>);

impl<N: Number> Default for Results<N> {
    fn default() -> Self {
        Results(Vec::new())
    }
}

impl<N: Number> Results<N> {
    /// Returns the number of a node, or `None` if the node was not needed.
    ///
    /// The number of a condition is 1 or 0.
    pub fn number(&self, node: Node) -> Option<N> {
        Some(match self.0.get(node.index())?.as_ref()? {
            Result::Number(number) => number.clone(),
            Result::Condition(condition) => N::of_condition(condition),
        })
    }

    /// Returns the truth of a node, or `None` if the node was not needed.
    ///
    /// A number is true if it is not 0.
    pub fn condition(&self, node: Node) -> Option<N::Condition> {
        Some(match self.0.get(node.index())?.as_ref()? {
            Result::Number(number) => number.holds(),
            Result::Condition(condition) => condition.clone(),
        })
    }
}

/// Evaluates `outputs`.
///
/// Kin computes each node once, after its operands. The result of a node without a number in the
/// graph is NaN.
pub fn evaluate<N: Number>(graph: &Graph, outputs: &[Node], source: &impl Source<N>) -> Results<N> {
    let mut results = Results((0..graph.len()).map(|_| None).collect());
    for node in graph.reachable(outputs) {
        let result = result(graph, node, &results, source);
        results.0[node.index()] = Some(result);
    }
    results
}

/// Evaluates all nodes, in the memory of an earlier call.
///
/// Use this function for graphs that contain only needed nodes.
pub fn evaluate_all<N: Number>(graph: &Graph, source: &impl Source<N>, results: &mut Results<N>) {
    results.0.clear();
    results.0.reserve(graph.len());
    for node in graph.nodes() {
        let result = result(graph, node, results, source);
        results.0.push(Some(result));
    }
}

/// Evaluates `outputs` when the number of one input differs from `known`.
///
/// Nodes that do not depend on this input keep their results.
pub fn evaluate_along<N: Number>(
    graph: &Graph,
    outputs: &[Node],
    input: Input,
    known: &Results<N>,
    source: &impl Source<N>,
) -> Results<N> {
    evaluate_beyond(
        graph,
        outputs,
        |node| (graph.op(node) == Op::Input(input)).then(|| source.input(input)),
        known,
        source,
    )
}

/// Evaluates `outputs` when some nodes have other numbers than in `known`.
///
/// The argument `given` contains these numbers.
pub fn evaluate_beyond<N: Number>(
    graph: &Graph,
    outputs: &[Node],
    given: impl Fn(Node) -> Option<N>,
    known: &Results<N>,
    source: &impl Source<N>,
) -> Results<N> {
    let mut results = known.clone();
    let mut moves = vec![false; graph.len()];
    for node in graph.reachable(outputs) {
        let given = given(node);
        let mut moving = given.is_some();
        graph.each_operand(node, |operand| moving |= moves[operand.index()]);
        if moving {
            moves[node.index()] = true;
            let result =
                given.map_or_else(|| result(graph, node, &results, source), Result::Number);
            results.0[node.index()] = Some(result);
        }
    }
    results
}

fn result<N: Number>(
    graph: &Graph,
    node: Node,
    known: &Results<N>,
    source: &impl Source<N>,
) -> Result<N> {
    let of = |node: Node| known.number(node).unwrap_or_else(|| N::constant(f64::NAN));
    let holds = |node: Node| known.condition(node).unwrap_or_else(|| N::Condition::known(false));
    let operands = || graph.operands(node).into_iter().map(of).collect();
    Result::Number(match graph.op(node) {
        Op::Compare(comparison, a, b) => {
            return Result::Condition(N::compare(comparison, &of(a), &of(b)));
        }
        Op::And(a, b) => return Result::Condition(holds(a).and(holds(b))),
        Op::Or(a, b) => return Result::Condition(holds(a).or(holds(b))),
        Op::Not(a) => return Result::Condition(holds(a).negated()),
        Op::Truth(holds) => return Result::Condition(N::Condition::known(holds)),
        Op::Input(input) => source.input(input),
        Op::Constant(bits) => N::constant(f64::from_bits(bits)),
        Op::Decimal(k) => graph
            .decimals
            .get(k)
            .map_or(N::constant(f64::NAN), |decimal| N::decimal(decimal.nearest, decimal.above)),
        Op::Add(a, b) => of(a) + of(b),
        Op::Sub(a, b) => of(a) - of(b),
        Op::Mul(a, b) if a == b => of(a).squared(),
        Op::Mul(a, b) => of(a) * of(b),
        Op::Div(a, b) => of(a) / of(b),
        Op::Fma(a, b, c) => of(a).fma(of(b), of(c)),
        Op::Neg(a) => -of(a),
        Op::Call(f, a) => of(a).call(f),
        Op::Call2(f, a, b) => of(a).call2(f, of(b)),
        Op::Powi(a, n) => of(a).powi(n),
        Op::Select(c, a, b) => N::select(&holds(c), of(a), of(b)),
        Op::Law(law, x, order) => source.law(law, of(x), order),
        Op::Opaque(number, component) => source.opaque(number, component, operands()),
        Op::Leaf(used) => source.leaf(used, operands()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Given;
    use crate::{Comparison, Function, Function2};

    #[test]
    fn every_operation_has_the_value_that_it_has_in_rust() {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let t = g.input(Input::Time);
        let all = [
            (Op::Add(x, t), 0.75 + 2.0),
            (Op::Sub(x, t), 0.75 - 2.0),
            (Op::Mul(x, t), 1.5),
            (Op::Mul(t, t), 4.0),
            (Op::Div(x, t), 0.375),
            (Op::Fma(x, t, t), 3.5),
            (Op::Neg(x), -0.75),
            (Op::Call(Function::Sin, x), 0.75_f64.sin()),
            (Op::Call2(Function2::Atan2, x, t), 0.75_f64.atan2(2.0)),
            (Op::Powi(t, -2), 0.25),
        ];
        let nodes: Vec<Node> = all.iter().map(|(op, _)| g.raw(*op)).collect();
        let less = g.raw(Op::Compare(Comparison::Less, x, t));
        let not = g.raw(Op::Not(less));
        let either = g.raw(Op::Or(less, not));
        let both = g.raw(Op::And(less, not));
        let chosen = [g.raw(Op::Select(either, x, t)), g.raw(Op::Select(both, x, t))];
        let outputs: Vec<Node> = nodes.iter().chain(&chosen).copied().collect();
        let given = Given([(Input::Column(0), 0.75), (Input::Time, 2.0)].into());
        let results = evaluate(&g, &outputs, &given);
        for (node, (op, value)) in nodes.iter().zip(all) {
            assert_eq!(results.number(*node), Some(value), "{op:?}");
        }
        assert_eq!(chosen.map(|node| results.number(node)), [Some(0.75), Some(2.0)]);
        assert_eq!((results.condition(less), results.number(not)), (Some(true), Some(0.0)));
    }

    #[test]
    fn kept_memory_holds_nothing_of_the_call_before() {
        let mut results = Results::default();
        for (x, t) in [(3.0, 4.0), (-1.0, 9.0)] {
            let mut g = Graph::default();
            let a = g.input(Input::Column(0));
            let b = g.input(Input::Time);
            let root = g.raw(Op::Call(Function::Sqrt, b));
            let all = [a, b, root, g.raw(Op::Mul(a, root))];
            let source = Given([(Input::Column(0), x), (Input::Time, t)].into());
            evaluate_all(&g, &source, &mut results);
            let fresh = evaluate(&g, &all, &source);
            assert_eq!(all.map(|node| results.number(node)), all.map(|node| fresh.number(node)));
        }
    }

    #[test]
    fn along_one_input_the_others_stay_as_they_are() {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let t = g.input(Input::Time);
        let product = g.raw(Op::Mul(x, t));
        let root = g.raw(Op::Call(Function::Sqrt, t));
        let still = evaluate(
            &g,
            &[product, root],
            &Given([(Input::Column(0), 3.0), (Input::Time, 4.0)].into()),
        );
        let moved = evaluate_along(
            &g,
            &[product, root],
            Input::Column(0),
            &still,
            &Given([(Input::Column(0), 5.0), (Input::Time, 9.0)].into()),
        );
        assert_eq!(
            [product, root, x, t].map(|node| moved.number(node)),
            [Some(20.0), Some(2.0), Some(5.0), Some(4.0)]
        );
    }

    #[test]
    fn beyond_a_node_with_another_number_the_others_follow() {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let t = g.input(Input::Time);
        let root = g.raw(Op::Call(Function::Sqrt, t));
        let product = g.raw(Op::Mul(x, root));
        let source = Given([(Input::Column(0), 3.0), (Input::Time, 4.0)].into());
        let still = evaluate(&g, &[product], &source);
        let moved =
            evaluate_beyond(&g, &[product], |node| (node == root).then_some(7.0), &still, &source);
        assert_eq!(
            [product, root, t].map(|node| moved.number(node)),
            [Some(21.0), Some(7.0), Some(4.0)]
        );
    }

    #[test]
    fn only_the_nodes_that_are_needed_are_looked_at() {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let t = g.input(Input::Time);
        let results = evaluate(&g, &[x], &Given([(Input::Column(0), 1.0)].into()));
        assert_eq!((results.number(x), results.number(t)), (Some(1.0), None));
    }
}
