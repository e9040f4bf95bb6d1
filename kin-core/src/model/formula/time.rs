//! Finds the nodes of a formula that depend on time alone, their bounds, and how the rows depend on
//! these nodes.

use kin_graph::{Formula, Node, Op, evaluate, evaluate_beyond};

use super::bounds::{Inputs, row};
use crate::model::formula::Outside;
use crate::numbers::enclosure::interval::{Interval, ONE};
use crate::numbers::enclosure::series::{Series, UNKNOWN};

/// Returns the nodes that depend on time alone and are rows, or operands of nodes that depend on
/// coordinates. Time acts only through them.
pub(crate) fn signals(formula: &Formula) -> Vec<Node> {
    let graph = &formula.graph;
    let needed = graph.reachable(&formula.rows);
    let mut read = vec![false; graph.len()];
    formula.rows.iter().for_each(|row| read[row.index()] = true);
    for node in needed.iter().filter(|node| graph.depends(**node).on_q) {
        graph.each_operand(*node, |operand| read[operand.index()] = true);
    }
    let is_of_time = |node: &Node| graph.depends(*node).on_t && !graph.depends(*node).on_q;
    needed.into_iter().filter(|node| read[node.index()] && is_of_time(node)).collect()
}

/// Returns true if a row can jump when coordinates move.
pub(crate) fn can_jump(formula: &Formula) -> bool {
    let jumps = |op: Op| match op {
        Op::Call(f, _) => f.facts().can_jump(),
        Op::Call2(f, ..) => f.facts().jumps,
        op => matches!(op, Op::Select(..) | Op::Opaque(..) | Op::Leaf(_)),
    };
    let graph = &formula.graph;
    graph
        .reachable(&formula.rows)
        .into_iter()
        .any(|node| graph.depends(node).on_q && jumps(graph.op(node)))
}

/// Returns the signals as functions of time. A condition that may change is unknown.
pub(crate) fn over_time(
    formula: &Formula,
    signals: &[Node],
    t: Series,
    parameters: &[f64],
    outside: Outside<'_>,
) -> Vec<Series> {
    let graph = &formula.graph;
    let results = evaluate(graph, signals, &Inputs { columns: &[], t, parameters, outside });
    let known = |node: &Node| {
        let y = results.number(*node)?;
        let is_condition =
            matches!(graph.op(*node), Op::Compare(..) | Op::And(..) | Op::Or(..) | Op::Not(_));
        (!y.is_open() && (!is_condition || y.value().is_thin())).then_some(y)
    };
    signals.iter().map(|node| known(node).unwrap_or(UNKNOWN)).collect()
}

/// Returns the slopes of all rows by each signal, at given coordinates and time; unknown slopes are
/// NaN.
pub(crate) fn slopes(
    formula: &Formula,
    signals: &[Node],
    (columns, t): (&[f64], f64),
    parameters: &[f64],
    outside: Outside<'_>,
) -> Vec<Vec<f64>> {
    let still = |x: f64| Series::constant(Interval::from(x));
    let columns: Vec<Series> = columns.iter().map(|x| still(*x)).collect();
    let inputs = Inputs { columns: &columns, t: still(t), parameters, outside };
    let known = evaluate(&formula.graph, &formula.rows, &inputs);
    let along = |signal: &Node| {
        let value = known.number(*signal).unwrap_or(UNKNOWN).value();
        let moving = |node: Node| (node == *signal).then(|| Series::variable(value, ONE, 2));
        let moved = evaluate_beyond(&formula.graph, &formula.rows, moving, &known, &inputs);
        let slope = |k: usize| {
            Some(row(formula, k, &moved).at(1))
                .filter(|slope| slope.is_finite())
                .map_or(f64::NAN, Interval::mid)
        };
        (0..formula.rows.len()).map(slope).collect()
    };
    signals.iter().map(along).collect()
}
