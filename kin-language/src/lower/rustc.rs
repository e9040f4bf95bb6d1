//! Mistakes that rustc reports in a program. For a text, which rustc does not read, the interpreter
//! reports them at the same token.

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{Arm, Expr, ExprMatch, Ident, Lifetime, Pat, Token};

use kin_graph::Node;

use super::scope::{Name, Place};
use super::value::{Adt, Value};
use super::{Read, Reader};
use crate::parse::SecondReader;

/// The message for a variable that only some branches give a value before it is read.
pub const PERHAPS: &str = "the variable has a value in some branches only: give the variable a value in every branch or in its declaration";

/// The message for `f64::from(k)` of a wide integer.
pub const WIDE: &str =
    "`f64::from` takes an `i32` or a `u32`: convert a wider integer `k` by `k as f64`";

const GOES_ON: &str =
    "the block after `else` must leave the function: `return`, `break`, `continue` or `panic!`";

impl Reader {
    /// Reports a mistake in a text. For a program the function returns `None`, because rustc
    /// reports the mistake.
    pub fn told_by_rustc(&mut self, at: &dyn ToTokens, message: &str) -> Option<Value> {
        (self.second_reader == SecondReader::Nobody).then(|| self.mistake(at, message))
    }

    /// Declares a variable of a pattern.
    pub fn declare_bound(&mut self, name: &Ident, mutable: bool, value: Value) {
        let slot = self.store.declare(value);
        if !mutable && self.second_reader == SecondReader::Nobody {
            self.fixed.insert(slot, name.to_string());
        }
        self.scopes.declare(name.to_string(), slot);
    }

    /// Reports a change of a variable that is not `mut`, unless the change is its first assignment.
    pub fn change(&mut self, expression: &Expr, place: &Place) {
        let Some(name) = self.fixed.get(&place.slot) else { return };
        // A place behind a reference belongs to another variable.
        let is_own = root(expression).is_some_and(
            |root| matches!(self.scopes.get(&root), Some(Name::Variable(slot)) if slot == place.slot),
        );
        let is_first =
            place.steps.is_empty() && matches!(self.store.get(place.slot), Value::Unassigned);
        if is_own && !is_first {
            let message = format!("`{name}` cannot change: declare `mut {name}`");
            self.told_by_rustc(expression, &message);
        }
    }

    /// Returns the value of a variable that only one of two branches has assigned.
    pub fn perhaps(&self, value: Value) -> Value {
        match (self.second_reader, value) {
            (SecondReader::Nobody, value)
                if !matches!(value, Value::Perhaps(_) | Value::Unassigned) =>
            {
                Value::Perhaps(Box::new(value))
            }
            (_, value) => value,
        }
    }

    /// Reads `assert!(condition, …)`.
    pub fn asserted(&mut self, call: &syn::Macro) -> Read {
        let all = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated);
        if let Some(condition) = all.ok().and_then(|all| all.into_iter().next()) {
            match self.expression(&condition)? {
                Value::Condition(_)
                | Value::Opaque(_)
                | Value::Poison
                | Value::Never
                | Value::Left => {}
                other => {
                    let message =
                        format!("expected a condition (bool), but found {}", other.name());
                    self.told_by_rustc(call, &message);
                }
            }
        }
        Ok(Value::unit())
    }

    /// Reads the block of a `let … else`, which must leave the code around it.
    pub fn leaving(&mut self, block: &Expr) -> Read {
        let value = self.expression(block)?;
        if !matches!(value, Value::Left | Value::Never | Value::Poison) {
            let told = self.told_by_rustc(block, GOES_ON);
            return Ok(told.unwrap_or(value));
        }
        Ok(value)
    }

    /// Reports a last arm of a `match` that has a condition, because the interpreter takes this arm
    /// without a test.
    pub fn exhaustive(&mut self, branch: &ExprMatch, last: &Arm, condition: Node) {
        if (last.guard.is_some() || is_narrow(&last.pat))
            && self.graph.truth(condition) != Some(true)
        {
            self.told_by_rustc(
                &branch.expr,
                "this `match` may have no matching arm: add the arm `_ => …`",
            );
        }
    }

    /// Reports `break 'row` and `continue 'row` if no loop has this label.
    pub fn no_such_loop(&mut self, label: Option<&Lifetime>) -> Option<Value> {
        let label = label?;
        let mut known: Vec<String> = self.labels().map(|label| format!("`{label}`")).collect();
        known.dedup();
        let known = if known.is_empty() { "none".to_string() } else { known.join(", ") };
        self.told_by_rustc(
            label,
            &format!("no enclosing loop has the label `{label}`: the known labels are {known}"),
        )
    }

    /// Reports a method that a type of the body does not have.
    pub fn no_such_method(&mut self, ty: &str, method: &Ident) -> Option<Value> {
        let known = self.own.methods(ty);
        if known.is_empty() {
            return None;
        }
        let message =
            format!("a `{ty}` has no method `{method}`: the methods are {}", known.join(", "));
        self.told_by_rustc(method, &message)
    }

    /// Returns true, after a report, for an array whose declared length is another one.
    pub fn is_of_another_length(
        &mut self,
        all: &[Value],
        ty: &syn::TypeArray,
        at: &dyn ToTokens,
    ) -> bool {
        let known =
            self.known_length(&ty.len).filter(|_| crate::parse::literal_length(&ty.len).is_none());
        let Some(n) = known.filter(|n| *n != all.len()) else { return false };
        let message = format!("expected an array of {n}, but found an array of {}", all.len());
        self.told_by_rustc(at, &message).is_some()
    }

    /// Reports a pattern of a variant that an enum of the body does not have.
    pub fn no_such_variant(&mut self, pattern: &Pat, adt: &Adt) -> Option<Value> {
        let path = match pattern {
            Pat::Path(path) => &path.path,
            Pat::TupleStruct(tuple) => &tuple.path,
            Pat::Struct(fields) => &fields.path,
            _ => return None,
        };
        let ty = adt.type_name();
        let name = &path.segments.last()?.ident;
        let variants = &self.own.declared(&ty)?.variants;
        if variants.is_empty() || variants.iter().any(|variant| name == &variant.name) {
            return None;
        }
        let known: Vec<String> =
            variants.iter().map(|variant| format!("`{}`", variant.name)).collect();
        let message =
            format!("`{ty}` has no variant `{name}`: the variants are {}", known.join(", "));
        self.told_by_rustc(name, &message)
    }

    /// Reports a method of an `Option` with a wrong number of arguments.
    pub fn other_count(&mut self, method: &Ident, given: usize) -> Option<Value> {
        const TAKE_ONE: [&str; 14] = [
            "map",
            "and_then",
            "filter",
            "unwrap_or",
            "unwrap_or_else",
            "is_some_and",
            "is_ok_and",
            "is_none_or",
            "or",
            "or_else",
            "and",
            "zip",
            "ok_or",
            "expect",
        ];
        let name = method.to_string();
        let takes = match name.as_str() {
            "map_or" | "map_or_else" => 2,
            name if TAKE_ONE.contains(&name) => 1,
            "unwrap" | "is_some" | "is_none" | "is_ok" | "is_err" | "unwrap_or_default" | "ok"
            | "flatten" => 0,
            _ => return None,
        };
        let message = super::counted(&format!("`{name}`"), takes, "argument", given);
        if takes == given { None } else { self.told_by_rustc(method, &message) }
    }

    /// Compares a constant with the length that the attribute gives.
    pub fn hold_length(&mut self, name: &Ident, value: &Value) {
        let given = self.lengths.iter().find(|(known, _)| known == name).cloned();
        if let (Some((at, length)), Value::Integer(k, _)) = (given, value)
            && length.base10_parse::<i64>().is_ok_and(|length| length != *k)
        {
            let message = format!(
                "the attribute states `{name} = {length}`, but `{name}` is {k}: write `{name} = {k}`"
            );
            self.told_by_rustc(&at, &message);
        }
    }
}

/// Returns true for a pattern that matches only some numbers.
fn is_narrow(pattern: &Pat) -> bool {
    match pattern {
        Pat::Lit(literal) => !matches!(literal.lit, syn::Lit::Bool(_)),
        Pat::Range(_) => true,
        Pat::Or(or) => or.cases.iter().all(is_narrow),
        Pat::Paren(inner) => is_narrow(&inner.pat),
        _ => false,
    }
}

/// Returns the variable of which an expression is a part, without following references.
fn root(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        Expr::Field(field) => root(&field.base),
        Expr::Index(index) => root(&index.expr),
        Expr::Paren(inner) => root(&inner.expr),
        Expr::Group(inner) => root(&inner.expr),
        _ => None,
    }
}
