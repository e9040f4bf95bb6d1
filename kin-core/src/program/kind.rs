//! The equation of one kind of constraint with its derivatives: found once for all constraints of the kind.
//!
//! Coordinates are [`Input::State`] of the local column, part R(0), and rates [`Input::Rate`] likewise: to
//! the passes of `kin_graph` each of them is an argument of its own.

use kin_graph::differentiate::{Jets, Partial};
use kin_graph::schedule::looked_up;
use kin_graph::{Column, Depends, Formula, Graph, Input, Node, Op, Part};

/// The part of a state that a coordinate is.
pub(crate) const SELF: Part = Part::R(0);

/// Rows with all that is asked of them.
pub(super) struct Kind {
    pub graph: Graph,
    pub rows: Vec<KindRow>,
    /// All that rows are computed from, operands before their users.
    pub nodes: Vec<Node>,
}

/// One row: C, ∂C/∂q_k by local columns, C_t, and g″(0) along the rates, which is −Q_d.
pub(super) struct KindRow {
    pub residual: Node,
    pub slopes: Vec<(usize, Node)>,
    pub by_time: Node,
    pub second: Node,
}

/// Why an equation cannot be read as a graph.
pub(crate) const FOREIGN: &str = "a function that only rustc can read is asked for something that moves";
const EMPTY: &str = "its equation is not known as a formula";

impl Kind {
    /// Of the rows as they are written.
    pub(super) fn of(formula: &Formula, rows: usize) -> Result<Kind, &'static str> {
        if formula.rows.len() != rows {
            return Err(EMPTY);
        }
        let (mut graph, mut places) = (Graph::default(), vec![Node::default(); formula.graph.len()]);
        for node in formula.graph.reachable(&formula.rows) {
            places[node.index()] = read(&mut graph, &formula.graph, node, &places)?;
        }
        let residuals: Vec<Node> = formula.rows.iter().map(|row| places[row.index()]).collect();
        let residuals = looked_up(&mut graph, &residuals);
        let columns: Vec<Vec<Column>> = residuals.iter().map(|row| graph.columns(&[*row])).collect();
        let mut slopes: Vec<Vec<(usize, Node)>> = vec![Vec::new(); residuals.len()];
        for column in graph.columns(&residuals) {
            let mut partial = Partial::by_column(column);
            for (k, row) in residuals.iter().enumerate().filter(|(k, _)| columns[*k].contains(&column)) {
                let slope = partial.of(&mut graph, *row);
                if !graph.is_zero(slope) {
                    slopes[k].push((column.argument, slope));
                }
            }
        }
        let (mut by_time, mut jets) = (Partial::by_time(), Jets::default());
        let mut row = |(residual, slopes): (Node, Vec<(usize, Node)>)| {
            let by_time = by_time.of(&mut graph, residual);
            KindRow { residual, slopes, by_time, second: jets.of(&mut graph, residual).second }
        };
        let rows: Vec<KindRow> = residuals.into_iter().zip(slopes).map(&mut row).collect();
        let nodes = graph.reachable(&outputs(&rows));
        Ok(Kind { graph, rows, nodes })
    }
}

/// All nodes that are asked for.
fn outputs(rows: &[KindRow]) -> Vec<Node> {
    let of = |row: &KindRow| {
        let own = [row.residual, row.by_time, row.second].into_iter();
        own.chain(row.slopes.iter().map(|(_, slope)| *slope)).collect::<Vec<Node>>()
    };
    rows.iter().flat_map(of).collect()
}

/// One step of a formula.
fn read(to: &mut Graph, from: &Graph, node: Node, places: &[Node]) -> Result<Node, &'static str> {
    let of = |node: Node| places[node.index()];
    Ok(match from.op(node) {
        Op::Input(Input::Column(k)) => to.input(Input::State(k, SELF)),
        Op::Input(input @ (Input::Time | Input::Parameter(_))) => to.input(input),
        Op::Law(law, x, order) => to.law(law, of(x), order),
        // The nearest f64, as kernels have it.
        Op::Decimal(k) => from.decimals.get(k).map(|decimal| to.constant(decimal.nearest)).ok_or(EMPTY)?,
        Op::Opaque(number, component) => {
            let operands: Vec<Node> = from.opaques[number].iter().map(|operand| of(*operand)).collect();
            let moves = |operand: &Node| Depends::varies(to.depends(*operand));
            if operands.iter().any(moves) {
                return Err(FOREIGN);
            }
            if to.opaques.len() <= number {
                to.opaques.resize(number + 1, Vec::new());
            }
            to.opaques[number] = operands;
            to.opaque(number, component)
        }
        op => to.rebuilt(op, of).ok_or(EMPTY)?,
    })
}
