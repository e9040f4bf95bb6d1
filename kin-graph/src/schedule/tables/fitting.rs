//! Finds the numbers with which a form equals a given piece.
//!
//! Numbers that are 0 or 1 have simplified the expressions around them, and signs have moved
//! outwards. So a sum can match one of its terms, and a product one of its factors.

use super::form::{Core, Form, Kind, Place, Term, peeled};
use crate::{Graph, Node, Op, is_power_of_two};

/// Steps after which a piece does not fit.
const LONGEST: usize = 4000;

/// The number for a place.
#[derive(Clone, Copy, PartialEq)]
pub enum Value {
    Number(f64),
    /// A parameter.
    Given(Node),
}

/// A part of the form as it is in the piece.
#[derive(Clone, Copy, PartialEq)]
enum Bound {
    /// A number times a node.
    Node(f64, Node),
    Number(f64),
}

enum Change {
    Place(Place),
    Core(Core),
}

pub struct Fitting<'a> {
    g: &'a Graph,
    form: &'a Form,
    values: Vec<Option<Value>>,
    bound: Vec<Option<Bound>>,
    trail: Vec<Change>,
    left: usize,
}

/// Returns the number of each place with which the form equals `piece`.
///
/// A place without a number may have any number.
pub fn fitted(g: &Graph, form: &Form, piece: Node) -> Option<Vec<Option<Value>>> {
    let values = vec![None; form.own.len()];
    let bound = vec![None; form.parts.len()];
    let mut fitting = Fitting { g, form, values, bound, trail: vec![], left: LONGEST };
    fitting.term(form.root, 1.0, piece).then_some(fitting.values)
}

impl Fitting<'_> {
    /// True if an attempt succeeds; what a failed one has noted is forgotten.
    fn attempt(&mut self, attempt: impl FnOnce(&mut Self) -> bool) -> bool {
        let before = self.trail.len();
        if self.left > 0 && attempt(self) {
            return true;
        }
        for change in self.trail.drain(before..).rev() {
            match change {
                Change::Place(place) => self.values[place] = None,
                Change::Core(core) => self.bound[core] = None,
            }
        }
        false
    }

    fn put(&mut self, place: Place, value: Value) -> bool {
        if self.values[place].is_none() {
            self.values[place] = Some(value);
            self.trail.push(Change::Place(place));
        }
        self.values[place] == Some(value)
    }

    /// Notes what a part is; true if that is new, `None` if it is something else already.
    fn bind(&mut self, core: Core, bound: Bound) -> Option<bool> {
        match self.bound[core] {
            Some(known) => (known == bound).then_some(false),
            None => {
                self.bound[core] = Some(bound);
                self.trail.push(Change::Core(core));
                Some(true)
            }
        }
    }

    fn own(&self, term: Term) -> f64 {
        self.g.constant_value(self.form.own[term.factor]).unwrap_or(1.0)
    }

    /// The term is `scale` times a node.
    fn term(&mut self, term: Term, scale: f64, node: Node) -> bool {
        self.left = self.left.saturating_sub(1);
        let (factor, rest) = peeled(self.g, node);
        let factor = scale * factor;
        match (term.core, rest) {
            (_, None) => self.number(term, factor),
            (None, Some(rest)) => {
                factor == 1.0
                    && super::chain::is_given(self.g, rest)
                    && self.put(term.factor, Value::Given(rest))
            }
            (Some(core), Some(rest)) => {
                // A factor goes inwards where numbers are met that differ anyway.
                let own = self.own(term);
                let ratio = factor / own;
                let exact = own == 1.0 || is_power_of_two(ratio.abs());
                let inwards = exact && (ratio == 1.0 || self.form.parts[core].adapts);
                inwards
                    && self.attempt(|it| {
                        it.put(term.factor, Value::Number(own)) && it.part(core, ratio, rest)
                    })
                    || self.attempt(|it| {
                        it.put(term.factor, Value::Number(factor)) && it.part(core, 1.0, rest)
                    })
            }
        }
    }

    /// A part is `scale` times a node without a factor of its own.
    fn part(&mut self, core: Core, scale: f64, node: Node) -> bool {
        match self.bind(core, Bound::Node(scale, node)) {
            None => return false,
            Some(false) => return true,
            Some(true) => {}
        }
        let g = self.g;
        let form = self.form;
        match &form.parts[core].kind {
            Kind::Given(place) => {
                scale == 1.0
                    && super::chain::is_given(g, node)
                    && self.put(*place, Value::Given(node))
            }
            Kind::Same => scale == 1.0 && node == form.parts[core].node,
            Kind::Sum(a, b) => self.sum([*a, *b], scale, node),
            Kind::Product(a, b) => self.product([*a, *b], scale, node),
            Kind::Quotient(a, b) => self.quotient([*a, *b], scale, node),
            Kind::Operation(operands) => {
                let kind = |node: Node| g.op(node).with_operands(|_| Node::default());
                let found = g.operands(node);
                // A slope may be infinite where nothing moves: so each of them moves or none.
                let moves = |a: &Node, b: &Node| g.depends(*a).varies() == g.depends(*b).varies();
                scale == 1.0
                    && kind(node) == kind(form.parts[core].node)
                    && operands.iter().zip(&found).all(|((own, _), operand)| moves(own, operand))
                    && operands
                        .iter()
                        .zip(found)
                        .all(|((_, term), operand)| self.term(*term, 1.0, operand))
            }
        }
    }

    fn sum(&mut self, [a, b]: [Term; 2], scale: f64, node: Node) -> bool {
        let terms = match self.g.op(node) {
            Op::Add(p, q) => Some((p, 1.0, q)),
            Op::Sub(p, q) => Some((p, -1.0, q)),
            _ => None,
        };
        if let Some((p, sign, q)) = terms.filter(|_| is_power_of_two(scale.abs()))
            && [(a, b), (b, a)].into_iter().any(|(a, b)| {
                self.attempt(|it| it.term(a, scale, p) && it.term(b, scale * sign, q))
            })
        {
            return true;
        }
        [(a, b), (b, a)]
            .into_iter()
            .any(|(a, b)| self.attempt(|it| it.zero(b) && it.term(a, scale, node)))
    }

    fn product(&mut self, [a, b]: [Term; 2], scale: f64, node: Node) -> bool {
        let orders = [(a, 1.0, b, scale), (b, 1.0, a, scale)];
        if let Op::Mul(p, q) = self.g.op(node)
            && orders.into_iter().any(|(a, one, b, scale)| {
                self.attempt(|it| it.term(a, one, p) && it.term(b, scale, q))
                    || self.attempt(|it| it.term(a, one, q) && it.term(b, scale, p))
            })
        {
            return true;
        }
        orders.into_iter().any(|(a, one, b, scale)| {
            self.attempt(|it| it.number(b, scale) && it.term(a, one, node))
        })
    }

    fn quotient(&mut self, [a, b]: [Term; 2], scale: f64, node: Node) -> bool {
        match self.g.op(node) {
            Op::Div(p, q) => self.attempt(|it| it.term(b, 1.0, q) && it.term(a, scale, p)),
            // A quotient by a power of two is a product now.
            _ => self.attempt(|it| it.number(b, 1.0) && it.term(a, scale, node)),
        }
    }

    /// The term is a number.
    fn number(&mut self, term: Term, number: f64) -> bool {
        let Some(core) = term.core else { return self.put(term.factor, Value::Number(number)) };
        if number == 0.0 {
            return self.zero(term);
        }
        let own = self.own(term);
        match self.form.parts[core].kind {
            Kind::Given(place) => {
                self.bind(core, Bound::Number(number)).is_some()
                    && self.put(term.factor, Value::Number(1.0))
                    && self.put(place, Value::Number(number))
            }
            Kind::Sum(a, b) if is_power_of_two(own.abs()) => {
                let inner = number / own;
                match self.bind(core, Bound::Number(inner)) {
                    None => false,
                    Some(false) => self.put(term.factor, Value::Number(own)),
                    Some(true) => {
                        self.put(term.factor, Value::Number(own))
                            && [(a, b), (b, a)]
                                .into_iter()
                                .any(|(a, b)| self.attempt(|it| it.number(a, inner) && it.zero(b)))
                    }
                }
            }
            _ => false,
        }
    }

    /// The term is nothing.
    fn zero(&mut self, term: Term) -> bool {
        let none = Value::Number(0.0);
        let Some(core) = term.core else { return self.put(term.factor, none) };
        let own = self.own(term);
        let part = &self.form.parts[core];
        // A factor that stands there is the user's number.
        if own != 1.0 && part.tame && self.attempt(|it| it.put(term.factor, none)) {
            return true;
        }
        let inside = match part.kind {
            Kind::Given(place) => self
                .attempt(|it| it.bind(core, Bound::Number(0.0)).is_some() && it.put(place, none)),
            Kind::Sum(a, b) => self.attempt(|it| match it.bind(core, Bound::Number(0.0)) {
                None => false,
                Some(false) => true,
                Some(true) => it.zero(a) && it.zero(b),
            }),
            // A factor of its own would be one more number to look up.
            Kind::Product(a, b) if part.tame && own == 1.0 => self.one_vanishes(a, b),
            Kind::Quotient(a, _) if part.tame && own == 1.0 => self.attempt(|it| it.vanishes(a)),
            _ => false,
        };
        inside || part.tame && self.put(term.factor, none)
    }

    fn part_is_tame(&self, core: Core) -> bool {
        self.form.parts[core].tame
    }

    fn one_vanishes(&mut self, a: Term, b: Term) -> bool {
        [b, a].into_iter().any(|factor| self.attempt(|it| it.vanishes(factor)))
    }

    /// A factor is nothing by numbers that stand in it.
    fn vanishes(&mut self, factor: Term) -> bool {
        let Some(core) = factor.core else { return self.put(factor.factor, Value::Number(0.0)) };
        match self.form.parts[core].kind {
            _ if self.own(factor) != 1.0 => self.zero(factor),
            Kind::Given(_) => self.zero(factor),
            Kind::Sum(a, b) => {
                self.bind(core, Bound::Number(0.0)) == Some(true)
                    && self.vanishes(a)
                    && self.vanishes(b)
            }
            Kind::Product(a, b) => self.one_vanishes(a, b),
            Kind::Quotient(a, _) => self.part_is_tame(core) && self.vanishes(a),
            Kind::Same | Kind::Operation(_) => false,
        }
    }
}
