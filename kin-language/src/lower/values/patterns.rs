//! Patterns: their variables, and tests of constants.

use quote::ToTokens;
use syn::visit::Visit;
use syn::visit_mut::VisitMut;
use syn::{Lit, Pat, visit_mut};

use super::{Read, Template, Unreadable, Value, Values};
use crate::vocabulary::type_argument;
use kin_graph::{Comparison, Node};

impl Values {
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

    /// Returns the type inside a parameter that is an `Option`, if the pattern is `Some(x)`.
    pub fn held_type(&self, template: &Template, pattern: &Pat) -> Option<syn::Type> {
        let inner = if let Template::Reference(inner) = template { inner } else { template };
        let Template::Parameter(name) = inner else { return None };
        let Pat::TupleStruct(tuple) = pattern else { return None };
        let simple =
            matches!(tuple.elems.first(), Some(Pat::Ident(ident)) if ident.subpat.is_none());
        let syn::Type::Path(path) = self.signature.parameter_types.get(&name.to_string())? else {
            return None;
        };
        path.path.segments.last().filter(|last| last.ident == "Option" && simple)?;
        let is_read = |ty: &&syn::Type| {
            crate::parse::shape(ty).is_some() || ty.to_token_stream().to_string() == "bool"
        };
        type_argument(&path.path).filter(is_read).cloned()
    }

    /// Matches a constant that the body declares.
    pub fn test_constant(&mut self, pattern: &Pat, value: &Value) -> Read<Node> {
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

    pub fn test_literal(&mut self, literal: &Lit, value: &Value, at: &Pat) -> Read<Node> {
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

/// Returns true if a pattern without variables matches every value. A tuple does so if all its
/// parts do.
pub fn is_open(pattern: &Pat) -> bool {
    match pattern {
        Pat::Wild(_) | Pat::Rest(_) => true,
        Pat::Tuple(tuple) => tuple.elems.iter().all(is_open),
        _ => false,
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_binds_its_small_names() {
        let arm: syn::Arm = syn::parse_quote!(Some((x, MOST, rest @ ..)) => 1);
        assert_eq!(names(&arm.pat), ["x", "rest"]);
        let arm: syn::Arm = syn::parse_quote!((_, ..) => 1);
        assert!(is_open(&arm.pat) && !binds(&arm.pat));
    }
}
