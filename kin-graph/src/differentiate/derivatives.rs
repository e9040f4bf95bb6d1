//! Computes all derivatives of the rows that a constraint provides, as nodes of the same graph, and
//! the facts that follow from them.

use super::{Jets, Partial, by_columns, promise_of_columns};
use crate::schedule::{fused, looked_up, operations};
use crate::{Column, Graph, Input, Node, Op, Part};

/// Every derivative of the rows.
pub struct Derivatives {
    /// C, in which a table of pieces is one expression with numbers from a lookup. The derivatives
    /// are those of this form.
    pub rows: Vec<Node>,
    /// The structurally nonzero entries of C_q, as (row, local column, value).
    pub jacobian: Vec<(usize, usize, Node)>,
    /// −C_t; empty if no row depends on time.
    pub velocity_rhs: Vec<Node>,
    /// −g″(0), the right side for accelerations.
    pub acceleration_rhs: Vec<Node>,
}

/// The terms that can change with t, be nonzero or be nonlinear, and the constant entries of C_q.
pub struct Promises {
    pub c_on_t: bool,
    pub c_q_on_t: bool,
    pub c_t: bool,
    pub q_d: bool,
    pub curved: bool,
    /// The constants of `jacobian`, in the same order; `None` for an entry that can change.
    pub constants: Vec<Option<f64>>,
}

impl Derivatives {
    /// Computes the derivatives of `rows`; `local` gives the local index of a column.
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

    /// Returns the arguments whose sine or cosine an output reads.
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

    /// Returns true if the rows are always linear in the coordinates.
    ///
    /// The gradient must be constant, and coordinates must enter only by sums and products, because
    /// steps and kinks have constant gradients too.
    pub fn is_linear(&self, g: &Graph) -> bool {
        let smooth = |op: Op| {
            matches!(op, Op::Input(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_))
        };
        self.jacobian.iter().all(|entry| g.constant_value(entry.2).is_some())
            && g.reachable(&self.rows)
                .into_iter()
                .all(|node| !g.depends(node).on_q || smooth(g.op(node)))
    }

    /// Returns the promises of the graph about the terms.
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
