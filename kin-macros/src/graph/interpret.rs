//! Values of nodes by plain interpretation, for the tests of the passes.

use std::collections::HashMap;

use super::{Graph, Input, Node, Op};

/// Value of a node by plain interpretation.
pub fn value(g: &Graph, node: Node, inputs: &HashMap<Input, f64>) -> f64 {
    let v = |n: Node| value(g, n, inputs);
    match g.op(node) {
        Op::Input(input) => inputs[&input],
        Op::Constant(bits) => f64::from_bits(bits),
        Op::Add(a, b) => v(a) + v(b),
        Op::Sub(a, b) => v(a) - v(b),
        Op::Mul(a, b) => v(a) * v(b),
        Op::Div(a, b) => v(a) / v(b),
        Op::Fma(a, b, c) => v(a).mul_add(v(b), v(c)),
        Op::Neg(a) => -v(a),
        Op::Call(f, a) => f.value()(v(a)),
        Op::Call2(f, a, b) => f.value()(v(a), v(b)),
        Op::Powi(a, n) => v(a).powi(n),
        Op::Select(c, a, b) => v(if truth(g, c, inputs) { a } else { b }),
        other => panic!("no value for {other:?}"),
    }
}

fn truth(g: &Graph, node: Node, inputs: &HashMap<Input, f64>) -> bool {
    use super::Comparison::*;
    let v = |n: Node| value(g, n, inputs);
    match g.op(node) {
        Op::Truth(value) => value,
        Op::Compare(Less, a, b) => v(a) < v(b),
        Op::Compare(LessEqual, a, b) => v(a) <= v(b),
        Op::Compare(Greater, a, b) => v(a) > v(b),
        Op::Compare(GreaterEqual, a, b) => v(a) >= v(b),
        Op::Compare(Equal, a, b) => v(a) == v(b),
        Op::Compare(NotEqual, a, b) => v(a) != v(b),
        Op::And(a, b) => truth(g, a, inputs) && truth(g, b, inputs),
        Op::Or(a, b) => truth(g, a, inputs) || truth(g, b, inputs),
        Op::Not(a) => !truth(g, a, inputs),
        other => panic!("no truth for {other:?}"),
    }
}
