//! Reads `if`, `match` and loops. The interpreter reads each turn of a loop separately, and the
//! number of turns must be known. An exit from a turn or from the loop is an exit from a frame.

use quote::ToTokens;
use syn::{BinOp, Block, Expr, ExprForLoop, ExprIf, ExprLoop, ExprMatch, ExprWhile, Label, Pat};

use super::{MOST_NODES, Reader};
use crate::lower::scope::{Guard, Kind};
use crate::lower::values::{Branching, MOST_TURNS, Read, Unreadable, Value};
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
                self.flow.path.push(Guard::branch(first));
                let second = self.tested_condition(&both.right);
                self.flow.path.pop();
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
        self.flow.path.push(Guard::branch(matched));
        let value = self.tested_condition(guard);
        self.flow.path.pop();
        let guard = value?;
        Ok(self.graph.and(matched, guard))
    }

    pub fn for_loop(&mut self, each: &ExprForLoop) -> Read {
        let over = self.raw_expression(&each.expr)?;
        if matches!(over, Value::Left) {
            return Ok(over);
        }
        self.each(over, &each.expr, &mut |reader, over| {
            let Some(items) = reader.elements(over, &each.expr)? else { return Ok(Value::unit()) };
            reader.turns(
                each.label.as_ref(),
                &each.for_token,
                &mut items.into_iter().map(Some).chain([None]),
                &mut |reader, item| {
                    let Some(item) = item else { return reader.leave_loop(each) };
                    reader.bind(&each.pat, item)?;
                    reader.block(&each.body)
                },
            )
        })
    }

    pub fn while_loop(&mut self, each: &ExprWhile) -> Read {
        self.turns(
            each.label.as_ref(),
            &each.while_token,
            &mut std::iter::repeat(None),
            &mut |reader, _| {
                let condition = reader.tested_condition(&each.cond)?;
                let out = |reader: &mut Self| reader.leave_loop(&each.cond);
                reader.choose(condition, |reader| reader.block(&each.body), out, &each.cond)
            },
        )
    }

    pub fn endless_loop(&mut self, each: &ExprLoop) -> Read {
        self.turns(
            each.label.as_ref(),
            &each.loop_token,
            &mut std::iter::repeat(None),
            &mut |reader, _| reader.block(&each.body),
        )
    }

    /// Leaves the innermost loop at its regular end.
    fn leave_loop(&mut self, at: &dyn ToTokens) -> Read {
        let number = self.flow.frame(|kind| kind == Kind::Loop, None).unwrap_or(0);
        self.leave(number, Value::unit(), at)
    }

    /// Reads turns until no path leads into another one.
    fn turns(
        &mut self,
        label: Option<&Label>,
        at: &dyn ToTokens,
        items: &mut dyn Iterator<Item = Option<Value>>,
        turn: &mut dyn FnMut(&mut Self, Option<Value>) -> Read,
    ) -> Read {
        let label = label.map(|label| label.name.to_string());
        self.enter(Kind::Loop, label.clone());
        let mut open = 0;
        for (k, item) in items.enumerate() {
            let ways_out = self.flow.exits();
            self.enter(Kind::Turn, label.clone());
            self.scopes.push();
            let value = turn(self, item);
            self.scopes.pop();
            let value = self.exit(value?, at)?;
            if !self.mistakes.is_empty() {
                return self.exit(Value::Poison, at);
            }
            if matches!(value, Value::Left | Value::Never) {
                return self.exit(value, at);
            }
            open += usize::from(self.flow.exits() > ways_out);
            if self.graph.len() > MOST_NODES || k as i64 > MOST_TURNS {
                return Err(Unreadable::new(at, "a loop of this length"));
            }
            if open > MOST_OPEN_TURNS {
                return Err(Unreadable::new(at, "a loop with an unknown end"));
            }
        }
        self.exit(Value::unit(), at)
    }

    pub fn labelled_block(&mut self, block: &Block, label: &Label) -> Read {
        self.enter(Kind::Block, Some(label.name.to_string()));
        let value = self.block(block)?;
        self.exit(value, block)
    }

    pub fn break_expression(&mut self, leaving: &syn::ExprBreak) -> Read {
        let value = match &leaving.expr {
            Some(value) => self.raw_expression(value)?,
            None => Value::unit(),
        };
        let label = leaving.label.as_ref().map(ToString::to_string);
        let wanted = |kind| kind == Kind::Loop || kind == Kind::Block && label.is_some();
        match self.flow.frame(wanted, label.as_deref()) {
            Some(number) => self.leave(number, value, leaving),
            None => self
                .no_such_loop(leaving.label.as_ref())
                .ok_or_else(|| Unreadable::new(leaving, "a `break` outside of a loop")),
        }
    }

    pub fn continue_expression(&mut self, leaving: &syn::ExprContinue) -> Read {
        let label = leaving.label.as_ref().map(ToString::to_string);
        match self.flow.frame(|kind| kind == Kind::Turn, label.as_deref()) {
            Some(number) => self.leave(number, Value::unit(), leaving),
            None => self
                .no_such_loop(leaving.label.as_ref())
                .ok_or_else(|| Unreadable::new(leaving, "a `continue` outside of a loop")),
        }
    }

    pub fn return_expression(&mut self, leaving: &syn::ExprReturn) -> Read {
        let value = match &leaving.expr {
            Some(value) => self.raw_expression(value)?,
            None => Value::unit(),
        };
        match (
            self.flow.frame(|kind| kind == Kind::Function, None),
            self.output.clone(),
            &leaving.expr,
        ) {
            (Some(0), Some(output), Some(place)) => {
                let value = self.typed(value, &output, place)?;
                self.leave(0, value, leaving)
            }
            (Some(number), ..) => self.leave(number, value, leaving),
            (None, ..) => Err(Unreadable::new(leaving, "a `return` outside of a function")),
        }
    }

    /// Reads `value?`.
    pub fn try_expression(&mut self, tried: &syn::ExprTry) -> Read {
        let value = self.expression(&tried.expr)?;
        self.each(value, &tried.question_token, &mut |reader, value| match value {
            Value::Adt(adt)
                if matches!(adt.name.as_str(), "Some" | "Ok") && adt.fields.len() == 1 =>
            {
                Ok(adt.fields[0].1.clone())
            }
            Value::Adt(adt) if matches!(adt.name.as_str(), "None" | "Err") => {
                match reader.flow.frame(|kind| kind == Kind::Function, None) {
                    Some(number) => reader.leave(number, Value::Adt(adt), tried),
                    None => Err(Unreadable::new(&tried.question_token, "`?`")),
                }
            }
            _ => Err(Unreadable::new(&tried.question_token, "`?`")),
        })
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

/// The most turns of a loop whose end depends on coordinates.
const MOST_OPEN_TURNS: usize = 128;

#[cfg(test)]
mod tests {
    use crate::lower::values::Value;
    use crate::lower::walk::Reader;
    use kin_graph::Graph;

    fn read(expression: syn::Expr) -> (Reader, Option<Value>) {
        let mut reader = Reader::new(Graph::default());
        let value = reader.expression(&expression).ok();
        (reader, value)
    }

    #[test]
    fn a_loop_is_read_turn_by_turn() {
        let (_, value) = read(syn::parse_quote!({
            fn sum() -> i64 {
                let mut sum = 0;
                for k in 1..=10 {
                    if k == 4 {
                        break;
                    }
                    sum += k;
                }
                sum
            }
            sum()
        }));
        assert!(matches!(value, Some(Value::Integer(6, _))));
        assert!(read(syn::parse_quote!(loop {})).1.is_none());
    }
}
