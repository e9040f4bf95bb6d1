//! Computes products of a factor and a tangent whose intermediate results may overflow although the
//! product is finite.
//!
//! In 1/(1 + eᵘ) the divisor and its tangents overflow although the quotient is finite, and 0 · ∞
//! is NaN. If a value grows like an exponential or a power (`Graph::bursts`), Kin first multiplies
//! by the outer factor: (c eᵘ) u′ for c (eᵘ)′. If the value itself has overflowed, the derivative
//! of a function that is finite at infinity is zero. Kin multiplies all other products directly,
//! without extra operations.

use crate::{Comparison, Function, Function2, Graph, Node, Op};

use super::rules;

/// Where tangents of first order are known.
pub(super) trait Tangents {
    /// The tangent of a node that has been looked at.
    fn tangent(&self, node: Node) -> Node;
}

/// Products and functions inside of one another that are gone into; beyond them tangents are taken
/// as they are.
const DEEPEST: usize = 6;
/// The same of sums.
const LONGEST: usize = 256;

/// How much further a product is taken apart.
#[derive(Clone, Copy)]
pub(super) struct Depth {
    products: usize,
    sums: usize,
}

impl Depth {
    pub const FULL: Depth = Depth { products: DEEPEST, sums: LONGEST };

    /// Returns the depth below one more product or function.
    pub fn product(self) -> Option<Depth> {
        Some(Depth { products: self.products.checked_sub(1)?, ..self })
    }

    /// Returns the depth below one more sum.
    pub fn sum(self) -> Option<Depth> {
        Some(Depth { sums: self.sums.checked_sub(1)?, ..self })
    }
}

/// c u′
pub(super) fn scaled(g: &mut Graph, by: &impl Tangents, c: Node, u: Node) -> Node {
    inside(g, by, c, u, Depth::FULL)
}

fn inside(g: &mut Graph, by: &impl Tangents, c: Node, u: Node, depth: Depth) -> Node {
    let tangent = by.tangent(u);
    if g.is_zero(tangent) {
        return tangent;
    }
    let parts = if g.bursts(u) { parts(g, by, c, u, depth) } else { None };
    parts.unwrap_or_else(|| g.mul(c, tangent))
}

/// The same taken apart; `None` where that is of no use, or goes too deep.
fn parts(g: &mut Graph, by: &impl Tangents, c: Node, u: Node, depth: Depth) -> Option<Node> {
    Some(match g.op(u) {
        Op::Neg(a) => {
            let inner = inside(g, by, c, a, depth.sum()?);
            g.neg(inner)
        }
        Op::Add(a, b) | Op::Sub(a, b) => {
            let depth = depth.sum()?;
            let left = inside(g, by, c, a, depth);
            let right = inside(g, by, c, b, depth);
            if matches!(g.op(u), Op::Add(..)) { g.add(left, right) } else { g.sub(left, right) }
        }
        Op::Mul(a, b) => {
            let depth = depth.product()?;
            let cb = g.mul(c, b);
            let ca = g.mul(c, a);
            let left = inside(g, by, cb, a, depth);
            let right = inside(g, by, ca, b, depth);
            g.add(left, right)
        }
        Op::Div(a, b) => {
            let depth = depth.product()?;
            let over = g.div(c, b);
            let left = inside(g, by, over, a, depth);
            let again = g.mul(over, u);
            let right = inside(g, by, again, b, depth);
            g.sub(left, right)
        }
        Op::Call(f, a) => {
            let slope = rules::derivative(g, f, a, u);
            let factor = g.mul(c, slope);
            inside(g, by, factor, a, depth.product()?)
        }
        Op::Select(condition, a, b) => {
            let depth = depth.sum()?;
            let left = inside(g, by, c, a, depth);
            let right = inside(g, by, c, b, depth);
            g.select(condition, left, right)
        }
        Op::Call2(Function2::Max | Function2::Min, a, b) => {
            let first = rules::takes_first(g, u);
            let depth = depth.sum()?;
            let left = inside(g, by, c, a, depth);
            let right = inside(g, by, c, b, depth);
            g.select(first, left, right)
        }
        _ => return None,
    })
}

/// The term where u is finite: a function that is finite where u has overflowed is flat there. Not
/// so at a pole, where it may jump.
pub(super) fn where_finite(g: &mut Graph, u: Node, term: Node) -> Node {
    if !g.overflows(u) || g.is_zero(term) {
        return term;
    }
    let finite = g.is_finite(u);
    let zero = g.zero();
    g.select(finite, term, zero)
}

/// The exponent of a power whose slope by its base is taken beside its value: a number, the base
/// being one that bursts.
pub(super) fn relative_exponent(g: &Graph, base: Node, exponent: Node) -> Option<f64> {
    g.constant_value(exponent).filter(|_| g.bursts(base))
}

/// Takes `relative` where a base is larger than 1, since nothing can vanish there, and `plain`
/// elsewhere; a falling power has no zero of the base to fear, and takes `relative` everywhere.
pub(super) fn where_large(
    g: &mut Graph,
    base: Node,
    exponent: f64,
    relative: Node,
    plain: Node,
) -> Node {
    if exponent < 0.0 {
        return relative;
    }
    let size = g.call(Function::Abs, base);
    let one = g.constant(1.0);
    let large = g.compare(Comparison::Greater, size, one);
    g.select(large, relative, plain)
}
