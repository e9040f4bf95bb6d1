//! Methods of vectors, matrices and Euler parameters, under the names of nalgebra, and methods of
//! body states.

use super::Call;
use crate::lower::values::{Attachment, Components, Read, Unreadable, Value, Values};
use kin_graph::{Graph, Node};

impl Values {
    /// Returns the first argument, which has the kind of the receiver or converts into it.
    pub fn other(&mut self, kind: Components, call: &Call) -> Vec<Node> {
        let place = call.places[0];
        match (call.arguments[0].clone().referent(), kind) {
            (Value::Vector(w), Components::Vector(n)) if w.len() != n => {
                self.mistake(
                    place,
                    format!(
                        "`{}` of a Vec{n} needs a Vec{n}, but the argument is a Vec{}",
                        call.name,
                        w.len()
                    ),
                );
                vec![w[0]; n]
            }
            (value, Components::Vector(n)) => self.convertible(value, n, place),
            (value, kind) => match self.shaped(value, &kind.shape(), place).components() {
                Some((_, nodes)) => nodes.to_vec(),
                None => vec![self.graph.zero(); kind.len()],
            },
        }
    }

    pub fn normalized(&mut self, v: &[Node]) -> Vec<Node> {
        let norm = self.norm(v);
        v.iter().map(|&n| self.graph.div(n, norm)).collect()
    }

    /// Applies an operation to the components of two vectors, one by one.
    pub fn component_by_component(
        &mut self,
        v: &[Node],
        w: &[Node],
        f: fn(&mut Graph, Node, Node) -> Node,
    ) -> Vec<Node> {
        v.iter().zip(w).map(|(&a, &b)| f(&mut self.graph, a, b)).collect()
    }

    /// Returns v × w, a number for vectors of two components.
    pub fn cross(&mut self, v: &[Node], w: &[Node]) -> Value {
        let mut minor = |a: usize, b: usize| self.determinant2(v[a], v[b], w[a], w[b]);
        match v.len() {
            2 => Value::Scalar(minor(0, 1)),
            _ => Value::Vector(vec![minor(1, 2), minor(2, 0), minor(0, 1)]),
        }
    }

    pub fn trace(&mut self, n: usize, m: &[Node]) -> Node {
        let zero = self.graph.zero();
        (0..n).fold(zero, |sum, k| self.graph.add(sum, m[k * n + k]))
    }

    pub fn determinant(&mut self, m: &[Node]) -> Node {
        if m.len() == 4 {
            return self.determinant2(m[0], m[1], m[2], m[3]);
        }
        let minors = [(4, 8, 5, 7), (5, 6, 3, 8), (3, 7, 4, 6)]
            .map(|(a, d, b, c)| self.determinant2(m[a], m[b], m[c], m[d]));
        self.dot(&m[..3], &minors)
    }

    /// Reads `m.row(k)` and `m.column(k)`.
    pub fn row_or_column(&mut self, n: usize, m: &[Node], call: &Call) -> Read {
        let name = &call.name;
        match call.arguments[0].clone().referent() {
            Value::Integer(k, _) if (0..n as i64).contains(&k) && name == "row" => {
                Ok(Value::Vector(m[k as usize * n..][..n].to_vec()))
            }
            Value::Integer(k, _) if (0..n as i64).contains(&k) => {
                Ok(Value::Vector((0..n).map(|i| m[i * n + k as usize]).collect()))
            }
            Value::Integer(k, _) => {
                Ok(self.mistake(call.places[0], format!("a Mat{n} has no {name} {k}")))
            }
            _ => Err(Unreadable::new(call.places[0], "an unknown index")),
        }
    }

    /// Adds a local point or direction of a body, unless it depends on coordinates or time.
    pub fn attach(&mut self, slot: usize, is_point: bool, local: &[Node]) {
        let attachment = Attachment { slot, is_point, local: local.to_vec() };
        let moves = local.iter().any(|&node| self.graph.depends(node).varies());
        if !moves && !self.attachments.contains(&attachment) {
            self.attachments.push(attachment);
        }
    }

    /// Returns the first argument as a vector with the dimension of a body.
    pub fn of_dimension(&mut self, n: usize, call: &Call) -> Vec<Node> {
        let name = &call.name;
        let body = body_name(n);
        let place = call.places[0];
        let value = match call.arguments[0].clone().referent() {
            Value::Vector(v) if v.len() != n => {
                let text = format!(
                    "`{name}` of {body} needs a Vec{n}, but the argument is a Vec{}",
                    v.len()
                );
                self.mistake(place, text)
            }
            value => value,
        };
        self.convertible(value, n, place)
    }
}

/// Returns what to write instead of a method that no vector has.
pub fn vector_cure(name: &str) -> &'static str {
    match name {
        "length" | "len" | "abs" | "magnitude" => ": write `norm()`",
        "length_squared" | "magnitude_squared" => ": write `norm_squared()`",
        "normalized" | "unit" => ": write `normalize()`",
        _ => {
            ": the methods are `dot`, `cross`, `norm`, `norm_squared`, `normalize`, `perp`, and the fields `x`, `y`"
        }
    }
}

/// Returns the name of a body in messages.
pub fn body_name(dimension: usize) -> &'static str {
    if dimension == 2 { "a planar body" } else { "a spatial body" }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Value, Values};
    use kin_graph::Graph;

    #[test]
    fn determinants_and_products_of_constants_are_constants() {
        let mut values = Values::new(Graph::default());
        let m: Vec<_> = [2.0, 0.0, 1.0, 0.0, 3.0, 0.0, 1.0, 0.0, 1.0]
            .map(|x| values.graph.constant(x))
            .to_vec();
        let determinant = values.determinant(&m);
        assert_eq!(values.graph.constant_value(determinant), Some(3.0));
        let trace = values.trace(3, &m);
        assert_eq!(values.graph.constant_value(trace), Some(6.0));
        let Value::Scalar(area) = values.cross(&m[..2], &m[3..5]) else { panic!("a number") };
        assert_eq!(values.graph.constant_value(area), Some(6.0));
    }
}
