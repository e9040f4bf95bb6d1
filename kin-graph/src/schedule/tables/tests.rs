//! Tables as one expression: the same values wherever they are asked for, and few operations.

use std::collections::HashMap;

use super::looked_up;
use crate::differentiate::Partial;
use crate::schedule::operations;
use crate::testing::{SplitMix, value};
use crate::{Comparison, Function, Function2, Graph, Input, Node, Op};

/// Numbers as they stand in tables: some of them simplify what stands around them.
fn number(g: &mut Graph, random: &mut SplitMix) -> Node {
    const EASY: [f64; 8] = [0.0, 0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.25];
    let any = random.below(4000) as f64 / 1000.0 - 2.0;
    g.constant(if random.below(3) == 0 { EASY[random.below(8)] } else { any })
}

/// A piece of a table: one of a few forms, with numbers at random.
fn piece(g: &mut Graph, random: &mut SplitMix, form: usize, [x, y]: [Node; 2], knot: f64) -> Node {
    let knot = g.constant(knot);
    let [a, b, c, d] = [(); 4].map(|()| number(g, random));
    let s = g.sub(x, knot);
    match form {
        0 => [c, b, a].into_iter().fold(d, |sum, next| {
            let product = g.mul(s, sum);
            g.add(next, product)
        }),
        1 => {
            let wide = g.constant(1.0 + random.below(8) as f64 / 4.0);
            let u = g.div(s, wide);
            let rise = g.sub(b, a);
            let up = g.mul(u, rise);
            let sum = g.add(a, up);
            let turned = g.mul(c, y);
            g.sub(turned, sum)
        }
        2 => {
            let angle = g.mul(c, s);
            let product = g.mul(b, y);
            let sine = g.call(Function::Sin, angle);
            let both = g.mul(d, sine);
            let sum = g.sub(both, product);
            let square = g.mul(s, s);
            let far = g.mul(a, square);
            g.add(sum, far)
        }
        _ => {
            let square = g.mul(s, s);
            let by_y = g.mul(y, b);
            let above = g.add(square, by_y);
            let most = g.call2(Function2::Max, above, c);
            g.mul(most, a)
        }
    }
}

/// A chain of `n` pieces by conditions of one kind, its selections one way round or the other.
fn table(g: &mut Graph, random: &mut SplitMix, form: usize, n: usize) -> Node {
    let of = [Input::Column(0), Input::Column(1)].map(|input| g.input(input));
    let comparison = Comparison::ALL[random.below(4)];
    let turned = random.below(2) == 0;
    let rising = matches!(comparison, Comparison::Less | Comparison::LessEqual);
    let mut all = piece(g, random, form, of, 9.0);
    for k in (0..n - 1).rev() {
        let knot = (if rising != turned { k } else { n - k }) as f64 / 2.0 - 3.0;
        let value = piece(g, random, form, of, knot);
        let end = g.constant(knot + 0.5);
        let condition = g.compare(comparison, of[0], end);
        all =
            if turned { g.select(condition, all, value) } else { g.select(condition, value, all) };
    }
    all
}

fn agree(g: &Graph, a: Node, b: Node, x: f64, y: f64) {
    let inputs = HashMap::from([(Input::Column(0), x), (Input::Column(1), y)]);
    let a = value(g, a, &inputs);
    let b = value(g, b, &inputs);
    assert!(
        a == b || (a - b).abs() <= 1e-13 * (1.0 + a.abs()) || a.is_nan() && b.is_nan(),
        "{a}, {b} at {x}, {y}"
    );
}

#[test]
fn a_table_is_one_expression_whatever_its_numbers_have_simplified() {
    let mut random = SplitMix(7);
    for form in 0..4 {
        let mut one = 0;
        for _ in 0..40 {
            let mut g = Graph::default();
            let n = 5 + random.below(12);
            let root = table(&mut g, &mut random, form, n);
            let found = looked_up(&mut g, &[root])[0];
            for k in 0..60 {
                agree(&g, root, found, k as f64 / 4.0 - 6.0, random.below(9) as f64 / 2.0 - 2.0);
            }
            let selects = |op: Op| matches!(op, Op::Select(..) | Op::Compare(..));
            let work = |root: Node| {
                g.reachable(&[root]).into_iter().filter(|n| !selects(g.op(*n))).count()
            };
            let operations =
                work(found) - g.reachable(&[found]).iter().filter(|n| constant(&g, **n)).count();
            if operations > 18 {
                println!("{form} {n} {operations} {}", root == found);
            }
            one += usize::from(operations <= 18);
        }
        assert!(one >= 36, "{one} of 40 tables of form {form} are one expression");
    }
}

fn constant(g: &Graph, node: Node) -> bool {
    g.constant_value(node).is_some()
}

#[test]
fn derivatives_of_a_table_need_no_more_than_one_piece() {
    let mut g = Graph::default();
    let mut random = SplitMix(3);
    let root = table(&mut g, &mut random, 0, 40);
    let slope = |g: &mut Graph, of: Node| Partial::by_variable().of(g, of);
    let plain = slope(&mut g, root);
    let found = looked_up(&mut g, &[root])[0];
    let looked = slope(&mut g, found);
    (0..80).for_each(|k| agree(&g, plain, looked, k as f64 / 4.0 - 5.0, 0.0));
    let numbers = |op: Op| !matches!(op, Op::Select(..) | Op::Compare(..) | Op::Constant(_));
    let count = |node: Node| g.reachable(&[node]).into_iter().filter(|n| numbers(g.op(*n))).count();
    assert!(count(looked) < 16 && count(plain) > 200, "{}, {}", count(looked), count(plain));
}

#[test]
fn what_is_infinite_in_one_piece_stays_away_from_the_others() {
    let mut g = Graph::default();
    let x = g.input(Input::Column(0));
    let log = g.call(Function::Ln, x);
    let mut all = log;
    for (k, factor) in [(3, 0.5), (2, 2.0), (1, 3.0), (0, 0.0)] {
        let end = g.constant(k as f64);
        let factor = g.constant(factor);
        let sum = g.constant(k as f64 + 1.0);
        let product = g.mul(factor, log);
        let piece = g.add(sum, product);
        let condition = g.compare(Comparison::Less, x, end);
        all = g.select(condition, piece, all);
    }
    let found = looked_up(&mut g, &[all])[0];
    [-1.0, 0.0, 0.5, 1.5, 2.5, 9.0].into_iter().for_each(|at| agree(&g, all, found, at, 0.0));
}

#[test]
fn pieces_that_have_nothing_in_common_stay_as_they_are() {
    let mut g = Graph::default();
    let x = g.input(Input::Column(0));
    let mut all = x;
    for (k, f) in
        [Function::Sin, Function::Exp, Function::Atan, Function::Tanh].into_iter().enumerate()
    {
        let end = g.constant(-(k as f64));
        let piece = g.call(f, x);
        let condition = g.compare(Comparison::Less, x, end);
        all = g.select(condition, piece, all);
    }
    assert_eq!(looked_up(&mut g, &[all]), [all]);
    // Three pieces are no table.
    let short = table(&mut g, &mut SplitMix(1), 0, 3);
    assert_eq!(looked_up(&mut g, &[short]), [short]);
    assert!(operations(&g, &[all]) > 0);
}

#[test]
fn parameters_are_looked_up_too() {
    let mut g = Graph::default();
    let x = g.input(Input::Column(0));
    let mut all = None;
    for k in (0..30).rev() {
        let [knot, a, b] = [3 * k, 3 * k + 1, 3 * k + 2].map(|k| g.input(Input::Parameter(k)));
        let s = g.sub(x, knot);
        let product = g.mul(s, b);
        let piece = g.add(a, product);
        let condition = g.compare(Comparison::LessEqual, x, knot);
        all = Some(all.map_or(piece, |rest| g.select(condition, piece, rest)));
    }
    let found = looked_up(&mut g, &[all.unwrap_or(x)])[0];
    let products = |op: Op| matches!(op, Op::Mul(..));
    assert_eq!(g.reachable(&[found]).into_iter().filter(|node| products(g.op(*node))).count(), 1);
}
