//! Defines the scalar graph, which contains every value of a constraint as hash-consed nodes.
//!
//! Equal expressions share one node, so the graph contains no duplicate subexpressions. The index
//! of a node is its order of creation; no result depends on the iteration order of hash tables.

mod decimal;
mod factors;
mod hash;
mod logic;
mod op;
mod rebuild;
mod simplify;
mod walk;

use std::collections::HashMap;

use crate::Function2;
use crate::functions::Growth;

pub use decimal::Decimal;
pub use op::{Column, Comparison, Direction, Input, Leaf, LeafNumber, LeafUse, Op, Part};
pub use simplify::is_power_of_two;

/// A scalar (or a condition) in a [`Graph`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Node(u32);

/// A graph of scalars and conditions. The constructors (in `simplify`) fold and simplify exactly.
#[derive(Clone, Default)]
pub struct Graph {
    ops: Vec<Op>,
    depends: Vec<Depends>,
    index: HashMap<Op, Node, hash::Quick>,
    /// The operands of each opaque value.
    pub opaques: Vec<Vec<Node>>,
    pub leaves: Vec<Leaf>,
    pub directions: Vec<Direction>,
    /// The numbers of the graph that are not f64.
    pub decimals: Vec<Decimal>,
    /// True if constants stay as they are written wherever f64 would round them.
    as_written: bool,
    /// True if f64 has rounded a constant.
    rounded: bool,
}

/// The kinds of inputs on which a node depends.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Depends {
    /// True if the node depends on a coordinate, or on the variable of a law.
    pub on_q: bool,
    /// True if the node depends on time.
    pub on_t: bool,
    /// Through a choice between values: `if`, `max`, `min`.
    chooses: bool,
    /// Grows as an exponential or a power does: it may overflow though what is made of it does not.
    bursts: bool,
    /// May be infinite at a pole, as a quotient and a logarithm are.
    has_poles: bool,
}

impl Depends {
    /// Returns true if the node depends on an input with a derivative.
    pub fn varies(self) -> bool {
        self.on_q || self.on_t
    }

    /// Notes how a function of it grows.
    fn grow(&mut self, growth: Growth) {
        match growth {
            Growth::Ordinary => {}
            Growth::Bounded => (self.bursts, self.has_poles) = (false, false),
            Growth::Logarithmic => self.bursts = false,
            Growth::Bursting => self.bursts = true,
        }
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
    /// Returns the index of the node, which is larger than the indices of its operands.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl Graph {
    /// Creates a graph without rounding: a decimal that is not an f64 remains a decimal, and Kin
    /// folds an operation on constants only if the result is exact.
    pub fn as_written() -> Self {
        Graph { as_written: true, ..Graph::default() }
    }

    /// Returns true if a number of the graph was rounded, so that [`Graph::as_written`] would
    /// contain another number.
    pub fn is_rounded(&self) -> bool {
        self.rounded
    }

    /// Returns true if constants remain as the user wrote them.
    pub fn keeps_constants(&self) -> bool {
        self.as_written
    }

    /// Returns true if a node consists of numbers alone.
    pub fn is_number(&self, node: Node) -> bool {
        let given = |n: &Node| {
            matches!(self.op(*n), Op::Input(_) | Op::Opaque(..) | Op::Leaf(_) | Op::Law(..))
        };
        !self.reachable(&[node]).iter().any(given)
    }

    pub fn op(&self, node: Node) -> Op {
        self.ops[node.0 as usize]
    }

    pub fn depends(&self, node: Node) -> Depends {
        self.depends[node.0 as usize]
    }

    /// Returns true if a node depends on a selection between values.
    pub fn chooses(&self, node: Node) -> bool {
        self.depends(node).chooses
    }

    /// Returns true if a node varies and grows like an exponential or a power.
    pub fn bursts(&self, node: Node) -> bool {
        self.depends(node).bursts
    }

    /// Returns true if a node is infinite only by overflow and never at a pole.
    pub fn overflows(&self, node: Node) -> bool {
        let Depends { bursts, has_poles, .. } = self.depends(node);
        bursts && !has_poles
    }

    /// Returns the constant value of a node, if the node is constant.
    ///
    /// The value of a condition is 1 if it is always true, and 0 if it is always false.
    pub fn known_value(&self, node: Node) -> Option<f64> {
        self.constant_value(node)
            .or_else(|| self.truth(node).map(|holds| f64::from(u8::from(holds))))
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

    /// The node of `op`, the same one each time.
    fn intern(&mut self, op: Op) -> Node {
        if let Some(&node) = self.index.get(&op) {
            return node;
        }
        let node = Node(self.ops.len() as u32);
        self.ops.push(op);
        let depends = match op {
            Op::Input(Input::State(..) | Input::Column(_)) => {
                Depends { on_q: true, ..Depends::default() }
            }
            Op::Input(Input::Time) => Depends { on_t: true, ..Depends::default() },
            _ => {
                let mut all = Depends::default();
                self.each_operand(node, |operand| all = all.or(self.depends(operand)));
                all.chooses |=
                    matches!(op, Op::Select(..) | Op::Call2(Function2::Max | Function2::Min, ..));
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
            Op::Call(f, _) => {
                let facts = f.facts();
                all.has_poles |= !facts.poles.is_empty();
                all.grow(facts.growth);
            }
            Op::Powi(_, n) => {
                all.bursts |= n.unsigned_abs() > 4;
                all.has_poles |= n < 0;
            }
            Op::Call2(Function2::Powf, _, n) => {
                all.bursts |= grows(n);
                all.has_poles |= falls(n);
            }
            Op::Call2(f, ..) => all.grow(f.facts().growth),
            Op::Div(_, b) => all.has_poles |= self.depends(b).varies(),
            Op::Law(..) | Op::Leaf(_) | Op::Opaque(..) => {
                (all.bursts, all.has_poles) = (false, true)
            }
            _ => {}
        }
        all.bursts &= all.varies();
        all.has_poles &= all.varies();
    }

    /// Returns the node of `op` without simplification.
    pub fn raw(&mut self, op: Op) -> Node {
        self.intern(op)
    }

    /// Returns the operation of `node` with other operands.
    ///
    /// A value of the user's program keeps its operands, because the text of the value names them.
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

    /// Returns the node of `op`, if the graph contains it.
    pub fn existing(&self, op: Op) -> Option<Node> {
        self.index.get(&op).copied()
    }

    pub fn input(&mut self, input: Input) -> Node {
        self.intern(Op::Input(input))
    }

    /// Returns the node of a component of an opaque value.
    pub fn opaque(&mut self, number: usize, component: usize) -> Node {
        self.intern(Op::Opaque(number, component))
    }

    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Returns all nodes, with operands before the nodes that use them.
    pub fn nodes(&self) -> impl Iterator<Item = Node> + use<> {
        (0..self.ops.len() as u32).map(Node)
    }

    /// Returns true if the graph has no nodes.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// Returns the index of a call of a generic function with these arguments that carry
    /// derivatives.
    ///
    /// The same call always has the same index.
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

    /// Returns the index of a direction of a leaf's arguments.
    ///
    /// The same direction always has the same index.
    pub fn direction(&mut self, direction: Direction) -> usize {
        self.directions.iter().position(|d| *d == direction).unwrap_or_else(|| {
            self.directions.push(direction);
            self.directions.len() - 1
        })
    }
}
