//! Builds the graph after substitution: coordinates are nodes of torn coordinates and time.

use kin_graph::{Graph, Input, Node, Op};

use super::gather::Whole;
use super::kind::SELF;
use super::substitute::Order;

/// A graph under construction, with the new node of each old one.
pub(crate) struct Reduced<'a> {
    /// The original graph.
    from: &'a Graph,
    /// The new graph.
    pub graph: Graph,
    /// For each old node its new node; `None` if it is not copied yet.
    places: Vec<Option<Node>>,
}

impl<'a> Reduced<'a> {
    /// Creates a reduction without substitutions.
    pub(crate) fn of_all(from: &'a Graph) -> Self {
        Reduced { from, graph: Graph::default(), places: vec![None; from.len()] }
    }

    /// Creates a reduction with all coordinates substituted. Returns the node of each coordinate
    /// too.
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

    /// Replaces an input by a node from now on.
    pub(crate) fn put(&mut self, input: Input, node: Node) {
        if let Some(own) = self.from.existing(Op::Input(input)) {
            self.places[own.index()] = Some(node);
        }
    }

    /// Discards the new nodes of everything computed from these inputs, except sines and cosines of
    /// them.
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

    /// Replaces inputs by nodes from now on, and discards the new nodes of everything computed from
    /// them.
    pub(crate) fn replace(&mut self, inputs: impl Iterator<Item = (Input, Node)>) {
        let mut replaced = vec![false; self.from.len()];
        for (input, node) in inputs {
            let Some(own) = self.from.existing(Op::Input(input)) else { continue };
            replaced[own.index()] = self.places[own.index()].is_some_and(|before| before != node);
            self.places[own.index()] = Some(node);
        }
        // Operands have smaller indices than their results.
        for node in self.from.nodes() {
            let mut stale = false;
            self.from.each_operand(node, |operand| stale |= replaced[operand.index()]);
            if stale {
                replaced[node.index()] = true;
                self.places[node.index()] = None;
            }
        }
    }

    /// Returns the new node of an old one.
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

    /// Copies a node whose operands are copied.
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

/// Returns x / c.
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
