//! Second-order jets: of g(s) = C(q + s q̇, t + s ṫ), the derivatives g′(0) and g″(0). −g″(0) is the whole acceleration right side.

use super::{Memo, rules};
use crate::{Direction, Graph, Input, LeafNumber, LeafUse, Node, Op, Part};

/// First and second derivative along the motion.
#[derive(Clone, Copy)]
pub struct Jet {
    pub first: Node,
    pub second: Node,
}

/// Jets along (q̇, ṫ); each node is differentiated once. First derivatives stand alone: the second derivative of f(u) needs the first of
/// f′(u), which can contain f(u) again.
#[derive(Default)]
pub struct Jets {
    first: Memo<Node>,
    second: Memo<Second>,
}

/// A second derivative as `outer + 2 cross`: the products of first derivatives are gathered through sums, and doubled once.
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
type Argument<'a> = (Node, &'a dyn Fn(&mut Graph) -> Node);

impl Jets {
    /// The jet of `node`.
    pub fn of(&mut self, g: &mut Graph, node: Node) -> Jet {
        let first = self.first(g, node);
        for inner in g.unknown(&[node], |n| self.second.has(n)) {
            let second = self.second_rule(g, inner);
            self.second.set(inner, second);
        }
        Jet { first, second: self.second.of(node).whole(g) }
    }

    fn first(&mut self, g: &mut Graph, node: Node) -> Node {
        for inner in g.unknown(&[node], |n| self.first.has(n)) {
            let first = self.first_rule(g, inner);
            self.first.set(inner, first);
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
            Op::Input(input) => input_jet(g, input).first,
            Op::Add(a, b) => g.add(d(a), d(b)),
            Op::Sub(a, b) => g.sub(d(a), d(b)),
            Op::Neg(a) => g.neg(d(a)),
            Op::Mul(a, b) => sum_of_products(g, [(d(a), b), (a, d(b))]),
            Op::Fma(a, b, c) => {
                let product = sum_of_products(g, [(d(a), b), (a, d(b))]);
                g.add(product, d(c))
            }
            Op::Div(a, b) => {
                let yb = g.mul(node, d(b));
                let numerator = g.sub(d(a), yb);
                g.div(numerator, b)
            }
            Op::Select(c, a, b) => g.select(c, d(a), d(b)),
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
            Op::Input(input) => plain(input_jet(g, input).second),
            Op::Add(a, b) => both(g, Graph::add, dd(a), dd(b)),
            Op::Sub(a, b) => both(g, Graph::sub, dd(a), dd(b)),
            Op::Neg(a) => both(g, Graph::sub, plain(zero), dd(a)),
            Op::Mul(a, b) => self.product(g, a, b),
            Op::Fma(a, b, c) => {
                let product = self.product(g, a, b);
                both(g, Graph::add, product, dd(c))
            }
            Op::Div(a, b) => plain(self.quotient(g, a, b, node)),
            Op::Select(c, a, b) => {
                let (a, b) = (dd(a).whole(g), dd(b).whole(g));
                plain(g.select(c, a, b))
            }
            Op::Leaf(of) => plain(self.leaf(g, of, LeafNumber::Second)),
            _ => plain(with_arguments(g, node, |g, arguments| self.chain_second(g, arguments))),
        }
    }

    /// (a b)″ = a″ b + a b″ + 2 a′ b′
    fn product(&self, g: &mut Graph, a: Node, b: Node) -> Second {
        let (ja, jb) = (self.known(g, a), self.known(g, b));
        let cross = g.mul(ja.first, jb.first);
        let outer = sum_of_products(g, [(ja.second, b), (a, jb.second)]);
        Second { outer, cross }
    }

    /// y = a/b:  y″ = (a″ − 2 y′ b′ − y b″)/b
    fn quotient(&self, g: &mut Graph, a: Node, b: Node, y: Node) -> Node {
        let (ja, jb) = (self.known(g, a), self.known(g, b));
        let cross = g.mul(self.first.of(y), jb.first);
        let cross = double(g, cross);
        let last = g.mul(y, jb.second);
        let numerator = g.sub(ja.second, cross);
        let numerator = g.sub(numerator, last);
        g.div(numerator, b)
    }

    /// y = f(a, …):  y′ = Σ f_a a′. Derivatives by arguments that do not move are not built.
    fn chain_first(&self, g: &mut Graph, arguments: &[Argument]) -> Node {
        let zero = g.zero();
        arguments.iter().fold(zero, |sum, (a, derivative)| {
            let inner = self.first.of(*a);
            if g.is_zero(inner) {
                return sum;
            }
            let outer = derivative(g);
            let term = g.mul(outer, inner);
            g.add(sum, term)
        })
    }

    /// y = f(a, …):  y″ = Σ (f_a)′ a′ + f_a a″.
    fn chain_second(&mut self, g: &mut Graph, arguments: &[Argument]) -> Node {
        let mut sum = g.zero();
        for (a, derivative) in arguments {
            let inner = self.known(g, *a);
            if g.is_zero(inner.first) && g.is_zero(inner.second) {
                continue;
            }
            let outer = derivative(g);
            let outer_first = self.first(g, outer);
            let term = sum_of_products(g, [(outer_first, inner.first), (outer, inner.second)]);
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
        let (first, second) = (jets.iter().map(|jet| jet.first).collect(), jets.iter().map(|jet| jet.second).collect());
        let direction = g.direction(Direction { leaf: of.leaf, first, second });
        g.leaf_output(of.leaf, of.output, number(direction))
    }
}

/// The arguments of a function node, each with the function's derivative by it; none for conditions.
fn with_arguments(g: &mut Graph, node: Node, chain: impl FnOnce(&mut Graph, &[Argument]) -> Node) -> Node {
    match g.op(node) {
        Op::Call(f, a) => chain(g, &[(a, &|g| rules::derivative(g, f, a, node))]),
        Op::Powi(a, n) => chain(g, &[(a, &|g| rules::power_derivative(g, a, n))]),
        Op::Law(law, a, order) => chain(g, &[(a, &|g| g.law(law, a, order + 1))]),
        Op::Call2(f, a, b) => {
            let by = rules::derivatives2(g, f, a, b, node);
            chain(g, &[(a, &|_| by.0), (b, &|_| by.1)])
        }
        _ => g.zero(),
    }
}

fn constant(g: &mut Graph) -> Jet {
    let zero = g.zero();
    Jet { first: zero, second: zero }
}

fn both(g: &mut Graph, combine: fn(&mut Graph, Node, Node) -> Node, a: Second, b: Second) -> Second {
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

fn input_jet(g: &mut Graph, input: Input) -> Jet {
    let zero = g.zero();
    match input {
        Input::Time => Jet { first: g.input(Input::TimeRate), second: zero },
        Input::State(argument, Part::Sin) => angle_jet(g, argument, Part::Sin, Part::Cos, false),
        Input::State(argument, Part::Cos) => angle_jet(g, argument, Part::Cos, Part::Sin, true),
        Input::State(argument, part) => Jet { first: g.input(Input::Rate(argument, part)), second: zero },
        _ => constant(g),
    }
}

/// (sin θ)′ = θ̇ cos θ, (sin θ)″ = −θ̇² sin θ;  (cos θ)′ = −θ̇ sin θ, (cos θ)″ = −θ̇² cos θ
fn angle_jet(g: &mut Graph, argument: usize, part: Part, other: Part, minus: bool) -> Jet {
    let (this, other) = (g.input(Input::State(argument, part)), g.input(Input::State(argument, other)));
    let rate = g.input(Input::Rate(argument, Part::Theta));
    let (first, rate_squared) = (g.mul(rate, other), g.mul(rate, rate));
    let second = g.mul(rate_squared, this);
    Jet { first: if minus { g.neg(first) } else { first }, second: g.neg(second) }
}
