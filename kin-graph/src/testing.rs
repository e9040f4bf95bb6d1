//! Values of nodes by plain interpretation, for the tests of the passes.

use std::collections::HashMap;

use crate::{Graph, Input, Node, Op};

/// Value of a node by plain interpretation.
pub fn value(g: &Graph, node: Node, inputs: &HashMap<Input, f64>) -> f64 {
    let v = |n: Node| value(g, n, inputs);
    match g.op(node) {
        Op::Input(input) => inputs[&input],
        Op::Constant(bits) => f64::from_bits(bits),
        Op::Decimal(k) => g.decimals[k].nearest,
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
    use crate::Comparison::*;
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

/// Reproducible random numbers (SplitMix64).
pub struct SplitMix(pub u64);

impl SplitMix {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}
