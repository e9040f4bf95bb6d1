//! All derivatives of the rows that a constraint is asked for, as nodes of the same graph, and what
//! follows from them for good.

use super::{Jets, Partial, by_columns, promise_of_columns};
use crate::schedule::{fused, looked_up, operations};
use crate::{Column, Graph, Input, Node, Op, Part};

/// Every derivative of the rows.
pub struct Derivatives {
    /// C, of tables of pieces one expression with numbers that are looked up; the derivatives are
    /// those of this.
    pub rows: Vec<Node>,
    /// (row, local column, value), structural non-zeros only.
    pub jacobian: Vec<(usize, usize, Node)>,
    /// −C_t; empty where nothing depends on time.
    pub velocity_rhs: Vec<Node>,
    /// −g″(0)
    pub acceleration_rhs: Vec<Node>,
}

/// The terms that can change with t, be other than zero, or be other than linear, and the entries
/// of C_q that are numbers for good.
pub struct Promises {
    pub c_on_t: bool,
    pub c_q_on_t: bool,
    pub c_t: bool,
    pub q_d: bool,
    pub curved: bool,
    /// Those of `jacobian`, in its order.
    pub constants: Vec<Option<f64>>,
}

impl Derivatives {
    /// The derivatives of `rows`; `local` numbers the columns.
    pub fn new(g: &mut Graph, rows: &[Node], local: impl Fn(Column) -> usize) -> Self {
        let rows = looked_up(g, rows);
        let jacobian = jacobian(g, &rows, local);
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
        Derivatives { rows, jacobian, velocity_rhs, acceleration_rhs }
    }

    /// Slots whose sine or cosine some output reads.
    pub fn trig(&self, g: &Graph) -> Vec<usize> {
        let mut outputs = self.rows.clone();
        outputs.extend(self.jacobian.iter().map(|entry| entry.2));
        outputs.extend(self.velocity_rhs.iter().chain(&self.acceleration_rhs));
        let reads = |node: Node| match g.op(node) {
            Op::Input(Input::State(slot, Part::Sin | Part::Cos)) => Some(slot),
            _ => None,
        };
        g.reachable(&outputs).into_iter().filter_map(reads).collect()
    }

    /// True if the rows are linear in the coordinates for good: with a gradient of numbers, and
    /// coordinates that enter by sums and products alone, for steps and kinks have such gradients
    /// too.
    pub fn is_linear(&self, g: &Graph) -> bool {
        let smooth = |op: Op| {
            matches!(op, Op::Input(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_))
        };
        self.jacobian.iter().all(|entry| g.constant_value(entry.2).is_some())
            && g.reachable(&self.rows)
                .into_iter()
                .all(|node| !g.depends(node).on_q || smooth(g.op(node)))
    }

    /// The promises of the graph about the terms.
    pub fn promises(&self, g: &Graph) -> Promises {
        let on_t = |n: &Node| g.depends(*n).on_t;
        let [c_t, q_d] = [&self.velocity_rhs, &self.acceleration_rhs]
            .map(|side| side.iter().any(|&n| !g.is_zero(n)));
        let number =
            |entry: &(usize, usize, Node)| g.constant_value(entry.2).filter(|c| c.is_finite());
        Promises {
            c_on_t: self.rows.iter().any(on_t),
            c_q_on_t: self.jacobian.iter().any(|entry| on_t(&entry.2)),
            c_t,
            q_d,
            curved: !self.is_linear(g),
            constants: self.jacobian.iter().map(number).collect(),
        }
    }
}

fn jacobian(
    g: &mut Graph,
    rows: &[Node],
    local: impl Fn(Column) -> usize,
) -> Vec<(usize, usize, Node)> {
    let columns = g.columns(rows);
    let mut entries = column_by_column(g, rows, &columns);
    if promise_of_columns(g, rows, &columns) >= MUCH {
        inwards_if_cheaper(g, rows, &columns, &mut entries);
    }
    entries.into_iter().map(|(row, column, value)| (row, local(columns[column]), value)).collect()
}

/// A promise below which another order gained nothing where it was tried; to try takes longer than
/// all other derivatives.
const MUCH: usize = 200;

/// Takes each row's derivatives from the row inwards, if that has the same structure and saves a
/// quarter of the operations of C and C_q: column by column a long chain is gone through once for
/// each column.
fn inwards_if_cheaper(
    g: &mut Graph,
    rows: &[Node],
    columns: &[Column],
    entries: &mut [(usize, usize, Node)],
) {
    let found: Option<Vec<Vec<Node>>> =
        rows.iter().map(|&row| by_columns(g, row, columns)).collect();
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
    let mut partials: Vec<Partial> =
        columns.iter().map(|&column| Partial::by_column(column)).collect();
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
