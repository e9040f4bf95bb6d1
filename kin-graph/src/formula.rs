//! The rows of an equation, or a law, as data: the graph as it was written, with no derivative in
//! it, and the expressions that its nodes are of.

use crate::{Graph, Node, Op};

/// An expression of the user's.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Expression {
    /// As it is written.
    pub text: String,
    /// Line, counted from 1.
    pub line: u32,
    /// Column, counted from 1.
    pub column: u32,
}

/// The rows of an equation. Coordinates are [`crate::Input::Column`], the variable of a law is
/// column 0; what only the user's program can compute stands as [`Op::Law`] and [`Op::Opaque`],
/// numbered together.
#[derive(Default)]
pub struct Formula {
    pub graph: Graph,
    /// The node of each row.
    pub rows: Vec<Node>,
    /// The names of the parameters.
    pub parameters: Vec<String>,
    pub expressions: Vec<Expression>,
    /// True if constants in it have been rounded before they could be read.
    pub is_rounded: bool,
    /// The number of each node's expression.
    written: Vec<Option<usize>>,
}

impl Formula {
    /// The node of an operation as it stands, which is of expression number `expression`.
    pub fn push(&mut self, op: Op, expression: Option<usize>) -> Node {
        let node = self.graph.raw(op);
        self.note(node, expression)
    }

    /// The same for a decimal that no f64 is.
    pub fn push_decimal(&mut self, nearest: f64, above: bool, expression: Option<usize>) -> Node {
        let node = self.graph.decimal_beside(nearest, above);
        self.note(node, expression)
    }

    fn note(&mut self, node: Node, expression: Option<usize>) -> Node {
        if self.written.len() <= node.index() {
            self.written.resize(node.index() + 1, None);
        }
        let known = &mut self.written[node.index()];
        *known = known.or(expression);
        node
    }

    /// The same for component `component` of value number `number`, which only the user's program
    /// can compute of `operands`.
    pub fn push_opaque(
        &mut self,
        number: usize,
        component: usize,
        operands: Vec<Node>,
        expression: Option<usize>,
    ) -> Node {
        if self.graph.opaques.len() <= number {
            self.graph.opaques.resize(number + 1, Vec::new());
        }
        self.graph.opaques[number] = operands;
        self.push(Op::Opaque(number, component), expression)
    }

    /// The number of the expression that a node is of.
    pub(crate) fn number_of_expression(&self, node: Node) -> Option<usize> {
        self.written.get(node.index()).copied().flatten()
    }

    /// The expression that a node is of.
    pub fn expression(&self, node: Node) -> Option<&Expression> {
        self.expressions.get(self.number_of_expression(node)?)
    }
}
