//! What an expression of the body can be while it is read: typed values over the scalar graph.

use std::rc::Rc;

use proc_macro2::TokenStream;

use crate::graph::Node;
use crate::parse::Shape;

use super::scope::Scopes;

/// A value of the body.
#[derive(Clone)]
pub enum Value {
    Scalar(Node),
    Condition(Node),
    /// An integer known here.
    Integer(i64),
    /// `Vec2` or `Vec3`.
    Vector(Vec<Node>),
    /// `Mat2` or `Mat3`: its side, and its entries row by row.
    Matrix(usize, Vec<Node>),
    /// Euler parameters e0..e3.
    Euler(Vec<Node>),
    Tuple(Vec<Value>),
    Array(Vec<Value>),
    /// An iterator over values known one by one.
    Iterator(Vec<Value>),
    /// State of an argument.
    Planar(usize),
    Spatial(usize),
    /// A law: how emitted code names it.
    Law(Template),
    Closure(Rc<Closure>),
    /// Something only rustc understands; a number of some shape as soon as its place asks for one.
    Opaque(Template),
    /// A sum of opaque values times numbers: still of the shape that its place asks for.
    Combined(Vec<(Template, Node)>),
    /// A variable declared without a value.
    Unassigned,
    /// What is left of an expression with a mistake in it.
    Poison,
}

/// A closure with the variables it saw.
pub struct Closure {
    pub inputs: Vec<syn::Pat>,
    pub body: syn::Expr,
    pub scopes: Scopes,
}

/// An expression that emitted code repeats as the user wrote it, with values of the graph put in.
#[derive(Clone)]
pub enum Template {
    /// As written.
    Tokens(TokenStream),
    /// A value of the graph.
    Numbers(Vec<Node>, Shape),
    /// A field of the constraint: a parameter whose type only rustc knows.
    Parameter(proc_macro2::Ident),
    Call(TokenStream, Vec<Template>),
    Method(Box<Template>, TokenStream, Vec<Template>),
    Field(Box<Template>, syn::Member),
    Index(Box<Template>, Box<Template>),
    Binary(Box<Template>, syn::BinOp, Box<Template>),
    Unary(syn::UnOp, Box<Template>),
    Cast(Box<Template>, TokenStream),
    Reference(Box<Template>),
    /// Does the value match the pattern?
    Matches(Box<Template>, TokenStream),
}

impl Template {
    /// The values of the graph in it, in order.
    pub fn nodes(&self) -> Vec<Node> {
        let mut nodes = Vec::new();
        self.visit(&mut |template| {
            if let Template::Numbers(numbers, _) = template {
                nodes.extend(numbers);
            }
        });
        nodes
    }

    fn visit(&self, f: &mut dyn FnMut(&Template)) {
        f(self);
        match self {
            Template::Tokens(_) | Template::Numbers(..) | Template::Parameter(_) => {}
            Template::Call(_, all) => all.iter().for_each(|t| t.visit(f)),
            Template::Method(receiver, _, all) => {
                receiver.visit(f);
                all.iter().for_each(|t| t.visit(f));
            }
            Template::Index(a, b) | Template::Binary(a, _, b) => {
                a.visit(f);
                b.visit(f);
            }
            Template::Field(a, _) | Template::Unary(_, a) | Template::Cast(a, _) | Template::Reference(a) | Template::Matches(a, _) => a.visit(f),
        }
    }
}

impl Value {
    /// How messages call it.
    pub fn name(&self) -> String {
        match self {
            Value::Scalar(_) => "a number".into(),
            Value::Condition(_) => "a condition".into(),
            Value::Integer(_) => "an integer".into(),
            Value::Vector(v) => format!("a Vec{}", v.len()),
            Value::Matrix(n, _) => format!("a Mat{n}"),
            Value::Euler(_) => "a set of Euler parameters".into(),
            Value::Tuple(all) if all.is_empty() => "nothing, `()`".into(),
            Value::Tuple(all) => format!("a tuple of {}", all.len()),
            Value::Array(all) => format!("an array of {}", all.len()),
            Value::Iterator(_) => "an iterator".into(),
            Value::Planar(_) => "the state of a planar body".into(),
            Value::Spatial(_) => "the state of a spatial body".into(),
            Value::Law(_) => "a Law".into(),
            Value::Closure(_) => "a closure".into(),
            Value::Opaque(_) | Value::Combined(_) => "a value of a type the macro does not know".into(),
            Value::Unassigned => "a variable without a value".into(),
            Value::Poison => "a mistake".into(),
        }
    }

    /// Nodes and shape of a value made of numbers.
    pub fn numbers(&self) -> Option<(Vec<Node>, Shape)> {
        match self {
            Value::Scalar(n) => Some((vec![*n], Shape::Scalar)),
            Value::Vector(v) => Some((v.clone(), Shape::Vector(v.len()))),
            Value::Matrix(n, m) => Some((m.clone(), Shape::Matrix(*n))),
            Value::Array(all) if !all.is_empty() => {
                let parts: Vec<_> = all.iter().map(Value::numbers).collect::<Option<_>>()?;
                let shape = parts[0].1.clone();
                let nodes = parts.iter().flat_map(|(nodes, _)| nodes.clone()).collect();
                parts.iter().all(|p| p.1 == shape).then(|| (nodes, Shape::Array(Box::new(shape), all.len())))
            }
            Value::Tuple(all) if !all.is_empty() => {
                let parts: Vec<_> = all.iter().map(Value::numbers).collect::<Option<_>>()?;
                let nodes = parts.iter().flat_map(|(nodes, _)| nodes.clone()).collect();
                Some((nodes, Shape::Tuple(parts.into_iter().map(|p| p.1).collect())))
            }
            _ => None,
        }
    }

    /// A value of `shape` from its numbers.
    pub fn from_numbers(shape: &Shape, numbers: &mut dyn Iterator<Item = Node>) -> Option<Value> {
        let mut take = |n: usize| -> Option<Vec<Node>> {
            let all: Vec<Node> = (0..n).map_while(|_| numbers.next()).collect();
            (all.len() == n).then_some(all)
        };
        Some(match shape {
            Shape::Scalar => Value::Scalar(take(1)?[0]),
            Shape::Vector(n) => Value::Vector(take(*n)?),
            Shape::Matrix(n) => Value::Matrix(*n, take(n * n)?),
            Shape::Array(inner, n) => Value::Array((0..*n).map(|_| Value::from_numbers(inner, numbers)).collect::<Option<_>>()?),
            Shape::Tuple(all) => Value::Tuple(all.iter().map(|s| Value::from_numbers(s, numbers)).collect::<Option<_>>()?),
            Shape::Any => return None,
        })
    }
}

impl Shape {
    /// How many numbers it is made of.
    pub fn len(&self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector(n) => *n,
            Shape::Matrix(n) => n * n,
            Shape::Array(inner, n) => inner.len() * n,
            Shape::Tuple(all) => all.iter().map(Shape::len).sum(),
            Shape::Any => 0,
        }
    }

    /// How messages call it.
    pub fn name(&self) -> String {
        match self {
            Shape::Scalar => "f64".into(),
            Shape::Vector(n) => format!("Vec{n}"),
            Shape::Matrix(n) => format!("Mat{n}"),
            Shape::Array(inner, n) => format!("[{}; {n}]", inner.name()),
            Shape::Tuple(all) => format!("({})", all.iter().map(Shape::name).collect::<Vec<_>>().join(", ")),
            Shape::Any => "_".into(),
        }
    }
}
