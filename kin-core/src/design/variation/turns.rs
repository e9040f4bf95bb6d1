//! Lets the points of a rotating body share their operands.
//!
//! For one point the cheapest form of A u is e0 (e0 u + e × u) + e (e · u). If a body has several
//! points and Kin differentiates each point, computing A once is cheaper. Kin writes a quadratic
//! form in the four Euler parameters of a body as Σ c (±e_a e_b ±e_c e_d …), with terms of equal
//! coefficients together. The sums in parentheses are the same nodes for all points. Kin changes
//! only homogeneous forms. Since |p| = 1, the terms of a homogeneous form are of the size of the
//! coefficients, so rounding errors remain small.

use kin_graph::{Graph, Input, Node, Op};

use super::nodes::Gathered;
use crate::coordinates::layout::Kind;
use crate::program::SELF;
use crate::system::System;

/// A constant, or a homogeneous form in the Euler parameters of the body whose coordinates begin at
/// this index.
#[derive(Clone, Copy)]
enum Form {
    Constant(f64),
    Linear(usize, [f64; 4]),
    /// The coefficients of the products of [`PAIRS`].
    Quadratic(usize, [f64; 10]),
}

/// Pairs of Euler parameters.
const PAIRS: [(usize, usize); 10] =
    [(0, 0), (0, 1), (0, 2), (0, 3), (1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)];

/// Returns the index of the pair of two Euler parameters.
fn pair(a: usize, b: usize) -> usize {
    PAIRS.iter().position(|known| *known == (a.min(b), a.max(b))).unwrap_or_default()
}

impl Gathered {
    /// Rewrites quadratic forms in Euler parameters with shared sums.
    pub(super) fn by_turns(mut self, system: &System) -> Gathered {
        let items = system.layout().items.iter().filter(|item| item.kind == Kind::Spatial);
        let bodies: Vec<usize> = items.map(|item| item.first).collect();
        if bodies.is_empty() {
            return self;
        }
        let slopes = self.by_q.iter().chain(&self.by_p).flatten().map(|(_, node)| *node);
        let outputs: Vec<Node> = slopes.chain(self.residuals.iter().copied()).collect();
        let places = self.rewritten(&bodies, &outputs);
        let moved = |node: &mut Node| *node = places[node.index()];
        self.residuals.iter_mut().for_each(moved);
        self.by_q.iter_mut().chain(&mut self.by_p).flatten().for_each(|(_, node)| moved(node));
        self
    }

    /// Rewrites the operands of the outputs with shared sums in a separate graph. The result is
    /// indexed by the old nodes.
    fn rewritten(&mut self, bodies: &[usize], outputs: &[Node]) -> Vec<Node> {
        let from = std::mem::take(&mut self.whole.graph);
        let to = &mut self.whole.graph;
        let mut places = vec![Node::default(); from.len()];
        let mut forms: Vec<Option<Form>> = vec![None; from.len()];
        for node in from.reachable(outputs) {
            let form = form(&from, node, bodies, |operand| forms[operand.index()]);
            let of = |operand: Node| places[operand.index()];
            let place = match (form, from.op(node)) {
                (Some(Form::Quadratic(first, c)), _) => quadratic(to, first, &c),
                (_, Op::Input(input)) => to.input(input),
                (_, Op::Law(law, x, order)) => to.law(law, of(x), order),
                (_, op) => to.rebuilt(op, of).unwrap_or_else(|| to.constant(f64::NAN)),
            };
            (places[node.index()], forms[node.index()]) = (place, form);
        }
        places
    }
}

/// Returns the form of a node, if its operands are forms.
fn form(
    graph: &Graph,
    node: Node,
    bodies: &[usize],
    of: impl Fn(Node) -> Option<Form>,
) -> Option<Form> {
    Some(match graph.op(node) {
        Op::Constant(bits) => Form::Constant(f64::from_bits(bits)),
        Op::Input(Input::State(j, SELF)) => {
            let first = bodies.iter().find(|first| (**first + 3..**first + 7).contains(&j))?;
            let mut c = [0.0; 4];
            c[j - first - 3] = 1.0;
            Form::Linear(*first, c)
        }
        Op::Neg(a) => times(of(a)?, -1.0),
        Op::Add(a, b) => plus(of(a)?, of(b)?, 1.0)?,
        Op::Sub(a, b) => plus(of(a)?, of(b)?, -1.0)?,
        Op::Mul(a, b) => match (of(a)?, of(b)?) {
            (Form::Constant(x), form) | (form, Form::Constant(x)) => times(form, x),
            (Form::Linear(body, a), Form::Linear(other, b)) if body == other => {
                product(body, &a, &b)
            }
            _ => return None,
        },
        _ => return None,
    })
}

fn times(form: Form, x: f64) -> Form {
    match form {
        Form::Constant(c) => Form::Constant(x * c),
        Form::Linear(body, c) => Form::Linear(body, c.map(|c| x * c)),
        Form::Quadratic(body, c) => Form::Quadratic(body, c.map(|c| x * c)),
    }
}

/// Returns a + s b, if both are forms of one degree in one body.
fn plus(a: Form, b: Form, s: f64) -> Option<Form> {
    Some(match (a, b) {
        (Form::Constant(a), Form::Constant(b)) => Form::Constant(a + s * b),
        (Form::Linear(body, a), Form::Linear(other, b)) if body == other => {
            Form::Linear(body, std::array::from_fn(|k| a[k] + s * b[k]))
        }
        (Form::Quadratic(body, a), Form::Quadratic(other, b)) if body == other => {
            Form::Quadratic(body, std::array::from_fn(|k| a[k] + s * b[k]))
        }
        _ => return None,
    })
}

fn product(body: usize, a: &[f64; 4], b: &[f64; 4]) -> Form {
    let mut c = [0.0; 10];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            c[pair(i, j)] += a * b;
        }
    }
    Form::Quadratic(body, c)
}

/// Builds Σ c (±e_a e_b ± …), with terms of equal coefficients together.
fn quadratic(graph: &mut Graph, first: usize, c: &[f64; 10]) -> Node {
    let mut groups: Vec<(f64, Node)> = Vec::new();
    for ((a, b), c) in PAIRS.into_iter().zip(c).filter(|(_, c)| **c != 0.0) {
        let [a, b] = [a, b].map(|k| graph.input(Input::State(first + 3 + k, SELF)));
        let term = graph.mul(a, b);
        match groups.iter_mut().find(|(known, _)| known.abs() == c.abs()) {
            Some((known, sum)) if *known == *c => *sum = graph.add(*sum, term),
            Some((_, sum)) => *sum = graph.sub(*sum, term),
            None => groups.push((*c, term)),
        }
    }
    let mut sum = graph.zero();
    for (c, group) in groups {
        let c = graph.constant(c);
        let term = graph.mul(c, group);
        sum = graph.add(sum, term);
    }
    sum
}
