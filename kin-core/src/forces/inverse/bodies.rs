//! Builds the balance of one body as nodes; `forces/body.rs` computes the same balance with
//! numbers.

use kin_graph::differentiate::Jets;
use kin_graph::{Function, Graph, Input, Node};

use super::acting::Acts;
use super::frame::{Frame, along_motion};
use super::vectors::Vectors;
use crate::model::formula::{copied, nothing_outside};
use crate::model::loads::Solid;
use crate::numbers::algebra::Vec3;
use crate::program::SELF;

/// The generalised forces of one body, and its potential energy.
struct Balance {
    /// M q̈ − Q_v, one node for each coordinate of the body.
    moving: Vec<Node>,
    weight: Vec<Node>,
    /// The potential energy of the weight, −m g · r_c.
    potential: Node,
}

impl Acts<'_> {
    /// Adds a body whose coordinates begin at index `first`.
    pub(super) fn body(&mut self, solid: &Solid, gravity: [f64; 3], first: usize, count: usize) {
        let orders = along_motion(self.whole, first, count);
        let graph = self.graph();
        let Balance { moving, weight, potential } = match count {
            3 => {
                planar(graph, solid, gravity, orders.each_ref().map(|all| [all[0], all[1], all[2]]))
            }
            _ => spatial(graph, solid, Vec3::from(gravity), orders.each_ref().map(Vec::as_slice)),
        };
        for k in 0..count {
            let rate = orders[1][k];
            let power = self.power(weight[k], rate);
            self.loads = self.whole.graph.add(self.loads, power);
            self.power(moving[k], rate);
            let force = self.graph().sub(weight[k], moving[k]);
            self.act(first + k, force);
        }
        let graph = self.graph();
        let kinetic = if count == 3 { planar_kinetic(solid) } else { spatial_kinetic(solid) };
        let [kinetic, rate] = kinetic.map(|(own, node)| moved(graph, &own, node, &orders));
        self.potential = self.whole.graph.add(self.potential, potential);
        self.kinetic = self.whole.graph.add(self.kinetic, kinetic);
        self.rate = self.whole.graph.add(self.rate, rate);
    }
}

/// Returns A c of a planar body, from sine and cosine of its angle.
fn lever(graph: &mut Graph, theta: Node, [x, y]: [f64; 2]) -> [Node; 2] {
    let sin = graph.call(Function::Sin, theta);
    let cos = graph.call(Function::Cos, theta);
    let [x, y] = [x, y].map(|c| graph.constant(c));
    let [a, b, c, d] = [graph.mul(cos, x), graph.mul(sin, y), graph.mul(sin, x), graph.mul(cos, y)];
    [graph.sub(a, b), graph.add(c, d)]
}

/// Computes a planar body: m a_c acts at the centre, J θ̈ about it. Global axes avoid a rotation
/// into the axes of the body and back.
fn planar(
    graph: &mut Graph,
    solid: &Solid,
    gravity: [f64; 3],
    [[rx, ry, theta], [_, _, w], [ax, ay, alpha]]: [[Node; 3]; 3],
) -> Balance {
    let arm = lever(graph, theta, [solid.centre.x, solid.centre.y]);
    let square = graph.mul(w, w);
    let [m, j, gx, gy] =
        [solid.mass, solid.inertia.m33, gravity[0], gravity[1]].map(|x| graph.constant(x));
    let inwards = arm.map(|arm| graph.mul(square, arm));
    let across = arm.map(|arm| graph.mul(alpha, arm));
    let x = graph.sub(ax, across[1]);
    let y = graph.add(ay, across[0]);
    let a = [graph.sub(x, inwards[0]), graph.sub(y, inwards[1])];
    let generalised = |graph: &mut Graph, f: [Node; 2]| {
        let plus = graph.mul(arm[0], f[1]);
        let minus = graph.mul(arm[1], f[0]);
        [f[0], f[1], graph.sub(plus, minus)]
    };
    let f = a.map(|a| graph.mul(m, a));
    let g = [gx, gy].map(|g| graph.mul(m, g));
    let [x, y, torque] = generalised(graph, f);
    let spin = graph.mul(j, alpha);
    let moving = vec![x, y, graph.add(torque, spin)];
    let weight = generalised(graph, g).to_vec();
    let at = [graph.add(rx, arm[0]), graph.add(ry, arm[1])];
    let height = [graph.mul(g[0], at[0]), graph.mul(g[1], at[1])];
    let height = graph.add(height[0], height[1]);
    Balance { moving, weight, potential: graph.neg(height) }
}

/// Computes a spatial body: m a_c acts at the centre, J ω̄̇ + ω̄ × J ω̄ about it, in the axes of
/// the body.
fn spatial(graph: &mut Graph, solid: &Solid, gravity: Vec3, orders: [&[Node]; 3]) -> Balance {
    let frame = Frame::new(graph, orders);
    let c = graph.vector(solid.centre);
    let turning = graph.cross(frame.omega, c);
    let [along, inwards] = [graph.cross(frame.alpha, c), graph.cross(frame.omega, turning)];
    let arm = graph.plus(along, inwards);
    let arm = frame.global(graph, arm);
    let a = graph.plus(frame.second, arm);
    let [spin, rest] =
        [frame.omega, frame.alpha].map(|omega| graph.apply_numbers(solid.inertia, omega));
    let gyroscopic = graph.cross(frame.omega, spin);
    let torque = graph.plus(rest, gyroscopic);
    let moving = graph.times(a, solid.mass);
    let weight = graph.vector(gravity * solid.mass);
    let at_origin = |graph: &mut Graph, f, torque| {
        let local = frame.local(graph, f);
        let moment = graph.cross(c, local);
        let torque = graph.plus(torque, moment);
        frame.generalised(graph, f, torque)
    };
    let none = graph.vector(Vec3::zeros());
    let moving = at_origin(graph, moving, torque);
    let weight = at_origin(graph, weight, none);
    let height = frame.global(graph, c);
    let at = graph.plus(frame.r, height);
    let upwards = graph.vector(gravity * -solid.mass);
    Balance { moving, weight, potential: graph.dot(upwards, at) }
}

/// Returns T and dT/dt of a planar body in separate graphs. Coordinates are states, and their
/// velocities are the states that follow, so T can be differentiated by both.
fn planar_kinetic(solid: &Solid) -> [(Graph, Node); 2] {
    let mut graph = Graph::default();
    let [theta, vx, vy, w] = [2, 3, 4, 5].map(|k| graph.input(Input::State(k, SELF)));
    let arm = lever(&mut graph, theta, [solid.centre.x, solid.centre.y]);
    let [x, y] = arm.map(|arm| graph.mul(w, arm));
    let v = [graph.sub(vx, y), graph.add(vy, x)];
    let [x, y, w] = [v[0], v[1], w].map(|v| graph.mul(v, v));
    let square = graph.add(x, y);
    let [m, j] = [0.5 * solid.mass, 0.5 * solid.inertia.m33].map(|x| graph.constant(x));
    let [moving, turning] = [graph.mul(m, square), graph.mul(j, w)];
    let kinetic = graph.add(moving, turning);
    with_rate(graph, kinetic)
}

/// Returns T and dT/dt of a spatial body in separate graphs.
fn spatial_kinetic(solid: &Solid) -> [(Graph, Node); 2] {
    let mut graph = Graph::default();
    let count = 7;
    let [q, qd] = [0, count].map(|first| {
        (first..first + count).map(|k| graph.input(Input::State(k, SELF))).collect::<Vec<Node>>()
    });
    let frame = Frame::new(&mut graph, [&q, &qd, &qd]);
    let c = graph.vector(solid.centre);
    let turning = graph.cross(frame.omega, c);
    let turning = frame.global(&mut graph, turning);
    let v = graph.plus(frame.rate, turning);
    let spin = graph.apply_numbers(solid.inertia, frame.omega);
    let [square, turning] = [graph.dot(v, v), graph.dot(frame.omega, spin)];
    let [m, half] = [0.5 * solid.mass, 0.5].map(|x| graph.constant(x));
    let [moving, turning] = [graph.mul(m, square), graph.mul(half, turning)];
    let kinetic = graph.add(moving, turning);
    with_rate(graph, kinetic)
}

/// Returns T, and its derivative along the motion.
fn with_rate(mut graph: Graph, kinetic: Node) -> [(Graph, Node); 2] {
    let rate = Jets::default().of(&mut graph, kinetic).first;
    [(graph.clone(), kinetic), (graph, rate)]
}

/// Copies a node of such a graph to the whole graph, with the body's coordinates there.
fn moved(graph: &mut Graph, own: &Graph, node: Node, orders: &[Vec<Node>; 3]) -> Node {
    let count = orders[0].len();
    let found = copied(own, node, graph, &nothing_outside, &mut |_, input| {
        // The derivative of a state that is a velocity is an acceleration.
        let (order, k) = match input {
            Input::State(k, _) => (k / count, k % count),
            Input::Rate(k, _) => (1 + k / count, k % count),
            _ => return None,
        };
        orders.get(order)?.get(k).copied()
    });
    found.unwrap_or_else(|| graph.constant(f64::NAN))
}
