//! Finds the coordinates that a row determines: q_j = −rest/c, if the row is c q_j + rest with a
//! constant c.
//!
//! The other coordinates are *torn*: Newton's method computes the torn coordinates from the
//! remaining rows.

use std::collections::{BTreeSet, HashSet};

use kin_graph::{Graph, Input, Node, Op};

use super::gather::{Row, Whole};
use super::kind::SELF;

/// A constant factor must be at least this share of the largest slope of its row at the guess, in
/// units of the sizes of coordinates. \[-\]
const SHARE: f64 = 0.1;

/// A coordinate that a row determines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Explicit {
    pub row: usize,
    pub column: usize,
    /// The constant factor ∂C_row/∂q_column.
    pub factor: f64,
    /// The row without that term.
    pub rest: Node,
}

/// The explicit coordinates, each from those before it and torn ones, and the remaining rows.
#[derive(Debug, Default)]
pub(crate) struct Order {
    /// The explicit coordinates, in the order of computation.
    pub explicit: Vec<Explicit>,
    /// The torn coordinates, by their indices in the system.
    pub torn: Vec<usize>,
    /// The remaining rows, as many as there are torn coordinates.
    pub rows: Vec<usize>,
}

/// Finds the order for a mechanism with as many rows as coordinates. `slopes` contains the values
/// of all slopes of each row at the guess, `sizes` the sizes of coordinates.
pub(crate) fn substitute(whole: &mut Whole, slopes: &[Vec<f64>], sizes: &[f64]) -> Order {
    let eligible = eligible(whole, slopes, sizes);
    let zero = whole.graph.zero();
    // A coordinate on which a row depends through steps only must be known before the row too.
    let steps = |row: &Row| row.steps.iter().map(|column| (*column, zero)).collect::<Vec<_>>();
    let all: Vec<Vec<(usize, Node)>> =
        whole.rows.iter().map(|row| [&row.slopes[..], &steps(row)].concat()).collect();
    let cells: Vec<&[(usize, Node)]> = all.iter().map(Vec::as_slice).collect();
    ordered(&cells, whole.n, eligible)
}

/// Orders rows with these entries in n coordinates. `eligible` contains the coordinates that each
/// row could determine.
pub(crate) fn ordered(cells: &[&[(usize, Node)]], n: usize, eligible: Vec<Vec<Explicit>>) -> Order {
    let mut search = Search::new(cells, n, eligible);
    while search.left > 0 {
        if let Some(row) = search.ready.pop() {
            search.give(row);
        } else {
            search.tear(cells);
        }
    }
    let Search { mut order, used, .. } = search;
    order.rows = (0..cells.len()).filter(|row| !used[*row]).collect();
    order
}

/// Returns the entries of a row that are constant and large in it, with their values.
pub(crate) fn constants(
    graph: &Graph,
    cells: &[(usize, Node)],
    values: &[f64],
    sizes: &[f64],
) -> Vec<(usize, f64)> {
    let measures =
        cells.iter().zip(values).map(|((column, _), value)| (value * sizes[*column]).abs());
    let largest = measures.fold(0.0, f64::max);
    let constant = |(column, cell): &(usize, Node)| {
        let large =
            |factor: &f64| (factor * sizes[*column]).abs() >= SHARE * largest && factor.is_finite();
        graph.constant_value(*cell).filter(large).map(|factor| (*column, factor))
    };
    cells.iter().filter_map(constant).filter(|(_, factor)| *factor != 0.0).collect()
}

/// Returns for each row the coordinates that it could determine, with factors and rests.
fn eligible(whole: &mut Whole, slopes: &[Vec<f64>], sizes: &[f64]) -> Vec<Vec<Explicit>> {
    let mut all = Vec::with_capacity(whole.rows.len());
    for (row, values) in slopes.iter().enumerate() {
        let mut own = Vec::new();
        for (column, factor) in constants(&whole.graph, &whole.rows[row].slopes, values, sizes) {
            let residual = whole.rows[row].residual;
            let Some(input) = whole.graph.existing(Op::Input(Input::State(column, SELF))) else {
                continue;
            };
            let split = split(&mut whole.graph, residual, input).filter(|(own, _)| *own == factor);
            own.extend(split.map(|(_, rest)| Explicit { row, column, factor, rest }));
        }
        all.push(own);
    }
    all
}

/// Returns a node as c q_j + rest, if it has that form.
fn split(graph: &mut Graph, node: Node, own: Node) -> Option<(f64, Node)> {
    // Operands have smaller indices than their results.
    if node < own {
        return Some((0.0, node));
    }
    let (factor, rest) = match graph.op(node) {
        _ if node == own => return Some((1.0, graph.zero())),
        Op::Neg(a) => {
            let (c, rest) = split(graph, a, own)?;
            (-c, graph.neg(rest))
        }
        Op::Add(a, b) => {
            let (c, left) = split(graph, a, own)?;
            let (d, right) = split(graph, b, own)?;
            (c + d, if (left, right) == (a, b) { node } else { graph.add(left, right) })
        }
        Op::Sub(a, b) => {
            let (c, left) = split(graph, a, own)?;
            let (d, right) = split(graph, b, own)?;
            (c - d, if (left, right) == (a, b) { node } else { graph.sub(left, right) })
        }
        Op::Mul(a, b) if graph.constant_value(a).is_some() => {
            let (c, rest) = split(graph, b, own)?;
            (graph.constant_value(a)? * c, if rest == b { node } else { graph.mul(a, rest) })
        }
        Op::Div(a, b) if graph.constant_value(b).is_some() => {
            let (c, rest) = split(graph, a, own)?;
            (c / graph.constant_value(b)?, if rest == a { node } else { graph.div(rest, b) })
        }
        _ => return (!reads(graph, node, own)).then_some((0.0, node)),
    };
    Some((factor, rest))
}

/// Returns true if a node depends on another one. A row is small compared with the whole graph.
fn reads(graph: &Graph, node: Node, wanted: Node) -> bool {
    let mut seen = HashSet::new();
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        if node == wanted {
            return true;
        }
        if node > wanted && seen.insert(node) {
            graph.each_operand(node, |operand| open.push(operand));
        }
    }
    false
}

struct Search {
    order: Order,
    eligible: Vec<Vec<Explicit>>,
    /// For each coordinate the rows that contain it.
    readers: Vec<Vec<usize>>,
    known: Vec<bool>,
    used: Vec<bool>,
    /// For each row the number of its unknown coordinates; `could` counts those that it could
    /// determine.
    unknown: Vec<usize>,
    could: Vec<usize>,
    /// The rows with one unknown that they determine, the first one last.
    ready: Vec<usize>,
    /// The rows that could determine one of their unknowns, as (number of unknowns, row).
    open: BTreeSet<(usize, usize)>,
    left: usize,
}

impl Search {
    fn new(cells: &[&[(usize, Node)]], n: usize, eligible: Vec<Vec<Explicit>>) -> Self {
        let mut readers = vec![Vec::new(); n];
        for (row, own) in cells.iter().enumerate() {
            own.iter().for_each(|(column, _)| readers[*column].push(row));
        }
        let unknown: Vec<usize> = cells.iter().map(|row| row.len()).collect();
        let could: Vec<usize> = eligible.iter().map(Vec::len).collect();
        let open = (0..unknown.len())
            .filter(|row| could[*row] > 0)
            .map(|row| (unknown[row], row))
            .collect();
        let ready =
            (0..unknown.len()).rev().filter(|row| unknown[*row] == 1 && could[*row] == 1).collect();
        let rows = cells.len();
        let order = Order::default();
        Search {
            order,
            eligible,
            readers,
            known: vec![false; n],
            used: vec![false; rows],
            unknown,
            could,
            ready,
            open,
            left: n,
        }
    }

    /// Determines the only unknown of a row, unless it has become known meanwhile.
    fn give(&mut self, row: usize) {
        let Some(found) =
            self.eligible[row].iter().find(|found| !self.known[found.column]).copied()
        else {
            return;
        };
        if !self.used[row] && self.unknown[row] == 1 {
            self.used[row] = true;
            self.order.explicit.push(found);
            self.note(found.column);
        }
    }

    /// Tears a coordinate of the row with the fewest unknowns. It prefers one that the row could
    /// not determine, and then the one that most rows contain.
    fn tear(&mut self, cells: &[&[(usize, Node)]]) {
        let row = self.open.first().map(|(_, row)| *row);
        let column = match row {
            Some(row) => {
                let own = cells[row]
                    .iter()
                    .map(|(column, _)| *column)
                    .filter(|column| !self.known[*column]);
                let gives =
                    |column: usize| self.eligible[row].iter().any(|found| found.column == column);
                own.max_by_key(|column| {
                    (!gives(*column), self.readers[*column].len(), std::cmp::Reverse(*column))
                })
            }
            None => self.known.iter().position(|known| !known),
        };
        if let Some(column) = column {
            self.order.torn.push(column);
            self.note(column);
        }
    }

    /// Marks a coordinate as known.
    fn note(&mut self, column: usize) {
        self.known[column] = true;
        self.left -= 1;
        for k in 0..self.readers[column].len() {
            let row = self.readers[column][k];
            self.open.remove(&(self.unknown[row], row));
            self.unknown[row] -= 1;
            self.could[row] -=
                usize::from(self.eligible[row].iter().any(|found| found.column == column));
            if self.used[row] || self.could[row] == 0 {
                continue;
            }
            self.open.insert((self.unknown[row], row));
            if self.unknown[row] == 1 {
                self.ready.push(row);
            }
        }
    }
}
