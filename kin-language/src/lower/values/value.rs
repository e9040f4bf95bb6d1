//! The values of the body's expressions during the reading: typed values over the scalar graph.

use std::rc::Rc;

use super::{Function, IntegerType, Place, Template};
use crate::parse::Shape;
use crate::vocabulary::last_name;
use kin_graph::Node;

/// A value of the body.
#[derive(Clone, Default)]
pub enum Value {
    Scalar(Node),
    Condition(Node),
    /// An integer that is known here, and its type if that is known.
    Integer(i64, Option<IntegerType>),
    /// `Vec2` or `Vec3`.
    Vector(Vec<Node>),
    /// `Mat2` or `Mat3`: the number of rows, and the entries row by row.
    Matrix(usize, Vec<Node>),
    /// Euler parameters e0..e3.
    Euler(Vec<Node>),
    Tuple(Vec<Value>),
    Array(Vec<Value>),
    /// An iterator over a known list of values.
    Iterator(Vec<Value>),
    /// An iterator whose values do not end.
    Endless(Endless),
    /// A value of a struct, or of a variant of an enum: `Some(x)`, `Link { length, angle }`.
    Adt(Adt),
    /// One of several values with their conditions, of which one holds; the last needs no test.
    Choice(Vec<(Node, Value)>),
    /// `&mut place`.
    Place(Place),
    /// A borrowed value. Only a function of the user's program distinguishes it from the value
    /// itself.
    Reference(Box<Value>),
    /// `value.into()`: its place decides the type.
    Into(Box<Value>),
    /// `std::array::from_fn(f)`: its place decides the length.
    Generator(Function),
    /// The state of a planar body; the number is the slot of the argument.
    Planar(usize),
    Spatial(usize),
    /// A law, as emitted code names it.
    Law(Template),
    /// An axis: its unit vectors h, f and g.
    Axis([Vec<Node>; 3]),
    Function(Function),
    /// A value that only rustc understands. It becomes a number or another shape when its place
    /// needs one.
    Opaque(Template),
    /// A variable declared without a value.
    Unassigned,
    /// In a text, a variable that has this value in some branches and none in others.
    Perhaps(Box<Value>),
    /// The absence of a value, from `unreachable!()` and similar macros.
    Never,
    /// The position after `return`, `break` and `continue`, where the interpreter reads nothing.
    Left,
    /// The substitute for an expression with a mistake in it.
    #[default]
    Poison,
}

/// A value of a struct or variant.
#[derive(Clone)]
pub struct Adt {
    /// The path as the user wrote it: `Link`, `Shape::Arc`, `Some`.
    pub path: syn::Path,
    /// The name of the struct or variant.
    pub name: String,
    /// The values of the fields, by their names or numbers.
    pub fields: Vec<(String, Value)>,
    /// True if it is written with braces.
    pub braces: bool,
}

impl Adt {
    /// Makes `name(value)`, or `name` alone.
    pub fn new(name: &str, value: Option<Value>) -> Self {
        let path = proc_macro2::Ident::new(name, proc_macro2::Span::call_site()).into();
        Adt {
            path,
            name: name.into(),
            fields: value.into_iter().map(|value| ("0".into(), value)).collect(),
            braces: false,
        }
    }

    /// Makes `Complex(a, b)`, `Shape::Line(a)`.
    pub fn tuple(path: &syn::Path, arguments: Vec<Value>) -> Self {
        let name = last_name(path);
        let fields =
            arguments.into_iter().enumerate().map(|(k, value)| (k.to_string(), value)).collect();
        Adt { path: path.clone(), name, fields, braces: false }
    }

    /// Returns the name of the type: the second last name of the path, if there are two.
    pub fn type_name(&self) -> String {
        let segments: Vec<String> =
            self.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        match &segments[..] {
            [.., ty, _] if ty.starts_with(char::is_uppercase) => ty.clone(),
            _ => self.name.clone(),
        }
    }

    pub fn field(&self, name: &str) -> Option<&Value> {
        self.fields.iter().find(|(field, _)| field == name).map(|(_, value)| value)
    }

    pub fn field_mut(&mut self, name: &str) -> Option<&mut Value> {
        self.fields.iter_mut().find(|(field, _)| field == name).map(|(_, value)| value)
    }
}

/// A value made of components, for which addition, scaling and negation apply to each component.
#[derive(Clone, Copy, PartialEq)]
pub enum Components {
    Vector(usize),
    Matrix(usize),
    Euler,
}

impl Components {
    /// Returns the number of rows of a matrix.
    pub fn side(self) -> usize {
        if let Components::Matrix(n) = self { n } else { 1 }
    }

    pub fn len(self) -> usize {
        self.shape().count()
    }

    pub fn value(self, nodes: Vec<Node>) -> Value {
        match self {
            Components::Vector(_) => Value::Vector(nodes),
            Components::Matrix(n) => Value::Matrix(n, nodes),
            Components::Euler => Value::Euler(nodes),
        }
    }

    pub fn shape(self) -> Shape {
        match self {
            Components::Vector(n) => Shape::Vector(n),
            Components::Matrix(n) => Shape::Matrix(n),
            Components::Euler => Shape::Euler,
        }
    }
}

impl Value {
    pub fn unit() -> Value {
        Value::Tuple(vec![])
    }

    pub fn some(value: Value) -> Value {
        Value::Adt(Adt::new("Some", Some(value)))
    }

    pub fn none() -> Value {
        Value::Adt(Adt::new("None", None))
    }

    /// Makes an index or a count.
    pub fn count(n: usize) -> Value {
        Value::Integer(n as i64, Some(IntegerType::SIZE))
    }

    /// Returns the number of values in the value.
    pub fn size(&self) -> usize {
        match self {
            Value::Tuple(all) | Value::Array(all) | Value::Iterator(all) => {
                1 + all.iter().map(Value::size).sum::<usize>()
            }
            Value::Reference(inner) | Value::Into(inner) => inner.size(),
            Value::Adt(adt) => 1 + adt.fields.iter().map(|(_, value)| value.size()).sum::<usize>(),
            Value::Choice(all) => 1 + all.iter().map(|(_, value)| value.size()).sum::<usize>(),
            Value::Opaque(template) => template.size(),
            _ => 1,
        }
    }

    /// Returns the value behind a reference, or any other value unchanged.
    pub fn referent(self) -> Value {
        match self {
            Value::Reference(inner) => inner.referent(),
            other => other,
        }
    }

    /// Returns the components, if the value has any.
    pub fn components(&self) -> Option<(Components, &[Node])> {
        match self {
            Value::Vector(v) => Some((Components::Vector(v.len()), v)),
            Value::Matrix(n, m) => Some((Components::Matrix(*n), m)),
            Value::Euler(p) => Some((Components::Euler, p)),
            _ => None,
        }
    }

    /// Returns the name of the kind in messages.
    pub fn name(&self) -> String {
        match self {
            Value::Scalar(_) => "a number".into(),
            Value::Condition(_) => "a condition".into(),
            Value::Integer(..) => "an integer".into(),
            Value::Vector(v) => format!("a Vec{}", v.len()),
            Value::Matrix(n, _) => format!("a Mat{n}"),
            Value::Euler(_) => "a set of Euler parameters".into(),
            Value::Tuple(all) if all.is_empty() => "nothing, `()`".into(),
            Value::Tuple(all) => format!("a tuple of {}", all.len()),
            Value::Array(all) => format!("an array of {}", all.len()),
            Value::Iterator(_) | Value::Endless(_) => "an iterator".into(),
            Value::Reference(inner) | Value::Into(inner) => inner.name(),
            Value::Generator(_) => "an array of unknown length".into(),
            Value::Planar(_) => "the state of a planar body".into(),
            Value::Spatial(_) => "the state of a spatial body".into(),
            Value::Law(_) => "a Law".into(),
            Value::Axis(_) => "an Axis".into(),
            Value::Function(_) => "a function".into(),
            Value::Opaque(_) => "a value of a type that the macro does not know".into(),
            Value::Adt(adt) => format!("a `{}`", adt.type_name()),
            Value::Choice(all) => all.first().map_or_else(String::new, |(_, value)| value.name()),
            Value::Place(_) => "a reference to a variable".into(),
            Value::Left => "no value at all".into(),
            Value::Unassigned | Value::Perhaps(_) => "a variable without a value".into(),
            Value::Never => "no value at all".into(),
            Value::Poison => "a mistake".into(),
        }
    }

    /// Returns the nodes and the shape of a value made of numbers.
    pub fn numbers(&self) -> Option<(Vec<Node>, Shape)> {
        match self {
            Value::Scalar(n) => Some((vec![*n], Shape::Scalar)),
            Value::Reference(inner) => inner.numbers(),
            Value::Array(all) if !all.is_empty() => {
                let (nodes, shapes) = several(all)?;
                let same = shapes.iter().all(|shape| *shape == shapes[0]);
                same.then(|| (nodes, Shape::Array(Box::new(shapes[0].clone()), all.len())))
            }
            Value::Tuple(all) if !all.is_empty() => {
                several(all).map(|(nodes, shapes)| (nodes, Shape::Tuple(shapes)))
            }
            other => other.components().map(|(kind, nodes)| (nodes.to_vec(), kind.shape())),
        }
    }

    /// Makes a value of `shape` from its numbers.
    pub fn from_numbers(shape: &Shape, numbers: &mut dyn Iterator<Item = Node>) -> Option<Value> {
        let mut take = |n: usize| -> Option<Vec<Node>> {
            let all: Vec<Node> = (0..n).map_while(|_| numbers.next()).collect();
            (all.len() == n).then_some(all)
        };
        Some(match shape {
            Shape::Scalar => Value::Scalar(*take(1)?.first()?),
            Shape::Vector(n) => Value::Vector(take(*n)?),
            Shape::Matrix(n) => Value::Matrix(*n, take(n * n)?),
            Shape::Euler => Value::Euler(take(4)?),
            Shape::Array(inner, n) => Value::Array(
                (0..*n).map(|_| Value::from_numbers(inner, numbers)).collect::<Option<_>>()?,
            ),
            Shape::Tuple(all) => Value::Tuple(
                all.iter().map(|s| Value::from_numbers(s, numbers)).collect::<Option<_>>()?,
            ),
            Shape::Any => return None,
        })
    }
}

/// Returns the nodes and the shapes of several values, if all are made of numbers.
fn several(all: &[Value]) -> Option<(Vec<Node>, Vec<Shape>)> {
    let parts: Vec<(Vec<Node>, Shape)> = all.iter().map(Value::numbers).collect::<Option<_>>()?;
    let nodes = parts.iter().flat_map(|(nodes, _)| nodes.iter().copied()).collect();
    Some((nodes, parts.into_iter().map(|(_, shape)| shape).collect()))
}

impl Shape {
    /// Returns how many numbers the shape has.
    pub fn count(&self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector(n) => *n,
            Shape::Matrix(n) => n * n,
            Shape::Euler => 4,
            Shape::Array(inner, n) => inner.count() * n,
            Shape::Tuple(all) => all.iter().map(Shape::count).sum(),
            Shape::Any => 0,
        }
    }

    /// Returns the name of the shape in messages.
    pub fn name(&self) -> String {
        match self {
            Shape::Scalar => "f64".into(),
            Shape::Vector(n) => format!("Vec{n}"),
            Shape::Matrix(n) => format!("Mat{n}"),
            Shape::Euler => "EulerParameters".into(),
            Shape::Array(inner, n) => format!("[{}; {n}]", inner.name()),
            Shape::Tuple(all) => {
                format!("({})", all.iter().map(Shape::name).collect::<Vec<_>>().join(", "))
            }
            Shape::Any => "_".into(),
        }
    }
}

/// Returns the position of a name among others.
pub fn position(name: &str, names: &[&str]) -> Option<usize> {
    names.iter().position(|n| *n == name)
}

/// Returns the position of `m12` in a matrix of `n` rows.
pub fn entry(name: &str, n: usize) -> Option<usize> {
    let digits: Vec<usize> = name
        .strip_prefix('m')?
        .chars()
        .filter_map(|c| c.to_digit(10))
        .map(|d| d as usize)
        .collect();
    match digits[..] {
        [r, c] if (1..=n).contains(&r) && (1..=n).contains(&c) => Some((r - 1) * n + c - 1),
        _ => None,
    }
}

/// An iterator without an end.
#[derive(Clone)]
pub enum Endless {
    /// `3..`
    From(i64, Option<IntegerType>),
    /// `repeat(x)`, `list.iter().cycle()`
    Cycle(Vec<Value>),
    /// `successors(first, next)`
    Successors(Box<Value>, Function),
    /// `endless.map(f)`
    Mapped(Rc<Endless>, Function),
    /// `endless.skip(n)`
    Skipped(Rc<Endless>, usize),
    /// `endless.step_by(n)`
    Stepped(Rc<Endless>, usize),
}
