//! The rotation matrix of Euler parameters, and the cheapest form of its products with vectors.

use super::{Values, transpose};
use kin_graph::{Graph, Node};

impl Values {
    /// Returns A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ, row by row.
    pub fn rotation_of(&mut self, p: &[Node]) -> Vec<Node> {
        let one = self.graph.constant(1.0);
        let two = self.graph.constant(2.0);
        let entry = |g: &mut Graph, row: usize, column: usize| {
            if row == column {
                let scalar = g.mul(p[0], p[0]);
                let axis = g.mul(p[row + 1], p[row + 1]);
                let sum = g.add(scalar, axis);
                let double = g.mul(two, sum);
                return g.sub(double, one);
            }
            let outer = g.mul(p[row + 1], p[column + 1]);
            let turn = g.mul(p[0], p[4 - row - column]);
            let sum = if column == (row + 1) % 3 { g.sub(outer, turn) } else { g.add(outer, turn) };
            g.mul(two, sum)
        };
        let a: Vec<Node> = (0..9).map(|k| entry(&mut self.graph, k / 3, k % 3)).collect();
        self.rotations.insert(a.clone(), p.to_vec());
        a
    }

    /// Returns the Euler parameters of a rotation matrix, and true if the matrix is transposed;
    /// returns `None` for any other matrix.
    pub fn known_rotation(&self, m: &[Node]) -> Option<(Vec<Node>, bool)> {
        let find = |m: &[Node], back| self.rotations.get(m).map(|p| (p.clone(), back));
        find(m, false).or_else(|| find(&transpose(m), true))
    }

    /// Returns A v, or Aᵀ v if `back`, as 2 (e0 w + r e) − v with w = e0 v ± e × v and r = e · v.
    /// This form needs fewer products than the nine entries of A, and w and r are most of the
    /// derivatives with respect to p.
    pub fn turned(&mut self, p: &[Node], back: bool, v: &[Node]) -> Vec<Node> {
        let e0 = p[0];
        let e = &p[1..];
        let r = self.dot(e, v);
        let g = &mut self.graph;
        let two = g.constant(2.0);
        let component = |k: usize| {
            let (next, last) =
                if back { ((k + 2) % 3, (k + 1) % 3) } else { ((k + 1) % 3, (k + 2) % 3) };
            let straight = g.mul(e0, v[k]);
            let plus = g.mul(e[next], v[last]);
            let minus = g.mul(e[last], v[next]);
            let w = g.sub(straight, minus);
            let w = g.add(w, plus);
            let turned = g.mul(e0, w);
            let along = g.mul(r, e[k]);
            let half = g.add(turned, along);
            let double = g.mul(two, half);
            g.sub(double, v[k])
        };
        (0..3).map(component).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Values, transpose};
    use kin_graph::{Graph, Input, Part};

    #[test]
    fn a_rotation_is_known_again_and_turned_back() {
        let mut values = Values::new(Graph::default());
        let p: Vec<_> = (0..4).map(|k| values.graph.input(Input::State(0, Part::P(k)))).collect();
        let a = values.rotation_of(&p);
        assert_eq!(values.known_rotation(&a), Some((p.clone(), false)));
        assert_eq!(values.known_rotation(&transpose(&a)), Some((p, true)));
        let one = values.graph.constant(1.0);
        assert_eq!(values.known_rotation(&[one; 9]), None);
    }
}
