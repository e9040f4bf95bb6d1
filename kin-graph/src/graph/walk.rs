//! Walks from a node to its operands.

use super::{Column, Graph, Input, LeafNumber, LeafUse, Node, Op, Part};

impl Graph {
    /// Returns the operands of `node`.
    pub fn operands(&self, node: Node) -> Vec<Node> {
        let mut operands = Vec::new();
        self.each_operand(node, |operand| operands.push(operand));
        operands
    }

    /// Returns the nodes from whose numbers `node` is computed.
    ///
    /// For a selection the result is the selected operand, for a condition it is empty, and
    /// otherwise the operands.
    pub fn numbers_behind(&self, node: Node, holds: impl Fn(Node) -> bool) -> Vec<Node> {
        match self.op(node) {
            Op::Select(c, a, b) => vec![if holds(c) { a } else { b }],
            Op::Compare(..) | Op::And(..) | Op::Or(..) | Op::Not(_) => vec![],
            _ => self.operands(node),
        }
    }

    /// Passes the operands of `node` to `show`, in order.
    pub fn each_operand(&self, node: Node, mut show: impl FnMut(Node)) {
        match self.op(node) {
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) => {}
            Op::Neg(a) | Op::Call(_, a) | Op::Powi(a, _) | Op::Law(_, a, _) | Op::Not(a) => show(a),
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => {
                [a, b].into_iter().for_each(show)
            }
            Op::Call2(_, a, b) | Op::Compare(_, a, b) | Op::And(a, b) | Op::Or(a, b) => {
                [a, b].into_iter().for_each(show)
            }
            Op::Select(a, b, c) | Op::Fma(a, b, c) => [a, b, c].into_iter().for_each(show),
            Op::Opaque(number, _) => self.opaques[number].iter().copied().for_each(show),
            Op::Leaf(LeafUse { leaf, what, .. }) => {
                self.leaf_operands(leaf, what).into_iter().for_each(show)
            }
        }
    }

    fn leaf_operands(&self, leaf: usize, what: LeafNumber) -> Vec<Node> {
        let mut operands = self.leaves[leaf].arguments.clone();
        if let LeafNumber::First(k) | LeafNumber::Second(k) = what {
            operands.extend(&self.directions[k].first);
            operands.extend(&self.directions[k].second);
            operands.extend(self.directions[k].moves.iter().flatten());
        }
        operands
    }

    /// Returns all columns on which `outputs` can depend.
    pub fn columns(&self, outputs: &[Node]) -> Vec<Column> {
        let mut columns: Vec<Column> = Vec::new();
        for node in self.reachable(outputs) {
            if let Op::Input(Input::State(argument, part)) = self.op(node) {
                columns
                    .extend(coordinates_behind(part).iter().map(|&part| Column { argument, part }));
            }
        }
        columns.sort();
        columns.dedup();
        columns
    }

    /// Returns `nodes` and their operands, in order of creation, up to known nodes.
    pub fn unknown(&self, nodes: &[Node], known: impl Fn(Node) -> bool) -> Vec<Node> {
        let mut seen = vec![false; self.ops.len()];
        let mut open = nodes.to_vec();
        let mut found = Vec::new();
        while let Some(node) = open.pop() {
            if !seen[node.index()] && !known(node) {
                seen[node.index()] = true;
                found.push(node);
                self.each_operand(node, |operand| open.push(operand));
            }
        }
        found.sort_unstable();
        found
    }

    /// Returns every node that `outputs` need, in order of creation, so that operands come before
    /// their users.
    pub fn reachable(&self, outputs: &[Node]) -> Vec<Node> {
        self.reachable_from(outputs, |_| false)
    }

    /// Returns every node that `outputs` need, without the operands of `known` nodes.
    ///
    /// One backward pass visits each node after all of its users.
    pub fn reachable_from(&self, outputs: &[Node], known: impl Fn(Node) -> bool) -> Vec<Node> {
        let last = outputs.iter().max().map_or(0, |last| last.index() + 1);
        let mut needed = vec![false; last];
        outputs.iter().for_each(|output| needed[output.index()] = true);
        let mut found = Vec::new();
        for k in (0..last).rev() {
            if needed[k] {
                let node = Node(k as u32);
                found.push(node);
                if !known(node) {
                    self.each_operand(node, |operand| needed[operand.index()] = true);
                }
            }
        }
        found.reverse();
        found
    }
}

/// The coordinates that a part of a state is a function of.
fn coordinates_behind(part: Part) -> &'static [Part] {
    match part {
        Part::R(0) => &[Part::R(0)],
        Part::R(1) => &[Part::R(1)],
        Part::R(_) => &[Part::R(2)],
        Part::Theta | Part::Sin | Part::Cos => &[Part::Theta],
        Part::P(0) => &[Part::P(0)],
        Part::P(1) => &[Part::P(1)],
        Part::P(2) => &[Part::P(2)],
        Part::P(_) => &[Part::P(3)],
    }
}
