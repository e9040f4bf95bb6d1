//! Sums and products of vectors, matrices and Euler parameters.

use super::{Values, transpose};
use kin_graph::{Function, Graph, Node};

impl Values {
    pub fn matrix_matrix(&mut self, n: usize, a: &[Node], b: &[Node]) -> Vec<Node> {
        let columns = transpose(b);
        (0..n * n).map(|k| self.dot(&a[k / n * n..][..n], &columns[k % n * n..][..n])).collect()
    }

    /// Returns the quaternion product p q.
    pub fn euler_product(&mut self, p: &[Node], q: &[Node]) -> Vec<Node> {
        const TERMS: [[(usize, bool); 4]; 4] = [
            [(0, true), (1, false), (2, false), (3, false)],
            [(1, true), (0, true), (3, false), (2, true)],
            [(2, true), (3, true), (0, true), (1, false)],
            [(3, true), (2, false), (1, true), (0, true)],
        ];
        // Component k is Σ_j ± p_i q_j, with (i, sign) listed by j.
        let component = |reader: &mut Self, terms: &[(usize, bool); 4]| {
            let zero = reader.graph.zero();
            terms.iter().zip(q).fold(zero, |sum, (&(i, plus), &q)| {
                let product = reader.graph.mul(p[i], q);
                if plus { reader.graph.add(sum, product) } else { reader.graph.sub(sum, product) }
            })
        };
        TERMS.iter().map(|terms| component(self, terms)).collect()
    }

    pub fn norm(&mut self, v: &[Node]) -> Node {
        let square = self.dot(v, v);
        self.graph.call(Function::Sqrt, square)
    }

    /// Returns a (1 − t) + b t.
    pub fn lerp(&mut self, a: &[Node], b: &[Node], t: Node) -> Vec<Node> {
        let one = self.graph.constant(1.0);
        let rest = self.graph.sub(one, t);
        let weighted = |g: &mut Graph, a: Node, b: Node| {
            let a = g.mul(a, rest);
            let b = g.mul(b, t);
            g.add(a, b)
        };
        a.iter().zip(b).map(|(&a, &b)| weighted(&mut self.graph, a, b)).collect()
    }

    /// Returns ã, with ã b = a × b.
    pub fn skew(&mut self, a: &[Node]) -> Vec<Node> {
        let zero = self.graph.zero();
        let minus = [a[0], a[1], a[2]].map(|n| self.graph.neg(n));
        vec![zero, minus[2], a[1], a[2], zero, minus[0], minus[1], a[0], zero]
    }

    /// Returns (cos φ/2, u sin φ/2).
    pub fn axis_angle(&mut self, axis: &[Node], angle: Node) -> Vec<Node> {
        let half = self.graph.constant(0.5);
        let half = self.graph.mul(half, angle);
        let sin = self.graph.call(Function::Sin, half);
        let cos = self.graph.call(Function::Cos, half);
        let norm = self.norm(axis);
        let unit: Vec<Node> = axis.iter().map(|&n| self.graph.div(n, norm)).collect();
        std::iter::once(cos).chain(unit.into_iter().map(|n| self.graph.mul(n, sin))).collect()
    }

    /// Returns a d − b c.
    pub fn determinant2(&mut self, a: Node, b: Node, c: Node, d: Node) -> Node {
        let ad = self.graph.mul(a, d);
        let bc = self.graph.mul(b, c);
        self.graph.sub(ad, bc)
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::Values;
    use kin_graph::{Graph, Node};

    fn numbers(values: &mut Values, all: &[f64]) -> Vec<Node> {
        all.iter().map(|&x| values.graph.constant(x)).collect()
    }

    fn constants(values: &Values, nodes: &[Node]) -> Vec<f64> {
        nodes.iter().map(|&n| values.graph.constant_value(n).unwrap_or(f64::NAN)).collect()
    }

    #[test]
    fn products_of_constants_are_constants() {
        let mut values = Values::new(Graph::default());
        let v = numbers(&mut values, &[3.0, 4.0]);
        let norm = values.norm(&v);
        assert_eq!(constants(&values, &[norm]), [5.0]);
        let m = numbers(&mut values, &[1.0, 2.0, 3.0, 4.0]);
        let square = values.matrix_matrix(2, &m, &m);
        assert_eq!(constants(&values, &square), [7.0, 10.0, 15.0, 22.0]);
    }

    #[test]
    fn i_j_is_k() {
        let mut values = Values::new(Graph::default());
        let i = numbers(&mut values, &[0.0, 1.0, 0.0, 0.0]);
        let j = numbers(&mut values, &[0.0, 0.0, 1.0, 0.0]);
        let k = values.euler_product(&i, &j);
        assert_eq!(constants(&values, &k), [0.0, 0.0, 0.0, 1.0]);
        let back = values.euler_product(&j, &i);
        assert_eq!(constants(&values, &back), [0.0, 0.0, 0.0, -1.0]);
    }
}
