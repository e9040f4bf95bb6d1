//! Code with branches run as it is emitted, on graphs at random and on tables.

use std::collections::HashMap;

use super::*;
use crate::schedule::{order, prepare};
use crate::testing::{SplitMix, value};
use crate::{Comparison, Function, Input};

/// Computes code as it is emitted: of a choice the branch that is taken, whose names are forgotten
/// behind it. Counts the operations that run.
struct Run<'a> {
    g: &'a Graph,
    branches: &'a Branches,
    inputs: &'a HashMap<Input, f64>,
    known: HashMap<Node, f64>,
    work: usize,
}

impl Run<'_> {
    fn all(&mut self, outputs: &[Node]) -> Vec<f64> {
        let mut values = vec![f64::NAN; outputs.len()];
        for group in order(self.g, self.branches, outputs, |node| self.known.contains_key(&node)) {
            group.nodes.into_iter().for_each(|node| self.compute(node));
            values[group.output] = self.read(outputs[group.output]);
        }
        values
    }

    fn read(&self, node: Node) -> f64 {
        match self.g.op(node) {
            Op::Input(_) | Op::Constant(_) => value(self.g, node, self.inputs),
            _ => *self.known.get(&node).unwrap_or_else(|| panic!("{node:?} is not known here")),
        }
    }

    fn compute(&mut self, node: Node) {
        if self.known.contains_key(&node) {
            return;
        }
        if let Some(choice) = self.branches.choice(node) {
            return self.choose(choice);
        }
        self.work += work(self.g.op(node));
        let read = |operand: Node| self.read(operand);
        let found = match self.g.op(node) {
            Op::Add(a, b) => read(a) + read(b),
            Op::Sub(a, b) => read(a) - read(b),
            Op::Mul(a, b) => read(a) * read(b),
            Op::Fma(a, b, c) => read(a) * read(b) + read(c),
            Op::Neg(a) => -read(a),
            Op::Call(Function::Abs, a) => read(a).abs(),
            Op::Compare(comparison, a, b) => {
                f64::from(u8::from(comparison.holds(&read(a), &read(b))))
            }
            Op::Select(c, a, b) => {
                let c = read(c);
                let a = read(a);
                let b = read(b);
                if c == 1.0 { a } else { b }
            }
            other => panic!("{other:?} is not in these graphs"),
        };
        self.known.insert(node, found);
    }

    fn choose(&mut self, choice: &Choice) {
        let taken = self.read(choice.condition) == 1.0;
        let of = |&node: &Node| match self.g.op(node) {
            Op::Select(_, a, b) => {
                if taken {
                    a
                } else {
                    b
                }
            }
            other => panic!("{other:?} is no selection"),
        };
        let values: Vec<Node> = choice.selections.iter().map(of).collect();
        let outside = self.known.clone();
        let values = self.all(&values);
        self.known = outside;
        self.known.extend(choice.selections.iter().copied().zip(values));
    }
}

/// Sums, products and many selections by few conditions, some of them inside each other.
fn graph(random: &mut SplitMix) -> (Graph, Vec<Node>) {
    let mut g = Graph::default();
    let mut nodes: Vec<Node> = (0..4).map(|k| g.input(Input::Parameter(k))).collect();
    nodes.extend([1.0, 2.0, 3.0].map(|c| g.constant(c)));
    let first = nodes.len();
    let mut conditions = Vec::new();
    for _ in 0..80 {
        let mut any = || nodes[random.below(nodes.len())];
        let a = any();
        let b = any();
        let c = any();
        let small = nodes[random.below(first)];
        let node = match random.below(9) {
            0 => g.add(a, b),
            1 => g.sub(a, b),
            2 | 3 => g.mul(a, small),
            4 => g.call(Function::Abs, a),
            _ => {
                if conditions.len() < 5 || random.below(6) == 0 {
                    conditions.push(g.compare(Comparison::ALL[random.below(6)], a, c));
                }
                let condition = conditions[random.below(conditions.len())];
                g.select(condition, a, b)
            }
        };
        nodes.push(node);
    }
    let outputs = (0..6).map(|_| nodes[first + random.below(80)]).collect();
    (g, outputs)
}

#[test]
fn every_branch_knows_what_it_reads_and_gives_the_same_values() {
    let mut random = SplitMix(21);
    let mut choices = 0;
    let mut inner = 0;
    for _ in 0..600 {
        let (mut g, outputs) = graph(&mut random);
        let outputs = prepare(&mut g, &outputs);
        let branches = Branches::longer_than(1, &g, &outputs, |_| false, |_| false);
        choices += branches.choices.len();
        inner += branches.choices.iter().filter(|choice| choice.reads.len() > 2).count();
        for _ in 0..4 {
            let input = |k: usize, random: &mut SplitMix| {
                (Input::Parameter(k), random.below(5) as f64 - 2.0)
            };
            let inputs: HashMap<Input, f64> = (0..4).map(|k| input(k, &mut random)).collect();
            let g = &g;
            let branches = &branches;
            let inputs = &inputs;
            let found = Run { g, branches, inputs, known: HashMap::new(), work: 0 }.all(&outputs);
            for (&node, found) in outputs.iter().zip(found) {
                let expected = value(g, node, inputs);
                assert!(found == expected || expected.abs() > 2f64.powi(50), "{found}, {expected}");
            }
        }
    }
    assert!(choices > 300 && inner > 50, "{choices} choices, {inner} that read");
}

/// A table of `n` pieces by `if … else if …`, and its slope.
fn pieces(n: usize) -> (Graph, Vec<Node>) {
    let mut g = Graph::default();
    let x = g.input(Input::Parameter(0));
    let mut values = [g.zero(); 2];
    for k in (0..n).rev() {
        let number = |g: &mut Graph, k: usize| g.constant(k as f64 + 0.5);
        let end = number(&mut g, k);
        let mut value = number(&mut g, 2 * k);
        let mut slope = g.zero();
        for power in 1..6 {
            let factor = number(&mut g, k + power);
            let down = g.mul(value, factor);
            let x_slope = g.mul(slope, x);
            (value, slope) = (g.mul(down, x), g.add(x_slope, down));
        }
        let condition = g.compare(Comparison::Less, x, end);
        values = [g.select(condition, value, values[0]), g.select(condition, slope, values[1])];
    }
    (g, values.into())
}

#[test]
fn a_table_of_pieces_computes_one_piece() {
    let (mut g, outputs) = pieces(20);
    let outputs = prepare(&mut g, &outputs);
    let branches = Branches::new(&g, &outputs, |_| false, |_| false);
    assert_eq!(branches.choices.len(), 19, "the last piece is too short to ask for");
    let whole: usize = g.reachable(&outputs).iter().map(|&node| work(g.op(node))).sum();
    for (at, most) in [(0.2, 30), (10.0, 40), (30.0, 50)] {
        let inputs = HashMap::from([(Input::Parameter(0), at)]);
        let g = &g;
        let branches = &branches;
        let inputs = &inputs;
        let mut run = Run { g, branches, inputs, known: HashMap::new(), work: 0 };
        run.all(&outputs);
        assert!(run.work < most && 5 * run.work < whole, "{} operations of {whole}", run.work);
    }
}

#[test]
fn short_and_very_deep_choices_stay_selections() {
    let (mut g, outputs) = pieces(DEEPEST + 40);
    let outputs = prepare(&mut g, &outputs);
    assert_eq!(Branches::new(&g, &outputs, |_| false, |_| false).choices.len(), DEEPEST);
    let mut g = Graph::default();
    let x = g.input(Input::Parameter(0));
    let zero = g.zero();
    let minus = g.neg(x);
    let condition = g.compare(Comparison::Less, x, zero);
    let size = g.select(condition, minus, x);
    assert!(Branches::new(&g, &[size], |_| false, |_| false).choices.is_empty());
}
