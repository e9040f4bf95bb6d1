//! Conditions, and the choice by one; folded where they are known.

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

    /// The condition that a number is finite.
    pub fn is_finite(&mut self, a: Node) -> Node {
        let (size, largest) = (self.call(Function::Abs, a), self.constant(f64::MAX));
        self.compare(Comparison::LessEqual, size, largest)
    }

    pub fn and(&mut self, a: Node, b: Node) -> Node {
        match (self.truth(a), self.truth(b)) {
            _ if a == b => a,
            (Some(true), _) => b,
            (_, Some(true)) => a,
            (Some(false), _) | (_, Some(false)) => self.bool(false),
            _ => self.intern(Op::And(a, b)),
        }
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
            None => self.intern(Op::Select(condition, a, b)),
        }
    }
}
