//! Tapes along a motion whose q, q̇ and q̈ are known: nothing is iterated, C_q is eliminated in an order that
//! is chosen at the first time, and what is asked for are outputs.
//!
//! Their graphs read time, coordinates as [`Input::State`], rates as [`Input::Rate`], and second rates as
//! [`Input::Parameter`], for nothing is differentiated by those. A time at which a pivot is small beside what
//! it was at the first one is left to other ways.

use kin_graph::{Graph, Input, Node};

use super::eliminate::Elimination;
use super::stages::{At, Pose, numbers};
use super::substitute::{Explicit, constants, ordered};
use super::tape::{OverTimes, Rows, Sink, Straight, straight};
use crate::model::law::Law;
use crate::model::motion::Motion;
use crate::system::{System, scale};

/// A tape whose first outputs are guards, with their values where its elimination was chosen.
pub(crate) struct Guarded {
    pub tape: Straight,
    marks: Vec<f64>,
}

impl Guarded {
    /// The tape of outputs that an elimination leads to, chosen at the position of a time; `cells` are those
    /// of C_q by rows. `None` where C_q is singular there.
    pub(crate) fn new(
        system: &System,
        (t, q): (f64, &[f64]),
        (mut graph, laws): (Graph, Vec<Law>),
        cells: &[Vec<(usize, Node)>],
        outputs: impl FnOnce(&mut Graph, &Elimination<'_>) -> Vec<Node>,
    ) -> Option<Guarded> {
        let sizes = sizes(system, t, q)?;
        let pose = Pose { t, q, sizes: &sizes };
        let at = |graph: &Graph, nodes: &[Node]| numbers(graph, nodes, &At { pose, laws: &laws });
        let eligible = |(row, cells): (usize, &Vec<(usize, Node)>)| {
            let nodes: Vec<Node> = cells.iter().map(|(_, cell)| *cell).collect();
            let values = at(&graph, &nodes);
            let given = |(column, factor)| Explicit { row, column, factor, rest: Node::default() };
            constants(&graph, cells, &values, &sizes).into_iter().map(given).collect()
        };
        let eligible: Vec<Vec<Explicit>> = cells.iter().enumerate().map(eligible).collect();
        let rows: Vec<&[(usize, Node)]> = cells.iter().map(Vec::as_slice).collect();
        let order = ordered(&rows, q.len(), eligible);
        let elimination = Elimination::new(&mut graph, &order, cells, &sizes, at).ok()?;
        let guards = elimination.guards().concat();
        let outputs = outputs(&mut graph, &elimination);
        let marks = at(&graph, &guards);
        let tape = straight(graph, laws, &[guards, outputs].concat());
        Some(Guarded { tape, marks })
    }

    /// Hands over all times of a motion; gives those that are left to other ways. `beside` tells the list and
    /// the column of inputs that are not the motion's. `None` where the machine has no lanes.
    pub(crate) fn run<'a>(
        &'a self,
        motion: &'a Motion,
        beside: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
        sink: impl Sink,
    ) -> Option<Vec<usize>> {
        let port = |input| port(motion, input).or_else(|| beside(input));
        OverTimes { tape: &self.tape, times: motion.times.len(), port: &port, marks: &self.marks, sink }.run()
    }
}

/// The list and the column of an input, along a motion.
fn port(motion: &Motion, input: Input) -> Option<(Rows<'_>, usize)> {
    let n = motion.layout.len();
    match input {
        Input::Time => Some(((&motion.times, 1), 0)),
        Input::State(j, _) => Some(((&motion.q, n), j)),
        Input::Rate(j, _) => Some(((&motion.qd, n), j)),
        Input::Parameter(j) if j < n => Some(((&motion.qdd, n), j)),
        _ => None,
    }
}

/// The sizes of coordinates at a position.
fn sizes(system: &System, t: f64, q: &[f64]) -> Option<Vec<f64>> {
    let point = system.model().linearize(q, t).ok()?;
    Some(scale::sizes(system.layout(), system.equations(), &point.values, q, system.links()))
}
