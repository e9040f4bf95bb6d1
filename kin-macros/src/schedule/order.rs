//! In which order to compute: each output as soon as it can be had, and next the one that takes the least beyond what is there already.

use std::cmp::Reverse;

use crate::graph::{Graph, Node, Op};

/// What to compute, and which output is complete then (by its number).
pub struct Group {
    pub nodes: Vec<Node>,
    pub output: usize,
}

/// Every node needed for `outputs`, operands before their users, cut where an output is complete.
pub fn order(g: &Graph, outputs: &[Node]) -> Vec<Group> {
    let needed: Vec<Vec<Node>> = outputs.iter().map(|&output| needed(g, output, &vec![false; g.len()])).collect();
    let mut missing: Vec<usize> = needed.iter().map(Vec::len).collect();
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); g.len()];
    for (output, nodes) in needed.iter().enumerate() {
        nodes.iter().for_each(|node| users[node.index()].push(output));
    }
    let mut known = vec![false; g.len()];
    let mut open: Vec<usize> = (0..outputs.len()).rev().collect();
    let mut groups = Vec::new();
    while let Some(place) = (0..open.len()).min_by_key(|&place| (missing[open[place]], Reverse(place))) {
        let output = open.remove(place);
        let nodes = self::needed(g, outputs[output], &known);
        for node in &nodes {
            known[node.index()] = true;
            users[node.index()].iter().for_each(|&other| missing[other] -= 1);
        }
        groups.push(Group { nodes, output });
    }
    groups
}

/// What `output` needs beyond the `known`, operands first, each as late as possible.
fn needed(g: &Graph, output: Node, known: &[bool]) -> Vec<Node> {
    let mut order = Vec::new();
    let mut seen = vec![false; output.index() + 1];
    let mut open = vec![(output, false)];
    while let Some((node, operands_done)) = open.pop() {
        if operands_done {
            order.push(node);
        } else if !known[node.index()] && !is_given(g, node) && !std::mem::replace(&mut seen[node.index()], true) {
            open.push((node, true));
            open.extend(g.operands(node).into_iter().rev().map(|operand| (operand, false)));
        }
    }
    order
}

fn is_given(g: &Graph, node: Node) -> bool {
    matches!(g.op(node), Op::Input(_) | Op::Constant(_) | Op::Truth(_))
}
