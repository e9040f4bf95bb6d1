//! From a program to its tape: sums are fused, steps of one kind are put side by side, and places are used
//! again when their number is not read any more.

use std::collections::HashMap;

use kin_graph::{Function, Graph, Input, Node, Op, schedule::fused};

use super::{Kind, Stage, Step, Tape};
use crate::program::stages::Program;

/// A step with nodes instead of places: what it reads, and what it makes.
struct Task {
    kind: Kind,
    reads: [Option<Node>; 3],
    makes: [Option<Node>; 3],
    stage: usize,
}

/// The tape of a program.
pub(crate) fn schedule(program: Program) -> Tape {
    let outputs = Outputs::new(&program);
    let mut graph = program.graph;
    let all = fused(&mut graph, &outputs.all);
    let own = |k: usize| outputs.part(k, &all);
    let mut planner = Planner::new(&graph, own(2));
    [0, 1].into_iter().for_each(|k| planner.require(own(k), 1));
    (2..outputs.parts.len()).for_each(|k| planner.require(own(k), 2));
    let order = planner.order();
    let (mut tape, readers) = (Tape::default(), planner.readers(&order, &all));
    let mut places = Places {
        planner: &planner,
        place: ByNode::new(&graph),
        free: Vec::new(),
        next: 0,
        nothing: 0,
        readers,
    };
    places.begin(&mut tape, &program.torn, &all);
    places.write(&mut tape, &order);
    let of = |nodes: &[Node]| {
        nodes
            .iter()
            .map(|node| places.place.get(planner.behind(*node)).unwrap_or(places.nothing))
            .collect::<Vec<u32>>()
    };
    let lists = [0, 1, 2, 3, 4, 5, 6].map(|k| of(own(k)));
    tape.guards = (7..outputs.parts.len()).map(|k| of(own(k))).collect();
    [tape.correction, tape.left, tape.values, tape.corrections, tape.rates, tape.second_rates, tape.verify] =
        lists;
    tape.places = places.next as usize;
    (tape.columns, tape.rows) = (program.torn, program.rows);
    (tape.laws, tape.blocks) = (program.laws, program.blocks);
    [&mut tape.time, &mut tape.correct, &mut tape.rest].into_iter().for_each(Stage::shorten);
    tape
}

/// All nodes that are asked for, part by part: the correction and the rows that are left first.
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
            &program.verify,
        ];
        let (mut all, mut parts) = (Vec::new(), Vec::new());
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

/// Which steps there are, and in which order.
struct Planner<'a> {
    graph: &'a Graph,
    /// The nodes of all coordinates: what `verify` reads as inputs.
    values: &'a [Node],
    tasks: Vec<Task>,
    /// The task that makes a node.
    maker: ByNode,
    sines: HashMap<Node, usize>,
    laws: HashMap<(usize, u8, Node), usize>,
    /// Nodes that are the same number as another one: a law of a coordinate and of what stands for it in
    /// `verify`.
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

    /// The node whose number is that of a node.
    fn behind(&self, node: Node) -> Node {
        match self.graph.op(node) {
            Op::Input(Input::Column(column)) => self.values[column],
            _ => self.same.get(&node).copied().unwrap_or(node),
        }
    }

    /// Plans what nodes need, as far as it is not planned; what depends on time alone goes to stage 0.
    fn require(&mut self, nodes: &[Node], stage: usize) {
        let mut open: Vec<Node> = nodes.iter().rev().map(|node| self.behind(*node)).collect();
        while let Some(&node) = open.last() {
            if self.maker.get(node).is_some() || is_given(self.graph, node) {
                open.pop();
                continue;
            }
            let (kind, reads) = self.step(node);
            let missing = |node: &Node| self.maker.get(*node).is_none() && !is_given(self.graph, *node);
            let before = open.len();
            open.extend(reads.iter().flatten().copied().filter(missing));
            if open.len() == before {
                open.pop();
                let stage = if self.graph.depends(node).on_q { stage } else { 0 };
                self.plan(node, Task { kind, reads, makes: [None; 3], stage });
            }
        }
    }

    /// One more task, or one more number that a task makes.
    fn plan(&mut self, node: Node, mut task: Task) {
        let next = self.tasks.len();
        let (task_number, place) = match self.graph.op(node) {
            Op::Call(f @ (Function::Sin | Function::Cos), x) => {
                (*self.sines.entry(x).or_insert(next), usize::from(f == Function::Cos))
            }
            Op::Law(law, x, order) => {
                let first = order / 3;
                (*self.laws.entry((law, first, self.behind(x))).or_insert(next), usize::from(order % 3))
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

    /// The operation of a node, on nodes that have numbers of their own: signs go into fused steps.
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
                let ((s, a), (t, b), (r, c)) = (signed(a), signed(b), signed(c));
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
            Op::Call2(f, a, b) => (Kind::Two(f), [own(a), own(b), None]),
            Op::Powi(a, n) => (Kind::Power(n), [own(a), None, None]),
            Op::Law(law, a, order) => (Kind::Law(law as u32, 3 * (order / 3)), [own(a), None, None]),
            Op::Compare(comparison, a, b) => (Kind::Compare(comparison), [own(a), own(b), None]),
            Op::And(a, b) => (Kind::Both, [own(a), own(b), None]),
            Op::Or(a, b) => (Kind::Either, [own(a), own(b), None]),
            Op::Not(a) => (Kind::Not, [own(a), None, None]),
            Op::Select(c, a, b) => (Kind::Select, [own(c), own(a), own(b)]),
            // Programs have no foreign values, and no calls.
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) | Op::Opaque(..) | Op::Leaf(_) => {
                (Kind::Not, [None; 3])
            }
        }
    }

    /// Stage by stage, each step after those that it reads; of one kind as many as can be had at once.
    fn order(&self) -> Vec<usize> {
        let mut users: Vec<Vec<usize>> = vec![Vec::new(); self.tasks.len()];
        let mut missing = vec![0; self.tasks.len()];
        for (k, task) in self.tasks.iter().enumerate() {
            for before in task.reads.iter().flatten().filter_map(|node| self.maker.get(*node)) {
                if self.tasks[before as usize].stage == task.stage {
                    users[before as usize].push(k);
                    missing[k] += 1;
                }
            }
        }
        let mut order = Vec::with_capacity(self.tasks.len());
        for stage in 0..3 {
            let mut ready: Vec<(Kind, Vec<usize>)> = Vec::new();
            let add = |ready: &mut Vec<(Kind, Vec<usize>)>, k: usize| {
                let kind = self.tasks[k].kind;
                match ready.iter_mut().find(|(known, _)| *known == kind) {
                    Some((_, own)) => own.push(k),
                    None => ready.push((kind, vec![k])),
                }
            };
            (0..self.tasks.len())
                .filter(|k| self.tasks[*k].stage == stage && missing[*k] == 0)
                .for_each(|k| add(&mut ready, k));
            while let Some(best) = (0..ready.len())
                .filter(|k| !ready[*k].1.is_empty())
                .max_by_key(|k| (ready[*k].1.len(), usize::MAX - k))
            {
                // A step of the same kind that becomes ready meanwhile belongs to the same run.
                let mut done = 0;
                while done < ready[best].1.len() {
                    let k = ready[best].1[done];
                    done += 1;
                    order.push(k);
                    for &user in &users[k] {
                        missing[user] -= 1;
                        if missing[user] == 0 {
                            add(&mut ready, user);
                        }
                    }
                }
                ready[best].1.clear();
            }
        }
        order
    }

    /// How often each number is read in its own stage; 0 of those that are kept: outputs, and what later
    /// stages read.
    fn readers(&self, order: &[usize], outputs: &[Node]) -> ByNode {
        let (mut reads, mut keep) = (ByNode::new(self.graph), Vec::new());
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

/// A number for some of the nodes.
struct ByNode(Vec<u32>);

impl ByNode {
    const NONE: u32 = u32::MAX;

    fn new(graph: &Graph) -> Self {
        ByNode(vec![Self::NONE; graph.len()])
    }

    fn get(&self, node: Node) -> Option<u32> {
        Some(self.0[node.index()]).filter(|number| *number != Self::NONE)
    }

    fn insert(&mut self, node: Node, number: u32) {
        self.0[node.index()] = number;
    }
}

/// True if a node stands in the memory from the beginning.
fn is_given(graph: &Graph, node: Node) -> bool {
    matches!(
        graph.op(node),
        Op::Input(_) | Op::Constant(_) | Op::Truth(_) | Op::Decimal(_) | Op::Opaque(..) | Op::Leaf(_)
    )
}

/// Where numbers stand.
struct Places<'a> {
    planner: &'a Planner<'a>,
    place: ByNode,
    free: Vec<u32>,
    next: u32,
    /// Of what has none.
    nothing: u32,
    /// How often each number is still read before its place is free.
    readers: ByNode,
}

impl Places<'_> {
    fn take(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.next += 1;
            self.next - 1
        })
    }

    /// The time, torn coordinates and constants, which stand first.
    fn begin(&mut self, tape: &mut Tape, torn: &[usize], outputs: &[Node]) {
        let graph = self.planner.graph;
        tape.t = self.take();
        if let Some(time) = graph.existing(Op::Input(Input::Time)) {
            self.place.insert(time, tape.t);
        }
        for &column in torn {
            let place = self.take();
            tape.torn.push(place);
            if let Some(node) = graph.existing(Op::Input(Input::State(column, crate::program::kind::SELF))) {
                self.place.insert(node, place);
            }
        }
        let read = self.planner.tasks.iter().flat_map(|task| task.reads).flatten();
        for node in read.chain(outputs.iter().map(|node| self.planner.behind(*node))) {
            let value =
                graph.constant_value(node).or(graph.truth(node).map(|holds| f64::from(u8::from(holds))));
            if let (Some(value), None) = (value, self.place.get(node)) {
                let place = self.take();
                self.place.insert(node, place);
                tape.constants.push((place, value));
            }
        }
    }

    /// The steps, with the places of their numbers.
    fn write(&mut self, tape: &mut Tape, order: &[usize]) {
        // A place that nothing writes holds no number, so that a fault of this pass cannot pass for one.
        let (idle, nothing) = (self.take(), self.take());
        tape.constants.push((nothing, f64::NAN));
        self.nothing = nothing;
        for &k in order {
            let Task { kind, reads, makes, stage } = &self.planner.tasks[k];
            let [a, b, c] =
                reads.map(|node| node.map_or(nothing, |node| self.place.get(node).unwrap_or(nothing)));
            for node in reads.iter().flatten() {
                let Some(left) = self.readers.get(*node).filter(|left| *left > 0) else { continue };
                self.readers.insert(*node, left - 1);
                if left == 1 {
                    self.free.extend(self.place.get(*node));
                }
            }
            let mut made = [idle; 3];
            for (made, node) in made.iter_mut().zip(makes) {
                let Some(node) = *node else { continue };
                *made = self.take();
                self.place.insert(node, *made);
            }
            let step = match kind {
                Kind::SinCos => Step { out: made[0], a, b: idle, c: made[1] },
                Kind::Law(..) => Step { out: made[0], a, b: made[1], c: made[2] },
                _ => Step { out: made[0], a, b, c },
            };
            let stages: [&mut Stage; 3] = [&mut tape.time, &mut tape.correct, &mut tape.rest];
            stages.into_iter().nth(*stage).into_iter().for_each(|stage| stage.push(*kind, step));
        }
    }
}
