//! Implements the rule for tangents that are zero.
//!
//! f(u)′ = f′(u) u′ is NaN if f′(u) is infinite and u′ is zero, but u′ can be zero for two reasons.
//! In √(max(1 − a², 0)) with a² > 1 the selected side is a constant, so the derivative is zero. In
//! √(x²) at x = 0 the tangent is zero only at this point: no slope exists, and the derivative
//! remains NaN, so that Kin reports the failure.
//!
//! So a tangent is zero *by structure* if the value does not depend on the variable of
//! differentiation. Such a value consists of parameters and constants alone, or the selected branch
//! of `max`, `min`, `clamp`, `if` and `match` does. Every term with such a tangent as a factor is
//! zero. In all other cases Kin treats zero like any other number. The dual route follows the same
//! rule by a mark in each number (`kin_core::extend::real`), and so does the search for a failed
//! expression.
//!
//! In the graph, the condition under which a value changes is a node. Kin builds this node only for
//! values that select a branch, so that other values need no extra operations.

use super::{Memo, rules};
use crate::{Function2, Graph, Node, Op};

/// The ways in which a value moves.
#[derive(Clone, Copy, Default)]
pub(super) enum Motion {
    #[default]
    Never,
    Always,
    /// Where a condition holds.
    When(Node),
}

/// The way in which each node moves.
#[derive(Default)]
pub(super) struct Moves(Memo<Motion>);

impl Moves {
    pub fn of(&self, node: Node) -> Motion {
        self.0.of(node)
    }

    /// Records if a node with a tangent changes, from the records of its operands.
    pub fn note(&mut self, g: &mut Graph, node: Node, tangent: Node) {
        let motion = match g.op(node) {
            _ if g.is_zero(tangent) => Motion::Never,
            _ if !g.chooses(node) => Motion::Always,
            Op::Select(c, a, b) => self.chosen(g, c, a, b),
            Op::Call2(Function2::Max | Function2::Min, a, b) => {
                let first = rules::takes_first(g, node);
                self.chosen(g, first, a, b)
            }
            _ => g
                .operands(node)
                .into_iter()
                .fold(Motion::Never, |motion, operand| either(g, motion, self.of(operand))),
        };
        self.0.set(node, motion);
    }

    fn chosen(&self, g: &mut Graph, c: Node, a: Node, b: Node) -> Motion {
        let not = g.not(c);
        let a = both(g, c, self.of(a));
        let b = both(g, not, self.of(b));
        either(g, a, b)
    }
}

impl Motion {
    /// Returns the tangent of a node where the node changes; elsewhere the tangent may have any
    /// value.
    pub fn inner(self, g: &Graph, tangent: Node) -> Node {
        match (self, g.op(tangent)) {
            (Motion::When(moves), Op::Select(c, inner, zero)) if c == moves && g.is_zero(zero) => {
                inner
            }
            _ => tangent,
        }
    }

    /// Returns the term where the node changes, otherwise zero.
    pub fn guard(self, g: &mut Graph, term: Node) -> Node {
        let zero = g.zero();
        match self {
            Motion::Never => zero,
            Motion::Always => term,
            Motion::When(moves) => g.select(moves, term, zero),
        }
    }
}

fn both(g: &mut Graph, c: Node, motion: Motion) -> Motion {
    match motion {
        Motion::Never => Motion::Never,
        Motion::Always => when(g, c),
        Motion::When(moves) => {
            let both = g.and(c, moves);
            when(g, both)
        }
    }
}

fn either(g: &mut Graph, a: Motion, b: Motion) -> Motion {
    match (a, b) {
        (Motion::Always, _) | (_, Motion::Always) => Motion::Always,
        (Motion::Never, other) | (other, Motion::Never) => other,
        (Motion::When(a), Motion::When(b)) if a == b => Motion::When(a),
        (Motion::When(a), Motion::When(b)) if is_negation(g, a, b) => Motion::Always,
        (Motion::When(a), Motion::When(b)) => {
            let either = g.or(a, b);
            when(g, either)
        }
    }
}

fn is_negation(g: &Graph, a: Node, b: Node) -> bool {
    g.op(a) == Op::Not(b) || g.op(b) == Op::Not(a)
}

fn when(g: &Graph, c: Node) -> Motion {
    match g.truth(c) {
        Some(true) => Motion::Always,
        Some(false) => Motion::Never,
        None => Motion::When(c),
    }
}
