//! The derivatives that this stage hands on: all those of the rows that emitted code computes, as nodes of
//! the same graph.

use kin_graph::differentiate::{Jets, Partial, by_columns, promise_of_columns};
use kin_graph::schedule::{fused, operations};
use kin_graph::{Column, Graph, Input, Node, Op, Part};
use kin_language::lower::Lowered;
use kin_language::parse::{Argument, Kind};

/// Every derivative of the rows.
pub struct Derivatives {
    /// (row, local column, value), structural non-zeros only.
    pub jacobian: Vec<(usize, usize, Node)>,
    /// −C_t; empty where nothing depends on time.
    pub velocity_rhs: Vec<Node>,
    /// −g″(0)
    pub acceleration_rhs: Vec<Node>,
}

impl Derivatives {
    pub fn new(lowered: &mut Lowered, arguments: &[Argument]) -> Self {
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let g = &mut lowered.graph;
        let jacobian = jacobian(g, &rows, arguments);
        let mut velocity_rhs = Vec::new();
        if rows.iter().any(|&row| g.depends(row).on_t) {
            let mut by_time = Partial::by_time();
            for &row in &rows {
                let c_t = by_time.of(g, row);
                velocity_rhs.push(g.neg(c_t));
            }
        }
        let mut jets = Jets::default();
        let mut acceleration_rhs = Vec::new();
        for &row in &rows {
            let second = jets.of(g, row).second;
            acceleration_rhs.push(g.neg(second));
        }
        Derivatives { jacobian, velocity_rhs, acceleration_rhs }
    }

    /// Slots whose sine or cosine some output reads.
    pub fn trig(&self, lowered: &Lowered) -> Vec<usize> {
        let mut outputs: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        outputs.extend(self.jacobian.iter().map(|entry| entry.2));
        outputs.extend(self.velocity_rhs.iter().chain(&self.acceleration_rhs));
        let reads = |node: Node| match lowered.graph.op(node) {
            Op::Input(Input::State(slot, Part::Sin | Part::Cos)) => Some(slot),
            _ => None,
        };
        lowered.graph.reachable(&outputs).into_iter().filter_map(reads).collect()
    }
}

fn jacobian(g: &mut Graph, rows: &[Node], arguments: &[Argument]) -> Vec<(usize, usize, Node)> {
    let columns = g.columns(rows);
    let mut entries = column_by_column(g, rows, &columns);
    if promise_of_columns(g, rows, &columns) >= MUCH {
        inwards_if_cheaper(g, rows, &columns, &mut entries);
    }
    entries
        .into_iter()
        .map(|(row, column, value)| (row, local_column(arguments, columns[column]), value))
        .collect()
}

/// A promise below which another order gained nothing where it was tried; to try takes longer than all other
/// derivatives.
const MUCH: usize = 200;

/// Takes each row's derivatives from the row inwards, if that has the same structure and saves a quarter of
/// the operations of C and C_q: column by column a long chain is gone through once for each column.
fn inwards_if_cheaper(
    g: &mut Graph,
    rows: &[Node],
    columns: &[Column],
    entries: &mut [(usize, usize, Node)],
) {
    let found: Option<Vec<Vec<Node>>> = rows.iter().map(|&row| by_columns(g, row, columns)).collect();
    let Some(found) = found else { return };
    let others: Vec<Node> = entries.iter().map(|&(row, column, _)| found[row][column]).collect();
    let zeros = found.iter().flatten().filter(|&&value| g.is_zero(value)).count();
    let is_known = |value: Node| g.constant_value(value).is_some();
    let same = zeros + entries.len() == rows.len() * columns.len()
        && entries.iter().zip(&others).all(|(entry, &other)| is_known(entry.2) == is_known(other));
    let values: Vec<Node> = entries.iter().map(|entry| entry.2).collect();
    let mut work = |values: &[Node]| {
        let outputs = fused(g, &[rows, values].concat());
        operations(g, &outputs)
    };
    if same && 4 * work(&others) < 3 * work(&values) {
        entries.iter_mut().zip(others).for_each(|(entry, other)| entry.2 = other);
    }
}

/// (row, column, value) of the structural non-zeros.
fn column_by_column(g: &mut Graph, rows: &[Node], columns: &[Column]) -> Vec<(usize, usize, Node)> {
    let mut partials: Vec<Partial> = columns.iter().map(|&column| Partial::by_column(column)).collect();
    let mut entries = Vec::new();
    for (k, &row) in rows.iter().enumerate() {
        // The same for each column: all of them have seen the rows before.
        let unknown = partials.first().map(|partial| partial.unknown(g, row)).unwrap_or_default();
        for (column, partial) in partials.iter_mut().enumerate() {
            partial.of_all(g, &unknown);
            let value = partial.known(row);
            if !g.is_zero(value) {
                entries.push((k, column, value));
            }
        }
    }
    entries
}

/// Number of a column among those of all arguments.
pub fn local_column(arguments: &[Argument], column: Column) -> usize {
    let (mut slot, mut first) = (0, 0);
    for argument in arguments {
        let slots = argument.kind.slots();
        if column.argument < slot + slots {
            return first
                + match (&argument.kind, column.part) {
                    (Kind::Planar, Part::Theta) => 2,
                    (Kind::Planars(_), part) => {
                        3 * (column.argument - slot) + if let Part::R(k) = part { k } else { 2 }
                    }
                    (Kind::Spatials(_), Part::R(k)) => 7 * (column.argument - slot) + k,
                    (Kind::Spatials(_), Part::P(k)) => 7 * (column.argument - slot) + 3 + k,
                    (_, Part::R(k)) => k,
                    (_, Part::P(k)) => 3 + k,
                    _ => column.argument - slot,
                };
        }
        slot += slots;
        first += argument.kind.columns();
    }
    first
}
