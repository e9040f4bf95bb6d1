//! Converts a program to its tape: fuses sums, places steps of one kind side by side, and reuses
//! places of numbers that are no longer read.

use std::collections::HashMap;

use kin_graph::{Function, Function2, Graph, Input, Node, Op, schedule::fused};

use super::order::{Neutral, ordered};
use super::places::{ByNode, Places, is_given};
use super::{Kind, Stage, Straight, Tape};
use crate::law::Law;
use crate::program::kind::SELF;
use crate::program::stages::Program;

/// The stages, by their indices.
pub(super) const SETUP: usize = 0;
const TIME: usize = 1;
const CORRECT: usize = 2;
pub(super) const REST: usize = 3;

/// A step with nodes instead of places: the nodes that it reads, and those that it makes.
pub(super) struct Task {
    pub kind: Kind,
    /// The nodes of the operands; `None` for operands that the kind does not have.
    pub reads: [Option<Node>; 3],
    /// The nodes of the results; `None` for results that the kind does not have.
    pub makes: [Option<Node>; 3],
    /// The stage that contains the step: `SETUP`, `TIME`, `CORRECT` or `REST`.
    pub stage: usize,
}

/// Makes the tape of a program. The phases are: the outputs, the plan of each stage, the order of
/// steps, the places.
pub(crate) fn schedule(program: Program) -> Tape {
    let outputs = Outputs::new(&program);
    let mut graph = program.graph;
    let all = fused(&mut graph, &outputs.all);
    let neutral = Neutral::new(&mut graph);
    let own = |k: usize| outputs.part(k, &all);
    let mut planner = Planner::new(&graph, own(2));
    [0, 1].into_iter().for_each(|k| planner.require(own(k), CORRECT));
    (2..outputs.parts.len()).for_each(|k| planner.require(own(k), REST));
    let order = ordered(&mut planner, neutral);
    let mut places = Places::new(&planner, planner.readers(&order, &all));
    let torn = program.torn.iter().map(|column| Input::State(*column, SELF));
    let free = (0..program.free.values.len()).map(Input::Parameter);
    let inputs: Vec<Input> = [Input::Time].into_iter().chain(torn).chain(free).collect();
    let inputs = places.begin(&inputs, &all);
    places.write(&order);
    let lists = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|k| places.of(own(k)));
    let guards = (lists.len()..outputs.parts.len()).map(|k| places.of(own(k))).collect();
    let (torn, parameters) = inputs[1..].split_at(program.torn.len());
    let torn = torn.to_vec();
    let parameters = parameters.to_vec();
    let mut tape = Tape { guards, t: inputs[0], torn, parameters, ..Tape::default() };
    tape.places = places.count();
    [tape.setup, tape.time, tape.correct, tape.rest] = places.stages;
    tape.constants = places.constants;
    [
        tape.correction,
        tape.left,
        tape.values,
        tape.corrections,
        tape.rates,
        tape.second_rates,
        tape.third_rates,
        tape.sides,
        tape.verify,
    ] = lists;
    (tape.columns, tape.rows) = (program.torn, program.rows);
    (tape.laws, tape.blocks, tape.free) = (program.laws, program.blocks, program.free);
    tape.chosen = program.chosen;
    [&mut tape.setup, &mut tape.time, &mut tape.correct, &mut tape.rest]
        .into_iter()
        .for_each(Stage::shorten);
    tape
}

/// Makes the tape of nodes of a graph without stages, from its inputs to these outputs.
pub(crate) fn straight(mut graph: Graph, laws: Vec<Law>, outputs: &[Node]) -> Straight {
    let outputs = fused(&mut graph, outputs);
    let neutral = Neutral::new(&mut graph);
    let mut planner = Planner::new(&graph, &[]);
    planner.require(&outputs, REST);
    let order = ordered(&mut planner, neutral);
    let mut places = Places::new(&planner, planner.readers(&order, &outputs));
    let read =
        planner.tasks.iter().flat_map(|task| task.reads).flatten().chain(outputs.iter().copied());
    let mut inputs: Vec<Input> = Vec::new();
    for node in read {
        match graph.op(node) {
            Op::Input(input) if !inputs.contains(&input) => inputs.push(input),
            _ => {}
        }
    }
    let at = places.begin(&inputs, &outputs);
    places.write(&order);
    let outputs = places.of(&outputs);
    let places_count = places.count();
    let [mut stage, time, _, rest] = places.stages;
    [time, rest].into_iter().for_each(|more| stage.append(more));
    stage.shorten();
    let inputs = inputs.into_iter().zip(at).collect();
    Straight { stage, laws, places: places_count, constants: places.constants, inputs, outputs }
}

/// All requested nodes, part by part: first the correction and the remaining rows.
struct Outputs {
    all: Vec<Node>,
    parts: Vec<std::ops::Range<usize>>,
}

impl Outputs {
    fn new(program: &Program) -> Self {
        let own = [
            &program.correction,
            &program.left,
            &program.values,
            &program.corrections,
            &program.rates,
            &program.second_rates,
            &program.third_rates,
            &program.sides,
            &program.verify,
        ];
        let mut all = Vec::new();
        let mut parts = Vec::new();
        for part in own.into_iter().chain(&program.guards) {
            parts.push(all.len()..all.len() + part.len());
            all.extend_from_slice(part);
        }
        Outputs { all, parts }
    }

    fn part<'a>(&self, k: usize, all: &'a [Node]) -> &'a [Node] {
        &all[self.parts[k].clone()]
    }
}

/// Plans the steps and their stages.
pub(super) struct Planner<'a> {
    pub graph: &'a Graph,
    /// The nodes of all coordinates, which `verify` reads as inputs.
    values: &'a [Node],
    /// The planned steps.
    pub tasks: Vec<Task>,
    /// For each node the task that makes it.
    pub maker: ByNode,
    /// The task that makes the sine and the cosine of each node.
    sines: HashMap<Node, usize>,
    /// The task of each law, by its number, the group of three orders, and its argument.
    laws: HashMap<(usize, u8, Node), usize>,
    /// Nodes that equal another node: a law of a coordinate and of its substitute in `verify`.
    same: HashMap<Node, Node>,
}

impl<'a> Planner<'a> {
    fn new(graph: &'a Graph, values: &'a [Node]) -> Self {
        Planner {
            graph,
            values,
            tasks: Vec::new(),
            maker: ByNode::new(graph),
            sines: HashMap::new(),
            laws: HashMap::new(),
            same: HashMap::new(),
        }
    }

    /// Returns the node that has the number of a node.
    pub(super) fn behind(&self, node: Node) -> Node {
        match self.graph.op(node) {
            Op::Input(Input::Column(column)) => self.values[column],
            _ => self.same.get(&node).copied().unwrap_or(node),
        }
    }

    /// Plans everything that nodes need and that is not planned yet. Steps without coordinates go
    /// to earlier stages.
    fn require(&mut self, nodes: &[Node], stage: usize) {
        let mut open: Vec<Node> = nodes.iter().rev().map(|node| self.behind(*node)).collect();
        while let Some(&node) = open.last() {
            if self.maker.get(node).is_some() || is_given(self.graph, node) {
                open.pop();
                continue;
            }
            let (kind, reads) = self.step(node);
            let missing =
                |node: &Node| self.maker.get(*node).is_none() && !is_given(self.graph, *node);
            let before = open.len();
            open.extend(reads.iter().flatten().copied().filter(missing));
            if open.len() == before {
                open.pop();
                let depends = self.graph.depends(node);
                let stage = match (depends.on_q, depends.on_t) {
                    (true, _) => stage,
                    (false, true) => TIME,
                    (false, false) => SETUP,
                };
                self.plan(node, Task { kind, reads, makes: [None; 3], stage });
            }
        }
    }

    /// Adds a task, or one more result of an existing task.
    fn plan(&mut self, node: Node, mut task: Task) {
        let next = self.tasks.len();
        let (task_number, place) = match self.graph.op(node) {
            Op::Call(f @ (Function::Sin | Function::Cos), x) => {
                (*self.sines.entry(x).or_insert(next), usize::from(f == Function::Cos))
            }
            Op::Law(law, x, order) => {
                let first = order / 3;
                (
                    *self.laws.entry((law, first, self.behind(x))).or_insert(next),
                    usize::from(order % 3),
                )
            }
            _ => (next, 0),
        };
        if task_number == next {
            task.makes[place] = Some(node);
            self.tasks.push(task);
        } else if let Some(known) = self.tasks[task_number].makes[place] {
            self.same.insert(node, known);
        } else {
            self.tasks[task_number].makes[place] = Some(node);
        }
        self.maker.insert(node, task_number as u32);
    }

    /// Returns the operation of a node on nodes that have numbers; signs become part of fused
    /// steps.
    fn step(&self, node: Node) -> (Kind, [Option<Node>; 3]) {
        let own = |node: Node| Some(self.behind(node));
        let signed = |node: Node| match self.graph.op(node) {
            Op::Neg(x) => (true, own(x)),
            _ => (false, own(node)),
        };
        match self.graph.op(node) {
            Op::Add(a, b) => (Kind::Add, [own(a), own(b), None]),
            Op::Sub(a, b) => (Kind::Sub, [own(a), own(b), None]),
            Op::Mul(a, b) => (Kind::Mul, [own(a), own(b), None]),
            Op::Div(a, b) => (Kind::Div, [own(a), own(b), None]),
            Op::Neg(a) => (Kind::Neg, [own(a), None, None]),
            Op::Fma(a, b, c) => {
                let (s, a) = signed(a);
                let (t, b) = signed(b);
                let (r, c) = signed(c);
                let kind = match (s != t, r) {
                    (false, false) => Kind::Fma,
                    (true, false) => Kind::NegatedProduct,
                    (false, true) => Kind::ProductLess,
                    (true, true) => Kind::NegatedSum,
                };
                (kind, [a, b, c])
            }
            Op::Call(Function::Sin | Function::Cos, a) => (Kind::SinCos, [own(a), None, None]),
            Op::Call(f, a) => (Kind::One(f), [own(a), None, None]),
            Op::Call2(f, a, b) => match self.larger_product(f, a, b) {
                Some([a, b, c]) => (Kind::LargerProduct, [own(a), own(b), own(c)]),
                None => (Kind::Two(f), [own(a), own(b), None]),
            },
            Op::Powi(a, n) => (Kind::Power(n), [own(a), None, None]),
            Op::Law(law, a, order) => {
                (Kind::Law(law as u32, 3 * (order / 3)), [own(a), None, None])
            }
            Op::Compare(comparison, a, b) => (Kind::Compare(comparison), [own(a), own(b), None]),
            Op::And(a, b) => (Kind::Both, [own(a), own(b), None]),
            Op::Or(a, b) => (Kind::Either, [own(a), own(b), None]),
            Op::Not(a) => (Kind::Not, [own(a), None, None]),
            Op::Select(c, a, b) => (Kind::Select, [own(c), own(a), own(b)]),
            // Programs contain no foreign values and no calls.
            Op::Input(_)
            | Op::Constant(_)
            | Op::Decimal(_)
            | Op::Truth(_)
            | Op::Opaque(..)
            | Op::Leaf(_) => (Kind::Not, [None; 3]),
        }
    }

    /// Returns a, b and c of max(c, |a b|).
    fn larger_product(&self, f: Function2, x: Node, y: Node) -> Option<[Node; 3]> {
        let product = |node: Node| match self.graph.op(node) {
            Op::Call(Function::Abs, product) => match self.graph.op(product) {
                Op::Mul(a, b) => Some([a, b]),
                _ => None,
            },
            _ => None,
        };
        let of = |size: Node, c: Node| product(size).map(|[a, b]| [a, b, c]);
        if f == Function2::Max { of(y, x).or_else(|| of(x, y)) } else { None }
    }

    /// Returns how often each number is read in its stage, or 0 for numbers that are kept: outputs,
    /// and operands of later stages.
    fn readers(&self, order: &[usize], outputs: &[Node]) -> ByNode {
        let mut reads = ByNode::new(self.graph);
        let mut keep = Vec::new();
        for &k in order {
            for node in self.tasks[k].reads.iter().flatten() {
                let stage = self.maker.get(*node).map(|maker| self.tasks[maker as usize].stage);
                if stage == Some(self.tasks[k].stage) {
                    reads.insert(*node, reads.get(*node).unwrap_or(0) + 1);
                } else {
                    keep.push(*node);
                }
            }
        }
        keep.extend(outputs.iter().map(|node| self.behind(*node)));
        keep.into_iter().for_each(|node| reads.insert(node, 0));
        reads
    }
}
