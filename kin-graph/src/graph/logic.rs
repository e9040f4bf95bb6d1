//! Constructs conditions, and selections by a condition, and folds known conditions.

use super::{Comparison, Graph, Node, Op};
use crate::Function;

impl Graph {
    pub fn bool(&mut self, value: bool) -> Node {
        self.intern(Op::Truth(value))
    }

    pub fn compare(&mut self, comparison: Comparison, a: Node, b: Node) -> Node {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(x), Some(y)) => self.bool(comparison.holds(&x, &y)),
            _ => self.intern(Op::Compare(comparison, a, b)),
        }
    }

    /// Returns the condition that a number is finite.
    pub fn is_finite(&mut self, a: Node) -> Node {
        let size = self.call(Function::Abs, a);
        let largest = self.constant(f64::MAX);
        self.compare(Comparison::LessEqual, size, largest)
    }

    pub fn and(&mut self, a: Node, b: Node) -> Node {
        match (self.truth(a), self.truth(b)) {
            _ if a == b => a,
            (Some(true), _) => b,
            (_, Some(true)) => a,
            (Some(false), _) | (_, Some(false)) => self.bool(false),
            _ => match self.narrowed(a, b) {
                Some(both) => both,
                None => self.intern(Op::And(a, b)),
            },
        }
    }

    /// (p or q) and b, where b says whether p holds.
    fn narrowed(&mut self, a: Node, b: Node) -> Option<Node> {
        let Op::Or(p, q) = self.op(a) else { return None };
        if b == p {
            return Some(p); // (p or q) and p → p
        }
        let rest = match self.op(b) {
            _ if self.is_not(b, p) => None,
            Op::And(not, rest) if self.is_not(not, p) => Some((not, rest)),
            _ => return None,
        };
        // (p or q) and not p and r → not p and q and r
        let q = self.without(q, p);
        let (not, rest) = match rest {
            None => (b, q),
            Some((not, rest)) => (not, self.and(q, rest)),
        };
        Some(self.and(not, rest))
    }

    fn is_not(&self, a: Node, b: Node) -> bool {
        self.op(a) == Op::Not(b) || self.op(b) == Op::Not(a)
    }

    pub fn or(&mut self, a: Node, b: Node) -> Node {
        match (self.truth(a), self.truth(b)) {
            _ if a == b => a,
            (Some(false), _) => b,
            (_, Some(false)) => a,
            (Some(true), _) | (_, Some(true)) => self.bool(true),
            _ => self.intern(Op::Or(a, b)),
        }
    }

    pub fn not(&mut self, a: Node) -> Node {
        match (self.truth(a), self.op(a)) {
            (Some(value), _) => self.bool(!value),
            (_, Op::Not(x)) => x,
            _ => self.intern(Op::Not(a)),
        }
    }

    pub fn select(&mut self, condition: Node, a: Node, b: Node) -> Node {
        match self.truth(condition) {
            Some(true) => a,
            Some(false) => b,
            None if a == b => a,
            None => match (self.op(condition), self.op(a)) {
                // (p or q) ? (p ? x : y) : b → p ? x : (q ? y : b)
                (Op::Or(p, q), Op::Select(first, x, y)) if p == first => {
                    let rest = self.without(q, p);
                    let rest = self.select(rest, y, b);
                    self.select(p, x, rest)
                }
                _ => self.intern(Op::Select(condition, a, b)),
            },
        }
    }

    /// A condition where another one does not hold: of `not p and q` what is left.
    fn without(&self, condition: Node, p: Node) -> Node {
        match self.op(condition) {
            Op::And(not, q) if self.is_not(not, p) => q,
            _ => condition,
        }
    }
}
