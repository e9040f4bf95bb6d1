//! Computes first derivatives by one column of C_q, by t, or by the variable of a law.

use super::moves::Moves;
use super::scaled::{Tangents, relative_exponent, scaled, where_finite, where_large};
use super::{Memo, rules};
use crate::{Column, Function2, Graph, Input, LeafNumber, LeafUse, Node, Op, Part};

/// The variable of differentiation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum By {
    Column(Column),
    Time,
    Variable,
}

/// Computes derivatives by one variable, and differentiates each node once.
pub struct Partial {
    by: By,
    memo: Memo<Node>,
    moves: Moves,
}

impl Tangents for Partial {
    fn tangent(&self, node: Node) -> Node {
        self.known(node)
    }
}

impl Partial {
    pub fn by_column(column: Column) -> Self {
        Partial::by(By::Column(column))
    }

    pub fn by_time() -> Self {
        Partial::by(By::Time)
    }

    pub fn by_variable() -> Self {
        Partial::by(By::Variable)
    }

    fn by(by: By) -> Self {
        Partial { by, memo: Memo::default(), moves: Moves::default() }
    }

    /// Returns the derivative of `node`.
    pub fn of(&mut self, g: &mut Graph, node: Node) -> Node {
        let unknown = self.unknown(g, node);
        self.of_all(g, &unknown);
        self.known(node)
    }

    /// Returns the nodes that must be differentiated before `node`, and `node` itself.
    ///
    /// Operands come before their users, so a loop over the nodes replaces a recursion as deep as
    /// the expression.
    pub fn unknown(&self, g: &Graph, node: Node) -> Vec<Node> {
        g.unknown(&[node], |n| self.memo.has(n))
    }

    /// Differentiates the nodes from [`Partial::unknown`].
    pub fn of_all(&mut self, g: &mut Graph, unknown: &[Node]) {
        let zero = g.zero();
        for &node in unknown {
            let derivative = if self.is_still(g, node) { zero } else { self.rule(g, node) };
            self.memo.set(node, derivative);
            self.moves.note(g, node, derivative);
        }
    }

    /// Returns the derivative of a node that is already differentiated.
    pub fn known(&self, node: Node) -> Node {
        self.memo.of(node)
    }

    /// True if none of a node's operands has a derivative.
    fn is_still(&self, g: &Graph, node: Node) -> bool {
        let mut still = !matches!(g.op(node), Op::Input(_));
        g.each_operand(node, |operand| still &= g.is_zero(self.known(operand)));
        still
    }

    /// The derivative of `node` from those of its operands.
    fn rule(&mut self, g: &mut Graph, node: Node) -> Node {
        if !g.depends(node).varies() {
            return g.zero();
        }
        match g.op(node) {
            Op::Input(input) => input_derivative(g, input, self.by),
            Op::Add(a, b) => g.add(self.known(a), self.known(b)),
            Op::Sub(a, b) => g.sub(self.known(a), self.known(b)),
            Op::Neg(a) => g.neg(self.known(a)),
            Op::Mul(a, b) => {
                let left = g.mul(self.known(a), b);
                let right = g.mul(a, self.known(b));
                g.add(left, right) // a′ b + a b′
            }
            Op::Fma(a, b, c) => {
                let left = g.mul(self.known(a), b);
                let right = g.mul(a, self.known(b));
                let product = g.add(left, right);
                g.add(product, self.known(c)) // a′ b + a b′ + c′
            }
            Op::Div(a, b) => self.quotient(g, a, b, node),
            Op::Call(f, a) => {
                self.chain(g, a, f.facts().is_tame(), |g| rules::derivative(g, f, a, node))
            }
            Op::Powi(a, n) if n < 0 && g.bursts(a) => self.relative_power(g, a, f64::from(n), node),
            Op::Powi(a, n) => self.chain(g, a, true, |g| rules::power_derivative(g, a, n)),
            Op::Law(law, a, order) => self.chain(g, a, false, |g| g.law(law, a, order + 1)),
            Op::Call2(Function2::Max | Function2::Min, a, b) => {
                let first = rules::takes_first(g, node);
                g.select(first, self.known(a), self.known(b))
            }
            Op::Call2(Function2::Powf, a, b) if relative_exponent(g, a, b).is_some() => {
                let n = relative_exponent(g, a, b).unwrap_or_default();
                let relative = self.relative_power(g, a, n, node);
                let by_a = rules::derivatives2(g, Function2::Powf, a, b, node).0;
                let plain = self.chain(g, a, false, |_| by_a);
                where_large(g, a, n, relative, plain)
            }
            Op::Call2(f, a, b) => {
                let (by_a, by_b) = rules::derivatives2(g, f, a, b, node);
                let left = self.chain(g, a, false, |_| by_a);
                let right = self.chain(g, b, false, |_| by_b);
                g.add(left, right)
            }
            Op::Select(c, a, b) => g.select(c, self.known(a), self.known(b)),
            Op::Leaf(of) => self.leaf(g, of),
            Op::Constant(_)
            | Op::Decimal(_)
            | Op::Opaque(..)
            | Op::Truth(_)
            | Op::Compare(..)
            | Op::And(..)
            | Op::Or(..)
            | Op::Not(_) => g.zero(),
        }
    }

    /// f′ a′, where f′ is only built if a′ is not a structural zero. It is zero where a does not
    /// move, if f is not `tame`: finite in its slope.
    fn chain(
        &mut self,
        g: &mut Graph,
        a: Node,
        tame: bool,
        outer: impl FnOnce(&mut Graph) -> Node,
    ) -> Node {
        let tangent = self.known(a);
        if g.is_zero(tangent) {
            return tangent;
        }
        let outer = outer(g);
        if g.bursts(a) {
            let term = scaled(g, self, outer, a);
            let term = where_finite(g, a, term);
            return if tame { term } else { self.moves.of(a).guard(g, term) };
        }
        if tame {
            return g.mul(outer, tangent);
        }
        let motion = self.moves.of(a);
        let inner = motion.inner(g, tangent);
        let term = g.mul(outer, inner);
        motion.guard(g, term)
    }

    /// y = a/b:  y′ = (a′ − y b′)/b
    fn quotient(&mut self, g: &mut Graph, a: Node, b: Node, y: Node) -> Node {
        if !g.bursts(b) {
            let product = g.mul(y, self.known(b));
            let numerator = g.sub(self.known(a), product);
            return g.div(numerator, b);
        }
        let one = g.constant(1.0);
        let inverse = g.div(one, b);
        let left = scaled(g, self, inverse, a);
        let right = scaled(g, self, inverse, b);
        let right = g.mul(y, right);
        let whole = g.sub(left, right);
        where_finite(g, b, whole)
    }

    /// y = aⁿ:  y′ = n y a′/a, which does not lose what is small as aⁿ⁻¹ does.
    fn relative_power(&mut self, g: &mut Graph, a: Node, n: f64, y: Node) -> Node {
        let one = g.constant(1.0);
        let factor = g.constant(n);
        let inverse = g.div(one, a);
        let relative = scaled(g, self, inverse, a);
        let factor = g.mul(factor, y);
        let whole = g.mul(factor, relative);
        where_finite(g, a, whole)
    }

    /// Σ ∂f/∂aₖ aₖ′ for a call of the user's generic function.
    fn leaf(&mut self, g: &mut Graph, of: LeafUse) -> Node {
        let arguments = g.leaves[of.leaf].arguments.clone();
        let zero = g.zero();
        arguments.iter().enumerate().fold(zero, |sum, (k, &a)| {
            let term = self
                .chain(g, a, false, |g| g.leaf_output(of.leaf, of.output, LeafNumber::Partial(k)));
            g.add(sum, term)
        })
    }
}

/// Derivative of an input: the coordinates themselves, and the parts of states that are functions
/// of them.
pub(super) fn input_derivative(g: &mut Graph, input: Input, by: By) -> Node {
    let (argument, part) = match (input, by) {
        (Input::Time, By::Time) | (Input::Column(0), By::Variable) => return g.constant(1.0),
        (Input::State(argument, part), By::Column(column)) if argument == column.argument => {
            (argument, (part, column.part))
        }
        _ => return g.zero(),
    };
    let state = |g: &mut Graph, part| g.input(Input::State(argument, part));
    match part {
        (Part::Sin, Part::Theta) => state(g, Part::Cos),
        (Part::Cos, Part::Theta) => {
            let sin = state(g, Part::Sin);
            g.neg(sin)
        }
        (of, by) => g.constant(if of == by { 1.0 } else { 0.0 }),
    }
}
