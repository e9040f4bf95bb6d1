//! The scalar graph: every value of a constraint as hash-consed nodes. Equal expressions are one node, so common subexpressions vanish
//! while building. Nodes are numbered in order of creation; nothing depends on hash iteration.

mod decimal;
mod hash;
mod simplify;

use std::collections::HashMap;

use crate::{Function, Function2};

pub use decimal::Decimal;
pub use simplify::is_power_of_two;

/// A scalar (or a condition) in a [`Graph`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Node(u32);

/// What the code around an emitted kernel provides.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Input {
    /// Part of the state of an argument.
    State(usize, Part),
    /// Rate of a coordinate of an argument.
    Rate(usize, Part),
    /// Time t.
    Time,
    /// ṫ, the factor of every derivative by time.
    TimeRate,
    /// The coordinate of a local column, where bodies and their states are not told apart; the variable of a law is column 0.
    Column(usize),
    /// A numeric parameter, by its number.
    Parameter(usize),
    /// What was evaluated once a time, by its number; put in before the scheduler.
    Timed(usize),
}

/// Part of a state. `R`, `Theta` and `P` are coordinates, the others depend on them. The value of a bare coordinate is its `Theta` too.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Part {
    R(usize),
    Theta,
    P(usize),
    Sin,
    Cos,
}

/// A coordinate of an argument: what C_q has a column for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Column {
    pub argument: usize,
    pub part: Part,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

impl Comparison {
    /// Every comparison.
    pub const ALL: [Comparison; 6] = {
        use Comparison::*;
        [Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual]
    };

    pub fn holds<T: PartialOrd>(self, a: &T, b: &T) -> bool {
        match self {
            Comparison::Less => a < b,
            Comparison::LessEqual => a <= b,
            Comparison::Greater => a > b,
            Comparison::GreaterEqual => a >= b,
            Comparison::Equal => a == b,
            Comparison::NotEqual => a != b,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Op {
    Input(Input),
    /// Bits of an f64.
    Constant(u64),
    /// A number that no f64 is, by its number among [`Graph::decimals`]; only in a graph as written.
    Decimal(usize),
    Add(Node, Node),
    Sub(Node, Node),
    Mul(Node, Node),
    Div(Node, Node),
    /// a b + c, rounded once where the processor can; made by the scheduler only.
    Fma(Node, Node, Node),
    Neg(Node),
    Call(Function, Node),
    Call2(Function2, Node, Node),
    Powi(Node, i32),
    /// k-th derivative of a law at x.
    Law(usize, Node, u8),
    /// One scalar of a value that is only known at run time and has no derivative: its number and component.
    Opaque(usize, usize),
    /// An output of a call of the user's generic function.
    Leaf(LeafUse),
    Select(Node, Node, Node),
    Compare(Comparison, Node, Node),
    And(Node, Node),
    Or(Node, Node),
    Not(Node),
    /// A condition known before the program runs.
    Truth(bool),
}

impl Op {
    /// The same operation on other operands; what holds none itself, values and calls of the user's own too, stays as it is.
    pub fn with_operands(self, of: impl Fn(Node) -> Node) -> Op {
        match self {
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) | Op::Opaque(..) | Op::Leaf(_) => self,
            Op::Neg(a) => Op::Neg(of(a)),
            Op::Call(f, a) => Op::Call(f, of(a)),
            Op::Powi(a, n) => Op::Powi(of(a), n),
            Op::Law(law, a, order) => Op::Law(law, of(a), order),
            Op::Not(a) => Op::Not(of(a)),
            Op::Add(a, b) => Op::Add(of(a), of(b)),
            Op::Sub(a, b) => Op::Sub(of(a), of(b)),
            Op::Mul(a, b) => Op::Mul(of(a), of(b)),
            Op::Div(a, b) => Op::Div(of(a), of(b)),
            Op::Call2(f, a, b) => Op::Call2(f, of(a), of(b)),
            Op::Compare(comparison, a, b) => Op::Compare(comparison, of(a), of(b)),
            Op::And(a, b) => Op::And(of(a), of(b)),
            Op::Or(a, b) => Op::Or(of(a), of(b)),
            Op::Select(c, a, b) => Op::Select(of(c), of(a), of(b)),
            Op::Fma(a, b, c) => Op::Fma(of(a), of(b), of(c)),
        }
    }
}

/// Which number of which evaluation of a leaf.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct LeafUse {
    pub leaf: usize,
    pub output: usize,
    pub what: LeafNumber,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum LeafNumber {
    Value,
    /// Partial derivative by one of the arguments that depend on coordinates or time.
    Partial(usize),
    /// First derivative along a direction of the arguments, by the direction's number.
    First(usize),
    /// Second derivative along a direction of the arguments.
    Second(usize),
}

/// A call of the user's generic function: its arguments that carry derivatives.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Leaf {
    /// Number of the call as the user wrote it.
    pub call: usize,
    pub arguments: Vec<Node>,
}

/// First and second derivatives of a leaf's arguments along the motion.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Direction {
    pub leaf: usize,
    pub first: Vec<Node>,
    pub second: Vec<Node>,
    /// The condition under which each of them moves at all, where there is one.
    pub moves: Vec<Option<Node>>,
}

/// The graph. Constructors (in `simplify`) fold and simplify exactly.
#[derive(Default)]
pub struct Graph {
    ops: Vec<Op>,
    depends: Vec<Depends>,
    index: HashMap<Op, Node, hash::Quick>,
    /// What each opaque value is computed from.
    pub opaques: Vec<Vec<Node>>,
    pub leaves: Vec<Leaf>,
    pub directions: Vec<Direction>,
    /// The numbers in it that no f64 is.
    pub decimals: Vec<Decimal>,
    /// Whether constants stay as they are written wherever f64 would round them.
    as_written: bool,
    /// Whether f64 has rounded a constant.
    rounded: bool,
}

/// What a node depends on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Depends {
    /// On a coordinate, or on the variable of a law.
    pub on_q: bool,
    /// On time.
    pub on_t: bool,
    /// Through a choice between values: `if`, `max`, `min`.
    chooses: bool,
    /// Grows as an exponential or a power does: it may overflow though what is made of it does not.
    bursts: bool,
    /// May be infinite at a pole, as a quotient and a logarithm are.
    has_poles: bool,
}

impl Depends {
    /// On anything that has a derivative.
    pub fn varies(self) -> bool {
        self.on_q || self.on_t
    }

    fn or(self, other: Depends) -> Depends {
        Depends {
            on_q: self.on_q || other.on_q,
            on_t: self.on_t || other.on_t,
            chooses: self.chooses || other.chooses,
            bursts: self.bursts || other.bursts,
            has_poles: self.has_poles || other.has_poles,
        }
    }
}

impl Node {
    /// Its number: what it is computed from has smaller ones.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl Graph {
    /// A graph in which nothing is rounded: a decimal that no f64 is stays itself, and an operation on constants is done only where its result is exact.
    pub fn as_written() -> Self {
        Graph { as_written: true, ..Graph::default() }
    }

    /// Whether anything in it is not quite as written: then [`Graph::as_written`] has another graph.
    pub fn is_rounded(&self) -> bool {
        self.rounded
    }

    /// Whether constants stay as they are written.
    pub fn keeps_constants(&self) -> bool {
        self.as_written
    }

    /// Whether a node is made of numbers alone.
    pub fn is_number(&self, node: Node) -> bool {
        let given = |n: &Node| matches!(self.op(*n), Op::Input(_) | Op::Opaque(..) | Op::Leaf(_) | Op::Law(..));
        !self.reachable(&[node]).iter().any(given)
    }

    pub fn op(&self, node: Node) -> Op {
        self.ops[node.0 as usize]
    }

    pub fn depends(&self, node: Node) -> Depends {
        self.depends[node.0 as usize]
    }

    /// Whether a choice between values lies behind a node.
    pub fn chooses(&self, node: Node) -> bool {
        self.depends(node).chooses
    }

    /// Whether a node moves and grows as an exponential or a power does.
    pub fn bursts(&self, node: Node) -> bool {
        self.depends(node).bursts
    }

    /// Whether a node is infinite only where it has grown too large for a number: never at a pole.
    pub fn overflows(&self, node: Node) -> bool {
        let Depends { bursts, has_poles, .. } = self.depends(node);
        bursts && !has_poles
    }

    pub fn constant_value(&self, node: Node) -> Option<f64> {
        match self.op(node) {
            Op::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    pub fn truth(&self, node: Node) -> Option<bool> {
        match self.op(node) {
            Op::Truth(value) => Some(value),
            _ => None,
        }
    }

    /// The nodes that `node` is computed from.
    pub fn operands(&self, node: Node) -> Vec<Node> {
        match self.op(node) {
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) => vec![],
            Op::Neg(a) | Op::Call(_, a) | Op::Powi(a, _) | Op::Law(_, a, _) | Op::Not(a) => vec![a],
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => vec![a, b],
            Op::Call2(_, a, b) | Op::Compare(_, a, b) | Op::And(a, b) | Op::Or(a, b) => vec![a, b],
            Op::Select(a, b, c) | Op::Fma(a, b, c) => vec![a, b, c],
            Op::Opaque(number, _) => self.opaques[number].clone(),
            Op::Leaf(LeafUse { leaf, what, .. }) => self.leaf_operands(leaf, what),
        }
    }

    /// The nodes whose numbers make that of `node`: its operands, of a selection the one that is taken, of a condition none.
    pub fn numbers_behind(&self, node: Node, holds: impl Fn(Node) -> bool) -> Vec<Node> {
        match self.op(node) {
            Op::Select(c, a, b) => vec![if holds(c) { a } else { b }],
            Op::Compare(..) | Op::And(..) | Op::Or(..) | Op::Not(_) => vec![],
            _ => self.operands(node),
        }
    }

    /// Shows the nodes that `node` is computed from, in their order.
    pub fn each_operand(&self, node: Node, mut show: impl FnMut(Node)) {
        match self.op(node) {
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) => {}
            Op::Neg(a) | Op::Call(_, a) | Op::Powi(a, _) | Op::Law(_, a, _) | Op::Not(a) => show(a),
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => {
                show(a);
                show(b);
            }
            _ => self.operands(node).into_iter().for_each(show),
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

    /// The node of `op`, the same one each time.
    fn intern(&mut self, op: Op) -> Node {
        if let Some(&node) = self.index.get(&op) {
            return node;
        }
        let node = Node(self.ops.len() as u32);
        self.ops.push(op);
        let depends = match op {
            Op::Input(Input::State(..) | Input::Column(_)) => Depends { on_q: true, ..Depends::default() },
            Op::Input(Input::Time) => Depends { on_t: true, ..Depends::default() },
            _ => {
                let mut all = Depends::default();
                self.each_operand(node, |operand| all = all.or(self.depends(operand)));
                all.chooses |= matches!(op, Op::Select(..) | Op::Call2(Function2::Max | Function2::Min, ..));
                self.note_growth(op, &mut all);
                all
            }
        };
        self.depends.push(depends);
        self.index.insert(op, node);
        node
    }

    /// Notes of an operation how it grows, from what is known of its operands.
    fn note_growth(&self, op: Op, all: &mut Depends) {
        let falls = |n: Node| self.constant_value(n).is_none_or(|n| n < 0.0);
        let grows = |n: Node| self.constant_value(n).is_none_or(|n| n.abs() > 4.0);
        match op {
            Op::Call(f, _) if f.is_bounded() => (all.bursts, all.has_poles) = (false, false),
            Op::Call(f, _) => {
                all.bursts = (all.bursts && !f.is_logarithmic()) || f.bursts();
                all.has_poles |= f.has_poles();
            }
            Op::Powi(_, n) => {
                all.bursts |= n.unsigned_abs() > 4;
                all.has_poles |= n < 0;
            }
            Op::Call2(Function2::Powf, _, n) => {
                all.bursts |= grows(n);
                all.has_poles |= falls(n);
            }
            Op::Call2(Function2::Atan2, ..) => (all.bursts, all.has_poles) = (false, false),
            Op::Div(_, b) => all.has_poles |= self.depends(b).varies(),
            Op::Law(..) | Op::Leaf(_) | Op::Opaque(..) => (all.bursts, all.has_poles) = (false, true),
            _ => {}
        }
        all.bursts &= all.varies();
        all.has_poles &= all.varies();
    }

    /// The node of `op` as it stands, not simplified.
    pub fn raw(&mut self, op: Op) -> Node {
        self.intern(op)
    }

    /// The operation of `node` on other operands. Values of the user's own keep theirs: their text names them.
    pub fn with_operands(&mut self, node: Node, of: impl Fn(Node) -> Node) -> Node {
        let op = match self.op(node) {
            Op::Leaf(used) => Op::Leaf(self.leaf_with_operands(used, of)),
            op => op.with_operands(of),
        };
        self.intern(op)
    }

    fn leaf_with_operands(&mut self, used: LeafUse, of: impl Fn(Node) -> Node) -> LeafUse {
        let all = |nodes: &[Node]| nodes.iter().map(|&n| of(n)).collect::<Vec<Node>>();
        let Leaf { call, arguments } = self.leaves[used.leaf].clone();
        let leaf = self.leaf(call, all(&arguments));
        let moved = |g: &mut Graph, k: usize| {
            let Direction { first, second, moves, .. } = g.directions[k].clone();
            let moves = moves.iter().map(|moves| moves.map(&of)).collect();
            g.direction(Direction { leaf, first: all(&first), second: all(&second), moves })
        };
        let what = match used.what {
            LeafNumber::First(k) => LeafNumber::First(moved(self, k)),
            LeafNumber::Second(k) => LeafNumber::Second(moved(self, k)),
            what => what,
        };
        LeafUse { leaf, what, ..used }
    }

    /// The node of `op`, if there is one.
    pub fn existing(&self, op: Op) -> Option<Node> {
        self.index.get(&op).copied()
    }

    pub fn input(&mut self, input: Input) -> Node {
        self.intern(Op::Input(input))
    }

    /// A component of an opaque value.
    pub fn opaque(&mut self, number: usize, component: usize) -> Node {
        self.intern(Op::Opaque(number, component))
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether there is no node yet.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// A call of a generic function, known by its arguments that carry derivatives; the same number each time.
    pub fn leaf(&mut self, call: usize, arguments: Vec<Node>) -> usize {
        let leaf = Leaf { call, arguments };
        self.leaves.iter().position(|known| *known == leaf).unwrap_or_else(|| {
            self.leaves.push(leaf);
            self.leaves.len() - 1
        })
    }

    pub fn leaf_output(&mut self, leaf: usize, output: usize, what: LeafNumber) -> Node {
        self.intern(Op::Leaf(LeafUse { leaf, output, what }))
    }

    /// The number of a direction of a leaf's arguments, the same one each time.
    pub fn direction(&mut self, direction: Direction) -> usize {
        self.directions.iter().position(|d| *d == direction).unwrap_or_else(|| {
            self.directions.push(direction);
            self.directions.len() - 1
        })
    }

    /// All columns that `outputs` can depend on.
    pub fn columns(&self, outputs: &[Node]) -> Vec<Column> {
        let mut columns: Vec<Column> = Vec::new();
        for node in self.reachable(outputs) {
            if let Op::Input(Input::State(argument, part)) = self.op(node) {
                columns.extend(coordinates_behind(part).iter().map(|&part| Column { argument, part }));
            }
        }
        columns.sort();
        columns.dedup();
        columns
    }

    /// `nodes` and what they are computed from, in order of creation, without going beyond what is known already.
    pub fn unknown(&self, nodes: &[Node], known: impl Fn(Node) -> bool) -> Vec<Node> {
        let mut seen = vec![false; self.ops.len()];
        let (mut open, mut found) = (nodes.to_vec(), Vec::new());
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

    /// Every node needed for `outputs`, in order of creation: operands come before their users.
    pub fn reachable(&self, outputs: &[Node]) -> Vec<Node> {
        self.reachable_from(outputs, |_| false)
    }

    /// The same where the operands of `known` nodes are not needed.
    pub fn reachable_from(&self, outputs: &[Node], known: impl Fn(Node) -> bool) -> Vec<Node> {
        let mut seen = vec![false; self.ops.len()];
        let mut open: Vec<Node> = outputs.to_vec();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.0 as usize], true) && !known(node) {
                self.each_operand(node, |operand| open.push(operand));
            }
        }
        (0..self.ops.len()).filter(|&k| seen[k]).map(|k| Node(k as u32)).collect()
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
