//! Mistakes that rustc reports in a program. For a text, which rustc does not read, the interpreter
//! reports them at the same token.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::{Arm, ExprMatch, Lifetime, Pat};

use super::{Adt, Value, Values, counted};
use crate::parse::SecondReader;
use kin_graph::Node;

/// The message for a variable that only some branches give a value before it is read.
pub const PERHAPS: &str = "the variable has a value in some branches only: give the variable a value in every branch or in its declaration";

/// The message for `f64::from(k)` of a wide integer.
pub const WIDE: &str =
    "`f64::from` takes an `i32` or a `u32`: convert a wider integer `k` by `k as f64`";

impl Values {
    /// Reports a mistake in a text. For a program the function returns `None`, because rustc
    /// reports the mistake.
    pub fn told_by_rustc(&mut self, at: &dyn ToTokens, message: &str) -> Option<Value> {
        (self.signature.second_reader == SecondReader::Nobody).then(|| self.mistake(at, message))
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
        let mut known: Vec<String> = self.flow.labels().map(|label| format!("`{label}`")).collect();
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

    /// Compares a constant with the length that the attribute gives.
    pub fn hold_length(&mut self, name: &Ident, value: &Value) {
        let given = self.signature.lengths.iter().find(|(known, _)| known == name).cloned();
        if let (Some((at, length)), Value::Integer(k, _)) = (given, value)
            && length.base10_parse::<i64>().is_ok_and(|length| length != *k)
        {
            let message = format!(
                "the attribute states `{name} = {length}`, but `{name}` is {k}: write `{name} = {k}`"
            );
            self.told_by_rustc(&at, &message);
        }
    }

    /// Reports a method of an `Option` with a wrong number of arguments.
    pub fn other_count(&mut self, method: &Ident, takes: usize, given: usize) -> Option<Value> {
        let message = counted(&format!("`{method}`"), takes, "argument", given);
        if takes == given { None } else { self.told_by_rustc(method, &message) }
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
