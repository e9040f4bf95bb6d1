//! Finds the nodes at which rounding decides: the argument of √ at 0, a comparison of equal
//! numbers.
//!
//! At such a node a b − c d must be 0 if both products are equal, which the fused form does not
//! guarantee.

use crate::{Function, Function2, Graph, Node, Op};

/// Returns, for each node, true if the node must keep its form.
pub fn exact(g: &Graph, nodes: &[Node]) -> Vec<bool> {
    let mut exact = vec![false; g.len()];
    let mut pinned = vec![false; g.len()];
    for &node in nodes.iter().rev() {
        let is_exact = exact[node.index()];
        let mut mark = |operand: Node| exact[operand.index()] = true;
        match g.op(node) {
            Op::Call(f, a) if !is_smooth(f) => mark(a),
            Op::Call2(Function2::Hypot, ..) => {}
            Op::Call2(_, a, b) | Op::Compare(_, a, b) => [a, b].into_iter().for_each(mark),
            Op::Div(_, b) | Op::Powi(b, _) => mark(b),
            Op::Add(a, b) | Op::Sub(a, b) if is_exact => [a, b].into_iter().for_each(mark),
            Op::Mul(a, b) if is_exact && a != b => [a, b].into_iter().for_each(mark),
            Op::Neg(a) if is_exact => mark(a),
            _ => {}
        }
        // The operands of a value of the user's own are written as they were read: the same number
        // wherever they are used.
        if pinned[node.index()] || matches!(g.op(node), Op::Opaque(..)) {
            g.each_operand(node, |operand| pinned[operand.index()] = true);
        }
    }
    exact.into_iter().zip(pinned).map(|(exact, pinned)| exact || pinned).collect()
}

/// Functions that take any argument and have no kink.
fn is_smooth(f: Function) -> bool {
    use Function::{Asinh, Atan, Cbrt, Cos, Cosh, Exp, Exp2, ExpM1, Sin, Sinh, Tanh};
    matches!(f, Sin | Cos | Sinh | Cosh | Tanh | Asinh | Atan | Exp | Exp2 | ExpM1 | Cbrt)
}
