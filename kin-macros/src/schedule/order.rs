//! In which order to compute: each output as soon as it can be had, and next the one that takes the least beyond what is there already.

use crate::graph::{Graph, Node, Op};

/// What to compute, and which output is complete then (by its number).
pub struct Group {
    pub nodes: Vec<Node>,
    pub output: usize,
}

/// Every node needed for `outputs`, operands before their users, cut where an output is complete.
pub fn order(g: &Graph, outputs: &[Node]) -> Vec<Group> {
    let mut known = vec![false; g.len()];
    let mut seen = vec![usize::MAX; g.len()];
    // Which outputs wait for a node, and for how many each.
    let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); g.len()];
    let mut missing = vec![0; outputs.len()];
    for (k, &output) in outputs.iter().enumerate() {
        for node in needed(g, output, &known, &mut seen, k) {
            waiting[node.index()].push(k);
            missing[k] += 1;
        }
    }
    let mut open: Vec<usize> = (0..outputs.len()).collect();
    let mut groups = Vec::new();
    while let Some(place) = (0..open.len()).min_by_key(|&place| missing[open[place]]) {
        let output = open.remove(place);
        let nodes = needed(g, outputs[output], &known, &mut seen, outputs.len() + output);
        for node in &nodes {
            known[node.index()] = true;
            waiting[node.index()].iter().for_each(|&other| missing[other] -= 1);
        }
        groups.push(Group { nodes, output });
    }
    groups
}

/// What `output` needs beyond the `known`, operands first, each as late as possible. Nodes `seen` in this turn are not looked at again.
fn needed(g: &Graph, output: Node, known: &[bool], seen: &mut [usize], turn: usize) -> Vec<Node> {
    let mut order = Vec::new();
    let mut open = vec![(output, false)];
    while let Some((node, operands_done)) = open.pop() {
        if operands_done {
            order.push(node);
        } else if !known[node.index()] && seen[node.index()] != turn && !is_given(g, node) {
            seen[node.index()] = turn;
            open.push((node, true));
            let operands = open.len();
            g.each_operand(node, |operand| open.push((operand, false)));
            // The last one is looked at first: of a fused operation the sum so far, which waits in one register while the product takes two.
            if !matches!(g.op(node), Op::Fma(..)) {
                open[operands..].reverse();
            }
        }
    }
    order
}

fn is_given(g: &Graph, node: Node) -> bool {
    matches!(g.op(node), Op::Input(_) | Op::Constant(_) | Op::Truth(_))
}
