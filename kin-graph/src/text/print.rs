//! Prints operations in any dialect: `crank / 2.0`, `hypot(dx, dy)`, `\frac{a}{2}`.

use super::{Binding, Infix, Piece};
use crate::{Function, Function2, Graph, Node, Op};

/// The words of a language for operations.
///
/// Each method returns the text of one operation of which the operands are printed already. So the
/// operands can be sub-expressions, or names of earlier results.
pub trait Dialect {
    /// The brackets around an operand.
    fn brackets(&self) -> [&'static str; 2] {
        ["(", ")"]
    }

    /// Returns a number.
    fn number(&self, x: f64) -> Piece;

    /// Returns a condition that is known.
    fn truth(&self, holds: bool) -> Piece;

    /// Returns the sign of an operator.
    fn sign(&self, operator: Infix) -> &'static str;

    /// Returns a function of one number.
    fn call(&self, function: Function, a: &Piece) -> Piece;

    /// Returns a function of two numbers.
    fn call2(&self, function: Function2, a: &Piece, b: &Piece) -> Piece;

    /// Returns aⁿ.
    fn power(&self, a: &Piece, n: i32) -> Piece;

    /// Returns the opposite of a condition.
    fn not(&self, a: &Piece) -> Piece;

    /// Returns `a` if `condition` holds, otherwise `b`.
    fn choice(&self, condition: &Piece, a: &Piece, b: &Piece) -> Piece;

    /// Returns −a.
    fn negative(&self, a: &Piece) -> Piece {
        Piece::new(format!("-{}", a.within(Binding::Sign, self.brackets())), Binding::Sign)
    }

    /// Returns a b + c.
    fn fused(&self, a: &Piece, b: &Piece, c: &Piece) -> Piece {
        self.infix(&self.infix(a, Infix::Product, b), Infix::Sum, c)
    }

    /// Returns two operands with an operator between them.
    fn infix(&self, a: &Piece, operator: Infix, b: &Piece) -> Piece {
        let [binding, left, right] = operator.bindings();
        let left = a.within(left, self.brackets());
        let right = b.within(right, self.brackets());
        Piece::new(format!("{left} {} {right}", self.sign(operator)), binding)
    }
}

/// Prints one operation; `of` returns the printed operands.
///
/// Returns `None` for an input or a value that only the user's program knows: such a node needs a
/// name.
pub fn print_operation<'p>(
    graph: &Graph,
    op: Op,
    dialect: &dyn Dialect,
    of: impl Fn(Node) -> &'p Piece,
) -> Option<Piece> {
    let infix = |a, operator, b| dialect.infix(of(a), operator, of(b));
    Some(match op {
        Op::Constant(bits) => dialect.number(f64::from_bits(bits)),
        Op::Decimal(k) => dialect.number(graph.decimals[k].nearest),
        Op::Truth(holds) => dialect.truth(holds),
        Op::Add(a, b) => infix(a, Infix::Sum, b),
        Op::Sub(a, b) => infix(a, Infix::Difference, b),
        Op::Mul(a, b) => infix(a, Infix::Product, b),
        Op::Div(a, b) => infix(a, Infix::Quotient, b),
        Op::And(a, b) => infix(a, Infix::And, b),
        Op::Or(a, b) => infix(a, Infix::Or, b),
        Op::Compare(comparison, a, b) => infix(a, Infix::Comparison(comparison), b),
        Op::Fma(a, b, c) => dialect.fused(of(a), of(b), of(c)),
        Op::Neg(a) => dialect.negative(of(a)),
        Op::Not(a) => dialect.not(of(a)),
        Op::Call(f, a) => dialect.call(f, of(a)),
        Op::Call2(f, a, b) => dialect.call2(f, of(a), of(b)),
        Op::Powi(a, n) => dialect.power(of(a), n),
        Op::Select(c, a, b) => dialect.choice(of(c), of(a), of(b)),
        Op::Input(_) | Op::Law(..) | Op::Opaque(..) | Op::Leaf(_) => return None,
    })
}

/// Prints the expression of a node, or returns `None` if the text needs more than `longest` bytes,
/// or if a node that needs a name has none.
///
/// The function `named` gives the names of inputs, and of other nodes. The text of an expression
/// that shares parts can have any length.
pub fn print(
    graph: &Graph,
    node: Node,
    dialect: &dyn Dialect,
    named: impl Fn(Node) -> Option<String>,
    longest: usize,
) -> Option<String> {
    let mut pieces: Vec<Piece> = vec![Piece::atom(""); graph.len()];
    for node in graph.reachable_from(&[node], |node| named(node).is_some()) {
        let piece = match named(node) {
            Some(name) => Piece::atom(name),
            None => print_operation(graph, graph.op(node), dialect, |node| &pieces[node.index()])?,
        };
        if piece.text.len() > longest {
            return None;
        }
        pieces[node.index()] = piece;
    }
    pieces.get(node.index()).map(|piece| piece.text.clone())
}
