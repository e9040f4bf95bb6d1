//! Vectors, matrices and rotations from their components.

use super::*;

impl Reader {
    /// Calls a constructor with its components.
    pub(super) fn make(&mut self, kind: Components, arguments: Vec<Value>, call: &Call) -> Value {
        match self.numbers(kind.len(), arguments, call) {
            Some(nodes) => kind.value(nodes),
            None => Value::Poison,
        }
    }

    /// Returns the arguments as `n` numbers.
    pub(super) fn numbers(
        &mut self,
        n: usize,
        arguments: Vec<Value>,
        call: &Call,
    ) -> Option<Vec<Node>> {
        if arguments.len() != n {
            let name = crate::error::tidy(&call.path.to_token_stream().to_string());
            self.mistake(
                call.path,
                crate::lower::counted(&format!("`{name}`"), n, "number", arguments.len()),
            );
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
    pub(super) fn associated(
        &mut self,
        ty: &str,
        function: &str,
        mut arguments: Vec<Value>,
        call: &Call,
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
                Value::Matrix(
                    n,
                    if function == "from_columns" {
                        crate::lower::state::transpose(&rows)
                    } else {
                        rows
                    },
                )
            }
            ("from", kind, 1) => {
                let value = self.loaded(arguments.remove(0));
                self.made_from(kind, value, call)
            }
            _ => return Err(Unreadable::new(call.path, format!("`{ty}::{function}`"))),
        })
    }

    /// Makes a vector or matrix from an array, a tuple, or a value of the same kind.
    fn made_from(&mut self, kind: Components, value: Value, call: &Call) -> Value {
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

    fn constants(&mut self, kind: Components, is_one: impl Fn(usize) -> bool) -> Value {
        kind.value(
            (0..kind.len())
                .map(|k| self.graph.constant(if is_one(k) { 1.0 } else { 0.0 }))
                .collect(),
        )
    }

    /// Returns the entries of n rows, from an array of vectors or arrays.
    fn rows_of(&mut self, value: Value, n: usize, call: &Call) -> Read<Vec<Node>> {
        match value.referent() {
            Value::Matrix(side, m) if side == n => Ok(m),
            Value::Array(rows) if rows.len() == n => Ok(rows
                .into_iter()
                .flat_map(|row| self.convertible(row, n, call.place(0)))
                .collect()),
            _ => Err(Unreadable::new(call.path, "a matrix from this value")),
        }
    }

    /// Returns ã, with ã b = a × b.
    fn skew(&mut self, a: &[Node]) -> Vec<Node> {
        let zero = self.graph.zero();
        let minus = [a[0], a[1], a[2]].map(|n| self.graph.neg(n));
        vec![zero, minus[2], a[1], a[2], zero, minus[0], minus[1], a[0], zero]
    }

    /// Returns (cos φ/2, u sin φ/2).
    fn axis_angle(&mut self, axis: &[Node], angle: Node) -> Vec<Node> {
        let half = self.graph.constant(0.5);
        let half = self.graph.mul(half, angle);
        let sin = self.graph.call(Function::Sin, half);
        let cos = self.graph.call(Function::Cos, half);
        let norm = self.norm(axis);
        let unit: Vec<Node> = axis.iter().map(|&n| self.graph.div(n, norm)).collect();
        std::iter::once(cos).chain(unit.into_iter().map(|n| self.graph.mul(n, sin))).collect()
    }
}
