//! Builds nodes of a body: its position, its motion, and the coordinates on which forces act.

use kin_graph::{Graph, Input, Node};

use super::vectors::{Nodes3, Vectors, transposed};
use crate::coordinates::layout::Kind;
use crate::program::{SELF, Whole};

/// The position, velocity and acceleration of a body's frame.
pub(super) struct Frame {
    /// R, and A by rows.
    pub r: Nodes3,
    pub a: [Nodes3; 3],
    /// Ṙ, and ω̄ in the axes of the body.
    pub rate: Nodes3,
    pub omega: Nodes3,
    /// R̈ and ω̄̇.
    pub second: Nodes3,
    pub alpha: Nodes3,
    /// The Euler parameters; `None` for a planar body.
    p: Option<[Node; 4]>,
}

/// Returns the number of coordinates of a body, or `None` for a scalar coordinate.
pub(super) fn coordinates(kind: Kind) -> Option<usize> {
    matches!(kind, Kind::Planar | Kind::Spatial).then(|| kind.coordinates().len())
}

/// Returns q, q̇ and q̈ of a body whose coordinates begin at index `first` of a motion.
pub(super) fn along_motion(whole: &mut Whole, first: usize, count: usize) -> [Vec<Node>; 3] {
    let all = first..first + count;
    let q = all.clone().map(|k| whole.coordinate(k)).collect();
    let qd = all.clone().map(|k| whole.moving(k, Input::Rate(k, SELF))).collect();
    [q, qd, all.map(|k| whole.moving(k, Input::Parameter(k))).collect()]
}

impl Frame {
    /// Creates the frame from the coordinates and their derivatives.
    pub(super) fn new(graph: &mut Graph, [q, qd, qdd]: [&[Node]; 3]) -> Frame {
        let zero = graph.zero();
        match q {
            &[x, y, theta] => Frame {
                r: [x, y, zero],
                a: graph.turn(theta),
                rate: [qd[0], qd[1], zero],
                omega: [zero, zero, qd[2]],
                second: [qdd[0], qdd[1], zero],
                alpha: [zero, zero, qdd[2]],
                p: None,
            },
            _ => {
                let vector = |q: &[Node]| [q[0], q[1], q[2]];
                let p = [q[3], q[4], q[5], q[6]];
                Frame {
                    r: vector(q),
                    a: graph.rotation(p),
                    rate: vector(qd),
                    omega: omega(graph, p, &qd[3..]),
                    second: vector(qdd),
                    alpha: omega(graph, p, &qdd[3..]),
                    p: Some(p),
                }
            }
        }
    }

    /// Returns A v of a vector in the axes of the body.
    pub(super) fn global(&self, graph: &mut Graph, v: Nodes3) -> Nodes3 {
        graph.apply(self.a, v)
    }

    /// Returns Aᵀ v of a global vector.
    pub(super) fn local(&self, graph: &mut Graph, v: Nodes3) -> Nodes3 {
        graph.apply(transposed(self.a), v)
    }

    /// Returns Q of a global force at the body's origin and a torque in its axes: (F, 2 Ḡᵀ T̄).
    pub(super) fn generalised(&self, graph: &mut Graph, f: Nodes3, torque: Nodes3) -> Vec<Node> {
        let Some([e0, e @ ..]) = self.p else { return vec![f[0], f[1], torque[2]] };
        // p (0, T̄), twice.
        let scalar = graph.dot(e, torque);
        let scalar = graph.neg(scalar);
        let along = torque.map(|t| graph.mul(e0, t));
        let across = graph.cross(e, torque);
        let vector = graph.plus(along, across);
        let by_p =
            [scalar].into_iter().chain(vector).map(|x| graph.add(x, x)).collect::<Vec<Node>>();
        f.into_iter().chain(by_p).collect()
    }
}

/// Returns ω̄ = 2 Ḡ ṗ: twice the vector part of p* ṗ.
fn omega(graph: &mut Graph, [e0, e @ ..]: [Node; 4], rate: &[Node]) -> Nodes3 {
    let f0 = rate[0];
    let f = [rate[1], rate[2], rate[3]];
    let along = f.map(|f| graph.mul(e0, f));
    let back = e.map(|e| graph.mul(f0, e));
    let cross = graph.cross(e, f);
    let half = graph.minus(along, back);
    let half = graph.minus(half, cross);
    half.map(|x| graph.add(x, x))
}
