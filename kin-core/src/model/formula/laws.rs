//! Differentiates the rows of a formula by the values of its laws of time.

mod lengths;

use kin_graph::{Formula, Input, Node, Op, evaluate, evaluate_beyond};

use super::jerk::Along;
use crate::numbers::real::{Dual3_64, Real};

pub(crate) use lengths::lengths;

/// Returns the index and the node of each law of time in a formula, in the order of the indices.
/// Returns `None` if the formula evaluates a law at several times, or evaluates a derivative of it:
/// then no row depends on a single value.
pub(crate) fn of_time(formula: &Formula) -> Option<Vec<(usize, Node)>> {
    let mut laws: Vec<(usize, Node)> = Vec::new();
    for node in formula.graph.reachable(&formula.rows) {
        let Op::Law(law, _, order) = formula.graph.op(node) else { continue };
        let on = formula.graph.depends(node);
        if on.on_q || !on.on_t {
            continue;
        }
        if order > 0 || laws.iter().any(|(known, _)| *known == law) {
            return None;
        }
        laws.push((law, node));
    }
    laws.sort_by_key(|(law, _)| *law);
    Some(laws)
}

/// Returns the indices of the laws whose argument is time itself, in increasing order. Returns
/// `None` if the formula reads time in another way too: outside of these laws, or by their slopes.
pub(crate) fn alone(formula: &Formula) -> Option<Vec<usize>> {
    let graph = &formula.graph;
    let is_time = |node: Node| graph.op(node) == Op::Input(Input::Time);
    let mut laws = Vec::new();
    let mut seen = vec![false; graph.len()];
    let mut open = formula.rows.clone();
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            continue;
        }
        match graph.op(node) {
            Op::Input(Input::Time) => return None,
            Op::Law(law, x, order) if is_time(x) => {
                if order > 0 {
                    return None;
                }
                laws.push(law);
            }
            _ => graph.each_operand(node, |operand| open.push(operand)),
        }
    }
    laws.sort_unstable();
    laws.dedup();
    Some(laws)
}

/// Returns true if row k is x(q) − f(t) with law k, as written.
pub(crate) fn are_rows(formula: &Formula, laws: &[(usize, Node)]) -> bool {
    let graph = &formula.graph;
    let is_own = |(row, (_, law)): (&Node, &(usize, Node))| match graph.op(*row) {
        Op::Sub(x, f) => f == *law && !graph.depends(x).on_t,
        _ => false,
    };
    laws.len() == formula.rows.len() && formula.rows.iter().zip(laws).all(is_own)
}

/// Returns ∂C/∂f of each of these laws, row by row, at constant coordinates and time.
pub(crate) fn slopes(
    formula: &Formula,
    laws: &[(usize, Node)],
    still: &Along<'_>,
) -> Vec<Vec<f64>> {
    let known = evaluate(&formula.graph, &formula.rows, still);
    let along = |(_, law): &(usize, Node)| {
        let value = known.number(*law).map_or(f64::NAN, |value: Real<Dual3_64>| value.0.re);
        let moving = |node: Node| (node == *law).then(|| Real(Dual3_64::new(value, 1.0, 0.0, 0.0)));
        let moved = evaluate_beyond(&formula.graph, &formula.rows, moving, &known, still);
        formula
            .rows
            .iter()
            .map(|row| moved.number(*row).map_or(f64::NAN, |slope| slope.0.v1))
            .collect()
    };
    laws.iter().map(along).collect()
}
