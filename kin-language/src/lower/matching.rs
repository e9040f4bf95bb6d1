//! Matches values with patterns: returns the condition and binds the variables of the pattern.

use quote::ToTokens;
use syn::visit_mut::VisitMut;
use syn::{Lit, Pat, RangeLimits};

use super::pattern::{Blank, binds, is_constant, is_open, names, rest_of};
use super::template::Template;
use super::value::{Adt, Value};
use super::{Read, Reader, Unreadable};
use kin_graph::{Comparison, Node};

impl Reader {
    /// Returns the condition under which `value` matches, and binds its variables in the current
    /// scope.
    pub fn test(&mut self, pattern: &Pat, value: &Value) -> Read<Node> {
        match (pattern, value) {
            (Pat::Wild(_) | Pat::Rest(_), _) => Ok(self.graph.bool(true)),
            (Pat::Ident(ident), _) if !is_constant(&ident.ident) => {
                self.declare_bound(&ident.ident, ident.mutability.is_some(), value.clone());
                match &ident.subpat {
                    Some((_, inner)) => self.test(inner, value),
                    None => Ok(self.graph.bool(true)),
                }
            }
            (Pat::Paren(inner), value) => self.test(&inner.pat, value),
            (Pat::Reference(inner), Value::Reference(value)) => self.test(&inner.pat, value),
            (Pat::Reference(inner), value) => {
                let value = self.loaded(value.clone());
                self.test(&inner.pat, &value)
            }
            (Pat::Type(typed), value) => {
                let value = self.typed(value.clone(), &typed.ty, typed)?;
                self.test(&typed.pat, &value)
            }
            (pattern, Value::Reference(_) | Value::Place(_)) => {
                let value = self.outer(value.clone());
                self.test(pattern, &value)
            }
            (Pat::Or(or), value) if !binds(pattern) || matches!(value, Value::Adt(_)) => {
                let mut any = self.graph.bool(false);
                for case in &or.cases {
                    let one = self.test(case, value)?;
                    if self.graph.truth(one) == Some(true) {
                        return Ok(one);
                    }
                    any = self.graph.or(any, one);
                }
                Ok(any)
            }
            (pattern, Value::Choice(all)) => self.test_choice(pattern, all),
            (Pat::Tuple(tuple), Value::Tuple(values)) => {
                self.test_parts(tuple.elems.iter(), values)
            }
            (Pat::Slice(slice), Value::Array(values)) => {
                self.test_parts(slice.elems.iter(), values)
            }
            (pattern, Value::Adt(adt)) => self.test_adt(pattern, adt),
            (pattern, Value::Opaque(template)) => self.test_opaque(pattern, template),
            (Pat::Lit(literal), value) => self.test_literal(&literal.lit, value, pattern),
            (Pat::Range(range), value) => self.test_range(range, value),
            (Pat::Ident(_) | Pat::Path(_), Value::Integer(..) | Value::Scalar(_)) => {
                self.test_constant(pattern, value)
            }
            (Pat::Struct(fields), value) if value.components().is_some() => {
                self.bind_fields(fields, value.clone())?;
                Ok(self.graph.bool(true))
            }
            (_, Value::Poison | Value::Never | Value::Left) => {
                names(pattern).into_iter().for_each(|name| self.declare(name, Value::Poison));
                Ok(self.graph.bool(true))
            }
            _ => Err(Unreadable::new(pattern, "this pattern")),
        }
    }

    /// Matches a choice: one of the alternatives that match must be the present one. A variable
    /// takes its value from that alternative.
    fn test_choice(&mut self, pattern: &Pat, all: &[(Node, Value)]) -> Read<Node> {
        let mut found: Vec<(Node, std::collections::BTreeMap<String, usize>)> = Vec::new();
        for (taken, value) in all {
            self.scopes.push();
            let matched = self.test(pattern, value);
            let scope = self.scopes.take();
            let matched = matched?;
            let both = self.graph.and(*taken, matched);
            if self.graph.truth(both) != Some(false) {
                found.push((both, scope.variables()));
            }
        }
        let never = self.graph.bool(false);
        let any = found.iter().fold(never, |any, (taken, _)| self.graph.or(any, *taken));
        let always = found.len() == all.len()
            && found.iter().zip(all).all(|((both, _), (taken, _))| both == taken);
        let Some((_, last)) = found.last() else { return Ok(never) };
        for (name, slot) in last.clone() {
            let mut value = self.store.get(slot).clone();
            for (taken, variables) in found.iter().rev().skip(1) {
                let Some(&other) = variables.get(&name) else { continue };
                let other = self.store.get(other).clone();
                value = self.joined(*taken, &other, &value, pattern)?;
            }
            self.declare(name, value);
        }
        Ok(if always { self.graph.bool(true) } else { any })
    }

    /// Matches a struct or a variant: the name must be equal, and the parts must match.
    fn test_adt(&mut self, pattern: &Pat, adt: &Adt) -> Read<Node> {
        let named =
            |path: &syn::Path| path.segments.last().is_some_and(|last| last.ident == adt.name);
        let never = self.graph.bool(false);
        if self.no_such_variant(pattern, adt).is_some() {
            names(pattern).into_iter().for_each(|name| self.declare(name, Value::Poison));
            return Ok(never);
        }
        match pattern {
            Pat::Ident(ident) => Ok(self.graph.bool(ident.ident == adt.name)),
            Pat::Path(path) => Ok(self.graph.bool(named(&path.path))),
            Pat::TupleStruct(tuple) if named(&tuple.path) => {
                let values: Vec<Value> =
                    adt.fields.iter().map(|(_, value)| value.clone()).collect();
                self.test_parts(tuple.elems.iter(), &values)
            }
            Pat::Struct(fields) if named(&fields.path) => {
                let mut all = self.graph.bool(true);
                for field in &fields.fields {
                    let Some(value) =
                        adt.field(&field.member.to_token_stream().to_string()).cloned()
                    else {
                        return Err(Unreadable::new(field, "this field"));
                    };
                    let one = self.test(&field.pat, &value)?;
                    all = self.graph.and(all, one);
                }
                Ok(all)
            }
            Pat::TupleStruct(_) | Pat::Struct(_) => Ok(never),
            other => Err(Unreadable::new(other, "this pattern")),
        }
    }

    /// Matches parts in order, with `..` for any number of them.
    fn test_parts<'a>(
        &mut self,
        parts: impl Iterator<Item = &'a Pat>,
        values: &[Value],
    ) -> Read<Node> {
        let parts: Vec<&Pat> = parts.collect();
        let Some(rest) = parts.iter().position(|part| rest_of(part).is_some()) else {
            return match parts.len() == values.len() {
                true => self.test_all(parts.into_iter(), values),
                false => Ok(self.graph.bool(false)),
            };
        };
        let after = parts.len() - rest - 1;
        if values.len() < rest + after {
            return Ok(self.graph.bool(false));
        }
        if let Some(Some(name)) = rest_of(parts[rest]) {
            self.declare(name, Value::Array(values[rest..values.len() - after].to_vec()));
        }
        let first = self.test_all(parts[..rest].iter().copied(), &values[..rest])?;
        let last =
            self.test_all(parts[rest + 1..].iter().copied(), &values[values.len() - after..])?;
        Ok(self.graph.and(first, last))
    }

    fn test_all<'a>(
        &mut self,
        parts: impl Iterator<Item = &'a Pat>,
        values: &[Value],
    ) -> Read<Node> {
        let always = self.graph.bool(true);
        parts.zip(values).try_fold(always, |all, (part, value)| {
            let one = self.test(part, value)?;
            Ok(self.graph.and(all, one))
        })
    }

    /// Leaves the match of a value that only rustc knows to emitted code, which takes its parts
    /// where it matches.
    fn test_opaque(&mut self, pattern: &Pat, template: &Template) -> Read<Node> {
        if let Pat::Lit(syn::PatLit { lit: Lit::Bool(wanted), .. }) = pattern
            && !template.nodes().is_empty()
        {
            let holds = self.condition(Value::Opaque(template.clone()), pattern);
            return Ok(if wanted.value { holds } else { self.graph.not(holds) });
        }
        if template.has_choice() || self.varies(template) {
            return Err(Unreadable::new(pattern, "a pattern for a value of unknown type"));
        }
        let mut blank = pattern.clone();
        Blank.visit_pat_mut(&mut blank);
        for name in names(pattern) {
            let ident = proc_macro2::Ident::new(&name, super::first_span(pattern));
            let part = Value::Opaque(Template::Part(
                Box::new(template.clone()),
                Box::new(pattern.clone()),
                ident,
            ));
            let part = match self.held_type(template, pattern) {
                Some(ty) => self.typed(part, &ty, pattern)?,
                None => part,
            };
            self.declare(name, part);
        }
        if let Pat::Struct(_) | Pat::TupleStruct(_) | Pat::Tuple(_) = pattern
            && is_open(&blank)
        {
            return Ok(self.graph.bool(true));
        }
        let matches = Template::Matches(Box::new(template.clone()), blank.to_token_stream());
        Ok(self.condition(Value::Opaque(matches), pattern))
    }

    /// Returns the type inside a parameter that is an `Option`, if the pattern is `Some(x)`.
    fn held_type(&self, template: &Template, pattern: &Pat) -> Option<syn::Type> {
        let name = match template {
            Template::Parameter(name) => name,
            Template::Reference(inner) => match &**inner {
                Template::Parameter(name) => name,
                _ => return None,
            },
            _ => return None,
        };
        let Pat::TupleStruct(tuple) = pattern else { return None };
        let simple =
            matches!(tuple.elems.first(), Some(Pat::Ident(ident)) if ident.subpat.is_none());
        let syn::Type::Path(path) = self.parameter_types.get(&name.to_string())? else {
            return None;
        };
        let last = path.path.segments.last().filter(|last| last.ident == "Option" && simple)?;
        let syn::PathArguments::AngleBracketed(given) = &last.arguments else { return None };
        match given.args.first()? {
            syn::GenericArgument::Type(ty)
                if crate::parse::shape(ty).is_some()
                    || ty.to_token_stream().to_string() == "bool" =>
            {
                Some(ty.clone())
            }
            _ => None,
        }
    }

    /// Matches a constant that the body declares.
    fn test_constant(&mut self, pattern: &Pat, value: &Value) -> Read<Node> {
        let name = pattern.to_token_stream().to_string();
        match (self.named(&name), value) {
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
            (Lit::Int(k), Value::Integer(n, _)) => {
                Ok(self.graph.bool(k.base10_parse::<i64>().is_ok_and(|k| k == *n)))
            }
            (Lit::Bool(b), Value::Condition(c)) => {
                Ok(if b.value { *c } else { self.graph.not(*c) })
            }
            (Lit::Float(x), Value::Scalar(n)) => {
                let x = self.graph.decimal(x.base10_digits());
                Ok(self.graph.compare(Comparison::Equal, *n, x))
            }
            (Lit::Float(x), Value::Integer(..)) => {
                let whole = x.base10_parse::<f64>().map_or(0.0, f64::trunc);
                self.mistake(at, format!("the value is an integer: write the pattern `{whole}`"));
                Ok(self.graph.bool(false))
            }
            (Lit::Int(k), Value::Scalar(_)) => {
                self.mistake(
                    at,
                    format!("the value is an f64: write the pattern `{}.0`", k.base10_digits()),
                );
                Ok(self.graph.bool(false))
            }
            _ => Err(Unreadable::new(at, "this pattern")),
        }
    }

    fn test_range(&mut self, range: &syn::PatRange, value: &Value) -> Read<Node> {
        let upper = if matches!(range.limits, RangeLimits::Closed(_)) {
            Comparison::LessEqual
        } else {
            Comparison::Less
        };
        let mut all = self.graph.bool(true);
        for (bound, comparison) in [(&range.start, Comparison::GreaterEqual), (&range.end, upper)] {
            let Some(bound) = bound else { continue };
            let one = match (self.expression(bound)?, value) {
                (Value::Scalar(b), Value::Scalar(n)) => self.graph.compare(comparison, *n, b),
                (Value::Integer(b, _), Value::Integer(n, _)) => {
                    self.graph.bool(comparison.holds(n, &b))
                }
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
