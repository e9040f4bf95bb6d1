//! Fields and methods of body states, as functions of the parts that emitted code reads.

use super::{Value, Values};
use kin_graph::{Input, Node, Part};

impl Values {
    pub fn part(&mut self, slot: usize, part: Part) -> Node {
        self.graph.input(Input::State(slot, part))
    }

    /// Returns the value of a bare coordinate.
    pub fn coordinate(&mut self, slot: usize) -> Value {
        Value::Scalar(self.part(slot, Part::Theta))
    }

    /// Returns R of a body.
    pub fn origin(&mut self, slot: usize, dimension: usize) -> Vec<Node> {
        (0..dimension).map(|k| self.part(slot, Part::R(k))).collect()
    }

    pub fn euler_parameters(&mut self, slot: usize) -> Vec<Node> {
        (0..4).map(|k| self.part(slot, Part::P(k))).collect()
    }

    /// Returns A of a body, row by row.
    pub fn rotation(&mut self, slot: usize, dimension: usize) -> Vec<Node> {
        if dimension == 3 {
            let p = self.euler_parameters(slot);
            return self.rotation_of(&p);
        }
        let sin = self.part(slot, Part::Sin);
        let cos = self.part(slot, Part::Cos);
        vec![cos, self.graph.neg(sin), sin, cos]
    }

    /// Returns a field of a body's state, or `None` if it has none with this name.
    pub fn state_field(&mut self, slot: usize, dimension: usize, name: &str) -> Option<Value> {
        Some(match (name, dimension) {
            ("r", _) => Value::Vector(self.origin(slot, dimension)),
            ("theta", 2) => Value::Scalar(self.part(slot, Part::Theta)),
            ("sin", 2) => Value::Scalar(self.part(slot, Part::Sin)),
            ("cos", 2) => Value::Scalar(self.part(slot, Part::Cos)),
            ("p", 3) => Value::Euler(self.euler_parameters(slot)),
            ("a", 3) => Value::Matrix(3, self.rotation(slot, 3)),
            _ => return None,
        })
    }

    /// Returns h = A h̄.
    pub fn direction(&mut self, slot: usize, h: &[Node]) -> Vec<Node> {
        let a = self.rotation(slot, h.len());
        self.matrix_vector(&a, h)
    }

    /// Returns r_P = R + A ū.
    pub fn point(&mut self, slot: usize, u: &[Node]) -> Vec<Node> {
        let r = self.origin(slot, u.len());
        let au = self.direction(slot, u);
        r.into_iter().zip(au).map(|(r, au)| self.graph.add(r, au)).collect()
    }

    /// Returns ū = Aᵀ (p − R).
    pub fn local(&mut self, slot: usize, p: &[Node]) -> Vec<Node> {
        let r = self.origin(slot, p.len());
        let a = self.rotation(slot, p.len());
        let d: Vec<Node> = p.iter().zip(r).map(|(&p, r)| self.graph.sub(p, r)).collect();
        let transposed = transpose(&a);
        self.matrix_vector(&transposed, &d)
    }

    pub fn matrix_vector(&mut self, m: &[Node], v: &[Node]) -> Vec<Node> {
        if let Some((p, back)) = self.known_rotation(m) {
            return self.turned(&p, back, v);
        }
        m.chunks(v.len()).map(|row| self.dot(row, v)).collect()
    }

    pub fn dot(&mut self, a: &[Node], b: &[Node]) -> Node {
        let zero = self.graph.zero();
        a.iter().zip(b).fold(zero, |sum, (&x, &y)| {
            let product = self.graph.mul(x, y);
            self.graph.add(sum, product)
        })
    }
}

/// Returns the transpose of a matrix.
pub fn transpose(m: &[Node]) -> Vec<Node> {
    let n = if m.len() == 9 { 3 } else { 2 };
    (0..n * n).map(|k| m[(k % n) * n + k / n]).collect()
}
