//! Methods of vectors, matrices and Euler parameters, under the names of nalgebra.

use super::Call;
use crate::lower::value::{Components, Value};
use crate::lower::{Read, Reader, Unreadable};
use kin_graph::{Graph, Node};

impl Reader {
    pub(super) fn vector_method(&mut self, v: &[Node], call: &Call) -> Read {
        let n = v.len();
        let kind = Components::Vector(n);
        if let Some(value) = self.common_method(kind, v, call)? {
            return Ok(value);
        }
        if n == 3 && matches!(call.name.as_str(), "axis" | "axis_near") {
            return self.axis_of(v, call);
        }
        let count = match (call.name.as_str(), n) {
            ("perp", 2) => 0,
            ("cross", _) => 1,
            _ => return Ok(self.unknown(call, &format!("a Vec{n}"), vector_cure(&call.name))),
        };
        if !self.counted(count, call) {
            return Ok(Value::Poison);
        }
        if call.name == "perp" {
            return Ok(Value::Vector(vec![self.graph.neg(v[1]), v[0]]));
        }
        let w = self.other(kind, call);
        let mut minor = |a: usize, b: usize| self.determinant2(v[a], v[b], w[a], w[b]);
        Ok(match n {
            2 => Value::Scalar(minor(0, 1)),
            _ => Value::Vector(vec![minor(1, 2), minor(2, 0), minor(0, 1)]),
        })
    }

    pub(super) fn euler_method(&mut self, p: &[Node], call: &Call) -> Read {
        if let Some(value) = self.common_method(Components::Euler, p, call)? {
            return Ok(value);
        }
        let count = match call.name.as_str() {
            "vector" | "conjugate" | "rotation" => 0,
            "product" => 1,
            _ => {
                return Ok(self.unknown(
                    call,
                    "a set of Euler parameters",
                    ": the methods are `norm`, `norm_squared`, `dot`, `vector`, `conjugate`",
                ));
            }
        };
        if !self.counted(count, call) {
            return Ok(Value::Poison);
        }
        Ok(match call.name.as_str() {
            "vector" => Value::Vector(p[1..].to_vec()),
            "conjugate" => Value::Euler(vec![
                p[0],
                self.graph.neg(p[1]),
                self.graph.neg(p[2]),
                self.graph.neg(p[3]),
            ]),
            "rotation" => Value::Matrix(3, self.rotation_of(p)),
            _ => {
                let q = self.other(Components::Euler, call);
                Value::Euler(self.euler_product(p, &q))
            }
        })
    }

    /// Calls a method that vectors and Euler parameters share; returns `None` for any other method.
    fn common_method(&mut self, kind: Components, v: &[Node], call: &Call) -> Read<Option<Value>> {
        let count = match call.name.as_str() {
            "norm" | "norm_squared" | "normalize" | "to_array" => 0,
            "dot" | "component_mul" | "component_div" | "map" => 1,
            "lerp" => 2,
            _ => return Ok(None),
        };
        if !self.counted(count, call) {
            return Ok(Some(Value::Poison));
        }
        Ok(Some(match call.name.as_str() {
            "norm" => Value::Scalar(self.norm(v)),
            "norm_squared" => Value::Scalar(self.dot(v, v)),
            "normalize" => {
                let norm = self.norm(v);
                kind.value(v.iter().map(|&n| self.graph.div(n, norm)).collect())
            }
            "to_array" => Value::Array(v.iter().copied().map(Value::Scalar).collect()),
            "map" => kind.value(self.mapped(v, call)?),
            "dot" => {
                let w = self.other(kind, call);
                Value::Scalar(self.dot(v, &w))
            }
            "lerp" => {
                let w = self.other(kind, call);
                let t = self.scalar(call.arguments[1].clone(), call.places[1]);
                kind.value(self.lerp(v, &w, t))
            }
            name => {
                let w = self.other(kind, call);
                let f = if name == "component_mul" { Graph::mul } else { Graph::div };
                let products: Vec<Node> =
                    v.iter().zip(w).map(|(&a, b)| f(&mut self.graph, a, b)).collect();
                kind.value(products)
            }
        }))
    }

    /// Applies the function in the first argument to each component.
    fn mapped(&mut self, nodes: &[Node], call: &Call) -> Read<Vec<Node>> {
        let f = self.function(call.arguments[0].clone().referent(), call.places[0])?;
        let each = nodes.iter().map(|&n| {
            let value = self.apply(&f, vec![Value::Scalar(n)], &[], call.whole)?;
            Ok(self.scalar(value, call.whole))
        });
        each.collect()
    }

    /// Returns the first argument, which has the kind of the receiver or converts into it.
    fn other(&mut self, kind: Components, call: &Call) -> Vec<Node> {
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

    /// Returns a d − b c.
    fn determinant2(&mut self, a: Node, b: Node, c: Node, d: Node) -> Node {
        let ad = self.graph.mul(a, d);
        let bc = self.graph.mul(b, c);
        self.graph.sub(ad, bc)
    }

    pub(super) fn matrix_method(&mut self, n: usize, m: &[Node], call: &Call) -> Read {
        let count = match call.name.as_str() {
            "transpose" | "determinant" | "trace" | "to_array" => 0,
            "column" | "row" | "map" => 1,
            _ => {
                let cure =
                    ": the methods are `transpose`, `determinant`, `trace`, `column(k)`, `row(k)`";
                return Ok(self.unknown(call, &format!("a Mat{n}"), cure));
            }
        };
        if !self.counted(count, call) {
            return Ok(Value::Poison);
        }
        let row = |k: usize| m[k * n..][..n].to_vec();
        Ok(match call.name.as_str() {
            "transpose" => Value::Matrix(n, crate::lower::state::transpose(m)),
            "to_array" => Value::Array(
                (0..n)
                    .map(|k| Value::Array(row(k).into_iter().map(Value::Scalar).collect()))
                    .collect(),
            ),
            "trace" => {
                let zero = self.graph.zero();
                Value::Scalar((0..n).fold(zero, |sum, k| self.graph.add(sum, m[k * n + k])))
            }
            "determinant" if n == 2 => Value::Scalar(self.determinant2(m[0], m[1], m[2], m[3])),
            "determinant" => {
                let minors = [(4, 8, 5, 7), (5, 6, 3, 8), (3, 7, 4, 6)]
                    .map(|(a, d, b, c)| self.determinant2(m[a], m[b], m[c], m[d]));
                Value::Scalar(self.dot(&m[..3], &minors))
            }
            "map" => Value::Matrix(n, self.mapped(m, call)?),
            name => match call.arguments[0].clone().referent() {
                Value::Integer(k, _) if (0..n as i64).contains(&k) && name == "row" => {
                    Value::Vector(row(k as usize))
                }
                Value::Integer(k, _) if (0..n as i64).contains(&k) => {
                    Value::Vector((0..n).map(|i| m[i * n + k as usize]).collect())
                }
                Value::Integer(k, _) => {
                    self.mistake(call.places[0], format!("a Mat{n} has no {name} {k}"))
                }
                _ => {
                    return Err(Unreadable::new(call.places[0], "an unknown index"));
                }
            },
        })
    }
}

fn vector_cure(name: &str) -> &'static str {
    match name {
        "length" | "len" | "abs" | "magnitude" => ": write `norm()`",
        "length_squared" | "magnitude_squared" => ": write `norm_squared()`",
        "normalized" | "unit" => ": write `normalize()`",
        _ => {
            ": the methods are `dot`, `cross`, `norm`, `norm_squared`, `normalize`, `perp`, and the fields `x`, `y`"
        }
    }
}
