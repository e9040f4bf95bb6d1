//! Reads `if` and `match`, their conditions, and the variables that their patterns bind.

use syn::{BinOp, Expr, ExprIf, ExprMatch, Pat};

use super::flow::Guard;
use super::value::Value;
use super::{Read, Reader, Unreadable};
use kin_graph::Node;

impl Reader {
    pub fn if_expression(&mut self, branch: &ExprIf) -> Read {
        self.scopes.push();
        let condition = self.tested_condition(&branch.cond)?;
        let value = self.choose(
            condition,
            |reader| reader.block(&branch.then_branch),
            |reader| {
                // The variables that the condition binds are out of scope here.
                let inside = reader.scopes.take();
                let value = match &branch.else_branch {
                    Some((_, otherwise)) => reader.expression(otherwise),
                    None => Ok(Value::unit()),
                };
                reader.scopes.put(inside);
                value
            },
            branch,
        );
        self.scopes.pop();
        value
    }

    /// Reads a condition that contains `let`; its variables go into the innermost scope.
    pub fn tested_condition(&mut self, condition: &Expr) -> Read<Node> {
        match condition {
            Expr::Paren(inner) => self.tested_condition(&inner.expr),
            Expr::Group(inner) => self.tested_condition(&inner.expr),
            Expr::Let(test) => {
                let value = self.matchable(&test.expr)?;
                self.test(&test.pat, &value)
            }
            Expr::Binary(both) if matches!(both.op, BinOp::And(_)) && holds_let(condition) => {
                let first = self.tested_condition(&both.left)?;
                self.path.push(Guard::branch(first));
                let second = self.tested_condition(&both.right);
                self.path.pop();
                let second = second?;
                Ok(self.graph.and(first, second))
            }
            other => {
                let value = self.expression(other)?;
                Ok(self.condition(value, other))
            }
        }
    }

    pub fn match_expression(&mut self, branch: &ExprMatch) -> Read {
        let value = self.matchable(&branch.expr)?;
        match value {
            Value::Left => Ok(value),
            value => self.arms(branch, &value, 0),
        }
    }

    /// Reads the value that a `match` examines.
    pub fn matchable(&mut self, expression: &Expr) -> Read {
        match self.raw_expression(expression)? {
            other @ (Value::Function(_)
            | Value::Law(_)
            | Value::Axis(_)
            | Value::Planar(_)
            | Value::Spatial(_)
            | Value::Unassigned) => {
                Err(Unreadable::new(expression, format!("a `match` on {}", other.name())))
            }
            value => Ok(value),
        }
    }

    /// Returns the value of the arms from number `k` on. The last arm needs no test, since a
    /// `match` is exhaustive.
    fn arms(&mut self, branch: &ExprMatch, value: &Value, k: usize) -> Read {
        let Some(arm) = branch.arms.get(k) else {
            return Err(Unreadable::new(branch, "a `match` without arms"));
        };
        self.scopes.push();
        let condition =
            self.tested(&arm.pat, arm.guard.as_ref().map(|(_, guard)| &**guard), value)?;
        let result = if k + 1 == branch.arms.len() {
            self.exhaustive(branch, arm, condition);
            self.expression(&arm.body)
        } else {
            let rest = |reader: &mut Self| {
                let inside = reader.scopes.take();
                let value = reader.arms(branch, value, k + 1);
                reader.scopes.put(inside);
                value
            };
            self.choose(condition, |reader| reader.expression(&arm.body), rest, branch)
        };
        self.scopes.pop();
        result
    }

    /// Returns the condition under which a value matches a pattern and its guard.
    pub fn tested(&mut self, pattern: &Pat, guard: Option<&Expr>, value: &Value) -> Read<Node> {
        let matched = self.test(pattern, value)?;
        let Some(guard) = guard else { return Ok(matched) };
        if self.graph.truth(matched) == Some(false) {
            return Ok(matched);
        }
        self.path.push(Guard::branch(matched));
        let value = self.tested_condition(guard);
        self.path.pop();
        let guard = value?;
        Ok(self.graph.and(matched, guard))
    }
}

/// Returns true if a condition contains `let`.
fn holds_let(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Paren(inner) => holds_let(&inner.expr),
        Expr::Binary(both) => holds_let(&both.left) || holds_let(&both.right),
        _ => false,
    }
}
