//! Converts values to the type that a place needs: a number, a vector, a condition, or a value of a
//! declared type. An opaque value gets the type of its place, and is a number where the place gives
//! none.

use quote::{ToTokens, quote};
use syn::{BinOp, UnOp};

use crate::parse::Shape;
use kin_graph::{Input, LeafNumber, Node, Part};

use super::template::Template;
use super::value::Value;
use super::{OpaqueKind, OpaqueValue, Read, Reader, Unreadable};

impl Reader {
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

    /// Returns the substitute for a number after a mistake. It depends on a coordinate, so that no
    /// second message follows.
    fn poison(&mut self) -> Node {
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
    fn shaped_choice(
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
    fn converted(&mut self, value: Value, shape: &Shape, at: &dyn ToTokens) -> Value {
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
    fn opaque_shaped(&mut self, template: Template, shape: &Shape, at: &dyn ToTokens) -> Value {
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
    fn computed(&mut self, template: Template, shape: &Shape, at: &dyn ToTokens) -> Value {
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
                if scalar && self.no_numbers.contains_key(&name.to_string()) =>
            {
                let ty = self.no_numbers[&name.to_string()].clone();
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
    fn opaque(&mut self, template: Template, kind: OpaqueKind) -> Vec<Node> {
        let count = if let OpaqueKind::Numbers(shape) = &kind { shape.count() } else { 1 };
        if kind != OpaqueKind::Condition && self.varies(&template) {
            return self.leaf(template, kind, count);
        }
        let template = self.guarded(template);
        let nodes = template.nodes();
        let key = format!("{} as {kind:?}", template.key());
        let number = *self.opaque_index.entry(key).or_insert_with(|| {
            self.opaques.push(OpaqueValue { template, kind });
            self.graph.opaques.push(nodes);
            self.opaques.len() - 1
        });
        (0..count).map(|k| self.graph.opaque(number, k)).collect()
    }

    /// Guards a template that may panic: emitted code does not compute it where a branch around it
    /// is not taken, as far as that depends on parameters only.
    fn guarded(&mut self, template: Template) -> Template {
        if !template.may_panic() {
            return template;
        }
        let always = self.graph.bool(true);
        let conditions: Vec<Node> = self.path.iter().map(|guard| guard.holds).collect();
        let constant =
            conditions.into_iter().filter(|&c| !self.graph.depends(c).varies()).collect::<Vec<_>>();
        let all = constant.into_iter().fold(always, |all, c| self.graph.and(all, c));
        match self.graph.truth(all) {
            Some(_) => template,
            None => Template::When(all, Box::new(template)),
        }
    }

    fn leaf(&mut self, template: Template, kind: OpaqueKind, count: usize) -> Vec<Node> {
        let key = format!("{} as {kind:?}", template.key());
        let number = match self.leaf_index.get(&key) {
            Some(&number) => number,
            None => {
                let number = self.graph.leaf(self.leaves.len(), template.nodes());
                self.leaves.push(OpaqueValue { template, kind });
                self.leaf_index.insert(key, number);
                number
            }
        };
        (0..count).map(|k| self.graph.leaf_output(number, k, LeafNumber::Value)).collect()
    }

    /// Returns a value as a template, for an expression that only rustc knows.
    pub fn template(&mut self, value: Value, at: &dyn ToTokens) -> Read<Template> {
        if let Some((nodes, shape)) = value.numbers()
            && !matches!(value, Value::Reference(_))
        {
            return Ok(Template::Numbers(nodes, shape, super::first_span(at)));
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
                k.set_span(super::first_span(at));
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
}

impl Reader {
    /// Returns the template of the state of a planar or spatial body, with all its numbers.
    fn state_template(&mut self, slot: usize, n: usize, at: &dyn ToTokens) -> Template {
        let mut nodes = self.origin(slot, n);
        if n == 2 {
            let turn = [Part::Theta, Part::Sin, Part::Cos];
            nodes.extend(turn.map(|part| self.graph.input(Input::State(slot, part))));
        } else {
            nodes.extend(self.euler_parameters(slot));
            nodes.extend(self.rotation(slot, 3));
        }
        Template::State(nodes, n, super::first_span(at))
    }

    fn templates(&mut self, parts: Vec<Value>, at: &dyn ToTokens) -> Read<Vec<Template>> {
        parts.into_iter().map(|part| self.template(part, at)).collect()
    }
}

fn is_sum(op: &BinOp) -> bool {
    matches!(op, BinOp::Add(_) | BinOp::Sub(_))
}

pub fn is_arithmetic(op: &BinOp) -> bool {
    is_sum(op) || matches!(op, BinOp::Mul(_) | BinOp::Div(_) | BinOp::Rem(_))
}

fn is_number(template: &Template) -> bool {
    matches!(template, Template::Numbers(_, Shape::Scalar, _))
}
