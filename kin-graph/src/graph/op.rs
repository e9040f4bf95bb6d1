//! The operations of nodes.

use super::Node;
use crate::{Function, Function2};

/// The inputs that the code around an emitted kernel provides.
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
    /// The coordinate of a local column, where bodies and their states are not told apart; the
    /// variable of a law is column 0.
    Column(usize),
    /// A numeric parameter, by its number.
    Parameter(usize),
    /// A value that was evaluated once a time, by its number; put in before the scheduler.
    Timed(usize),
}

/// Part of a state. `R`, `Theta` and `P` are coordinates, the others depend on them. The value of a
/// bare coordinate is its `Theta` too.
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
    /// A number that no f64 is, by its number among [`super::Graph::decimals`]; only in a graph as
    /// written.
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
    /// One scalar of a value that is only known at run time and has no derivative: its number and
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
    /// The same operation on other operands; what holds none itself, values and calls of the user's
    /// own too, stays as it is.
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
