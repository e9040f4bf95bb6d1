//! Builds one graph of all equations of a system, with their derivatives by coordinates and by the
//! requested names.

use kin_graph::{Graph, Input, Node};

use crate::design::along::Prepared;
use crate::design::asked::{Asked, Hangs};
use crate::design::equation::Equation;
use crate::program::{Column, Leaves, Obstacle, Reduced, SELF, Whole, columns};
use crate::system::System;
use crate::system::evaluate::Block;

/// A node with its first and second time derivatives.
pub(super) type NodeJet = [Node; 3];

/// Such nodes with their columns or rows.
pub(super) type JetCells = Vec<(usize, NodeJet)>;

/// C_q and C_p as nodes of coordinates and time.
pub(super) struct Gathered {
    pub whole: Whole,
    /// C, one node for each row.
    pub residuals: Vec<Node>,
    /// C_q: for each row the columns with their nodes.
    pub by_q: Vec<Vec<(usize, Node)>>,
    /// C_p: for each requested name the rows with their nodes.
    pub by_p: Vec<Vec<(usize, Node)>>,
}

impl Gathered {
    /// Gathers the requested nodes. Returns the reason if something cannot be compiled.
    pub(super) fn of(prepared: &Prepared<'_>) -> Result<Self, Obstacle> {
        let system = prepared.system;
        let none = |count| vec![Vec::new(); count];
        let mut all = Gathered {
            whole: Whole::new(system.n_coordinates()),
            residuals: Vec::with_capacity(system.n_equations()),
            by_q: none(system.n_equations()),
            by_p: none(prepared.names),
        };
        for (number, block) in system.equations().blocks.iter().enumerate() {
            let own: Vec<&Asked> =
                prepared.asked.iter().filter(|asked| asked.block == number).collect();
            all.add(system, block, (&prepared.blocks[number], &own))?;
        }
        Ok(all)
    }

    /// Appends the rows of a constraint and their requested derivatives.
    fn add(
        &mut self,
        system: &System,
        block: &Block,
        (equation, asked): (&Equation, &[&Asked]),
    ) -> Result<(), Obstacle> {
        let mut columns =
            columns(system, block.constraint.as_ref()).ok_or(Obstacle::OtherMechanism)?;
        let whole = &mut self.whole;
        let first = block.rows().start;
        let done = block.constraint.formula(|_, parameters, outside| {
            columns.extend(parameters.iter().map(|value| Column::Fixed(*value)));
            columns.extend(equation.calls.iter().map(|_| Column::Fixed(0.0)));
            let leaves =
                Leaves { columns: &columns, parameters, outside, timed: &[], of_parameters: &[] };
            let nodes = equation.graph.reachable(&needed(equation, asked));
            let places = whole.copy(&equation.graph, &nodes, &leaves)?;
            let of = |node: Node| places[node.index()];
            for (row, slopes) in (first..).zip(&equation.rows) {
                self.residuals.push(of(slopes.residual));
                for (column, slope) in &slopes.by_column {
                    if let Some(Column::Coordinate(j)) = columns.get(*column) {
                        sum(&mut whole.graph, &mut self.by_q[row], *j, of(*slope));
                    }
                }
            }
            for asked in asked.iter().copied() {
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
                                let by = whole
                                    .law_at(by.clone(), of(call.x), call.order)
                                    .ok_or(Obstacle::NoFormula)?;
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
        done.unwrap_or(Err(Obstacle::NoFormula))
    }
}

/// Returns the nodes of an equation that are C, C_q or requested derivatives.
fn needed(equation: &Equation, asked: &[&Asked]) -> Vec<Node> {
    let mut nodes = Vec::new();
    for row in &equation.rows {
        nodes.push(row.residual);
        nodes.extend(row.by_column.iter().map(|(_, slope)| *slope));
        for asked in asked {
            match &asked.hangs {
                Hangs::Parameter(k) => {
                    nodes.extend(
                        row.by_parameter.iter().filter(|(own, _)| own == k).map(|(_, node)| *node),
                    );
                }
                Hangs::Law { number, .. } => {
                    let calls =
                        row.by_call.iter().filter(|(k, _)| equation.calls[*k].law == *number);
                    nodes.extend(calls.flat_map(|(k, slope)| [*slope, equation.calls[*k].x]));
                }
            }
        }
    }
    nodes
}

/// Sets the derivatives that a tape along a motion reads: ṫ is 1, and q̈, the velocities of
/// arguments from index `second` on, are parameters.
pub(super) fn put_rates(reduced: &mut Reduced<'_>, n: usize, second: usize) {
    let one = reduced.graph.constant(1.0);
    reduced.put(Input::TimeRate, one);
    for j in 0..n {
        let own = reduced.graph.input(Input::Parameter(j));
        reduced.put(Input::Rate(second + j, SELF), own);
    }
}

/// Copies entries to another graph, without those that are zero.
pub(super) fn moved(reduced: &mut Reduced<'_>, cells: &[JetCells]) -> Vec<JetCells> {
    let zero = reduced.graph.zero();
    let mut own = |cells: &JetCells| -> JetCells {
        let moved = cells.iter().map(|(k, jet)| (*k, jet.map(|node| reduced.of(node))));
        moved.filter(|(_, jet)| jet.iter().any(|node| *node != zero)).collect()
    };
    cells.iter().map(&mut own).collect()
}

/// Adds to the entry at this index; an equation can contain a body twice.
fn sum(graph: &mut Graph, cells: &mut Vec<(usize, Node)>, k: usize, node: Node) {
    match cells.iter_mut().find(|(known, _)| *known == k) {
        Some((_, own)) => *own = graph.add(*own, node),
        None => cells.push((k, node)),
    }
}
