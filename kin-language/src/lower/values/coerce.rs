//! Converts values to the type that a place needs: a number, a vector, a condition. An opaque value
//! gets the type of its place, and is a number where the place gives none.

use quote::{ToTokens, quote};
use syn::{BinOp, Type, UnOp};

use super::{IntegerType, Read, Template, Unreadable, Value, Values, first_span, integer};
use crate::lower::opaque::{OpaqueKind, guarded};
use crate::parse::Shape;
use crate::vocabulary::last_name;
use kin_graph::{Input, LeafNumber, Node, Part};

impl Values {
    /// Returns a number; anything else is a mistake at `at` and gives a substitute number.
    pub fn scalar(&mut self, value: Value, at: &dyn ToTokens) -> Node {
        match self.shaped(value, &Shape::Scalar, at) {
            Value::Scalar(node) => node,
            _ => self.poison(),
        }
    }

    /// Returns a vector of `n` components, or reports a mistake at `at`.
    pub fn vector(&mut self, value: Value, n: usize, at: &dyn ToTokens) -> Vec<Node> {
        match self.shaped(value, &Shape::Vector(n), at) {
            Value::Vector(nodes) => nodes,
            _ => vec![self.poison(); n],
        }
    }

    /// Returns a vector, also from an array or tuple that converts into one.
    pub fn convertible(&mut self, value: Value, n: usize, at: &dyn ToTokens) -> Vec<Node> {
        match self.loaded(value) {
            Value::Array(all) | Value::Tuple(all) if all.len() == n => {
                all.into_iter().map(|part| self.scalar(part, at)).collect()
            }
            value => self.vector(value, n, at),
        }
    }

    /// Returns an index or a count. `remarks` are the texts for one out of range, and for one that
    /// is unknown.
    pub fn index_of(value: &Value, at: &dyn ToTokens, remarks: [&str; 2]) -> Read<usize> {
        match value {
            Value::Integer(k, _) => {
                usize::try_from(*k).map_err(|_| Unreadable::new(at, remarks[0]))
            }
            _ => Err(Unreadable::new(at, remarks[1])),
        }
    }

    /// Returns the substitute for a number after a mistake. It depends on a coordinate, so that no
    /// second message follows.
    pub fn poison(&mut self) -> Node {
        self.graph.input(Input::State(0, Part::Theta))
    }

    /// Returns a condition, or reports a mistake at `at`.
    pub fn condition(&mut self, value: Value, at: &dyn ToTokens) -> Node {
        match self.loaded(value) {
            Value::Condition(node) => node,
            Value::Choice(all) => {
                let never = self.graph.bool(false);
                all.into_iter().fold(never, |any, (taken, value)| {
                    let holds = self.condition(value, at);
                    let both = self.graph.and(taken, holds);
                    self.graph.or(any, both)
                })
            }
            Value::Opaque(Template::Choice(condition, a, b)) => {
                let a = self.condition(Value::Opaque(*a), at);
                let b = self.condition(Value::Opaque(*b), at);
                let yes = self.graph.and(condition, a);
                let not = self.graph.not(condition);
                let no = self.graph.and(not, b);
                self.graph.or(yes, no)
            }
            Value::Opaque(template) => self.opaque(template, OpaqueKind::Condition)[0],
            Value::Poison | Value::Never | Value::Left => self.graph.bool(true),
            other => {
                self.mistake(
                    at,
                    format!("expected a condition (bool), but found {}", other.name()),
                );
                self.graph.bool(true)
            }
        }
    }

    /// Returns a value of `shape`, or reports a mistake at `at`.
    pub fn shaped(&mut self, value: Value, shape: &Shape, at: &dyn ToTokens) -> Value {
        match (value, shape) {
            (Value::Reference(inner), shape) => self.shaped(*inner, shape, at),
            (value @ Value::Place(_), shape) => {
                let value = self.loaded(value);
                self.shaped(value, shape, at)
            }
            (Value::Choice(all), shape) => self.shaped_choice(all, shape, at),
            (Value::Poison | Value::Left, _) => Value::Poison,
            (Value::Never, shape) => self.nowhere(shape),
            (value, Shape::Any) => value,
            (Value::Scalar(n), Shape::Scalar) => Value::Scalar(n),
            (Value::Into(inner), shape) => self.converted(*inner, shape, at),
            (Value::Array(all), Shape::Array(inner, n)) if all.len() == *n => {
                Value::Array(all.into_iter().map(|v| self.shaped(v, inner, at)).collect())
            }
            (Value::Tuple(all), Shape::Tuple(shapes)) if all.len() == shapes.len() => Value::Tuple(
                all.into_iter().zip(shapes).map(|(v, s)| self.shaped(v, s, at)).collect(),
            ),
            (Value::Opaque(template), shape) => self.opaque_shaped(template, shape, at),
            (Value::Integer(k, _), Shape::Scalar) => {
                self.mistake(at, crate::error::integer_for_a_number(at, k))
            }
            (Value::Law(_), Shape::Scalar) => {
                let name = at.to_token_stream();
                self.mistake(at, format!("`{name}` is a Law: get a value with `{name}.at(x)`"))
            }
            (Value::Euler(_), Shape::Vector(_)) => self.mistake(
                at,
                "Euler parameters are not a vector: write `p.vector()` for (e1, e2, e3)",
            ),
            (value, shape)
                if value.components().is_some_and(|(kind, _)| kind.shape() == *shape) =>
            {
                value
            }
            (other, shape) => {
                self.mistake(at, format!("expected {}, but found {}", shape.name(), other.name()))
            }
        }
    }

    /// Converts each of several possible values to the shape of the place.
    pub fn shaped_choice(
        &mut self,
        all: Vec<(Node, Value)>,
        shape: &Shape,
        at: &dyn ToTokens,
    ) -> Value {
        let mut rest = all.into_iter().rev();
        let Some((_, last)) = rest.next() else { return Value::Poison };
        let mut joined = self.shaped(last, shape, at);
        for (taken, value) in rest {
            let value = self.shaped(value, shape, at);
            joined = self.select(taken, &value, &joined).unwrap_or(Value::Poison);
        }
        joined
    }

    /// Reads `value.into()` at a place of `shape`.
    pub fn converted(&mut self, value: Value, shape: &Shape, at: &dyn ToTokens) -> Value {
        match (self.loaded(value), shape) {
            (Value::Vector(v), Shape::Array(inner, n))
                if **inner == Shape::Scalar && v.len() == *n =>
            {
                Value::Array(v.into_iter().map(Value::Scalar).collect())
            }
            (Value::Integer(k, _), Shape::Scalar) => Value::Scalar(self.graph.constant(k as f64)),
            (value, Shape::Vector(n)) => Value::Vector(self.convertible(value, *n, at)),
            (value, shape) => self.shaped(value, shape, at),
        }
    }

    /// Returns a value of `shape` whose numbers are NaN, where no value exists.
    pub fn nowhere(&mut self, shape: &Shape) -> Value {
        let nan = self.graph.constant(f64::NAN);
        Value::from_numbers(shape, &mut std::iter::repeat(nan)).unwrap_or(Value::Never)
    }

    /// Converts an opaque value to `shape`; its nodes belong to the expression that made it.
    pub fn opaque_shaped(&mut self, template: Template, shape: &Shape, at: &dyn ToTokens) -> Value {
        let first = self.graph.len();
        let expression = self.expressions.of_template(&template);
        let value = self.computed(template, shape, at);
        if let Some(expression) = expression {
            self.expressions.give(first..self.graph.len(), expression);
        }
        value
    }

    /// Computes arithmetic with values of the graph in the graph, and any other template as a
    /// whole.
    pub fn computed(&mut self, template: Template, shape: &Shape, at: &dyn ToTokens) -> Value {
        let known = !template.nodes().is_empty();
        let scalar = *shape == Shape::Scalar;
        let components = matches!(shape, Shape::Vector(_) | Shape::Matrix(_) | Shape::Euler);
        match template {
            Template::Numbers(nodes, own, _) if own == *shape => {
                Value::from_numbers(shape, &mut nodes.into_iter()).unwrap_or(Value::Poison)
            }
            Template::Binary(a, op, b)
                if known && (scalar && is_arithmetic(&op) || components && is_sum(&op)) =>
            {
                let a = self.opaque_shaped(*a, shape, at);
                let b = self.opaque_shaped(*b, shape, at);
                self.combined(op, &a, &b, at)
            }
            Template::Binary(a, op @ BinOp::Mul(_), b) if components && is_number(&a) => {
                let a = self.opaque_shaped(*a, &Shape::Scalar, at);
                let b = self.opaque_shaped(*b, shape, at);
                self.combined(op, &a, &b, at)
            }
            Template::Binary(a, op @ (BinOp::Mul(_) | BinOp::Div(_)), b)
                if components && is_number(&b) =>
            {
                let a = self.opaque_shaped(*a, shape, at);
                let b = self.opaque_shaped(*b, &Shape::Scalar, at);
                self.combined(op, &a, &b, at)
            }
            Template::Choice(condition, a, b) => {
                let a = self.opaque_shaped(*a, shape, at);
                let b = self.opaque_shaped(*b, shape, at);
                self.select(condition, &a, &b).unwrap_or(Value::Poison)
            }
            Template::Unary(UnOp::Neg(_), a) if known && (scalar || components) => {
                let a = self.opaque_shaped(*a, shape, at);
                self.negated(a)
            }
            Template::Parameter(name)
                if scalar && self.signature.no_numbers.contains_key(&name.to_string()) =>
            {
                let ty = self.signature.no_numbers[&name.to_string()].clone();
                let cure = if ty == "bool" {
                    format!("if {name} {{ … }} else {{ … }}")
                } else {
                    format!("{name} as f64")
                };
                self.mistake(&name, format!("`{name}` is a `{ty}`: write `{cure}` for a number"))
            }
            template => {
                let nodes = self.opaque(template, OpaqueKind::Numbers(shape.clone()));
                Value::from_numbers(shape, &mut nodes.into_iter()).unwrap_or(Value::Poison)
            }
        }
    }

    /// Returns true if a template depends on a coordinate or on time.
    pub fn varies(&self, template: &Template) -> bool {
        template.nodes().iter().any(|&n| self.graph.depends(n).varies())
    }

    /// Returns the components of an opaque value. If it depends on coordinates or time it is a leaf
    /// of the graph, which emitted code calls with numbers that carry derivatives.
    pub fn opaque(&mut self, template: Template, kind: OpaqueKind) -> Vec<Node> {
        let count = if let OpaqueKind::Numbers(shape) = &kind { shape.count() } else { 1 };
        let g = &mut self.graph;
        let varies = template.nodes().iter().any(|&n| g.depends(n).varies());
        if kind != OpaqueKind::Condition && varies {
            let number = self.parts.leaf(g, template, kind);
            return (0..count).map(|k| g.leaf_output(number, k, LeafNumber::Value)).collect();
        }
        let template = guarded(g, template, self.flow.conditions());
        let number = self.parts.opaque(g, template, kind);
        (0..count).map(|k| g.opaque(number, k)).collect()
    }

    /// Returns a value as a template, for an expression that only rustc knows.
    pub fn template(&mut self, value: Value, at: &dyn ToTokens) -> Read<Template> {
        if let Some((nodes, shape)) = value.numbers()
            && !matches!(value, Value::Reference(_))
        {
            return Ok(Template::Numbers(nodes, shape, first_span(at)));
        }
        Ok(match value {
            Value::Opaque(template) if template.has_choice() => {
                return Err(Unreadable::new(
                    at,
                    "one of two values of unknown type passed to a user-defined function",
                ));
            }
            Value::Opaque(template) | Value::Law(template) => template,
            Value::Reference(inner) => Template::Reference(Box::new(self.template(*inner, at)?)),
            Value::Place(_) => {
                return Err(Unreadable::new(at, "`&mut` passed to a user-defined function"));
            }
            Value::Adt(adt) if self.own.is_type(&adt.type_name()) => {
                return Err(Unreadable::new(
                    at,
                    "a value of a type that is declared in the function body",
                ));
            }
            Value::Adt(adt) => {
                let fields = adt
                    .fields
                    .into_iter()
                    .map(|(name, value)| Ok((name, self.template(value, at)?)))
                    .collect::<Read<_>>()?;
                Template::Struct(adt.path, fields, adt.braces)
            }
            Value::Planar(slot) => self.state_template(slot, 2, at),
            Value::Spatial(slot) => self.state_template(slot, 3, at),
            Value::Tuple(parts) => Template::Tuple(self.templates(parts, at)?),
            Value::Array(parts) => Template::Array(self.templates(parts, at)?),
            Value::Integer(k, _) => {
                let mut k = proc_macro2::Literal::i64_unsuffixed(k);
                k.set_span(first_span(at));
                Template::Tokens(quote!(#k))
            }
            Value::Poison => Template::Tokens(quote!(())),
            Value::Condition(node) if self.graph.truth(node).is_some() => {
                let truth = self.graph.truth(node) == Some(true);
                Template::Tokens(quote!(#truth))
            }
            other => {
                return Err(Unreadable::new(
                    at,
                    format!("{} passed to a user-defined function", other.name()),
                ));
            }
        })
    }

    /// Returns the template of the state of a planar or spatial body, with all its numbers.
    pub fn state_template(&mut self, slot: usize, n: usize, at: &dyn ToTokens) -> Template {
        let mut nodes = self.origin(slot, n);
        if n == 2 {
            let turn = [Part::Theta, Part::Sin, Part::Cos];
            nodes.extend(turn.map(|part| self.graph.input(Input::State(slot, part))));
        } else {
            nodes.extend(self.euler_parameters(slot));
            nodes.extend(self.rotation(slot, 3));
        }
        Template::State(nodes, n, first_span(at))
    }

    pub fn templates(&mut self, parts: Vec<Value>, at: &dyn ToTokens) -> Read<Vec<Template>> {
        parts.into_iter().map(|part| self.template(part, at)).collect()
    }

    /// Returns true if a value depends on coordinates or time.
    pub fn value_varies(&self, value: &Value) -> bool {
        let numbers = value.clone().referent().numbers();
        numbers
            .is_some_and(|(nodes, _)| nodes.iter().any(|&node| self.graph.depends(node).varies()))
    }

    /// Reports a function of f64 without a derivative, such as `to_bits`, on a value that depends
    /// on coordinates or time.
    pub fn no_derivative(&mut self, function: &str, at: &dyn ToTokens) -> Value {
        self.mistake(
            at,
            format!("`{function}` has no derivative, but the value depends on coordinates or time"),
        )
    }

    pub fn typed_integer(&mut self, value: Value, name: &str, at: &dyn ToTokens) -> Read {
        match self.loaded(value) {
            Value::Integer(k, known) => match IntegerType::named(name) {
                Some(ty) => integer::typed(k, known, ty)
                    .ok_or_else(|| Unreadable::new(at, format!("`{k}` as {name}"))),
                None => Ok(Value::Integer(k, known)),
            },
            value @ (Value::Opaque(_) | Value::Never | Value::Poison) => Ok(value),
            Value::Into(_) => Err(Unreadable::new(at, "a conversion into an integer")),
            other => Ok(self.mistake(at, format!("expected {name}, but found {}", other.name()))),
        }
    }

    /// Returns true if a value holds only constants of the graph.
    pub fn is_known(&self, value: &Value) -> bool {
        match value {
            Value::Integer(..) | Value::Function(_) => true,
            Value::Condition(node) => self.graph.is_number(*node),
            Value::Reference(inner) => self.is_known(inner),
            Value::Array(all) | Value::Tuple(all) => all.iter().all(|part| self.is_known(part)),
            Value::Adt(adt) => adt.fields.iter().all(|(_, part)| self.is_known(part)),
            value => value
                .numbers()
                .is_some_and(|(nodes, _)| nodes.iter().all(|&n| self.graph.is_number(n))),
        }
    }
}

pub fn is_sum(op: &BinOp) -> bool {
    matches!(op, BinOp::Add(_) | BinOp::Sub(_))
}

pub fn is_arithmetic(op: &BinOp) -> bool {
    is_sum(op) || matches!(op, BinOp::Mul(_) | BinOp::Div(_) | BinOp::Rem(_))
}

pub fn is_number(template: &Template) -> bool {
    matches!(template, Template::Numbers(_, Shape::Scalar, _))
}

/// Returns the last name of a type's path.
pub fn named(ty: &Type) -> String {
    match ty {
        Type::Path(path) => last_name(&path.path),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::opaque::Template;
    use kin_graph::Graph;

    #[test]
    fn an_integer_is_no_number_but_converts_into_one() {
        let mut values = Values::new(Graph::default());
        let at = quote!(2);
        let two = Value::Into(Box::new(Value::Integer(2, None)));
        let node = values.scalar(two, &at);
        assert_eq!(values.graph.constant_value(node), Some(2.0));
        assert!(values.mistakes.is_empty());
        values.scalar(Value::Integer(2, None), &at);
        assert!(!values.mistakes.is_empty());
    }

    #[test]
    fn an_opaque_value_gets_the_shape_of_its_place() {
        let mut values = Values::new(Graph::default());
        let opaque = Value::Opaque(Template::Tokens(quote!(K)));
        assert_eq!(values.vector(opaque.clone(), 3, &quote!(K)).len(), 3);
        values.condition(opaque, &quote!(K));
        assert_eq!(values.parts.opaques.len(), 2);
    }
}
