//! Writes the rules of the list of functions as nodes of a graph.

use std::cell::RefCell;

use super::term::{Term, nodes_of};
use crate::{Comparison, Function, Function2, Graph, Node, Op, rules};

/// Returns dy/du of y = f(u).
pub fn derivative(g: &mut Graph, f: Function, u: Node, y: Node) -> Node {
    let graph = RefCell::new(g);
    let [u, y] = [u, y].map(|node| Term::Node(&graph, node));
    let slope = rules::slope(f, u, y);
    nodes_of(&graph, [slope])[0]
}

/// Returns (∂z/∂u, ∂z/∂v) of z = f(u, v).
///
/// The function does not accept `max` and `min`, whose tangent is the tangent of the selected
/// operand ([`takes_first`]).
pub fn derivatives2(g: &mut Graph, f: Function2, u: Node, v: Node, z: Node) -> (Node, Node) {
    // An exponent that depends on nothing has no derivative, so its logarithm must not spoil u ≤ 0.
    let is_still = f == Function2::Powf && !g.depends(v).varies();
    let graph = RefCell::new(g);
    let (by_u, by_v) = {
        let [u, v, z] = [u, v, z].map(|node| Term::Node(&graph, node));
        rules::slopes(f, u, v, z)
    };
    let by_v = if is_still { Term::Constant(0.0) } else { by_v };
    let [by_u, by_v] = nodes_of(&graph, [by_u, by_v]);
    (by_u, by_v)
}

/// Returns the condition under which `max` or `min` selects the first operand.
///
/// The first operand is selected if it equals or beats the second, or if the second is NaN.
pub fn takes_first(g: &mut Graph, z: Node) -> Node {
    let (comparison, u, v) = match g.op(z) {
        Op::Call2(Function2::Min, u, v) => (Comparison::LessEqual, u, v),
        Op::Call2(_, u, v) => (Comparison::GreaterEqual, u, v),
        _ => return g.bool(true),
    };
    let wins = g.compare(comparison, u, v);
    let alone = g.compare(Comparison::NotEqual, v, v);
    g.or(wins, alone)
}

/// Returns n uⁿ⁻¹, the derivative of uⁿ.
pub fn power_derivative(g: &mut Graph, u: Node, n: i32) -> Node {
    let factor = g.constant(f64::from(n));
    let power = g.powi(u, n.saturating_sub(1));
    g.mul(factor, power)
}
