//! Defines the operations of nodes.

use super::Node;
use crate::{Function, Function2};

/// The inputs that the code around an emitted kernel provides.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Input {
    /// A part of the state of an argument.
    State(usize, Part),
    /// The velocity of a coordinate of an argument.
    Rate(usize, Part),
    /// The time t.
    Time,
    /// ṫ, the factor of every derivative by time.
    TimeRate,
    /// The coordinate of a local column, in a graph without states of bodies; the variable of a law
    /// is column 0.
    Column(usize),
    /// A numeric parameter, by its index.
    Parameter(usize),
    /// A value that the program evaluates once for each time, by its index.
    Timed(usize),
}

/// A part of a state.
///
/// `R`, `Theta` and `P` are coordinates; the other parts depend on them. The value of a scalar
/// coordinate is its `Theta`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Part {
    R(usize),
    Theta,
    P(usize),
    Sin,
    Cos,
}

/// A coordinate of an argument, which has a column in C_q.
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
    /// The bits of an f64.
    Constant(u64),
    /// A number that is not an f64, by its index in [`super::Graph::decimals`]; only in a graph
    /// without rounding.
    Decimal(usize),
    Add(Node, Node),
    Sub(Node, Node),
    Mul(Node, Node),
    Div(Node, Node),
    /// a b + c, rounded once if the processor supports it; only the scheduler creates this
    /// operation.
    Fma(Node, Node, Node),
    Neg(Node),
    Call(Function, Node),
    Call2(Function2, Node, Node),
    Powi(Node, i32),
    /// The k-th derivative of a law at x.
    Law(usize, Node, u8),
    /// One component of a value without derivative that is known only at run time: its index and
    /// component.
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
    /// Returns the operation with other operands.
    ///
    /// An operation without operands, and a value or call of the user's program, does not change.
    pub fn with_operands(self, of: impl Fn(Node) -> Node) -> Op {
        match self {
            Op::Input(_)
            | Op::Constant(_)
            | Op::Decimal(_)
            | Op::Truth(_)
            | Op::Opaque(..)
            | Op::Leaf(_) => self,
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

/// An output of an evaluation of a leaf.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct LeafUse {
    pub leaf: usize,
    pub output: usize,
    pub what: LeafNumber,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum LeafNumber {
    Value,
    /// The partial derivative by one argument that depends on coordinates or time.
    Partial(usize),
    /// The first derivative along a direction of the arguments, by the index of the direction.
    First(usize),
    /// The second derivative along a direction of the arguments.
    Second(usize),
}

/// A call of the user's generic function: its arguments that carry derivatives.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Leaf {
    /// The index of the call in the user's text.
    pub call: usize,
    pub arguments: Vec<Node>,
}

/// The first and second derivatives of a leaf's arguments along the motion.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Direction {
    pub leaf: usize,
    pub first: Vec<Node>,
    pub second: Vec<Node>,
    /// For each argument the condition under which it changes; `None` without a condition.
    pub moves: Vec<Option<Node>>,
}
