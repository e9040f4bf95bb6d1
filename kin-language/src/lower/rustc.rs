//! The mistakes that rustc tells of a program by itself, told of texts, which it does not read: at
//! the token at which it would.

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::{Arm, Expr, ExprMatch, Ident, Lifetime, Pat, Token};

use kin_graph::Node;

use super::scope::{Name, Place};
use super::value::{Adt, Value};
use super::{Read, Reader};
use crate::parse::SecondReader;

/// Of a variable that is read behind branches some of which give it no value.
pub const PERHAPS: &str = "this variable has a value in some branches only: give it one in every branch, or where it is declared";

/// Of `f64::from(k)` of a wide integer.
pub const WIDE: &str =
    "a number is made of an `i32` or a `u32` so: of a wider integer `k` it is `k as f64`";

const GOES_ON: &str = "behind `else` there is no value to go on with: leave by `return`, `break`, `continue` or `panic!`";

impl Reader {
    /// Notes a mistake of a text; `None` of a program, which rustc reads.
    pub fn told_by_rustc(&mut self, at: &dyn ToTokens, message: &str) -> Option<Value> {
        (self.second_reader == SecondReader::Nobody).then(|| self.mistake(at, message))
    }

    /// A new variable of a pattern.
    pub fn declare_bound(&mut self, name: &Ident, mutable: bool, value: Value) {
        let slot = self.store.declare(value);
        if !mutable && self.second_reader == SecondReader::Nobody {
            self.fixed.insert(slot, name.to_string());
        }
        self.scopes.declare(name.to_string(), slot);
    }

    /// Something changes the place that an expression is: its variable must be `mut`, or have no
    /// value yet.
    pub fn change(&mut self, expression: &Expr, place: &Place) {
        let Some(name) = self.fixed.get(&place.slot) else { return };
        // A place behind a reference is another variable's.
        let is_own = root(expression).is_some_and(
            |root| matches!(self.scopes.get(&root), Some(Name::Variable(slot)) if slot == place.slot),
        );
        let is_first =
            place.steps.is_empty() && matches!(self.store.get(place.slot), Value::Unassigned);
        if is_own && !is_first {
            let message = format!("`{name}` cannot change: declare it `mut {name}`");
            self.told_by_rustc(expression, &message);
        }
    }

    /// The value of a variable that only one of two branches has given a value.
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

    /// `assert!(condition, …)`
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
                        format!("this must be a condition (bool), but it is {}", other.name());
                    self.told_by_rustc(call, &message);
                }
            }
        }
        Ok(Value::unit())
    }

    /// The block of a `let … else`, which does not go on.
    pub fn leaving(&mut self, block: &Expr) -> Read {
        let value = self.expression(block)?;
        if !matches!(value, Value::Left | Value::Never | Value::Poison) {
            let told = self.told_by_rustc(block, GOES_ON);
            return Ok(told.unwrap_or(value));
        }
        Ok(value)
    }

    /// The last arm of a `match`, which is taken without a test, must not depend on one.
    pub fn exhaustive(&mut self, branch: &ExprMatch, last: &Arm, condition: Node) {
        if (last.guard.is_some() || is_narrow(&last.pat))
            && self.graph.truth(condition) != Some(true)
        {
            self.told_by_rustc(&branch.expr, "this `match` may find no arm: end it with `_ => …`");
        }
    }

    /// `break 'row` and `continue 'row` where no loop is called so.
    pub fn no_such_loop(&mut self, label: Option<&Lifetime>) -> Option<Value> {
        let label = label?;
        let mut known: Vec<String> = self.labels().map(|label| format!("`{label}`")).collect();
        known.dedup();
        let known = if known.is_empty() { "none".to_string() } else { known.join(", ") };
        self.told_by_rustc(
            label,
            &format!("no loop around this is called `{label}`: known here: {known}"),
        )
    }

    /// A method of a type of the body's own that the type does not have.
    pub fn no_such_method(&mut self, ty: &str, method: &Ident) -> Option<Value> {
        let known = self.own.methods(ty);
        if known.is_empty() {
            return None;
        }
        let message =
            format!("a `{ty}` has no method `{method}`; its methods are {}", known.join(", "));
        self.told_by_rustc(method, &message)
    }

    /// True, and noted, of an array whose type has a name for another length.
    pub fn is_of_another_length(
        &mut self,
        all: &[Value],
        ty: &syn::TypeArray,
        at: &dyn ToTokens,
    ) -> bool {
        let known =
            self.known_length(&ty.len).filter(|_| crate::parse::literal_length(&ty.len).is_none());
        let Some(n) = known.filter(|n| *n != all.len()) else { return false };
        let message = format!("expected an array of {n}, but this is an array of {}", all.len());
        self.told_by_rustc(at, &message).is_some()
    }

    /// A pattern of a variant that the enum of the body's own does not have.
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
            format!("`{ty}` has no variant `{name}`: its variants are {}", known.join(", "));
        self.told_by_rustc(name, &message)
    }

    /// A method of an `Option` with more or fewer arguments than it takes.
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

    /// A constant whose length the attribute gives must be of that length.
    pub fn hold_length(&mut self, name: &Ident, value: &Value) {
        let given = self.lengths.iter().find(|(known, _)| known == name).cloned();
        if let (Some((at, length)), Value::Integer(k, _)) = (given, value)
            && length.base10_parse::<i64>().is_ok_and(|length| length != *k)
        {
            let message = format!(
                "`{name}` is {k}, not {length}, as the attribute says: write `{name} = {k}`"
            );
            self.told_by_rustc(&at, &message);
        }
    }
}

/// True of a pattern of some numbers only.
fn is_narrow(pattern: &Pat) -> bool {
    match pattern {
        Pat::Lit(literal) => !matches!(literal.lit, syn::Lit::Bool(_)),
        Pat::Range(_) => true,
        Pat::Or(or) => or.cases.iter().all(is_narrow),
        Pat::Paren(inner) => is_narrow(&inner.pat),
        _ => false,
    }
}

/// The variable of which an expression is a part, without going through references.
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
