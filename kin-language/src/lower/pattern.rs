//! Patterns: binding variables in `let`, `for` and closures, and testing in `match`.

use quote::ToTokens;
use syn::{Lit, Pat, RangeLimits};

use super::template::Template;
use super::value::Value;
use super::{Read, Reader, Unreadable};
use kin_graph::{Comparison, Node};

impl Reader {
    /// Binds the variables of an irrefutable pattern.
    pub fn bind(&mut self, pattern: &Pat, value: Value) -> Read<()> {
        match pattern {
            Pat::Wild(_) => Ok(()),
            Pat::Ident(ident) if ident.subpat.is_none() => {
                self.scopes.declare(ident.ident.to_string(), value);
                Ok(())
            }
            Pat::Type(typed) => {
                let value = self.typed(value, &typed.ty, typed)?;
                self.bind(&typed.pat, value)
            }
            Pat::Paren(inner) => self.bind(&inner.pat, value),
            Pat::Reference(inner) => self.bind(&inner.pat, value.referent()),
            Pat::Tuple(tuple) => self.bind_all(pattern, tuple.elems.iter(), value, "a tuple"),
            Pat::Slice(slice) => self.bind_all(pattern, slice.elems.iter(), value, "an array"),
            Pat::Struct(fields) => self.bind_fields(fields, value.referent()),
            other => Err(Unreadable::new(other, "this pattern")),
        }
    }

    fn bind_all<'a>(&mut self, at: &Pat, parts: impl Iterator<Item = &'a Pat>, value: Value, what: &str) -> Read<()> {
        let parts: Vec<&Pat> = parts.collect();
        let mut values = match value.referent() {
            Value::Tuple(all) if what == "a tuple" => all,
            Value::Array(all) if what == "an array" => all,
            Value::Poison | Value::Never => return parts.into_iter().try_for_each(|part| self.bind_nothing(part)),
            Value::Opaque(_) | Value::Generator(_) => return Err(Unreadable::new(at, "taking apart a value of unknown type")),
            other => {
                self.mistake(at, format!("this takes apart {what}, but the value is {}", other.name()));
                return parts.into_iter().try_for_each(|part| self.bind_nothing(part));
            }
        };
        let rest = parts.iter().position(|part| rest_of(part).is_some());
        let fits = rest.map_or(parts.len() == values.len(), |_| parts.len() <= values.len() + 1);
        if !fits {
            self.mistake(at, format!("this takes apart {what} of {}, but the value has {}", parts.len(), values.len()));
            return parts.into_iter().try_for_each(|part| self.bind_nothing(part));
        }
        let Some(rest) = rest else { return parts.into_iter().zip(values).try_for_each(|(part, value)| self.bind(part, value)) };
        let after = values.split_off(values.len() - (parts.len() - rest - 1));
        let middle = values.split_off(rest);
        parts[..rest].iter().zip(values).try_for_each(|(part, value)| self.bind(part, value))?;
        if let Some(Some(name)) = rest_of(parts[rest]) {
            self.scopes.declare(name, Value::Array(middle));
        }
        parts[rest + 1..].iter().zip(after).try_for_each(|(part, value)| self.bind(part, value))
    }

    /// The variables of a pattern after a mistake.
    fn bind_nothing(&mut self, pattern: &Pat) -> Read<()> {
        match rest_of(pattern) {
            Some(_) => Ok(()),
            None => self.bind(pattern, Value::Poison),
        }
    }

    /// `let Vec2 { x, y } = v`
    fn bind_fields(&mut self, pattern: &syn::PatStruct, value: Value) -> Read<()> {
        for field in &pattern.fields {
            let part = self.field(value.clone(), &field.member)?;
            self.bind(&field.pat, part)?;
        }
        Ok(())
    }

    /// The condition under which `value` matches, with its variables bound in the current scope.
    pub fn test(&mut self, pattern: &Pat, value: &Value) -> Read<Node> {
        match (pattern, value) {
            (Pat::Wild(_), _) => Ok(self.graph.bool(true)),
            (Pat::Ident(ident), _) if ident.subpat.is_none() && !is_constant(&ident.ident) => {
                self.scopes.declare(ident.ident.to_string(), value.clone());
                Ok(self.graph.bool(true))
            }
            (Pat::Paren(inner), value) => self.test(&inner.pat, value),
            (Pat::Reference(inner), value) => self.test(&inner.pat, value),
            (pattern, Value::Reference(inner)) => self.test(pattern, inner),
            (Pat::Or(or), value) if !binds(pattern) => {
                let never = self.graph.bool(false);
                or.cases.iter().try_fold(never, |any, case| {
                    let one = self.test(case, value)?;
                    Ok(self.graph.or(any, one))
                })
            }
            (Pat::Tuple(tuple), Value::Tuple(values)) if tuple.elems.len() == values.len() => self.test_all(tuple.elems.iter(), values),
            (Pat::Slice(slice), Value::Array(values)) if slice.elems.len() == values.len() => self.test_all(slice.elems.iter(), values),
            (pattern, Value::Opaque(template)) => self.test_opaque(pattern, template),
            (Pat::Lit(literal), value) => self.test_literal(&literal.lit, value, pattern),
            (Pat::Range(range), value) => self.test_range(range, value),
            (Pat::Ident(_) | Pat::Path(_), Value::Integer(..) | Value::Scalar(_)) => self.test_constant(pattern, value),
            (_, Value::Poison | Value::Never) => Ok(self.graph.bool(true)),
            _ => Err(Unreadable::new(pattern, "this pattern")),
        }
    }

    fn test_all<'a>(&mut self, parts: impl Iterator<Item = &'a Pat>, values: &[Value]) -> Read<Node> {
        let always = self.graph.bool(true);
        parts.zip(values).try_fold(always, |all, (part, value)| {
            let one = self.test(part, value)?;
            Ok(self.graph.and(all, one))
        })
    }

    /// rustc matches values of types that only it knows.
    fn test_opaque(&mut self, pattern: &Pat, template: &Template) -> Read<Node> {
        if binds(pattern) || template.has_choice() {
            return Err(Unreadable::new(pattern, "a pattern that takes a value of unknown type apart"));
        }
        let matches = Template::Matches(Box::new(template.clone()), pattern.to_token_stream());
        Ok(self.condition(Value::Opaque(matches), pattern))
    }

    /// A constant of the body's own.
    fn test_constant(&mut self, pattern: &Pat, value: &Value) -> Read<Node> {
        let name = pattern.to_token_stream().to_string();
        match (self.scopes.get(&name), value) {
            (Some(Value::Integer(a, _)), Value::Integer(b, _)) => {
                let same = a == b;
                Ok(self.graph.bool(same))
            }
            (Some(Value::Scalar(a)), Value::Scalar(b)) => {
                let a = *a;
                Ok(self.graph.compare(Comparison::Equal, *b, a))
            }
            _ => Err(Unreadable::new(pattern, "a constant in a pattern")),
        }
    }

    fn test_literal(&mut self, literal: &Lit, value: &Value, at: &Pat) -> Read<Node> {
        match (literal, value) {
            (Lit::Int(k), Value::Integer(n, _)) => Ok(self.graph.bool(k.base10_parse::<i64>().is_ok_and(|k| k == *n))),
            (Lit::Bool(b), Value::Condition(c)) => Ok(if b.value { *c } else { self.graph.not(*c) }),
            (Lit::Float(x), Value::Scalar(n)) => {
                let x = self.graph.decimal(x.base10_digits());
                Ok(self.graph.compare(Comparison::Equal, *n, x))
            }
            _ => Err(Unreadable::new(at, "this pattern")),
        }
    }

    fn test_range(&mut self, range: &syn::PatRange, value: &Value) -> Read<Node> {
        let upper = if matches!(range.limits, RangeLimits::Closed(_)) { Comparison::LessEqual } else { Comparison::Less };
        let mut all = self.graph.bool(true);
        for (bound, comparison) in [(&range.start, Comparison::GreaterEqual), (&range.end, upper)] {
            let Some(bound) = bound else { continue };
            let one = match (self.expression(bound)?, value) {
                (Value::Scalar(b), Value::Scalar(n)) => self.graph.compare(comparison, *n, b),
                (Value::Integer(b, _), Value::Integer(n, _)) => self.graph.bool(comparison.holds(n, &b)),
                (Value::Opaque(b), Value::Scalar(n)) => {
                    let b = self.scalar(Value::Opaque(b), bound);
                    self.graph.compare(comparison, *n, b)
                }
                _ => return Err(Unreadable::new(range, "this pattern")),
            };
            all = self.graph.and(all, one);
        }
        Ok(all)
    }
}

/// `..` or `name @ ..`: the name, if there is one.
fn rest_of(pattern: &Pat) -> Option<Option<String>> {
    match pattern {
        Pat::Rest(_) => Some(None),
        Pat::Ident(ident) if ident.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_))) => {
            Some(Some(ident.ident.to_string()))
        }
        _ => None,
    }
}

/// Names in capitals are constants, not new variables.
fn is_constant(name: &syn::Ident) -> bool {
    name.to_string().chars().next().is_some_and(char::is_uppercase)
}

/// Whether a pattern brings in a variable.
fn binds(pattern: &Pat) -> bool {
    match pattern {
        Pat::Ident(ident) => !is_constant(&ident.ident),
        Pat::Or(or) => or.cases.iter().any(binds),
        Pat::Paren(inner) => binds(&inner.pat),
        Pat::Tuple(tuple) => tuple.elems.iter().any(binds),
        Pat::TupleStruct(tuple) => tuple.elems.iter().any(binds),
        Pat::Struct(fields) => fields.fields.iter().any(|field| binds(&field.pat)),
        Pat::Slice(slice) => slice.elems.iter().any(binds),
        Pat::Reference(inner) => binds(&inner.pat),
        _ => false,
    }
}
