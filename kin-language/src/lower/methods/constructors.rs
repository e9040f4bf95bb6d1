//! Functions by their paths: vectors, matrices and rotations from their components, `f64::from`,
//! `std::mem::swap`, and functions of the user's program.

use proc_macro2::Span;
use quote::ToTokens;
use syn::{Expr, ExprPath};

use crate::lower::values::{
    Components, IntegerType, Read, Template, Unreadable, Value, Values, WIDE, counted, transpose,
};
use crate::vocabulary::is_std_function;
use kin_graph::{Function, Node};

impl Values {
    /// Calls a constructor with its components.
    pub fn make(&mut self, kind: Components, arguments: Vec<Value>, call: &PathCall) -> Value {
        match self.numbers(kind.len(), arguments, call) {
            Some(nodes) => kind.value(nodes),
            None => Value::Poison,
        }
    }

    /// Returns the arguments as `n` numbers.
    pub fn numbers(
        &mut self,
        n: usize,
        arguments: Vec<Value>,
        call: &PathCall,
    ) -> Option<Vec<Node>> {
        if arguments.len() != n {
            let name = crate::error::tidy_text(call.path);
            self.mistake(call.path, counted(&format!("`{name}`"), n, "number", arguments.len()));
            return None;
        }
        Some(
            arguments
                .into_iter()
                .enumerate()
                .map(|(k, value)| self.scalar(value, call.place(k)))
                .collect(),
        )
    }

    /// Calls constructors and other functions of vector and matrix types.
    pub fn associated(
        &mut self,
        ty: &str,
        function: &str,
        mut arguments: Vec<Value>,
        call: &PathCall,
    ) -> Read {
        let n = if ty.ends_with('2') { 2 } else { 3 };
        let kind = match ty {
            "EulerParameters" => Components::Euler,
            ty if ty.starts_with('V') => Components::Vector(n),
            _ => Components::Matrix(n),
        };
        let axis = ["x", "y", "z"].iter().position(|name| *name == function);
        Ok(match (function, kind, arguments.len()) {
            ("new", kind, _) => self.make(kind, arguments, call),
            ("zeros" | "default", Components::Vector(_) | Components::Matrix(_), 0)
            | ("zeros", _, 0) => self.constants(kind, |_| false),
            ("x" | "y" | "z", Components::Vector(_), 0) => {
                self.constants(kind, |k| Some(k) == axis)
            }
            ("identity", Components::Matrix(n), 0) => self.constants(kind, |k| k % n == k / n),
            ("identity" | "default", Components::Euler, 0) => self.constants(kind, |k| k == 0),
            ("rotation", Components::Matrix(2), 1) => {
                let Some(angle) = self.numbers(1, arguments, call) else {
                    return Ok(Value::Poison);
                };
                let sin = self.graph.call(Function::Sin, angle[0]);
                let cos = self.graph.call(Function::Cos, angle[0]);
                Value::Matrix(2, vec![cos, self.graph.neg(sin), sin, cos])
            }
            ("from_axis_angle", Components::Euler, 2) => {
                let angle = arguments.pop().unwrap_or(Value::Poison);
                let axis = arguments.remove(0);
                let axis = self.convertible(axis, 3, call.place(0));
                let angle = self.scalar(angle, call.place(1));
                Value::Euler(self.axis_angle(&axis, angle))
            }
            ("skew", Components::Matrix(3), 1) => {
                let v = self.convertible(arguments.remove(0), 3, call.place(0));
                Value::Matrix(3, self.skew(&v))
            }
            ("from_rows" | "from_columns", Components::Matrix(n), 1)
            | ("from", Components::Matrix(n), 1) => {
                let rows = self.rows_of(arguments.remove(0), n, call)?;
                Value::Matrix(n, if function == "from_columns" { transpose(&rows) } else { rows })
            }
            ("from", kind, 1) => {
                let value = self.loaded(arguments.remove(0));
                self.made_from(kind, value, call)
            }
            _ => return Err(Unreadable::new(call.path, format!("`{ty}::{function}`"))),
        })
    }

    /// Makes a vector or matrix from an array, a tuple, or a value of the same kind.
    pub fn made_from(&mut self, kind: Components, value: Value, call: &PathCall) -> Value {
        match value {
            // A value that only rustc knows may be an array, a tuple or a vector: emitted code
            // converts it.
            Value::Opaque(template)
                if matches!(kind, Components::Vector(_)) && template.nodes().is_empty() =>
            {
                let path = Box::new(Template::path(call.path));
                let converted = Template::Call(path, vec![template], last_span(call.at));
                self.shaped(Value::Opaque(converted), &kind.shape(), call.place(0))
            }
            value if value.components().is_some_and(|(own, _)| own == kind) => value,
            Value::Array(all) | Value::Tuple(all) if all.len() == kind.len() => {
                kind.value(all.into_iter().map(|part| self.scalar(part, call.place(0))).collect())
            }
            value => self.shaped(value, &kind.shape(), call.place(0)),
        }
    }

    pub fn constants(&mut self, kind: Components, is_one: impl Fn(usize) -> bool) -> Value {
        kind.value(
            (0..kind.len())
                .map(|k| self.graph.constant(if is_one(k) { 1.0 } else { 0.0 }))
                .collect(),
        )
    }

    /// Returns the entries of n rows, from an array of vectors or arrays.
    pub fn rows_of(&mut self, value: Value, n: usize, call: &PathCall) -> Read<Vec<Node>> {
        match value.referent() {
            Value::Matrix(side, m) if side == n => Ok(m),
            Value::Array(rows) if rows.len() == n => Ok(rows
                .into_iter()
                .flat_map(|row| self.convertible(row, n, call.place(0)))
                .collect()),
            _ => Err(Unreadable::new(call.path, "a matrix from this value")),
        }
    }

    pub fn number_from(&mut self, mut arguments: Vec<Value>, call: &PathCall) -> Read {
        match (arguments.len(), arguments.pop().map(Value::referent)) {
            (1, Some(Value::Integer(k, ty))) => {
                if ty.is_some_and(IntegerType::is_wide) {
                    self.told_by_rustc(call.path, WIDE);
                }
                Ok(Value::Scalar(self.graph.constant(k as f64)))
            }
            (1, Some(Value::Scalar(n))) => Ok(Value::Scalar(n)),
            (1, Some(value)) => {
                let template = self.template(value, call.at)?;
                Ok(Value::Opaque(Template::Call(
                    Box::new(Template::path(call.path)),
                    vec![template],
                    last_span(call.at),
                )))
            }
            _ => Ok(self.mistake(call.at, "`f64::from` takes one argument")),
        }
    }

    /// Calls a function of the user's program. Emitted code repeats the call; it passes numbers
    /// that carry derivatives where the arguments do.
    pub fn own_function(
        &mut self,
        callee: Template,
        arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        let mut templates = Vec::new();
        for (k, value) in arguments.into_iter().enumerate() {
            let place = places.get(k).map_or(at, |place| *place as &dyn ToTokens);
            templates.push(self.template(value, place)?);
        }
        let std = matches!(&callee, Template::Path(path, _) if is_std_function(path));
        if std && templates.iter().any(|template| !template.nodes().is_empty()) {
            return Err(Unreadable::new(at, "this function of the standard library"));
        }
        Ok(Value::Opaque(Template::Call(Box::new(callee), templates, last_span(at))))
    }

    /// Returns true if a value has the type with which the path of a method begins.
    pub fn is_receiver(&self, ty: &str, value: &Value) -> bool {
        let value = self.loaded(value.clone());
        match ty {
            "Vec2" | "Vec3" => matches!(value, Value::Vector(_)),
            "Mat2" | "Mat3" => matches!(value, Value::Matrix(..)),
            "EulerParameters" => matches!(value, Value::Euler(_)),
            "Planar" => matches!(value, Value::Planar(_) | Value::Choice(_)),
            "Spatial" => matches!(value, Value::Spatial(_) | Value::Choice(_)),
            "Law" => matches!(value, Value::Law(_)),
            "Vec" => matches!(value, Value::Array(_)),
            _ => matches!(value, Value::Adt(_) | Value::Choice(_)),
        }
    }

    /// Reads `std::mem::swap(&mut a, &mut b)`, and `replace` and `take` of the same module.
    pub fn exchange(&mut self, name: &str, arguments: Vec<Value>, call: &PathCall) -> Read {
        let unreadable = || Unreadable::new(call.path, "an exchange of unknown values");
        let (Some(Value::Place(a)), second) = (arguments.first(), arguments.get(1)) else {
            return Err(unreadable());
        };
        let old = self.at_place(a).ok_or_else(unreadable)?;
        let new = match (name, second) {
            ("swap", Some(Value::Place(b))) => {
                let other = self.at_place(b).ok_or_else(unreadable)?;
                self.put_at(b, old.clone(), call.at).ok_or_else(unreadable)?;
                other
            }
            ("replace", Some(value)) => value.clone(),
            ("take", None) if matches!(old, Value::Scalar(_)) => Value::Scalar(self.graph.zero()),
            ("take", None) if matches!(old, Value::Adt(_)) => Value::none(),
            _ => return Err(unreadable()),
        };
        self.put_at(a, new, call.at).ok_or_else(unreadable)?;
        Ok(if name == "swap" { Value::unit() } else { old })
    }
}

/// A call by name, with the expressions of its arguments, for messages.
pub struct PathCall<'a> {
    pub path: &'a ExprPath,
    pub places: &'a [&'a Expr],
    pub at: &'a dyn ToTokens,
}

impl PathCall<'_> {
    pub fn place(&self, k: usize) -> &dyn ToTokens {
        self.places.get(k).map_or(self.at, |place| *place as &dyn ToTokens)
    }
}

/// Returns the span of a call's parentheses, which are its last token.
fn last_span(at: &dyn ToTokens) -> Span {
    at.to_token_stream().into_iter().last().map_or_else(Span::call_site, |token| token.span())
}
