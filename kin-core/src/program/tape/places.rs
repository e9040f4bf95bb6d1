//! Assigns places in memory to the numbers of a tape.
//!
//! Kin reuses a place after a step has read its number for the last time.

use kin_graph::{Graph, Input, Node, Op};

use super::schedule::{Planner, Task};
use super::{Kind, Stage, Step};

/// A number for some nodes; `NONE` for the others.
pub(super) struct ByNode(Vec<u32>);

impl ByNode {
    const NONE: u32 = u32::MAX;

    pub(super) fn new(graph: &Graph) -> Self {
        ByNode(vec![Self::NONE; graph.len()])
    }

    pub(super) fn get(&self, node: Node) -> Option<u32> {
        Some(self.0[node.index()]).filter(|number| *number != Self::NONE)
    }

    pub(super) fn insert(&mut self, node: Node, number: u32) {
        self.0[node.index()] = number;
    }
}

/// Returns true if a node is in the memory from the beginning.
pub(super) fn is_given(graph: &Graph, node: Node) -> bool {
    matches!(
        graph.op(node),
        Op::Input(_)
            | Op::Constant(_)
            | Op::Truth(_)
            | Op::Decimal(_)
            | Op::Opaque(..)
            | Op::Leaf(_)
    )
}

/// The assignment of places.
pub(super) struct Places<'a> {
    planner: &'a Planner<'a>,
    place: ByNode,
    free: Vec<u32>,
    next: u32,
    /// The place of a node that has none.
    nothing: u32,
    /// For each number how often it will still be read before its place is free.
    readers: ByNode,
    /// The steps of each stage, and the constants as (place, value).
    pub stages: [Stage; 4],
    pub constants: Vec<(u32, f64)>,
}

impl<'a> Places<'a> {
    /// Creates the assignment of a plan; `readers` says how often each number is read.
    pub(super) fn new(planner: &'a Planner<'a>, readers: ByNode) -> Self {
        Places {
            planner,
            place: ByNode::new(planner.graph),
            free: Vec::new(),
            next: 0,
            nothing: 0,
            readers,
            stages: Default::default(),
            constants: Vec::new(),
        }
    }

    fn take(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.next += 1;
            self.next - 1
        })
    }

    /// Returns the number of places.
    pub(super) fn count(&self) -> usize {
        self.next as usize
    }

    /// Returns the places of nodes.
    pub(super) fn of(&self, nodes: &[Node]) -> Vec<u32> {
        let of = |node: &Node| self.place.get(self.planner.behind(*node)).unwrap_or(self.nothing);
        nodes.iter().map(of).collect()
    }

    /// Assigns the first places to inputs and constants, and returns the places of the inputs.
    pub(super) fn begin(&mut self, inputs: &[Input], outputs: &[Node]) -> Vec<u32> {
        let graph = self.planner.graph;
        let mut own = Vec::with_capacity(inputs.len());
        for input in inputs {
            let place = self.take();
            own.push(place);
            if let Some(node) = graph.existing(Op::Input(*input)) {
                self.place.insert(node, place);
            }
        }
        let read = self.planner.tasks.iter().flat_map(|task| task.reads).flatten();
        for node in read.chain(outputs.iter().map(|node| self.planner.behind(*node))) {
            let value = graph
                .constant_value(node)
                .or(graph.truth(node).map(|holds| f64::from(u8::from(holds))));
            if let (Some(value), None) = (value, self.place.get(node)) {
                let place = self.take();
                self.place.insert(node, place);
                self.constants.push((place, value));
            }
        }
        own
    }

    /// Writes the steps with the places of their numbers.
    pub(super) fn write(&mut self, order: &[usize]) {
        // A place that no step writes contains no number, so that a fault of this pass is detected.
        let idle = self.take();
        let nothing = self.take();
        self.constants.push((nothing, f64::NAN));
        self.nothing = nothing;
        for &k in order {
            let Task { kind, reads, makes, stage } = &self.planner.tasks[k];
            let [a, b, c] = reads
                .map(|node| node.map_or(nothing, |node| self.place.get(node).unwrap_or(nothing)));
            for node in reads.iter().flatten() {
                let Some(left) = self.readers.get(*node).filter(|left| *left > 0) else { continue };
                self.readers.insert(*node, left - 1);
                if left == 1 {
                    self.free.extend(self.place.get(*node));
                }
            }
            let mut made = [idle; 3];
            for (made, node) in made.iter_mut().zip(makes) {
                let Some(node) = *node else { continue };
                *made = self.take();
                self.place.insert(node, *made);
            }
            let step = match kind {
                Kind::SinCos => Step { out: made[0], a, b: idle, c: made[1] },
                Kind::Law(..) => Step { out: made[0], a, b: made[1], c: made[2] },
                _ => Step { out: made[0], a, b, c },
            };
            self.stages[*stage].push(*kind, step);
        }
    }
}
