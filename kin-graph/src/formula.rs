//! Stores the rows of an equation, or a law, as data: the graph as the user wrote it, without
//! derivatives, and the expressions of its nodes.

use crate::{Graph, Node, Op};

/// An expression of the user's program.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Expression {
    /// The text of the expression.
    pub text: String,
    /// The line of the expression, counted from 1.
    pub line: u32,
    /// The column of the expression, counted from 1.
    pub column: u32,
}

/// The rows of an equation.
///
/// Coordinates are [`crate::Input::Column`], and the variable of a law is column 0. Values that
/// only the user's program can compute are [`Op::Law`] and [`Op::Opaque`], with common indices.
#[derive(Default)]
pub struct Formula {
    pub graph: Graph,
    /// The node of each row.
    pub rows: Vec<Node>,
    /// The names of the parameters.
    pub parameters: Vec<String>,
    pub expressions: Vec<Expression>,
    /// True if constants of the formula were rounded before Kin could read them.
    pub is_rounded: bool,
    /// The number of each node's expression.
    written: Vec<Option<usize>>,
}

impl Formula {
    /// Adds an operation without simplification and returns its node.
    ///
    /// The operation belongs to the expression with index `expression`.
    pub fn push(&mut self, op: Op, expression: Option<usize>) -> Node {
        let node = self.graph.raw(op);
        self.note(node, expression)
    }

    /// Adds a decimal that is not an f64 and returns its node.
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

    /// Adds component `component` of the value with index `number` and returns its node.
    ///
    /// Only the user's program can compute this value from `operands`.
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

    /// Returns the expression to which a node belongs.
    pub fn expression(&self, node: Node) -> Option<&Expression> {
        self.expressions.get(self.number_of_expression(node)?)
    }
}
