//! Implements vectors and matrices of nodes.

use kin_graph::{Function, Graph, Node};

use crate::numbers::algebra::{Mat3, Vec3};

/// The components x, y and z.
pub(super) type Nodes3 = [Node; 3];

/// Operations on vectors, as nodes of a graph.
pub(super) trait Vectors {
    fn vector(&mut self, v: Vec3) -> Nodes3;
    fn plus(&mut self, a: Nodes3, b: Nodes3) -> Nodes3;
    fn minus(&mut self, a: Nodes3, b: Nodes3) -> Nodes3;
    fn times(&mut self, a: Nodes3, factor: f64) -> Nodes3;
    fn dot(&mut self, a: Nodes3, b: Nodes3) -> Node;
    fn cross(&mut self, a: Nodes3, b: Nodes3) -> Nodes3;
    /// Returns M v of a matrix by rows.
    fn apply(&mut self, rows: [Nodes3; 3], v: Nodes3) -> Nodes3;
    /// Returns M v of a matrix of numbers.
    fn apply_numbers(&mut self, matrix: Mat3, v: Nodes3) -> Nodes3;
    /// Returns A of a planar body, by rows.
    fn turn(&mut self, angle: Node) -> [Nodes3; 3];
    /// Returns A(p) = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ, by rows.
    fn rotation(&mut self, p: [Node; 4]) -> [Nodes3; 3];
}

/// Returns Mᵀ.
pub(super) fn transposed(rows: [Nodes3; 3]) -> [Nodes3; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| rows[j][i]))
}

impl Vectors for Graph {
    fn vector(&mut self, v: Vec3) -> Nodes3 {
        v.to_array().map(|x| self.constant(x))
    }

    fn plus(&mut self, a: Nodes3, b: Nodes3) -> Nodes3 {
        [0, 1, 2].map(|k| self.add(a[k], b[k]))
    }

    fn minus(&mut self, a: Nodes3, b: Nodes3) -> Nodes3 {
        [0, 1, 2].map(|k| self.sub(a[k], b[k]))
    }

    fn times(&mut self, a: Nodes3, factor: f64) -> Nodes3 {
        let factor = self.constant(factor);
        a.map(|x| self.mul(factor, x))
    }

    fn dot(&mut self, a: Nodes3, b: Nodes3) -> Node {
        let zero = self.zero();
        a.into_iter().zip(b).fold(zero, |sum, (a, b)| {
            let product = self.mul(a, b);
            self.add(sum, product)
        })
    }

    fn cross(&mut self, a: Nodes3, b: Nodes3) -> Nodes3 {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let plus = self.mul(a[i], b[j]);
            let minus = self.mul(a[j], b[i]);
            self.sub(plus, minus)
        })
    }

    fn apply(&mut self, rows: [Nodes3; 3], v: Nodes3) -> Nodes3 {
        rows.map(|row| self.dot(row, v))
    }

    fn apply_numbers(&mut self, matrix: Mat3, v: Nodes3) -> Nodes3 {
        [0, 1, 2].map(|k| {
            let row = self.vector(matrix.row(k));
            self.dot(row, v)
        })
    }

    fn turn(&mut self, angle: Node) -> [Nodes3; 3] {
        let sin = self.call(Function::Sin, angle);
        let cos = self.call(Function::Cos, angle);
        let minus = self.neg(sin);
        let zero = self.zero();
        let one = self.constant(1.0);
        [[cos, minus, zero], [sin, cos, zero], [zero, zero, one]]
    }

    fn rotation(&mut self, [e0, e @ ..]: [Node; 4]) -> [Nodes3; 3] {
        let double = e.map(|x| self.add(x, x));
        let scalar = self.add(e0, e0);
        let square = self.mul(scalar, e0);
        let one = self.constant(1.0);
        let diagonal = self.sub(square, one);
        // ẽ, as index of the component with its sign.
        let skew =
            [[(0, 0), (2, -1), (1, 1)], [(2, 1), (0, 0), (0, -1)], [(1, -1), (0, 1), (0, 0)]];
        [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                let outer = self.mul(double[i.min(j)], e[i.max(j)]);
                let (k, sign) = skew[i][j];
                match sign {
                    0 => self.add(diagonal, outer),
                    1 => {
                        let turn = self.mul(e[k], scalar);
                        self.add(outer, turn)
                    }
                    _ => {
                        let turn = self.mul(e[k], scalar);
                        self.sub(outer, turn)
                    }
                }
            })
        })
    }
}
