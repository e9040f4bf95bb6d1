//! Describes the form of a piece: its expression with places at which other pieces may have other
//! numbers.

use std::collections::HashMap;

use crate::{Function, Function2, Graph, Input, Node, Op};

/// A place for a number, by its number.
pub type Place = usize;

/// A part of a form, by its number.
pub type Core = usize;

/// A number times a part, or the number alone.
#[derive(Clone, Copy)]
pub struct Term {
    pub factor: Place,
    pub core: Option<Core>,
}

pub enum Kind {
    /// A parameter.
    Given(Place),
    /// A node that all pieces have in common.
    Same,
    Sum(Term, Term),
    Product(Term, Term),
    Quotient(Term, Term),
    /// Any other operation, with its operands.
    Operation(Vec<(Node, Term)>),
}

pub struct Part {
    /// The node of the template.
    pub node: Node,
    pub kind: Kind,
    /// True if it is finite wherever its inputs are: nothing times it is nothing.
    pub tame: bool,
    /// True if numbers stand in it that can take a factor of all of it.
    pub adapts: bool,
}

/// A piece taken apart.
pub struct Form {
    pub root: Term,
    /// Operands come before their users.
    pub parts: Vec<Part>,
    /// The numbers of the template, by place.
    pub own: Vec<Node>,
}

impl Form {
    /// Creates the form of a node.
    ///
    /// The form does not contain the operands of nodes for which `is_same` is true.
    pub fn new(g: &mut Graph, node: Node, is_same: impl Fn(Node) -> bool) -> Form {
        let mut reading = Reading {
            is_same,
            known: HashMap::new(),
            form: Form { root: Term { factor: 0, core: None }, parts: vec![], own: vec![] },
        };
        // Operands first, without recursion: a piece may be long.
        let inside = inside(g, &[node], &reading.is_same);
        inside.into_iter().for_each(|node| reading.part(g, node));
        reading.form.root = reading.term(g, node);
        reading.form
    }
}

/// Returns the nodes between `nodes` and the common nodes of all pieces, operands first.
pub fn inside(g: &Graph, nodes: &[Node], is_same: &impl Fn(Node) -> bool) -> Vec<Node> {
    g.unknown(nodes, is_same)
}

struct Reading<F> {
    is_same: F,
    known: HashMap<Node, Core>,
    form: Form,
}

impl<F: Fn(Node) -> bool> Reading<F> {
    fn place(&mut self, own: Node) -> Place {
        self.form.own.push(own);
        self.form.own.len() - 1
    }

    fn term(&mut self, g: &mut Graph, node: Node) -> Term {
        let (factor, rest) = peeled(g, node);
        let factor = g.constant(factor);
        let factor = self.place(factor);
        if let Some(rest) = rest
            && !self.known.contains_key(&rest)
        {
            self.part(g, rest);
        }
        Term { factor, core: rest.map(|rest| self.known[&rest]) }
    }

    fn part(&mut self, g: &mut Graph, node: Node) {
        if self.known.contains_key(&node) || !matches!(peeled(g, node), (1.0, Some(_))) {
            return;
        }
        let kind = match g.op(node) {
            Op::Input(Input::Parameter(_) | Input::Timed(_)) => Kind::Given(self.place(node)),
            _ if (self.is_same)(node) => Kind::Same,
            Op::Input(_) | Op::Truth(_) | Op::Decimal(_) | Op::Opaque(..) | Op::Leaf(_) => {
                Kind::Same
            }
            Op::Add(a, b) => Kind::Sum(self.term(g, a), self.term(g, b)),
            Op::Sub(a, b) => Kind::Sum(self.term(g, a), self.negated(g, b)),
            Op::Mul(a, b) => Kind::Product(self.term(g, a), self.term(g, b)),
            Op::Div(a, b) => Kind::Quotient(self.term(g, a), self.term(g, b)),
            _ => Kind::Operation(
                g.operands(node).into_iter().map(|a| (a, self.term(g, a))).collect(),
            ),
        };
        let tame = self.is_tame(g.op(node), &kind);
        self.known.insert(node, self.form.parts.len());
        let adapts = self.adapts(g, &kind);
        self.form.parts.push(Part { node, kind, tame, adapts });
    }

    fn negated(&mut self, g: &mut Graph, node: Node) -> Term {
        let term = self.term(g, node);
        let factor = g.neg(self.form.own[term.factor]);
        self.form.own[term.factor] = factor;
        term
    }

    fn adapts(&self, g: &Graph, kind: &Kind) -> bool {
        let adapts = |term: &Term| {
            let own = g.constant_value(self.form.own[term.factor]);
            own != Some(1.0) || term.core.is_none_or(|core| self.form.parts[core].adapts)
        };
        match kind {
            Kind::Sum(a, b) => adapts(a) && adapts(b),
            Kind::Product(a, b) => adapts(a) || adapts(b),
            Kind::Quotient(a, _) => adapts(a),
            Kind::Given(_) | Kind::Same | Kind::Operation(_) => false,
        }
    }

    fn is_tame(&self, op: Op, kind: &Kind) -> bool {
        let tame = |term: &Term| term.core.is_none_or(|core| self.form.parts[core].tame);
        match kind {
            Kind::Given(_) => true,
            Kind::Same => matches!(op, Op::Input(_)),
            Kind::Sum(a, b) | Kind::Product(a, b) => tame(a) && tame(b),
            Kind::Quotient(a, b) => tame(a) && b.core.is_none(),
            Kind::Operation(operands) => {
                matches!(
                    op,
                    Op::Call(Function::Sin | Function::Cos | Function::Abs, _)
                        | Op::Call2(Function2::Min | Function2::Max, ..)
                ) && operands.iter().all(|(_, term)| tame(term))
            }
        }
    }
}

/// Splits a node into a number and a factor, or returns a number alone.
pub fn peeled(g: &Graph, mut node: Node) -> (f64, Option<Node>) {
    let mut factor = 1.0;
    loop {
        match g.op(node) {
            Op::Constant(bits) => return (factor * f64::from_bits(bits), None),
            Op::Neg(a) => (factor, node) = (-factor, a),
            Op::Mul(a, b) if g.constant_value(a).is_some() => {
                (factor, node) = (factor * g.constant_value(a).unwrap_or(1.0), b);
            }
            _ => return (factor, Some(node)),
        }
    }
}
