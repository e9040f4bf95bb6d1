//! From values to what a place asks for: a number, a vector, a condition. An opaque value becomes what its place says; unless a place says
//! otherwise it is a number.

use quote::{ToTokens, quote};

use crate::graph::{LeafNumber, Node};
use crate::parse::Shape;

use super::value::{Template, Value};
use super::{OpaqueKind, OpaqueValue, Reader};

impl Reader {
    /// A number; a mistake at `at` (and zero) if it is something else.
    pub fn scalar(&mut self, value: Value, at: &dyn ToTokens) -> Node {
        match self.shaped(value, &Shape::Scalar, at) {
            Value::Scalar(node) => node,
            _ => self.poison(),
        }
    }

    /// A vector of `n` components, or a mistake at `at`.
    pub fn vector(&mut self, value: Value, n: usize, at: &dyn ToTokens) -> Vec<Node> {
        match self.shaped(value, &Shape::Vector(n), at) {
            Value::Vector(nodes) => nodes,
            _ => vec![self.poison(); n],
        }
    }

    /// Stands for a number after a mistake; depends on a coordinate, so that no second message follows from it.
    fn poison(&mut self) -> Node {
        self.graph.input(crate::graph::Input::State(0, crate::graph::Part::Theta))
    }

    /// A condition, or a mistake at `at`.
    pub fn condition(&mut self, value: Value, at: &dyn ToTokens) -> Node {
        match value {
            Value::Condition(node) => node,
            Value::Opaque(template) => self.opaque(template, OpaqueKind::Condition, at)[0],
            Value::Poison => self.graph.bool(true),
            other => {
                self.mistake(at, format!("this must be a condition (bool), but it is {}", other.name()));
                self.graph.bool(true)
            }
        }
    }

    /// A value of `shape`, or a mistake at `at`.
    pub fn shaped(&mut self, value: Value, shape: &Shape, at: &dyn ToTokens) -> Value {
        match (value, shape) {
            (Value::Poison, _) => Value::Poison,
            (value, Shape::Any) => value,
            (Value::Scalar(n), Shape::Scalar) => Value::Scalar(n),
            (Value::Vector(v), Shape::Vector(n)) if v.len() == *n => Value::Vector(v),
            (Value::Matrix(m, v), Shape::Matrix(n)) if m == *n => Value::Matrix(m, v),
            (Value::Array(all), Shape::Array(inner, n)) if all.len() == *n => {
                Value::Array(all.into_iter().map(|v| self.shaped(v, inner, at)).collect())
            }
            (Value::Tuple(all), Shape::Tuple(shapes)) if all.len() == shapes.len() => {
                Value::Tuple(all.into_iter().zip(shapes).map(|(v, s)| self.shaped(v, s, at)).collect())
            }
            (Value::Opaque(template), shape) => self.opaque_shaped(template, shape, at),
            (Value::Combined(terms), shape) => self.combined(terms, shape, at),
            (Value::Integer(k), Shape::Scalar) => self.mistake(at, format!("`{k}` is an integer; a number is written `{k}.0`")),
            (Value::Law(_), Shape::Scalar) => {
                let name = at.to_token_stream();
                self.mistake(at, format!("`{name}` is a Law: ask it for a value with `{name}.at(x)`"))
            }
            (Value::Euler(_), Shape::Vector(_)) => self.mistake(at, "Euler parameters are not a vector; `p.vector()` is (e1, e2, e3)"),
            (other, shape) => self.mistake(at, format!("expected {}, but this is {}", shape.name(), other.name())),
        }
    }

    /// Σ opaque · factor, every term of `shape`.
    fn combined(&mut self, terms: Vec<(Template, Node)>, shape: &Shape, at: &dyn ToTokens) -> Value {
        let zero = self.graph.zero();
        let mut sum = vec![zero; shape.len()];
        for (template, factor) in terms {
            let nodes = self.opaque(template, OpaqueKind::Numbers(shape.clone()), at);
            for (place, node) in sum.iter_mut().zip(nodes) {
                let product = self.graph.mul(node, factor);
                *place = self.graph.add(*place, product);
            }
        }
        Value::from_numbers(shape, &mut sum.into_iter()).unwrap_or(Value::Poison)
    }

    fn opaque_shaped(&mut self, template: Template, shape: &Shape, at: &dyn ToTokens) -> Value {
        let nodes = self.opaque(template, OpaqueKind::Numbers(shape.clone()), at);
        Value::from_numbers(shape, &mut nodes.into_iter()).unwrap_or(Value::Poison)
    }

    /// Components of an opaque value. Where it depends on coordinates or time it is a leaf, called with numbers that carry derivatives.
    fn opaque(&mut self, template: Template, kind: OpaqueKind, at: &dyn ToTokens) -> Vec<Node> {
        let nodes = template.nodes();
        let count = if let OpaqueKind::Numbers(shape) = &kind { shape.len() } else { 1 };
        let key = format!("{} as {kind:?}", key(&template));
        if kind != OpaqueKind::Condition && nodes.iter().any(|&n| self.graph.depends(n).varies()) {
            return self.leaf(template, kind, key, count, at);
        }
        let number = *self.opaque_index.entry(key).or_insert_with(|| {
            self.opaques.push(OpaqueValue { template, kind });
            self.graph.opaques.push(nodes);
            self.opaques.len() - 1
        });
        (0..count).map(|k| self.graph.opaque(number, k)).collect()
    }

    fn leaf(&mut self, template: Template, kind: OpaqueKind, key: String, count: usize, at: &dyn ToTokens) -> Vec<Node> {
        let number = match self.leaf_index.get(&key) {
            Some(&number) => number,
            None => {
                let number = self.graph.leaf(template.nodes());
                self.leaves.push(OpaqueValue { template, kind });
                self.leaf_index.insert(key, number);
                number
            }
        };
        let outputs: Vec<Node> = (0..count).map(|k| self.graph.leaf_output(number, k, LeafNumber::Value)).collect();
        outputs.iter().for_each(|&output| self.risk(output, at));
        outputs
    }

    /// A value as it is handed to the user's own function.
    pub fn template(&mut self, value: Value, at: &dyn ToTokens) -> Template {
        match value {
            Value::Opaque(template) | Value::Law(template) => template,
            Value::Integer(k) => {
                let k = proc_macro2::Literal::i64_unsuffixed(k);
                Template::Tokens(quote!(#k))
            }
            Value::Condition(node) if self.graph.truth(node).is_some() => {
                let truth = self.graph.truth(node);
                Template::Tokens(quote!(#truth))
            }
            Value::Combined(terms) => Template::Numbers(vec![self.scalar(Value::Combined(terms), at)], Shape::Scalar),
            other => match other.numbers() {
                Some((nodes, shape)) => Template::Numbers(nodes, shape),
                None => {
                    self.mistake(at, format!("{} cannot be handed to a function of your own: hand over numbers or vectors", other.name()));
                    Template::Tokens(quote!(()))
                }
            },
        }
    }
}

/// Text that is equal for equal templates.
pub fn key(template: &Template) -> String {
    let list = |all: &[Template]| all.iter().map(key).collect::<Vec<_>>().join(", ");
    match template {
        Template::Tokens(tokens) => tokens.to_string(),
        Template::Numbers(nodes, shape) => format!("{nodes:?}: {shape:?}"),
        Template::Parameter(name) => format!("self.{name}"),
        Template::Call(callee, all) => format!("{callee}({})", list(all)),
        Template::Method(receiver, name, all) => format!("({}).{name}({})", key(receiver), list(all)),
        Template::Field(base, member) => format!("({}).{}", key(base), member.to_token_stream()),
        Template::Index(base, index) => format!("({})[{}]", key(base), key(index)),
        Template::Binary(a, op, b) => format!("({}) {} ({})", key(a), op.to_token_stream(), key(b)),
        Template::Unary(op, a) => format!("{}({})", op.to_token_stream(), key(a)),
        Template::Cast(a, ty) => format!("({}) as {ty}", key(a)),
        Template::Reference(a) => format!("&({})", key(a)),
        Template::Matches(a, pattern) => format!("({}) matches {pattern}", key(a)),
    }
}
