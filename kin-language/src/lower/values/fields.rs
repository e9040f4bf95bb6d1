//! Literals, and parts of values: fields, and elements by their index.

use std::rc::Rc;

use proc_macro2::Ident;
use quote::ToTokens;
use syn::{ExprLit, Lit, Member};

use super::{
    Branching, IntegerType, Read, Template, Unreadable, Value, Values, entry, first_span, position,
};

impl Values {
    /// Reads `base.member`.
    pub fn field(&mut self, base: Value, member: &Member) -> Read {
        let name = member.to_token_stream().to_string();
        let found = match &base {
            Value::Planar(slot) => self.state_field(*slot, 2, &name),
            Value::Spatial(slot) => self.state_field(*slot, 3, &name),
            Value::Vector(v) => {
                position(&name, &["x", "y", "z"][..v.len()]).map(|k| Value::Scalar(v[k]))
            }
            Value::Axis(vectors) => {
                position(&name, &["h", "f", "g"]).map(|k| Value::Vector(vectors[k].clone()))
            }
            Value::Euler(p) => {
                position(&name, &["e0", "e1", "e2", "e3"]).map(|k| Value::Scalar(p[k]))
            }
            Value::Matrix(n, m) => entry(&name, *n).map(|k| Value::Scalar(m[k])),
            Value::Tuple(all) => name.parse::<usize>().ok().and_then(|k| all.get(k).cloned()),
            Value::Adt(adt) => adt.field(&name).cloned(),
            Value::Place(_) | Value::Reference(_) | Value::Choice(_) => {
                let base = self.loaded(base);
                return self.each(base, member, &mut |reader, base| reader.field(base, member));
            }
            Value::Opaque(template) => Some(Value::Opaque(
                template.clone().each(&|part| Template::Field(Box::new(part), member.clone())),
            )),
            Value::Poison | Value::Never | Value::Left => Some(base.clone()),
            _ => None,
        };
        Ok(found.unwrap_or_else(|| {
            let cure = field_cure(&base, &name);
            self.mistake(member, format!("{} has no field `{name}`{cure}", base.name()))
        }))
    }

    /// Returns true for a variant such as `Shape::Flat` of an enum that the body declares.
    pub fn is_own_variant(&self, path: &syn::ExprPath) -> bool {
        let names: Vec<String> = self
            .own
            .whole_path(&path.path)
            .segments
            .iter()
            .map(|segment| segment.ident.to_string())
            .collect();
        let ty = names.iter().rev().nth(1).or(names.last().filter(|_| names.len() == 1));
        ty.is_some_and(|ty| self.own.is_type(ty)) && crate::vocabulary::is_type_name(path)
    }

    /// Returns the variables in scope at a name in small letters.
    pub fn variables_beside(&self, path: &syn::ExprPath) -> Rc<[Ident]> {
        let Some(word) = path.path.get_ident() else { return Rc::from([]) };
        if word.to_string().chars().any(char::is_uppercase) {
            return Rc::from([]);
        }
        let names = self
            .scopes
            .variables()
            .into_iter()
            .filter_map(|name| syn::parse_str::<Ident>(name).ok());
        names.map(|name| name_at_use(name, path)).collect()
    }

    pub fn literal(&mut self, literal: &ExprLit) -> Read {
        match &literal.lit {
            Lit::Float(x) if x.suffix() == "f32" => {
                Ok(self.mistake(x, "write `f64`: Kin computes with `f64` only"))
            }
            Lit::Float(x) => Ok(Value::Scalar(self.graph.decimal(x.base10_digits()))),
            Lit::Int(k) if k.suffix() == "f64" => {
                Ok(Value::Scalar(self.graph.decimal(k.base10_digits())))
            }
            Lit::Int(k) => match k.base10_parse() {
                Ok(value) => Ok(Value::Integer(value, IntegerType::named(k.suffix()))),
                Err(_) => Err(Unreadable::new(k, "an integer of this size")),
            },
            Lit::Bool(b) => Ok(self.truth(b.value)),
            other => Ok(Value::Opaque(Template::Tokens(other.to_token_stream()))),
        }
    }

    pub fn element(&mut self, base: &Value, k: i64, index: &syn::ExprIndex) -> Value {
        let all: Vec<Value> = match base {
            Value::Array(all) => all.clone(),
            Value::Vector(v) | Value::Euler(v) => v.iter().copied().map(Value::Scalar).collect(),
            other => {
                return self.mistake(&index.expr, format!("{} cannot be indexed", other.name()));
            }
        };
        match usize::try_from(k).ok().and_then(|k| all.get(k)) {
            Some(value) => value.clone(),
            None => self.mistake(
                &index.index,
                format!("index {k} is out of range: the value is {}", base.name()),
            ),
        }
    }

    /// Reads an element of an array by an index that only the running program knows: the value is a
    /// choice among all elements.
    pub fn element_at_run_time(
        &mut self,
        base: &Value,
        at: Template,
        index: &syn::ExprIndex,
    ) -> Read {
        match base.numbers() {
            Some((nodes, shape)) if !at.has_choice() => {
                let all = Template::Numbers(nodes, shape, first_span(&index.expr));
                Ok(Value::Opaque(Template::Index(Box::new(all), Box::new(at))))
            }
            _ => Err(Unreadable::new(&index.index, "an unknown index")),
        }
    }
}

pub fn field_cure(base: &Value, name: &str) -> &'static str {
    match (base, name) {
        (Value::Planar(_), "x" | "y") | (Value::Spatial(_), "x" | "y" | "z") => {
            ": write `.r.x` and `.r.y` for the origin"
        }
        (Value::Planar(_), "a") => ": write `.a()` for the rotation matrix",
        (Value::Planar(_), _) => {
            ": the fields are `r` and `theta`, the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`"
        }
        (Value::Spatial(_), "theta") => ": write `p` for the Euler parameters of a spatial body",
        (Value::Spatial(_), _) => {
            ": the fields are `r` and `p`, the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`"
        }
        (Value::Axis(_), _) => ": the fields are `h`, and `f` and `g` across `h`",
        (Value::Vector(v), _) if v.len() == 2 => ": the fields are `x` and `y`",
        (Value::Vector(_), _) => ": the fields are `x`, `y` and `z`",
        (Value::Euler(_), _) => ": the fields are `e0`, `e1`, `e2` and `e3`",
        (Value::Law(_), _) => ": write `.at(x)` for a value",
        _ => "",
    }
}

/// Returns the name of a parameter with the span of its use in the body, for messages.
pub fn name_at_use(mut name: syn::Ident, path: &syn::ExprPath) -> syn::Ident {
    if let Some(word) = path.path.get_ident() {
        name.set_span(word.span());
    }
    name
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Adt, Value, Values};
    use kin_graph::Graph;

    #[test]
    fn a_value_has_the_fields_of_its_kind() {
        let mut values = Values::new(Graph::default());
        let x = values.graph.constant(1.0);
        let y = values.graph.constant(2.0);
        let vector = Value::Vector(vec![x, y]);
        let field = values.field(vector.clone(), &syn::parse_quote!(y));
        assert!(matches!(field, Ok(Value::Scalar(n)) if n == y));
        let some = Value::Adt(Adt::new("Some", Some(vector.clone())));
        assert!(matches!(values.field(some, &syn::parse_quote!(0)), Ok(Value::Vector(_))));
        assert!(values.mistakes.is_empty());
        assert!(matches!(values.field(vector, &syn::parse_quote!(z)), Ok(Value::Poison)));
        assert!(!values.mistakes.is_empty());
    }
}
