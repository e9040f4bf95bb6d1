//! Implements numbers by nodes of a graph, so that the formulas of the list of functions can be
//! written to the graph.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Comparison, Condition, Function, Function2, Graph, Node, Number};

type Shared<'a, 'g> = &'a RefCell<&'g mut Graph>;

/// A node, or a constant that is in no graph yet.
#[derive(Clone, Copy)]
pub(super) enum Term<'a, 'g> {
    Constant(f64),
    Node(Shared<'a, 'g>, Node),
}

/// The nodes of terms.
pub(super) fn nodes_of<const N: usize>(
    graph: Shared<'_, '_>,
    terms: [Term<'_, '_>; N],
) -> [Node; N] {
    terms.map(|term| node_of(&mut graph.borrow_mut(), term))
}

fn node_of(g: &mut Graph, term: Term<'_, '_>) -> Node {
    match term {
        Term::Constant(x) => g.constant(x),
        Term::Node(_, node) => node,
    }
}

impl<'a, 'g> Term<'a, 'g> {
    fn graph(self) -> Option<Shared<'a, 'g>> {
        match self {
            Term::Constant(_) => None,
            Term::Node(graph, _) => Some(graph),
        }
    }

    /// An operation on one term, and what it is of a constant.
    fn map(
        self,
        node: impl FnOnce(&mut Graph, Node) -> Node,
        constant: impl FnOnce(f64) -> f64,
    ) -> Self {
        match self {
            Term::Constant(x) => Term::Constant(constant(x)),
            Term::Node(graph, a) => Term::Node(graph, node(&mut graph.borrow_mut(), a)),
        }
    }

    /// An operation on two terms, and what it is of constants.
    fn with(
        self,
        other: Self,
        node: impl FnOnce(&mut Graph, Node, Node) -> Node,
        constant: impl FnOnce(f64, f64) -> f64,
    ) -> Self {
        match (self, other, self.graph().or(other.graph())) {
            (Term::Constant(x), Term::Constant(y), _) => Term::Constant(constant(x, y)),
            (_, _, None) => self,
            (a, b, Some(graph)) => {
                let g = &mut graph.borrow_mut();
                let a = node_of(g, a);
                let b = node_of(g, b);
                Term::Node(graph, node(g, a, b))
            }
        }
    }
}

impl Neg for Term<'_, '_> {
    type Output = Self;

    fn neg(self) -> Self {
        self.map(Graph::neg, Neg::neg)
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Term<'_, '_> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                self.with(other, Graph::$method, $trait::$method)
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl<'a, 'g> Number for Term<'a, 'g> {
    type Condition = Holds<'a, 'g>;

    fn constant(x: f64) -> Self {
        Term::Constant(x)
    }

    fn call(self, f: Function) -> Self {
        self.map(|g, a| g.call(f, a), f.value())
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        self.with(other, |g, a, b| g.call2(f, a, b), f.value())
    }

    fn powi(self, n: i32) -> Self {
        self.map(|g, a| g.powi(a, n), |x| x.powi(n))
    }

    fn compare(comparison: Comparison, a: &Self, b: &Self) -> Holds<'a, 'g> {
        match (*a, *b, a.graph().or(b.graph())) {
            (Term::Constant(x), Term::Constant(y), _) => Holds::Known(comparison.holds(&x, &y)),
            (_, _, None) => Holds::Known(false),
            (a, b, Some(graph)) => {
                let g = &mut graph.borrow_mut();
                let a = node_of(g, a);
                let b = node_of(g, b);
                Holds::Node(graph, g.compare(comparison, a, b))
            }
        }
    }

    fn select(condition: &Holds<'a, 'g>, a: Self, b: Self) -> Self {
        match *condition {
            Holds::Known(holds) => {
                if holds {
                    a
                } else {
                    b
                }
            }
            Holds::Node(graph, condition) => {
                let g = &mut graph.borrow_mut();
                let a = node_of(g, a);
                let b = node_of(g, b);
                Term::Node(graph, g.select(condition, a, b))
            }
        }
    }

    fn of_condition(condition: &Holds<'a, 'g>) -> Self {
        Self::select(condition, Term::Constant(1.0), Term::Constant(0.0))
    }

    fn holds(&self) -> Holds<'a, 'g> {
        Self::compare(Comparison::NotEqual, self, &Term::Constant(0.0))
    }
}

/// A condition in a graph, or one that is known.
#[derive(Clone, Copy)]
pub(super) enum Holds<'a, 'g> {
    Known(bool),
    Node(Shared<'a, 'g>, Node),
}

impl<'a, 'g> Holds<'a, 'g> {
    fn with(
        self,
        other: Self,
        node: fn(&mut Graph, Node, Node) -> Node,
        known: fn(bool, bool) -> bool,
    ) -> Self {
        let of = |g: &mut Graph, condition: Self| match condition {
            Holds::Known(holds) => g.bool(holds),
            Holds::Node(_, node) => node,
        };
        match (self, other) {
            (Holds::Known(a), Holds::Known(b)) => Holds::Known(known(a, b)),
            (Holds::Node(graph, _), _) | (_, Holds::Node(graph, _)) => {
                let g = &mut graph.borrow_mut();
                let a = of(g, self);
                let b = of(g, other);
                Holds::Node(graph, node(g, a, b))
            }
        }
    }
}

impl Condition for Holds<'_, '_> {
    fn known(holds: bool) -> Self {
        Holds::Known(holds)
    }

    fn and(self, other: Self) -> Self {
        self.with(other, Graph::and, |a, b| a && b)
    }

    fn or(self, other: Self) -> Self {
        self.with(other, Graph::or, |a, b| a || b)
    }

    fn negated(self) -> Self {
        match self {
            Holds::Known(holds) => Holds::Known(!holds),
            Holds::Node(graph, condition) => Holds::Node(graph, graph.borrow_mut().not(condition)),
        }
    }
}
