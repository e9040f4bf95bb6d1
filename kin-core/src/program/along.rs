//! Builds tapes along a motion whose q, q̇ and q̈ are known, so that the tape needs no iteration.
//!
//! Kin eliminates C_q in an order that it chooses at the first time. The requested results are
//! outputs of the tape.
//!
//! The graphs read time, coordinates as [`Input::State`], velocities as [`Input::Rate`], and
//! accelerations as [`Input::Parameter`], because Kin does not differentiate by accelerations. The
//! tape returns a time to the caller if a pivot is small relative to its value at the first time.

use kin_graph::{Graph, Input, LeafUse, Node, Source};

use super::eliminate::Elimination;
use super::stages::{At, Pose, numbers};
use super::substitute::{Explicit, constants, ordered};
use super::tape::{Masks, OverTimes, Rows, Sink, Straight, straight};
use crate::law::Law;
use crate::outcome::motion::Motion;
use crate::system::{System, scale};

/// A tape whose first outputs are guards. Pairs of a number and its limit follow, then the
/// requested outputs.
pub(crate) struct Guarded {
    /// The tape.
    pub tape: Straight,
    /// The values of the guards at the time at which the elimination was chosen, one for each
    /// guard.
    marks: Vec<f64>,
    /// The number of pairs of a number and its limit.
    limited: usize,
}

/// The results that a tape along a motion computes.
pub(crate) struct Asked {
    /// Pairs of a number and its limit. A time at which a number exceeds its limit is returned to
    /// the caller.
    pub limited: Vec<(Node, Node)>,
    /// The requested nodes.
    pub outputs: Vec<Node>,
}

impl Guarded {
    /// Makes the tape of outputs that need an elimination, chosen at the position of a time.
    /// `cells` are the entries of C_q by rows. They are masked during the elimination, like other
    /// long expressions. Returns `None` if C_q is singular there.
    pub(crate) fn new(
        system: &System,
        (t, q): (f64, &[f64]),
        made: (Graph, Vec<Law>),
        cells: &[Vec<(usize, Node)>],
        outputs: impl FnOnce(&mut Graph, &Elimination<'_>, &mut Masks) -> Vec<Node>,
    ) -> Option<Guarded> {
        let asked = |graph: &mut Graph, elimination: &Elimination<'_>, masks: &mut Masks| Asked {
            limited: Vec::new(),
            outputs: outputs(graph, elimination, masks),
        };
        Guarded::limited(system, (t, q), made, cells, asked)
    }

    /// Makes such a tape with limited numbers. For a redundant mechanism `cells` contains as many
    /// independent rows as there are coordinates.
    pub(crate) fn limited(
        system: &System,
        (t, q): (f64, &[f64]),
        (mut graph, laws): (Graph, Vec<Law>),
        cells: &[Vec<(usize, Node)>],
        asked: impl FnOnce(&mut Graph, &Elimination<'_>, &mut Masks) -> Asked,
    ) -> Option<Guarded> {
        let sizes = sizes(system, t, q)?;
        let pose = Pose { t, q, sizes: &sizes };
        let at = |graph: &Graph, nodes: &[Node]| {
            numbers(graph, nodes, &At { pose, laws: &laws, free: &[] })
        };
        let eligible = |(row, cells): (usize, &Vec<(usize, Node)>)| {
            let nodes: Vec<Node> = cells.iter().map(|(_, cell)| *cell).collect();
            let values = at(&graph, &nodes);
            let given = |(column, factor)| Explicit { row, column, factor, rest: Node::default() };
            constants(&graph, cells, &values, &sizes).into_iter().map(given).collect()
        };
        let eligible: Vec<Vec<Explicit>> = cells.iter().enumerate().map(eligible).collect();
        let rows: Vec<&[(usize, Node)]> = cells.iter().map(Vec::as_slice).collect();
        let order = ordered(&rows, q.len(), eligible);
        let mut masks = Masks::default();
        let masked = |row: &Vec<(usize, Node)>| -> Vec<(usize, Node)> {
            row.iter().map(|(column, cell)| (*column, masks.of(&mut graph, *cell))).collect()
        };
        let cells: Vec<Vec<(usize, Node)>> = cells.iter().map(masked).collect();
        let values = at(&graph, masks.behind());
        let by_cells = |graph: &Graph, nodes: &[Node]| {
            numbers(
                graph,
                nodes,
                &Masked { at: At { pose, laws: &laws, free: &[] }, values: &values },
            )
        };
        let elimination = Elimination::new(&mut graph, &order, &cells, &sizes, by_cells).ok()?;
        let guards = elimination.guards().concat();
        let asked = asked(&mut graph, &elimination, &mut masks);
        let count = guards.len();
        let pairs: Vec<Node> =
            asked.limited.iter().flat_map(|(number, limit)| [*number, *limit]).collect();
        let outputs = masks.removed(&mut graph, &[guards, pairs, asked.outputs].concat());
        let marks = at(&graph, &outputs[..count]);
        let tape = straight(graph, laws, &outputs);
        Some(Guarded { tape, marks, limited: asked.limited.len() })
    }

    /// Makes the tape of outputs that need no elimination.
    pub(crate) fn of(graph: Graph, laws: Vec<Law>, outputs: &[Node]) -> Guarded {
        Guarded { tape: straight(graph, laws, outputs), marks: Vec::new(), limited: 0 }
    }

    /// Computes all times of a motion and returns those that remain for the caller. `beside`
    /// returns the list and the column of inputs that do not belong to the motion. Returns `None`
    /// if the machine has no SIMD.
    pub(crate) fn run<'a>(
        &'a self,
        motion: &'a Motion,
        beside: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
        sink: impl Sink,
    ) -> Option<Vec<usize>> {
        let port = |input| port(motion, input).or_else(|| beside(input));
        let tape = &self.tape;
        let times = motion.times.len();
        let port = &port as &_;
        OverTimes { tape, times, port, marks: &self.marks, limited: self.limited, sink }.run()
    }
}

/// A pose, and the numbers behind masks there.
struct Masked<'a> {
    at: At<'a>,
    values: &'a [f64],
}

impl Source<f64> for Masked<'_> {
    fn input(&self, input: Input) -> f64 {
        match input {
            Input::Timed(number) => self.values.get(number).copied().unwrap_or(f64::NAN),
            input => self.at.input(input),
        }
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        self.at.law(law, x, order)
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<f64>) -> f64 {
        self.at.opaque(number, component, operands)
    }

    fn leaf(&self, used: LeafUse, operands: Vec<f64>) -> f64 {
        self.at.leaf(used, operands)
    }
}

/// Returns the list and the column of an input along a motion.
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

/// Returns the sizes of coordinates at a position.
fn sizes(system: &System, t: f64, q: &[f64]) -> Option<Vec<f64>> {
    let point = system.model().linearize(q, t).ok()?;
    Some(scale::sizes(system.layout(), system.equations(), &point.values, (q, t), system.links()))
}
