//! Each pass on graphs of its own, and all of them on random graphs whose values are whole numbers,
//! so that no rounding hides a mistake.

use std::collections::HashMap;

use super::{Branches, operations, order, prepare};
use crate::testing::SplitMix;
use crate::testing::value;
use crate::{Function, Graph, Input, Node, Op};

/// Sums and products of six inputs and small constants, at most quadratic in each other.
fn graph(random: &mut SplitMix) -> (Graph, Vec<Node>) {
    let mut g = Graph::default();
    let mut nodes: Vec<Node> = (0..6).map(|k| g.input(Input::Parameter(k))).collect();
    nodes.extend([1.0, 2.0, 4.0, 3.0].map(|c| g.constant(c)));
    let linear = nodes.len();
    for k in 0..60 {
        let a = nodes[random.below(nodes.len())];
        let b = nodes[random.below(nodes.len())];
        let c = nodes[random.below(linear)];
        let d = nodes[random.below(linear)];
        let node = match random.below(6) {
            0 => g.add(a, b),
            1 => g.sub(a, b),
            2 => g.neg(a),
            3 if k % 9 == 0 => g.mul(a, b),
            _ => g.mul(c, d),
        };
        nodes.push(node);
    }
    let outputs = (0..8).map(|_| nodes[linear + random.below(60)]).collect();
    (g, outputs)
}

fn inputs(values: &[f64]) -> HashMap<Input, f64> {
    values.iter().enumerate().map(|(k, &x)| (Input::Parameter(k), x)).collect()
}

fn letters<const N: usize>() -> (Graph, [Node; N]) {
    let mut g = Graph::default();
    let all = std::array::from_fn(|k| g.input(Input::Parameter(k)));
    (g, all)
}

fn has_sign(g: &Graph, outputs: &[Node]) -> bool {
    outputs.iter().any(|&output| matches!(g.op(output), Op::Neg(_)))
}

#[test]
fn values_stay_and_operations_do_not_grow() {
    let mut random = SplitMix(7);
    let mut fewer = 0;
    for _ in 0..400 {
        let (mut g, outputs) = graph(&mut random);
        let at = inputs(&std::array::from_fn::<f64, 6, _>(|_| random.below(7) as f64 - 3.0));
        let scheduled = prepare(&mut g, &outputs);
        let before = operations(&g, &outputs);
        let after = operations(&g, &scheduled);
        assert!(after <= before, "{before} operations became {after}");
        fewer += usize::from(after < before);
        for (&output, &node) in outputs.iter().zip(&scheduled) {
            let expected = value(&g, output, &at);
            assert!(expected.abs() < 2f64.powi(50), "{expected} is not exact");
            assert_eq!(value(&g, node, &at), expected);
        }
    }
    assert!(fewer > 200, "only {fewer} of 400 graphs became smaller");
}

#[test]
fn every_node_is_computed_once_after_its_operands_and_before_the_output_that_needs_it() {
    let mut random = SplitMix(8);
    for _ in 0..100 {
        let (mut g, outputs) = graph(&mut random);
        let scheduled = prepare(&mut g, &outputs);
        let given = |node: Node| matches!(g.op(node), Op::Input(_) | Op::Constant(_));
        let mut known = vec![false; g.len()];
        let mut written = vec![];
        for group in order(&g, &Branches::none(), &scheduled, |_| false) {
            for node in group.nodes {
                assert!(g.operands(node).iter().all(|&n| given(n) || known[n.index()]));
                assert!(!std::mem::replace(&mut known[node.index()], true));
            }
            let output = scheduled[group.output];
            assert!(given(output) || known[output.index()]);
            written.push(group.output);
        }
        written.sort_unstable();
        assert_eq!(written, (0..outputs.len()).collect::<Vec<_>>());
    }
}

#[test]
fn a_sum_of_products_is_a_chain() {
    let (mut g, [a, b, c, d, e]) = letters();
    let ab = g.mul(a, b);
    let cd = g.mul(c, d);
    let sum = g.sub(ab, cd);
    let sum = g.add(sum, e);
    let scheduled = prepare(&mut g, &[sum]);
    assert_eq!(operations(&g, &scheduled), 2);
    assert_eq!(value(&g, scheduled[0], &inputs(&[2.0, 3.0, 5.0, 7.0, 1.0])), -28.0);
}

#[test]
fn a_product_that_sums_share_begins_them() {
    let (mut g, [a, b, c, d, e]) = letters();
    let shared = g.mul(a, b);
    let others = [g.mul(c, d), g.mul(d, e), g.mul(c, e)];
    let sums = others.map(|other| g.add(shared, other));
    let scheduled = prepare(&mut g, &sums);
    assert_eq!(operations(&g, &scheduled), 4, "one product, three fused");
}

#[test]
fn a_factor_two_goes_where_it_serves_many() {
    let (mut g, [a, b, u, v, w]) = letters();
    let two = g.constant(2.0);
    let rows = [(u, v), (v, w), (w, u), (u, w)].map(|(x, y)| {
        let ax = g.mul(a, x);
        let by = g.mul(b, y);
        let sum = g.add(ax, by);
        g.mul(two, sum)
    });
    let scheduled = prepare(&mut g, &rows);
    assert!(operations(&g, &scheduled) <= 10, "2 a, 2 b, and two operations a row or fewer");
    let at = inputs(&[2.0, 3.0, 5.0, 7.0, 11.0]);
    rows.iter()
        .zip(&scheduled)
        .for_each(|(&row, &node)| assert_eq!(value(&g, node, &at), value(&g, row, &at)));
}

#[test]
fn a_sum_takes_the_sign_that_its_outputs_ask_for() {
    let (mut g, [a, b, c, d, e]) = letters();
    let ab = g.mul(a, b);
    let cd = g.mul(c, d);
    let sum = g.add(ab, cd);
    let minus = g.neg(sum);
    let more = g.add(sum, e);
    let scheduled = prepare(&mut g, &[minus, more]);
    assert!(!has_sign(&g, &scheduled));
    let at = inputs(&[2.0, 3.0, 5.0, 7.0, 1.0]);
    assert_eq!(scheduled.iter().map(|&n| value(&g, n, &at)).collect::<Vec<_>>(), [-41.0, 42.0]);
}

#[test]
fn equal_products_cancel_under_a_root() {
    let (mut g, [a, b, c, d]) = letters();
    let ab = g.mul(a, b);
    let cd = g.mul(c, d);
    let difference = g.sub(ab, cd);
    let root = g.call(Function::Sqrt, difference);
    let at = inputs(&[0.1, 0.3, 0.1, 0.3]);
    let scheduled = prepare(&mut g, &[root]);
    assert_eq!(value(&g, scheduled[0], &at), 0.0);
    let scheduled = prepare(&mut g, &[difference]);
    assert_ne!(
        value(&g, scheduled[0], &at),
        0.0,
        "what is fused leaves the rounding of one product"
    );
}
