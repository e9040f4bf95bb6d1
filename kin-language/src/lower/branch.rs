//! `if`, `match` and `for`: both sides of an open condition are read, and what they change is joined by a selection.

use quote::ToTokens;
use syn::{Expr, ExprForLoop, ExprIf, ExprMatch, Pat};

use super::scope::Scopes;
use super::template::Template;
use super::value::Value;
use super::{MOST_NODES, Read, Reader, Unreadable};
use kin_graph::Node;

impl Reader {
    pub fn if_expression(&mut self, branch: &ExprIf) -> Read {
        if matches!(*branch.cond, Expr::Let(_)) {
            return Err(Unreadable::new(&branch.cond, "`if let`"));
        }
        let value = self.expression(&branch.cond)?;
        let condition = self.condition(value, &branch.cond);
        let no = |reader: &mut Self| match &branch.else_branch {
            Some((_, otherwise)) => reader.expression(otherwise),
            None => Ok(Value::unit()),
        };
        self.choose(condition, |reader| reader.block(&branch.then_branch), no, branch)
    }

    pub fn match_expression(&mut self, branch: &ExprMatch) -> Read {
        let value = self.matchable(&branch.expr)?;
        self.scopes.push();
        let result = self.arms(branch, &value, 0);
        self.scopes.pop();
        result
    }

    /// The value that a `match` looks at.
    pub fn matchable(&mut self, expression: &Expr) -> Read {
        match self.expression(expression)? {
            other @ (Value::Function(_) | Value::Law(_) | Value::Axis(_) | Value::Planar(_) | Value::Spatial(_) | Value::Unassigned) => {
                Err(Unreadable::new(expression, format!("a `match` on {}", other.name())))
            }
            value => Ok(value),
        }
    }

    /// The value of the arms from number `k` on, whose variables go into the innermost scope. The last one is taken without a test, since a
    /// `match` is exhaustive.
    fn arms(&mut self, branch: &ExprMatch, value: &Value, k: usize) -> Read {
        self.scopes.clear_innermost();
        let Some(arm) = branch.arms.get(k) else { return Err(Unreadable::new(branch, "a `match` without arms")) };
        let condition = self.tested(&arm.pat, arm.guard.as_ref().map(|(_, guard)| &**guard), value)?;
        if k + 1 == branch.arms.len() {
            return self.expression(&arm.body);
        }
        self.choose(condition, |reader| reader.expression(&arm.body), |reader| reader.arms(branch, value, k + 1), branch)
    }

    /// The condition under which a value matches a pattern and its guard.
    pub fn tested(&mut self, pattern: &Pat, guard: Option<&Expr>, value: &Value) -> Read<Node> {
        let matched = self.test(pattern, value)?;
        let Some(guard) = guard else { return Ok(matched) };
        self.path.push(matched);
        let value = self.expression(guard);
        self.path.pop();
        let guard = self.condition(value?, guard);
        Ok(self.graph.and(matched, guard))
    }

    /// Reads both branches, unless the condition is known, and joins their values and what they did to variables.
    fn choose(
        &mut self,
        condition: Node,
        yes: impl FnOnce(&mut Self) -> Read,
        no: impl FnOnce(&mut Self) -> Read,
        at: &dyn ToTokens,
    ) -> Read {
        let (a, b) = match self.both(condition, yes, no)? {
            Outcome::Known(value) => return Ok(value),
            Outcome::Open { a, b, after_no } => {
                self.with_variables_of_both(condition, &after_no, at)?;
                (a, b)
            }
        };
        self.joined(condition, &a, &b, at)
    }

    /// The value of `yes` where the condition holds, with what it did to variables only there; `no` if it is known not to hold.
    pub fn choose_beside(&mut self, condition: Node, yes: impl FnOnce(&mut Self) -> Read, no: Value, at: &dyn ToTokens) -> Read {
        match self.both(condition, yes, |_| Ok(no))? {
            Outcome::Known(value) => Ok(value),
            Outcome::Open { a, after_no, .. } => self.with_variables_of_both(condition, &after_no, at).map(|()| a),
        }
    }

    /// Joins what two branches did to variables; those of the first one are in hand.
    fn with_variables_of_both(&mut self, condition: Node, after_no: &Scopes, at: &dyn ToTokens) -> Read<()> {
        let mut scopes = std::mem::take(&mut self.scopes);
        let merged = scopes.merge(after_no, |a, b| self.select(condition, a, b));
        self.scopes = scopes;
        merged.map_err(|name| Unreadable::new(at, format!("`{name}`, which is of one kind in one branch and of another in the other,")))
    }

    /// As `choose`, where nothing follows that could see what the branches did to variables.
    pub fn choose_value(
        &mut self,
        condition: Node,
        yes: impl FnOnce(&mut Self) -> Read,
        no: impl FnOnce(&mut Self) -> Read,
        at: &dyn ToTokens,
    ) -> Read {
        match self.both(condition, yes, no)? {
            Outcome::Known(value) => Ok(value),
            Outcome::Open { a, b, .. } => self.joined(condition, &a, &b, at),
        }
    }

    /// The outcomes of both branches, each begun with the variables as they are; afterwards they are those of the first branch.
    fn both(&mut self, condition: Node, yes: impl FnOnce(&mut Self) -> Read, no: impl FnOnce(&mut Self) -> Read) -> Read<Outcome> {
        match self.graph.truth(condition) {
            Some(true) => return yes(self).map(Outcome::Known),
            Some(false) => return no(self).map(Outcome::Known),
            None => {}
        }
        let before: Scopes = self.scopes.clone();
        let depth = self.path.len();
        self.path.push(condition);
        let a = yes(self)?;
        let after_yes = std::mem::replace(&mut self.scopes, before);
        let otherwise = self.graph.not(condition);
        self.path.truncate(depth);
        self.path.push(otherwise);
        let b = no(self)?;
        self.path.truncate(depth);
        let after_no = std::mem::replace(&mut self.scopes, after_yes);
        Ok(Outcome::Open { a, b, after_no })
    }

    fn joined(&mut self, condition: Node, a: &Value, b: &Value, at: &dyn ToTokens) -> Read {
        match self.select(condition, a, b) {
            Some(value) => Ok(value),
            None if open(a) || open(b) => Err(Unreadable::new(at, "branches of kinds that cannot be joined here")),
            None => {
                let nothing = |value: &Value| matches!(value, Value::Tuple(all) if all.is_empty());
                let cure = if nothing(a) || nothing(b) { "; give the other one a value too, as in `else { 0.0 }`" } else { "" };
                Ok(self.mistake(at, format!("the branches differ: {} and {}{cure}", a.name(), b.name())))
            }
        }
    }

    /// `a` where the condition holds, else `b`; `None` if they are of different kinds.
    pub fn select(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        Some(match (a, b) {
            (Value::Poison, other) | (other, Value::Poison) => other.clone(),
            (Value::Never, Value::Never) => Value::Never,
            (Value::Never, known) | (known, Value::Never) => {
                let Some((_, shape)) = known.numbers() else { return Some(known.clone()) };
                let nowhere = self.nowhere(&shape);
                let (a, b) = if matches!(a, Value::Never) { (&nowhere, known) } else { (known, &nowhere) };
                self.select(condition, a, b)?
            }
            (Value::Reference(a), b) => self.select(condition, a, b)?,
            (a, Value::Reference(b)) => self.select(condition, a, b)?,
            (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.graph.select(condition, *a, *b)),
            (Value::Condition(a), Value::Condition(b)) => {
                let (yes, not) = (self.graph.and(condition, *a), self.graph.not(condition));
                let no = self.graph.and(not, *b);
                Value::Condition(self.graph.or(yes, no))
            }
            (Value::Integer(a, x), Value::Integer(b, y)) if a == b => Value::Integer(*a, x.or(*y)),
            (Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => Value::Tuple(self.select_all(condition, a, b)?),
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => Value::Array(self.select_all(condition, a, b)?),
            (Value::Iterator(a), Value::Iterator(b)) if a.len() == b.len() => Value::Iterator(self.select_all(condition, a, b)?),
            (Value::Planar(a), Value::Planar(b)) if a == b => Value::Planar(*a),
            (Value::Spatial(a), Value::Spatial(b)) if a == b => Value::Spatial(*a),
            (Value::Unassigned, Value::Unassigned) => Value::Unassigned,
            (Value::Into(a), Value::Into(b)) => Value::Into(Box::new(self.select(condition, a, b)?)),
            (Value::Function(a), Value::Function(b)) if a.is(b) => Value::Function(a.clone()),
            (Value::Generator(a), Value::Generator(b)) if a.is(b) => Value::Generator(a.clone()),
            (Value::Law(a), Value::Law(b)) if a.key() == b.key() => Value::Law(a.clone()),
            (Value::Opaque(a), Value::Opaque(b)) if a.key() == b.key() => Value::Opaque(a.clone()),
            (Value::Opaque(a), Value::Opaque(b)) => Value::Opaque(Template::Choice(condition, Box::new(a.clone()), Box::new(b.clone()))),
            (Value::Opaque(_), known) | (known, Value::Opaque(_)) => {
                let (shape, nowhere) = (known.numbers()?.1, proc_macro2::TokenStream::new());
                let (a, b) = (self.shaped(a.clone(), &shape, &nowhere), self.shaped(b.clone(), &shape, &nowhere));
                self.select(condition, &a, &b)?
            }
            (a, b) => {
                let ((kind, a), (other, b)) = (a.components()?, b.components()?);
                let each = a.iter().zip(b).map(|(&a, &b)| self.graph.select(condition, a, b)).collect();
                (kind == other).then(|| kind.value(each))?
            }
        })
    }

    fn select_all(&mut self, condition: Node, a: &[Value], b: &[Value]) -> Option<Vec<Value>> {
        a.iter().zip(b).map(|(a, b)| self.select(condition, a, b)).collect()
    }

    pub fn for_loop(&mut self, each: &ExprForLoop) -> Read {
        let over = self.expression(&each.expr)?;
        let Some(items) = self.elements(over, &each.expr)? else { return Ok(Value::unit()) };
        for item in items {
            self.scopes.push();
            let turn = self.bind(&each.pat, item).and_then(|()| self.block(&each.body));
            self.scopes.pop();
            turn?;
            if self.graph.len() > MOST_NODES {
                return Err(Unreadable::new(&each.for_token, "a loop this long"));
            }
        }
        Ok(Value::unit())
    }

    /// The values that `for` and iterators go over; `None` after a mistake.
    pub fn elements(&mut self, value: Value, at: &Expr) -> Read<Option<Vec<Value>>> {
        match value.referent() {
            Value::Array(all) | Value::Iterator(all) => Ok(Some(all)),
            Value::Poison => Ok(None),
            Value::Opaque(_) | Value::Into(_) | Value::Generator(_) | Value::Never => {
                Err(Unreadable::new(at, "a loop over something whose length is not known here"))
            }
            other => {
                self.mistake(at, format!("this goes over a range or an array, but the value is {}", other.name()));
                Ok(None)
            }
        }
    }
}

/// What reading two branches gave.
enum Outcome {
    /// Only one of them can be taken.
    Known(Value),
    Open {
        a: Value,
        b: Value,
        /// Variables after the second branch.
        after_no: Scopes,
    },
}

/// Kinds whose mismatch may still be good Rust.
fn open(value: &Value) -> bool {
    match value {
        Value::Opaque(_) | Value::Integer(..) | Value::Function(_) | Value::Iterator(_) | Value::Law(_) | Value::Never => true,
        Value::Planar(_) | Value::Spatial(_) | Value::Axis(_) | Value::Into(_) | Value::Generator(_) => true,
        Value::Tuple(all) | Value::Array(all) => all.iter().any(open),
        Value::Reference(inner) => open(inner),
        _ => false,
    }
}
