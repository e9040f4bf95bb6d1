//! Converts values of time that only the user's program can compute to laws of time.
//!
//! A compiled program evaluates these laws lane by lane, with derivatives by dual numbers.

use kin_graph::Node;

use crate::law::{Law, LawFunction};
use crate::model::constraint::Constraint;
use crate::model::formula::jerk::Along;

/// A node of a constraint's formula that depends on time alone.
struct Timed {
    constraint: Box<dyn Constraint>,
    node: Node,
}

impl LawFunction for Timed {
    fn jet(&self, t: f64) -> [f64; 4] {
        let jet = self.constraint.formula(|table, parameters, outside| {
            Along::of_time(t, parameters, outside).of(table.formula(), self.node)
        });
        jet.unwrap_or([f64::NAN; 4])
    }

    fn kind(&self) -> &str {
        "value of time"
    }
}

/// Returns these nodes of a constraint's formula as laws, with the present parameters.
pub(super) fn timed(constraint: &dyn Constraint, nodes: &[Node]) -> Vec<(Node, Law)> {
    let law = |node: &Node| {
        (*node, Law::new(Timed { constraint: constraint.clone_boxed(), node: *node }))
    };
    nodes.iter().map(law).collect()
}
