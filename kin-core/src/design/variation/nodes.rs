//! C_q and C_p with two derivatives by time, as nodes of one graph, and the elimination of C_q.

use kin_graph::differentiate::{Jet, Jets};
use kin_graph::{Graph, Input, Node};

use crate::design::along::Prepared;
use crate::design::asked::{Asked, Hangs};
use crate::design::equation::Equation;
use crate::model::law::Law;
use crate::program::{
    ABROAD, Column, Elimination, Guarded, Leaves, REDUNDANT, Reduced, SELF, UNREAD, Whole, columns,
};
use crate::solve::motion::Motion;
use crate::system::System;
use crate::system::evaluate::Block;

/// A node with its first and second derivative by time.
pub(super) type NodeJet = [Node; 3];

/// Jets by columns or by rows.
pub(super) type JetCells = Vec<(usize, NodeJet)>;

/// Both of a system, of coordinates, rates and second rates along a motion. Second rates are parameters of
/// the graph, for nothing is differentiated by them.
pub(super) struct Variation {
    pub graph: Graph,
    pub laws: Vec<Law>,
    /// By rows.
    pub by_q: Vec<JetCells>,
    /// By the names that are asked for.
    pub by_p: Vec<JetCells>,
}

/// Derivatives without those by time: in the graph of the whole, by rows and by names.
struct Slopes {
    by_q: Vec<Vec<(usize, Node)>>,
    by_p: Vec<Vec<(usize, Node)>>,
}

impl Variation {
    /// Of what is asked for; refuses what cannot be compiled.
    pub(super) fn of(prepared: &Prepared<'_>) -> Result<Self, &'static str> {
        let system = prepared.system;
        if system.is_redundant() || system.n_equations() != system.n_coordinates() {
            return Err(REDUNDANT);
        }
        let mut whole = Whole::new(system.n_coordinates());
        let mut slopes =
            Slopes { by_q: vec![Vec::new(); system.n_equations()], by_p: vec![Vec::new(); prepared.names] };
        for (number, block) in system.equations().blocks.iter().enumerate() {
            let own = prepared.asked.iter().filter(|asked| asked.block == number);
            slopes.add(&mut whole, system, block, (&prepared.blocks[number], own))?;
        }
        Ok(slopes.along_time(whole))
    }

    /// The tape of outputs that an elimination leads to, chosen at the first time of a motion. `None` where
    /// that is singular.
    pub(super) fn guarded(
        self,
        system: &System,
        motion: &Motion,
        outputs: impl FnOnce(&mut Graph, &Elimination<'_>, [&[JetCells]; 2]) -> Vec<Node>,
    ) -> Option<Guarded> {
        let Variation { graph, laws, by_q, by_p } = self;
        let cell = |(column, jet): &(usize, NodeJet)| (*column, jet[0]);
        let cells: Vec<Vec<(usize, Node)>> = by_q.iter().map(|row| row.iter().map(cell).collect()).collect();
        let begin = (*motion.times().first()?, motion.q(0));
        Guarded::new(system, begin, (graph, laws), &cells, |graph, elimination| {
            outputs(graph, elimination, [&by_q, &by_p])
        })
    }
}

impl Slopes {
    /// Appends the rows of a constraint, and what of them is asked for.
    fn add<'a>(
        &mut self,
        whole: &mut Whole,
        system: &System,
        block: &Block,
        (equation, asked): (&Equation, impl Iterator<Item = &'a Asked>),
    ) -> Result<(), &'static str> {
        let mut columns = columns(system, block.constraint.as_ref()).ok_or(ABROAD)?;
        let first = block.rows().start;
        let done = block.constraint.formula(|_, parameters, outside| {
            columns.extend(parameters.iter().map(|value| Column::Fixed(*value)));
            columns.extend(equation.calls.iter().map(|_| Column::Fixed(0.0)));
            let leaves = Leaves { columns: &columns, parameters, outside, timed: &[] };
            let nodes = equation.graph.reachable(&equation.outputs());
            let places = whole.copy(&equation.graph, &nodes, &leaves)?;
            let of = |node: Node| places[node.index()];
            for (row, slopes) in (first..).zip(&equation.rows) {
                for (column, slope) in &slopes.by_column {
                    if let Some(Column::Coordinate(j)) = columns.get(*column) {
                        sum(&mut whole.graph, &mut self.by_q[row], *j, of(*slope));
                    }
                }
            }
            for asked in asked {
                let factor = whole.graph.constant(asked.slope);
                for (row, slopes) in (first..).zip(&equation.rows) {
                    match &asked.hangs {
                        Hangs::Parameter(k) => {
                            let own = slopes.by_parameter.iter().filter(|(known, _)| known == k);
                            for (_, slope) in own {
                                let slope = whole.graph.mul(factor, of(*slope));
                                sum(&mut whole.graph, &mut self.by_p[asked.name], row, slope);
                            }
                        }
                        Hangs::Law { number, by } => {
                            for (k, slope) in &slopes.by_call {
                                let call = &equation.calls[*k];
                                if call.law != *number {
                                    continue;
                                }
                                let by = whole.law_at(by.clone(), of(call.x), call.order).ok_or(UNREAD)?;
                                let slope = whole.graph.mul(of(*slope), by);
                                let slope = whole.graph.mul(factor, slope);
                                sum(&mut whole.graph, &mut self.by_p[asked.name], row, slope);
                            }
                        }
                    }
                }
            }
            Ok(())
        });
        done.unwrap_or(Err(UNREAD))
    }

    /// The same with derivatives by time. The second one of f(q, t) is that along constant rates, and f′ once
    /// more along the second rates.
    fn along_time(self, mut whole: Whole) -> Variation {
        let mut jets = Jets::default();
        let flat = self.by_q.iter().chain(&self.by_p).flatten().map(|(_, node)| *node);
        let before: Vec<(Node, Jet)> = flat.map(|node| (node, jets.of(&mut whole.graph, node))).collect();
        let mut reduced = Reduced::of_all(&whole.graph);
        let (one, zero) = (reduced.graph.constant(1.0), reduced.graph.zero());
        reduced.put(Input::TimeRate, one);
        let mut along =
            |(node, jet): &(Node, Jet)| [*node, jet.first, jet.second].map(|node| reduced.of(node));
        let mut after: Vec<NodeJet> = before.iter().map(&mut along).collect();
        let seconds: Vec<Node> = (0..whole.n).map(|j| reduced.graph.input(Input::Parameter(j))).collect();
        let seconds = seconds.into_iter().enumerate().map(|(j, node)| (Input::Rate(j, SELF), node));
        reduced.rewrite(seconds.chain([(Input::TimeRate, zero)]));
        for (jet, (_, before)) in after.iter_mut().zip(&before) {
            let along = reduced.of(before.first);
            jet[2] = reduced.graph.add(jet[2], along);
        }
        let mut after = after.into_iter();
        let mut with = |own: Vec<(usize, Node)>| -> JetCells {
            let own = own.into_iter().zip(after.by_ref()).map(|((k, _), jet)| (k, jet));
            own.filter(|(_, jet)| jet.iter().any(|node| *node != zero)).collect()
        };
        let by_q = self.by_q.into_iter().map(&mut with).collect();
        let by_p = self.by_p.into_iter().map(&mut with).collect();
        Variation { graph: reduced.graph, laws: whole.laws, by_q, by_p }
    }
}

/// Adds to the cell in that place; a body may be given twice.
fn sum(graph: &mut Graph, cells: &mut Vec<(usize, Node)>, k: usize, node: Node) {
    match cells.iter_mut().find(|(known, _)| *known == k) {
        Some((_, own)) => *own = graph.add(*own, node),
        None => cells.push((k, node)),
    }
}
