//! Chooses the order of computation: each output as early as possible, and next the output after
//! which the fewest values remain for later use.

use super::{Branches, Lists};
use crate::{Graph, Node, Op};

/// Nodes to compute, and the index of the output that is complete after them.
pub struct Group {
    pub nodes: Vec<Node>,
    pub output: usize,
    /// True if at least one node is more than a sign.
    pub computes: bool,
}

/// A graph, and the choices that its code makes.
type Code<'a> = (&'a Graph, &'a Branches);

/// So many outputs, those that take the least, are looked at before one is chosen.
const CANDIDATES: usize = 8;

/// Returns every node that `outputs` need except the `given` nodes, in groups that end where an
/// output is complete.
///
/// Operands come before their users. The order of a branch contains the nodes that only this branch
/// needs.
pub fn order(
    g: &Graph,
    branches: &Branches,
    outputs: &[Node],
    given: impl Fn(Node) -> bool,
) -> Vec<Group> {
    let nodes = branches.reachable(g, outputs, &given);
    let mut known = vec![false; g.len()];
    nodes.iter().for_each(|&node| known[node.index()] = given(node));
    let mut seen = vec![0; g.len()];
    let mut turn = 0;
    // Which outputs wait for a node, and for how many each.
    let mut waiting: Lists<usize> = Lists::new(g.len());
    let mut missing = vec![0; outputs.len()];
    for (k, &output) in outputs.iter().enumerate() {
        turn += 1;
        for node in needed((g, branches), output, &known, &mut seen, turn) {
            waiting.to(node).push(k);
            missing[k] += 1;
        }
    }
    let mut left = super::uses(g, branches, &nodes, outputs);
    let mut open: Vec<usize> = (0..outputs.len()).collect();
    let mut groups = Vec::new();
    while !open.is_empty() {
        open.sort_by_key(|&output| missing[output]);
        let mut best: Option<((isize, usize), usize, Vec<Node>)> = None;
        for place in 0..open.len().min(CANDIDATES) {
            turn += 1;
            let nodes = needed((g, branches), outputs[open[place]], &known, &mut seen, turn);
            let key = (
                waiting_values((g, branches), &nodes, outputs[open[place]], &mut left),
                nodes.len(),
            );
            if best.as_ref().is_none_or(|(least, ..)| key < *least) {
                best = Some((key, place, nodes));
            }
        }
        let Some((_, place, nodes)) = best else { break };
        let output = open.remove(place);
        left[outputs[output].index()] -= 1;
        for node in &nodes {
            known[node.index()] = true;
            branches.each_operand(g, *node, |operand| left[operand.index()] -= 1);
            waiting.of(*node).iter().for_each(|&other| missing[other] -= 1);
        }
        let computes = nodes.iter().any(|node| takes_place(g, *node));
        groups.push(Group { nodes, output, computes });
    }
    groups
}

/// How many more values wait for a later use when `nodes` are computed and `output` is written.
fn waiting_values(
    (g, branches): Code<'_>,
    nodes: &[Node],
    output: Node,
    left: &mut [usize],
) -> isize {
    let mut waiting = nodes.iter().filter(|node| takes_place(g, **node)).count() as isize;
    let mut take = |node: Node, left: &mut [usize]| {
        left[node.index()] -= 1;
        if left[node.index()] == 0 && takes_place(g, node) {
            waiting -= 1;
        }
    };
    take(output, left);
    nodes.iter().for_each(|&node| branches.each_operand(g, node, |operand| take(operand, left)));
    left[output.index()] += 1;
    nodes
        .iter()
        .for_each(|&node| branches.each_operand(g, node, |operand| left[operand.index()] += 1));
    waiting
}

/// The nodes that `output` needs beyond the `known`, operands first, each as late as possible.
/// Nodes `seen` in this turn are not looked at again.
fn needed(
    (g, branches): Code<'_>,
    output: Node,
    known: &[bool],
    seen: &mut [usize],
    turn: usize,
) -> Vec<Node> {
    let mut order = Vec::new();
    let mut open = vec![(output, false)];
    while let Some((node, operands_done)) = open.pop() {
        if operands_done {
            order.push(node);
        } else if !known[node.index()] && seen[node.index()] != turn && !is_given(g, node) {
            seen[node.index()] = turn;
            open.push((node, true));
            let operands = open.len();
            branches.each_operand(g, node, |operand| open.push((operand, false)));
            // The last one is looked at first: of a fused operation the sum so far, which waits in
            // one register while the product takes two.
            if !matches!(g.op(node), Op::Fma(..)) {
                open[operands..].reverse();
            }
        }
    }
    order
}

fn is_given(g: &Graph, node: Node) -> bool {
    matches!(g.op(node), Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_))
}

/// True if a node takes an operation and a register.
fn takes_place(g: &Graph, node: Node) -> bool {
    !is_given(g, node) && !matches!(g.op(node), Op::Neg(_))
}
