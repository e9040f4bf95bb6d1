//! Patterns: binding variables in `let`, `for` and closures, and testing in `match`.

use quote::ToTokens;
use syn::{Lit, Pat, RangeLimits};

use super::value::{Template, Value};
use super::{Read, Reader, Unreadable};
use crate::graph::{Comparison, Node};

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
                let value = match crate::parse::shape(&typed.ty) {
                    Some(shape) => self.shaped(value, &shape, typed),
                    None => value,
                };
                self.bind(&typed.pat, value)
            }
            Pat::Paren(inner) => self.bind(&inner.pat, value),
            Pat::Reference(inner) => self.bind(&inner.pat, value),
            Pat::Tuple(tuple) => self.bind_all(pattern, tuple.elems.iter(), value, "a tuple"),
            Pat::Slice(slice) => self.bind_all(pattern, slice.elems.iter(), value, "an array"),
            Pat::Struct(fields) => self.bind_fields(fields, value),
            other => Err(Unreadable::new(other, "this pattern")),
        }
    }

    fn bind_all<'a>(&mut self, at: &Pat, parts: impl Iterator<Item = &'a Pat>, value: Value, what: &str) -> Read<()> {
        let parts: Vec<&Pat> = parts.collect();
        let values = match value {
            Value::Tuple(all) if what == "a tuple" => all,
            Value::Array(all) if what == "an array" => all,
            Value::Poison => vec![Value::Poison; parts.len()],
            Value::Opaque(_) => return Err(Unreadable::new(at, "taking apart a value of unknown type")),
            other => {
                self.mistake(at, format!("this takes apart {what}, but the value is {}", other.name()));
                vec![Value::Poison; parts.len()]
            }
        };
        if parts.iter().any(|part| matches!(part, Pat::Rest(_))) {
            return Err(Unreadable::new(at, "`..` in a pattern"));
        }
        if parts.len() != values.len() {
            self.mistake(at, format!("this takes apart {what} of {}, but the value has {}", parts.len(), values.len()));
        }
        let values = values.into_iter().chain(std::iter::repeat(Value::Poison));
        parts.into_iter().zip(values).try_for_each(|(part, value)| self.bind(part, value))
    }

    /// `let Vec2 { x, y } = v`
    fn bind_fields(&mut self, pattern: &syn::PatStruct, value: Value) -> Read<()> {
        for field in &pattern.fields {
            let part = self.field(value.clone(), &field.member, &field.member)?;
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
            (Pat::Or(_), Value::Opaque(template)) => self.test_opaque(pattern, template),
            (Pat::Or(or), value) => {
                let never = self.graph.bool(false);
                or.cases.iter().try_fold(never, |any, case| {
                    let one = self.test(case, value)?;
                    Ok(self.graph.or(any, one))
                })
            }
            (Pat::Tuple(tuple), Value::Tuple(values)) if tuple.elems.len() == values.len() => {
                let always = self.graph.bool(true);
                tuple.elems.iter().zip(values).try_fold(always, |all, (part, value)| {
                    let one = self.test(part, value)?;
                    Ok(self.graph.and(all, one))
                })
            }
            (pattern, Value::Opaque(template)) => self.test_opaque(pattern, template),
            (Pat::Lit(literal), value) => self.test_literal(&literal.lit, value, pattern),
            (Pat::Range(range), value) => self.test_range(range, value),
            (_, Value::Poison) => Ok(self.graph.bool(true)),
            _ => Err(Unreadable::new(pattern, "this pattern")),
        }
    }

    /// rustc matches values of types that only it knows.
    fn test_opaque(&mut self, pattern: &Pat, template: &Template) -> Read<Node> {
        if binds(pattern) {
            return Err(Unreadable::new(pattern, "a pattern that takes a value of unknown type apart"));
        }
        let matches = Template::Matches(Box::new(template.clone()), pattern.to_token_stream());
        Ok(self.condition(Value::Opaque(matches), pattern))
    }

    fn test_literal(&mut self, literal: &Lit, value: &Value, at: &Pat) -> Read<Node> {
        match (literal, value) {
            (Lit::Int(k), Value::Integer(n)) => Ok(self.graph.bool(k.base10_parse::<i64>().is_ok_and(|k| k == *n))),
            (Lit::Bool(b), Value::Condition(c)) => Ok(if b.value { *c } else { self.graph.not(*c) }),
            (Lit::Float(x), Value::Scalar(n)) => {
                let x = self.graph.constant(x.base10_parse().unwrap_or(f64::NAN));
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
                (Value::Integer(b), Value::Integer(n)) => {
                    let (b, n) = (self.graph.constant(b as f64), self.graph.constant(*n as f64));
                    self.graph.compare(comparison, n, b)
                }
                _ => return Err(Unreadable::new(range, "this pattern")),
            };
            all = self.graph.and(all, one);
        }
        Ok(all)
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
