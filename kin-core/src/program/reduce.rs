//! The graph in which what rows give is put in: coordinates are nodes of what is torn and of time.

use kin_graph::{Graph, Input, Node, Op};

use super::gather::Whole;
use super::kind::SELF;
use super::substitute::Order;

/// A graph on the way from that of a whole: what each of its nodes has become.
pub(crate) struct Reduced<'a> {
    from: &'a Graph,
    pub graph: Graph,
    places: Vec<Option<Node>>,
}

impl<'a> Reduced<'a> {
    /// With nothing put in.
    pub(crate) fn of_all(from: &'a Graph) -> Self {
        Reduced { from, graph: Graph::default(), places: vec![None; from.len()] }
    }

    /// With all coordinates put in: their nodes, by coordinates.
    pub(super) fn new(whole: &'a Whole, order: &Order) -> (Self, Vec<Node>) {
        let mut reduced = Reduced::of_all(&whole.graph);
        let mut values = vec![Node::default(); whole.n];
        for &column in &order.torn {
            values[column] = reduced.graph.input(Input::State(column, SELF));
            reduced.put(Input::State(column, SELF), values[column]);
        }
        for given in &order.explicit {
            let rest = reduced.of(given.rest);
            values[given.column] = over(&mut reduced.graph, rest, -given.factor);
            reduced.put(Input::State(given.column, SELF), values[given.column]);
        }
        (reduced, values)
    }

    /// An input is this node from now on.
    pub(crate) fn put(&mut self, input: Input, node: Node) {
        if let Some(own) = self.from.existing(Op::Input(input)) {
            self.places[own.index()] = Some(node);
        }
    }

    /// Forgets what the nodes that are computed from these inputs have become, sines and cosines of
    /// them but: those stay.
    pub(crate) fn rewrite(&mut self, inputs: impl Iterator<Item = (Input, Node)>) {
        let mut kept = vec![None; self.from.len()];
        for (input, node) in inputs {
            let Some(own) = self.from.existing(Op::Input(input)) else { continue };
            kept[own.index()] = Some(node);
            for f in [kin_graph::Function::Sin, kin_graph::Function::Cos] {
                let Some(own) = self.from.existing(Op::Call(f, own)) else { continue };
                kept[own.index()] = self.places[own.index()];
            }
        }
        self.places = kept;
    }

    /// Inputs are these nodes from now on: what is computed from them is forgotten, and nothing
    /// else.
    pub(crate) fn replace(&mut self, inputs: impl Iterator<Item = (Input, Node)>) {
        let mut replaced = vec![false; self.from.len()];
        for (input, node) in inputs {
            let Some(own) = self.from.existing(Op::Input(input)) else { continue };
            replaced[own.index()] = self.places[own.index()].is_some_and(|before| before != node);
            self.places[own.index()] = Some(node);
        }
        // Operands have smaller numbers than what is computed from them.
        for node in self.from.nodes() {
            let mut stale = false;
            self.from.each_operand(node, |operand| stale |= replaced[operand.index()]);
            if stale {
                replaced[node.index()] = true;
                self.places[node.index()] = None;
            }
        }
    }

    /// The node that stands for another one now.
    pub(crate) fn of(&mut self, node: Node) -> Node {
        let mut open = vec![node];
        while let Some(&next) = open.last() {
            if self.places[next.index()].is_some() {
                open.pop();
                continue;
            }
            let before = open.len();
            self.from.each_operand(next, |operand| {
                if self.places[operand.index()].is_none() {
                    open.push(operand);
                }
            });
            if open.len() == before {
                self.places[next.index()] = Some(self.node(next));
                open.pop();
            }
        }
        self.places[node.index()].unwrap_or_default()
    }

    /// A node whose operands are there.
    fn node(&mut self, node: Node) -> Node {
        let places = &self.places;
        let of = |node: Node| places[node.index()].unwrap_or_default();
        let to = &mut self.graph;
        match self.from.op(node) {
            Op::Input(input) => to.input(input),
            Op::Law(law, x, order) => to.law(law, of(x), order),
            op => to.rebuilt(op, of).unwrap_or_else(|| to.constant(f64::NAN)),
        }
    }
}

/// x / c
pub(super) fn over(graph: &mut Graph, x: Node, c: f64) -> Node {
    if c == 1.0 {
        return x;
    }
    if c == -1.0 {
        return graph.neg(x);
    }
    let c = graph.constant(c);
    graph.div(x, c)
}
