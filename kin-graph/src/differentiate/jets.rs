//! Computes second-order jets: the derivatives g′(0) and g″(0) of g(s) = C(q + s q̇, t + s ṫ).
//!
//! The right side for accelerations is −g″(0). Along a curve q + s q̇ + ½ s² q̈ the second
//! derivative contains the term of q̈ too.

use super::curve::Curve;
use super::moves::{Motion, Moves};
use super::scaled::{Depth, Tangents, relative_exponent, scaled, where_finite, where_large};
use super::{Memo, rules};
use crate::{Direction, Function2, Graph, LeafNumber, LeafUse, Node, Op};

/// The first and second derivative of a node along the motion.
#[derive(Clone, Copy)]
pub struct Jet {
    pub first: Node,
    pub second: Node,
}

/// Computes jets along (q̇, ṫ) and differentiates each node once.
///
/// Kin stores first derivatives separately: the second derivative of f(u) needs the first
/// derivative of f′(u), which can contain f(u) again.
#[derive(Default)]
pub struct Jets {
    first: Memo<Node>,
    second: Memo<Second>,
    moves: Moves,
    curve: Curve,
}

impl Tangents for Jets {
    fn tangent(&self, node: Node) -> Node {
        self.first.of(node)
    }
}

/// A second derivative as `outer + 2 cross`: the products of first derivatives are gathered through
/// sums, and doubled once.
#[derive(Clone, Copy, Default)]
struct Second {
    outer: Node,
    cross: Node,
}

impl Second {
    fn whole(self, g: &mut Graph) -> Node {
        let cross = double(g, self.cross);
        g.add(self.outer, cross)
    }
}

/// An argument of a function, with the function's derivative by it.
struct Argument<'a> {
    node: Node,
    derivative: &'a dyn Fn(&mut Graph) -> Node,
    /// True if the derivative is finite wherever the function is.
    tame: bool,
}

impl Jets {
    /// Creates jets along a curve.
    ///
    /// The second derivative of argument k is the input [`Input::Rate`](crate::Input::Rate) of
    /// argument k + `beyond`.
    pub fn along_curve(beyond: usize) -> Jets {
        Jets { curve: Curve::Bent(beyond), ..Jets::default() }
    }

    /// Returns the jet of `node`.
    pub fn of(&mut self, g: &mut Graph, node: Node) -> Jet {
        let first = self.first(g, node);
        for inner in g.unknown(&[node], |n| self.second.has(n)) {
            let second = self.second_rule(g, inner);
            self.second.set(inner, second);
        }
        Jet { first, second: self.second.of(node).whole(g) }
    }

    /// Returns the first derivative of `node`, without the second.
    pub fn first(&mut self, g: &mut Graph, node: Node) -> Node {
        for inner in g.unknown(&[node], |n| self.first.has(n)) {
            let first = self.first_rule(g, inner);
            self.first.set(inner, first);
            self.moves.note(g, inner, first);
        }
        self.first.of(node)
    }

    fn known(&self, g: &mut Graph, node: Node) -> Jet {
        Jet { first: self.first.of(node), second: self.second.of(node).whole(g) }
    }

    fn first_rule(&mut self, g: &mut Graph, node: Node) -> Node {
        if !g.depends(node).varies() {
            return g.zero();
        }
        let d = |n: Node| self.first.of(n);
        match g.op(node) {
            Op::Input(input) => self.curve.jet(g, input).first,
            Op::Add(a, b) => g.add(d(a), d(b)),
            Op::Sub(a, b) => g.sub(d(a), d(b)),
            Op::Neg(a) => g.neg(d(a)),
            Op::Mul(a, b) => sum_of_products(g, [(d(a), b), (a, d(b))]),
            Op::Fma(a, b, c) => {
                let product = sum_of_products(g, [(d(a), b), (a, d(b))]);
                g.add(product, d(c))
            }
            Op::Div(a, b) if g.bursts(b) => {
                let inverse = inverse(g, b);
                let left = scaled(g, self, inverse, a);
                let right = scaled(g, self, inverse, b);
                let right = g.mul(node, right);
                let whole = g.sub(left, right);
                where_finite(g, b, whole)
            }
            Op::Div(a, b) => {
                let yb = g.mul(node, d(b));
                let numerator = g.sub(d(a), yb);
                g.div(numerator, b)
            }
            Op::Powi(a, n) if n < 0 && g.bursts(a) => {
                self.relative_power_first(g, a, f64::from(n), node)
            }
            Op::Call2(Function2::Powf, a, b) if relative_exponent(g, a, b).is_some() => {
                let n = relative_exponent(g, a, b).unwrap_or_default();
                let relative = self.relative_power_first(g, a, n, node);
                let plain = with_arguments(g, node, |g, arguments| self.chain_first(g, arguments));
                where_large(g, a, n, relative, plain)
            }
            Op::Select(c, a, b) => g.select(c, d(a), d(b)),
            Op::Call2(Function2::Max | Function2::Min, a, b) => {
                let first = rules::takes_first(g, node);
                g.select(first, d(a), d(b))
            }
            Op::Leaf(of) => self.leaf(g, of, LeafNumber::First),
            _ => with_arguments(g, node, |g, arguments| self.chain_first(g, arguments)),
        }
    }

    fn second_rule(&mut self, g: &mut Graph, node: Node) -> Second {
        let zero = g.zero();
        let plain = |outer: Node| Second { outer, cross: zero };
        if !g.depends(node).varies() {
            return plain(zero);
        }
        let dd = |n: Node| self.second.of(n);
        match g.op(node) {
            Op::Input(input) => plain(self.curve.jet(g, input).second),
            Op::Add(a, b) => both(g, Graph::add, dd(a), dd(b)),
            Op::Sub(a, b) => both(g, Graph::sub, dd(a), dd(b)),
            Op::Neg(a) => both(g, Graph::sub, plain(zero), dd(a)),
            Op::Mul(a, b) => self.product(g, a, b),
            Op::Fma(a, b, c) => {
                let product = self.product(g, a, b);
                both(g, Graph::add, product, dd(c))
            }
            Op::Div(a, b) => plain(self.quotient(g, a, b, node)),
            Op::Powi(a, n) if n < 0 && g.bursts(a) => {
                plain(self.relative_power(g, a, f64::from(n), node))
            }
            Op::Call2(Function2::Powf, a, b) if relative_exponent(g, a, b).is_some() => {
                let n = relative_exponent(g, a, b).unwrap_or_default();
                let relative = self.relative_power(g, a, n, node);
                let whole = with_arguments(g, node, |g, arguments| self.chain_second(g, arguments));
                plain(where_large(g, a, n, relative, whole))
            }
            Op::Select(c, a, b) => {
                let a = dd(a).whole(g);
                let b = dd(b).whole(g);
                plain(g.select(c, a, b))
            }
            Op::Call2(Function2::Max | Function2::Min, a, b) => {
                let first = rules::takes_first(g, node);
                let a = dd(a).whole(g);
                let b = dd(b).whole(g);
                plain(g.select(first, a, b))
            }
            Op::Leaf(of) => plain(self.leaf(g, of, LeafNumber::Second)),
            _ => plain(with_arguments(g, node, |g, arguments| self.chain_second(g, arguments))),
        }
    }

    /// (a b)″ = a″ b + a b″ + 2 a′ b′
    fn product(&self, g: &mut Graph, a: Node, b: Node) -> Second {
        let ja = self.known(g, a);
        let jb = self.known(g, b);
        let cross = g.mul(ja.first, jb.first);
        let outer = sum_of_products(g, [(ja.second, b), (a, jb.second)]);
        Second { outer, cross }
    }

    /// y = a/b:  y″ = (a″ − 2 y′ b′ − y b″)/b
    fn quotient(&mut self, g: &mut Graph, a: Node, b: Node, y: Node) -> Node {
        if g.bursts(b) {
            let inverse = inverse(g, b);
            let first = self.first.of(y);
            let whole = self.scaled_second(g, inverse, a, Depth::FULL);
            let relative = scaled(g, self, inverse, b);
            let cross = g.mul(first, relative);
            let bent = self.scaled_second(g, inverse, b, Depth::FULL);
            let cross = double(g, cross);
            let last = g.mul(y, bent);
            let whole = g.sub(whole, cross);
            let whole = g.sub(whole, last);
            return where_finite(g, b, whole);
        }
        let ja = self.known(g, a);
        let jb = self.known(g, b);
        let cross = g.mul(self.first.of(y), jb.first);
        let cross = double(g, cross);
        let last = g.mul(y, jb.second);
        let numerator = g.sub(ja.second, cross);
        let numerator = g.sub(numerator, last);
        g.div(numerator, b)
    }

    /// y = aⁿ:  y′ = n y a′/a
    fn relative_power_first(&self, g: &mut Graph, a: Node, n: f64, y: Node) -> Node {
        let inverse = inverse(g, a);
        let n = g.constant(n);
        let relative = scaled(g, self, inverse, a);
        let factor = g.mul(n, y);
        let whole = g.mul(factor, relative);
        where_finite(g, a, whole)
    }

    /// y = aⁿ, with α = a′/a:  y″ = n y (a″/a + (n − 1) α²)
    fn relative_power(&mut self, g: &mut Graph, a: Node, n: f64, y: Node) -> Node {
        let inverse = inverse(g, a);
        let relative = scaled(g, self, inverse, a);
        let bent = self.scaled_second(g, inverse, a, Depth::FULL);
        let square = g.mul(relative, relative);
        let lower = g.constant(n - 1.0);
        let n = g.constant(n);
        let square = g.mul(lower, square);
        let sum = g.add(bent, square);
        let factor = g.mul(n, y);
        let whole = g.mul(factor, sum);
        where_finite(g, a, whole)
    }

    /// c u″, the factor first: see [`scaled`].
    fn scaled_second(&mut self, g: &mut Graph, c: Node, u: Node, depth: Depth) -> Node {
        let second = self.second.of(u).whole(g);
        if !g.bursts(u) {
            return g.mul(c, second);
        }
        let parts = self.second_parts(g, c, u, depth);
        parts.unwrap_or_else(|| g.mul(c, second))
    }

    /// The same taken apart; `None` where that is of no use, or goes too deep.
    fn second_parts(&mut self, g: &mut Graph, c: Node, u: Node, depth: Depth) -> Option<Node> {
        Some(match g.op(u) {
            Op::Neg(a) => {
                let inner = self.scaled_second(g, c, a, depth.sum()?);
                g.neg(inner)
            }
            Op::Add(a, b) | Op::Sub(a, b) => {
                let depth = depth.sum()?;
                let left = self.scaled_second(g, c, a, depth);
                let right = self.scaled_second(g, c, b, depth);
                if matches!(g.op(u), Op::Add(..)) { g.add(left, right) } else { g.sub(left, right) }
            }
            // a″ b + 2 a′ b′ + a b″
            Op::Mul(a, b) => {
                let depth = depth.product()?;
                let cb = g.mul(c, b);
                let ca = g.mul(c, a);
                let left = self.scaled_second(g, cb, a, depth);
                let right = self.scaled_second(g, ca, b, depth);
                let cross = scaled(g, self, c, a);
                let cross = scaled(g, self, cross, b);
                let cross = double(g, cross);
                let sum = g.add(left, right);
                g.add(sum, cross)
            }
            // f′ a″ + (f′)′ a′
            Op::Call(f, a) => {
                let slope = rules::derivative(g, f, a, u);
                self.first(g, slope);
                let bent = scaled(g, self, c, slope);
                let factor = g.mul(c, slope);
                let bent = scaled(g, self, bent, a);
                let straight = self.scaled_second(g, factor, a, depth.product()?);
                g.add(straight, bent)
            }
            Op::Select(condition, a, b) => {
                let depth = depth.sum()?;
                let left = self.scaled_second(g, c, a, depth);
                let right = self.scaled_second(g, c, b, depth);
                g.select(condition, left, right)
            }
            _ => return None,
        })
    }

    /// y = f(a, …):  y′ = Σ f_a a′. Derivatives by arguments that do not move are not built.
    fn chain_first(&self, g: &mut Graph, arguments: &[Argument]) -> Node {
        let zero = g.zero();
        arguments.iter().fold(zero, |sum, argument| {
            let a = argument.node;
            let tangent = self.first.of(argument.node);
            if g.is_zero(tangent) {
                return sum;
            }
            let outer = (argument.derivative)(g);
            let motion = self.moves.of(a);
            let term = if g.bursts(a) {
                let term = scaled(g, self, outer, a);
                where_finite(g, a, term)
            } else {
                let inner = if argument.tame { tangent } else { motion.inner(g, tangent) };
                g.mul(outer, inner)
            };
            let term = if argument.tame { term } else { motion.guard(g, term) };
            g.add(sum, term)
        })
    }

    /// y = f(a, …):  y″ = Σ (f_a)′ a′ + f_a a″.
    fn chain_second(&mut self, g: &mut Graph, arguments: &[Argument]) -> Node {
        let mut sum = g.zero();
        for argument in arguments {
            let a = argument.node;
            let inner = self.known(g, a);
            if g.is_zero(inner.first) && g.is_zero(inner.second) {
                continue;
            }
            let outer = (argument.derivative)(g);
            let outer_first = self.first(g, outer);
            let motion = self.moves.of(a);
            let term = if g.bursts(a) {
                let bent = scaled(g, self, outer_first, a);
                let straight = self.scaled_second(g, outer, a, Depth::FULL);
                let term = g.add(bent, straight);
                where_finite(g, a, term)
            } else {
                let open = |node: Node| if argument.tame { node } else { motion.inner(g, node) };
                let [first, second] = [inner.first, inner.second].map(open);
                sum_of_products(g, [(outer_first, first), (outer, second)])
            };
            let term = if argument.tame { term } else { motion.guard(g, term) };
            sum = g.add(sum, term);
        }
        sum
    }

    /// One evaluation of the user's function with jets for arguments gives both derivatives.
    fn leaf(&mut self, g: &mut Graph, of: LeafUse, number: fn(usize) -> LeafNumber) -> Node {
        let arguments = g.leaves[of.leaf].arguments.clone();
        let jets: Vec<Jet> = arguments.iter().map(|&a| self.of(g, a)).collect();
        if jets.iter().all(|jet| g.is_zero(jet.first) && g.is_zero(jet.second)) {
            return g.zero();
        }
        let first = jets.iter().map(|jet| jet.first).collect();
        let second = jets.iter().map(|jet| jet.second).collect();
        let condition =
            |a: &Node| if let Motion::When(moves) = self.moves.of(*a) { Some(moves) } else { None };
        let moves = arguments.iter().map(condition).collect();
        let direction = g.direction(Direction { leaf: of.leaf, first, second, moves });
        g.leaf_output(of.leaf, of.output, number(direction))
    }
}

/// The arguments of a function node, each with the function's derivative by it; none for
/// conditions.
fn with_arguments(
    g: &mut Graph,
    node: Node,
    chain: impl FnOnce(&mut Graph, &[Argument]) -> Node,
) -> Node {
    match g.op(node) {
        Op::Call(f, a) => chain(
            g,
            &[Argument {
                node: a,
                derivative: &|g| rules::derivative(g, f, a, node),
                tame: f.facts().is_tame(),
            }],
        ),
        Op::Powi(a, n) => chain(
            g,
            &[Argument { node: a, derivative: &|g| rules::power_derivative(g, a, n), tame: true }],
        ),
        Op::Law(law, a, order) => chain(
            g,
            &[Argument { node: a, derivative: &|g| g.law(law, a, order + 1), tame: false }],
        ),
        Op::Call2(f, a, b) => {
            let by = rules::derivatives2(g, f, a, b, node);
            let by_a = Argument { node: a, derivative: &|_| by.0, tame: false };
            chain(g, &[by_a, Argument { node: b, derivative: &|_| by.1, tame: false }])
        }
        _ => g.zero(),
    }
}

fn inverse(g: &mut Graph, a: Node) -> Node {
    let one = g.constant(1.0);
    g.div(one, a)
}

fn both(
    g: &mut Graph,
    combine: fn(&mut Graph, Node, Node) -> Node,
    a: Second,
    b: Second,
) -> Second {
    Second { outer: combine(g, a.outer, b.outer), cross: combine(g, a.cross, b.cross) }
}

fn double(g: &mut Graph, a: Node) -> Node {
    let two = g.constant(2.0);
    g.mul(two, a)
}

fn sum_of_products(g: &mut Graph, terms: [(Node, Node); 2]) -> Node {
    let [left, right] = terms.map(|(a, b)| g.mul(a, b));
    g.add(left, right)
}
