//! `if`, `match` and `for`: both sides of an open condition are read, and what they change is joined by a selection.

use syn::{Expr, ExprForLoop, ExprIf, ExprMatch};

use super::scope::Scopes;
use super::statement::unit;
use super::value::Value;
use super::{MOST_NODES, Read, Reader, Unreadable};
use crate::graph::Node;

impl Reader {
    pub fn if_expression(&mut self, branch: &ExprIf) -> Read {
        if matches!(*branch.cond, Expr::Let(_)) {
            return Err(Unreadable::new(&branch.cond, "`if let`"));
        }
        let value = self.expression(&branch.cond)?;
        let condition = self.condition(value, &branch.cond);
        let otherwise = branch.else_branch.as_ref().map(|(_, otherwise)| &**otherwise);
        let no = |reader: &mut Self| match otherwise {
            Some(otherwise) => reader.expression(otherwise),
            None => Ok(unit()),
        };
        self.choose(condition, |reader| reader.block(&branch.then_branch), no, branch)
    }

    pub fn match_expression(&mut self, branch: &ExprMatch) -> Read {
        let value = self.expression(&branch.expr)?;
        let value = match value {
            Value::Opaque(_) | Value::Integer(_) | Value::Condition(_) | Value::Scalar(_) | Value::Tuple(_) | Value::Poison => value,
            other => return Err(Unreadable::new(&branch.expr, format!("a `match` on {}", other.name()))),
        };
        self.arms(branch, &value, 0)
    }

    /// The value of the arms from number `k` on; the last one is taken without a test, since a `match` is exhaustive.
    fn arms(&mut self, branch: &ExprMatch, value: &Value, k: usize) -> Read {
        let Some(arm) = branch.arms.get(k) else { return Err(Unreadable::new(branch, "a `match` without arms")) };
        self.scopes.push();
        let condition = self.arm_condition(arm, value);
        let result = condition.and_then(|condition| {
            let last = k + 1 == branch.arms.len() || self.graph.truth(condition) == Some(true);
            if last {
                return self.expression(&arm.body);
            }
            self.choose(condition, |reader| reader.expression(&arm.body), |reader| reader.arms(branch, value, k + 1), branch)
        });
        self.scopes.pop();
        result
    }

    fn arm_condition(&mut self, arm: &syn::Arm, value: &Value) -> Read<Node> {
        let matched = self.test(&arm.pat, value)?;
        let Some((_, guard)) = &arm.guard else { return Ok(matched) };
        let value = self.expression(guard)?;
        let guard = self.condition(value, guard);
        Ok(self.graph.and(matched, guard))
    }

    /// Reads both branches, unless the condition is known, and joins their values and what they did to variables.
    fn choose(
        &mut self,
        condition: Node,
        yes: impl FnOnce(&mut Self) -> Read,
        no: impl FnOnce(&mut Self) -> Read,
        at: &dyn quote::ToTokens,
    ) -> Read {
        match self.graph.truth(condition) {
            Some(true) => return yes(self),
            Some(false) => return no(self),
            None => {}
        }
        let before: Scopes = self.scopes.clone();
        let a = yes(self)?;
        let after_yes = std::mem::replace(&mut self.scopes, before);
        let b = no(self)?;
        let after_no = std::mem::replace(&mut self.scopes, after_yes);
        let mut scopes = std::mem::take(&mut self.scopes);
        let merged = scopes.merge(&after_no, |a, b| self.select(condition, a, b));
        self.scopes = scopes;
        if let Err(name) = merged {
            return Err(Unreadable::new(at, format!("`{name}`, which is of one kind in one branch and of another in the other,")));
        }
        match self.select(condition, &a, &b) {
            Some(value) => Ok(value),
            None if open(&a) || open(&b) => Err(Unreadable::new(at, "branches of kinds that cannot be joined here")),
            None => Ok(self.mistake(at, format!("the branches differ: {} and {}", a.name(), b.name()))),
        }
    }

    /// `a` where the condition holds, else `b`; `None` if they are of different kinds.
    fn select(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        let each = |reader: &mut Self, a: &[Node], b: &[Node]| -> Vec<Node> {
            a.iter().zip(b).map(|(&a, &b)| reader.graph.select(condition, a, b)).collect()
        };
        Some(match (a, b) {
            (Value::Poison, other) | (other, Value::Poison) => other.clone(),
            (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.graph.select(condition, *a, *b)),
            (Value::Condition(a), Value::Condition(b)) => {
                let (yes, not) = (self.graph.and(condition, *a), self.graph.not(condition));
                let no = self.graph.and(not, *b);
                Value::Condition(self.graph.or(yes, no))
            }
            (Value::Integer(a), Value::Integer(b)) if a == b => Value::Integer(*a),
            (Value::Vector(a), Value::Vector(b)) if a.len() == b.len() => Value::Vector(each(self, a, b)),
            (Value::Matrix(n, a), Value::Matrix(m, b)) if n == m => Value::Matrix(*n, each(self, a, b)),
            (Value::Euler(a), Value::Euler(b)) => Value::Euler(each(self, a, b)),
            (Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => Value::Tuple(self.select_all(condition, a, b)?),
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => Value::Array(self.select_all(condition, a, b)?),
            (Value::Planar(a), Value::Planar(b)) if a == b => Value::Planar(*a),
            (Value::Spatial(a), Value::Spatial(b)) if a == b => Value::Spatial(*a),
            (Value::Unassigned, Value::Unassigned) => Value::Unassigned,
            (Value::Closure(a), Value::Closure(b)) if std::rc::Rc::ptr_eq(a, b) => Value::Closure(a.clone()),
            (Value::Law(a), Value::Law(b)) if super::coerce::key(a) == super::coerce::key(b) => Value::Law(a.clone()),
            (Value::Opaque(a), Value::Opaque(b)) if super::coerce::key(a) == super::coerce::key(b) => Value::Opaque(a.clone()),
            (opaque @ (Value::Opaque(_) | Value::Combined(_)), known) | (known, opaque @ (Value::Opaque(_) | Value::Combined(_))) => {
                let (_, shape) = known.numbers().or_else(|| Some((vec![], crate::parse::Shape::Scalar)))?;
                let taken = self.shaped(opaque.clone(), &shape, &proc_macro2::TokenStream::new());
                let other = self.shaped(known.clone(), &shape, &proc_macro2::TokenStream::new());
                let (a, b) = if matches!(a, Value::Opaque(_) | Value::Combined(_)) { (taken, other) } else { (other, taken) };
                self.select(condition, &a, &b)?
            }
            _ => return None,
        })
    }

    fn select_all(&mut self, condition: Node, a: &[Value], b: &[Value]) -> Option<Vec<Value>> {
        a.iter().zip(b).map(|(a, b)| self.select(condition, a, b)).collect()
    }

    pub fn for_loop(&mut self, each: &ExprForLoop) -> Read {
        let over = self.expression(&each.expr)?;
        let Some(items) = self.items(over, &each.expr)? else { return Ok(unit()) };
        for item in items {
            self.scopes.push();
            let turn = self.bind(&each.pat, item).and_then(|_| self.block(&each.body));
            self.scopes.pop();
            turn?;
            if self.graph.len() > MOST_NODES {
                return Err(Unreadable::new(&each.for_token, "a loop this long"));
            }
        }
        Ok(unit())
    }

    /// The values that `for` and iterators go over; `None` after a mistake.
    pub fn items(&mut self, value: Value, at: &Expr) -> Read<Option<Vec<Value>>> {
        match value {
            Value::Array(all) | Value::Iterator(all) => Ok(Some(all)),
            Value::Vector(all) => Ok(Some(all.into_iter().map(Value::Scalar).collect())),
            Value::Poison => Ok(None),
            Value::Opaque(_) => Err(Unreadable::new(at, "a loop over something whose length is not known here")),
            other => {
                self.mistake(at, format!("this goes over a range or an array, but the value is {}", other.name()));
                Ok(None)
            }
        }
    }
}

/// Kinds whose mismatch may still be good Rust.
fn open(value: &Value) -> bool {
    matches!(value, Value::Opaque(_) | Value::Integer(_) | Value::Closure(_) | Value::Iterator(_) | Value::Law(_) | Value::Planar(_) | Value::Spatial(_))
}
