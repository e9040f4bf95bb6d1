//! Patterns: bind variables in `let`, `for` and closures, and test values in `match`.

use syn::Pat;
use syn::visit::Visit;
use syn::visit_mut::{self, VisitMut};

use super::template::Template;
use super::value::Value;
use super::{Read, Reader, Unreadable};

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

    /// Returns a value whose parts a pattern can bind. For `&mut` of a composite value these parts
    /// are references to its parts.
    pub fn outer(&mut self, value: Value) -> Value {
        let Value::Place(place) = &value else { return value.referent() };
        match self.at_place(place) {
            Some(Value::Tuple(all)) => Value::Tuple(
                (0..all.len()).map(|k| Value::Place(place.field(&k.to_string()))).collect(),
            ),
            Some(Value::Array(all)) => {
                Value::Array((0..all.len()).map(|k| Value::Place(place.index(k))).collect())
            }
            Some(Value::Adt(mut adt)) => {
                adt.fields
                    .iter_mut()
                    .for_each(|(name, value)| *value = Value::Place(place.field(name)));
                Value::Adt(adt)
            }
            _ => self.loaded(value),
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
}

/// Returns the name, if there is one, of `..` or `name @ ..`; returns `None` for any other pattern.
pub fn rest_of(pattern: &Pat) -> Option<Option<String>> {
    match pattern {
        Pat::Rest(_) => Some(None),
        Pat::Ident(ident)
            if ident.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_))) =>
        {
            Some(Some(ident.ident.to_string()))
        }
        _ => None,
    }
}

/// Returns true for a name in capitals, which is a constant and no new variable.
pub fn is_constant(name: &syn::Ident) -> bool {
    name.to_string().chars().next().is_some_and(char::is_uppercase)
}

/// Returns true if a pattern binds a variable.
pub fn binds(pattern: &Pat) -> bool {
    !names(pattern).is_empty()
}

/// Returns the variables that a pattern binds, in order.
pub fn names(pattern: &Pat) -> Vec<String> {
    struct Names(Vec<String>);
    impl Visit<'_> for Names {
        fn visit_pat_ident(&mut self, pattern: &syn::PatIdent) {
            if !is_constant(&pattern.ident) && !self.0.contains(&pattern.ident.to_string()) {
                self.0.push(pattern.ident.to_string());
            }
            syn::visit::visit_pat_ident(self, pattern);
        }
    }
    let mut names = Names(Vec::new());
    names.visit_pat(pattern);
    names.0
}

/// The visitor that replaces variables by `_`.
pub struct Blank;

impl VisitMut for Blank {
    fn visit_pat_mut(&mut self, pattern: &mut Pat) {
        if let Pat::Ident(ident) = pattern
            && !is_constant(&ident.ident)
        {
            *pattern = match ident.subpat.take() {
                Some((_, inner)) => *inner,
                None => syn::parse_quote!(_),
            };
        }
        visit_mut::visit_pat_mut(self, pattern);
    }

    fn visit_field_pat_mut(&mut self, field: &mut syn::FieldPat) {
        field.colon_token.get_or_insert_with(Default::default);
        self.visit_pat_mut(&mut field.pat);
    }
}

/// Returns true if a pattern without variables matches every value. A tuple does so if all its
/// parts do.
pub fn is_open(pattern: &Pat) -> bool {
    match pattern {
        Pat::Wild(_) | Pat::Rest(_) => true,
        Pat::Tuple(tuple) => tuple.elems.iter().all(is_open),
        _ => false,
    }
}
