//! Loops: the interpreter reads each turn separately, and the number of turns must be known. An
//! exit from a turn or from the loop is an exit from a frame.

use quote::ToTokens;
use syn::{Block, Expr, ExprForLoop, ExprLoop, ExprWhile, Label};

use super::flow::Kind;
use super::value::Value;
use super::{MOST_NODES, MOST_TURNS, Read, Reader, Unreadable};

/// The most turns of a loop whose end depends on coordinates.
const MOST_OPEN_TURNS: usize = 128;

impl Reader {
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
        let number = self.frame(|kind| kind == Kind::Loop, None).unwrap_or(0);
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
            let ways_out = self.exits();
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
            open += usize::from(self.exits() > ways_out);
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
        match self.frame(wanted, label.as_deref()) {
            Some(number) => self.leave(number, value, leaving),
            None => self
                .no_such_loop(leaving.label.as_ref())
                .ok_or_else(|| Unreadable::new(leaving, "a `break` outside of a loop")),
        }
    }

    pub fn continue_expression(&mut self, leaving: &syn::ExprContinue) -> Read {
        let label = leaving.label.as_ref().map(ToString::to_string);
        match self.frame(|kind| kind == Kind::Turn, label.as_deref()) {
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
        match (self.frame(|kind| kind == Kind::Function, None), self.output.clone(), &leaving.expr)
        {
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
                match reader.frame(|kind| kind == Kind::Function, None) {
                    Some(number) => reader.leave(number, Value::Adt(adt), tried),
                    None => Err(Unreadable::new(&tried.question_token, "`?`")),
                }
            }
            _ => Err(Unreadable::new(&tried.question_token, "`?`")),
        })
    }

    /// Returns the values of the sequence of a `for` or an iterator, or `None` after a mistake.
    pub fn elements(&mut self, value: Value, at: &Expr) -> Read<Option<Vec<Value>>> {
        match value {
            Value::Reference(inner) => match *inner {
                Value::Array(all) => Ok(Some(
                    all.into_iter().map(|value| Value::Reference(Box::new(value))).collect(),
                )),
                inner => self.elements(inner, at),
            },
            Value::Place(place) => match self.at_place(&place) {
                Some(Value::Array(all)) => {
                    Ok(Some((0..all.len()).map(|k| Value::Place(place.index(k))).collect()))
                }
                Some(Value::Iterator(all)) => {
                    let _ = self.put_at(&place, Value::Iterator(vec![]), at);
                    Ok(Some(all))
                }
                Some(inner) => self.elements(inner, at),
                None => Err(Unreadable::new(at, "a loop over something of unknown length")),
            },
            Value::Array(all) | Value::Iterator(all) => Ok(Some(all)),
            Value::Opaque(ref template) if self.integers_of(template).is_some() => {
                Ok(self.integers_of(template))
            }
            Value::Poison => Ok(None),
            Value::Adt(adt) if matches!(adt.name.as_str(), "Some" | "None") => {
                Ok(Some(adt.fields.into_iter().map(|(_, value)| value).collect()))
            }
            Value::Opaque(_)
            | Value::Endless(_)
            | Value::Into(_)
            | Value::Generator(_)
            | Value::Never
            | Value::Choice(_)
            | Value::Left
            | Value::Adt(_) => Err(Unreadable::new(at, "a loop over something of unknown length")),
            other => {
                self.mistake(
                    at,
                    format!("a loop needs a range or an array, but the value is {}", other.name()),
                );
                Ok(None)
            }
        }
    }
}
