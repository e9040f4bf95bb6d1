//! Patterns: binds their variables in `let`, `for` and closures, and tests values in `match`.

use quote::ToTokens;
use syn::visit_mut::VisitMut;
use syn::{Lit, Pat, RangeLimits};

use super::Reader;
use crate::lower::values::{
    Adt, Blank, Read, Template, Unreadable, Value, binds, first_span, is_constant, is_open, names,
    rest_of,
};
use kin_graph::{Comparison, Node};

impl Reader {
    /// Binds the variables of an irrefutable pattern.
    pub fn bind(&mut self, pattern: &Pat, value: Value) -> Read<()> {
        match pattern {
            Pat::Wild(_) => Ok(()),
            Pat::Ident(ident) => {
                let value =
                    if ident.by_ref.is_some() { Value::Reference(Box::new(value)) } else { value };
                if let Some((_, inner)) = &ident.subpat {
                    self.bind(inner, value.clone())?;
                }
                self.declare_bound(&ident.ident, ident.mutability.is_some(), value);
                Ok(())
            }
            Pat::Type(typed) => {
                let value = self.typed(value, &typed.ty, typed)?;
                self.bind(&typed.pat, value)
            }
            Pat::Paren(inner) => self.bind(&inner.pat, value),
            Pat::Reference(inner) => match value {
                Value::Reference(value) => self.bind(&inner.pat, *value),
                value => {
                    let value = self.loaded(value);
                    self.bind(&inner.pat, value)
                }
            },
            pattern => match self.outer(value) {
                Value::Unassigned => names(pattern).into_iter().try_for_each(|name| {
                    self.declare(name, Value::Unassigned);
                    Ok(())
                }),
                value => self.bind_parts(pattern, value),
            },
        }
    }

    fn bind_parts(&mut self, pattern: &Pat, value: Value) -> Read<()> {
        match pattern {
            Pat::Tuple(tuple) => self.bind_all(pattern, tuple.elems.iter(), value, "a tuple"),
            Pat::Slice(slice) => self.bind_all(pattern, slice.elems.iter(), value, "an array"),
            Pat::Struct(fields) if !matches!(value, Value::Choice(_)) => {
                self.bind_fields(fields, value)
            }
            Pat::TupleStruct(_) | Pat::Struct(_) | Pat::Or(_) => {
                self.test(pattern, &value).map(drop)
            }
            other => Err(Unreadable::new(other, "this pattern")),
        }
    }

    fn bind_all<'a>(
        &mut self,
        at: &Pat,
        parts: impl Iterator<Item = &'a Pat>,
        value: Value,
        what: &str,
    ) -> Read<()> {
        let parts: Vec<&Pat> = parts.collect();
        let mut values = match value {
            Value::Tuple(all) if what == "a tuple" => all,
            Value::Array(all) if what == "an array" => all,
            Value::Poison | Value::Never | Value::Left => {
                return parts.into_iter().try_for_each(|part| self.bind_nothing(part));
            }
            Value::Opaque(template)
                if what == "a tuple"
                    && !template.has_choice()
                    && parts.iter().all(|part| rest_of(part).is_none()) =>
            {
                let member = |k: usize| syn::Member::Unnamed(k.into());
                (0..parts.len())
                    .map(|k| Value::Opaque(Template::Field(Box::new(template.clone()), member(k))))
                    .collect()
            }
            Value::Opaque(_) | Value::Generator(_) | Value::Choice(_) => {
                return Err(Unreadable::new(at, "a pattern for a value of unknown type"));
            }
            other => {
                self.mistake(
                    at,
                    format!("the pattern takes apart {what}, but the value is {}", other.name()),
                );
                return parts.into_iter().try_for_each(|part| self.bind_nothing(part));
            }
        };
        let rest = parts.iter().position(|part| rest_of(part).is_some());
        let fits = rest.map_or(parts.len() == values.len(), |_| parts.len() <= values.len() + 1);
        if !fits {
            self.mistake(
                at,
                format!(
                    "the pattern takes apart {what} of {}, but the value has {}",
                    parts.len(),
                    values.len()
                ),
            );
            return parts.into_iter().try_for_each(|part| self.bind_nothing(part));
        }
        let Some(rest) = rest else {
            return parts
                .into_iter()
                .zip(values)
                .try_for_each(|(part, value)| self.bind(part, value));
        };
        let after = values.split_off(values.len() - (parts.len() - rest - 1));
        let middle = values.split_off(rest);
        parts[..rest].iter().zip(values).try_for_each(|(part, value)| self.bind(part, value))?;
        if let Some(Some(name)) = rest_of(parts[rest]) {
            self.declare(name, Value::Array(middle));
        }
        parts[rest + 1..].iter().zip(after).try_for_each(|(part, value)| self.bind(part, value))
    }

    /// Binds the variables of a pattern after a mistake.
    fn bind_nothing(&mut self, pattern: &Pat) -> Read<()> {
        match rest_of(pattern) {
            Some(_) => Ok(()),
            None => self.bind(pattern, Value::Poison),
        }
    }

    /// Binds `let Vec2 { x, y } = v`.
    pub fn bind_fields(&mut self, pattern: &syn::PatStruct, value: Value) -> Read<()> {
        for field in &pattern.fields {
            let part = self.field(value.clone(), &field.member)?;
            self.bind(&field.pat, part)?;
        }
        Ok(())
    }

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
            let ident = proc_macro2::Ident::new(&name, first_span(pattern));
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
    fn a_pattern_takes_a_value_apart() {
        let (_, value) = read(syn::parse_quote!({
            let (a, [b, ..]) = (1, [2, 3]);
            match (a, b) {
                (2.., _) => 0,
                (1, k @ 2) => k * 10,
                _ => 1,
            }
        }));
        assert!(matches!(value, Some(Value::Integer(20, _))));
        let (reader, _) = read(syn::parse_quote!({
            let (a, b) = (1.0, 2.0, 3.0);
            a
        }));
        assert!(!reader.mistakes.is_empty());
    }
}
