//! Differentiates the equation of one kind of constraint, once for all constraints of the kind.
//!
//! Coordinates are [`Input::State`] of the local column with the part R(0), and velocities
//! [`Input::Rate`] in the same way. For the passes of `kin_graph` each coordinate and each velocity
//! is a separate argument.

use kin_graph::differentiate::{Jets, Partial};
use kin_graph::schedule::looked_up;
use kin_graph::{Column, Formula, Graph, Input, Node, Op, Part};

use super::refusal::Obstacle;
use crate::model::formula::sides::Choice;

/// The part of a state or velocity that represents a coordinate. The second part represents the
/// acceleration.
pub(crate) const SELF: Part = Part::R(0);
pub(super) const SECOND: Part = Part::R(1);

/// The index from which laws of the graph are values of time alone that only rustc can read.
pub(super) const TIMED: usize = usize::MAX / 2;

/// The rows of a kind with their derivatives.
pub(super) struct Kind {
    /// The graph of all rows.
    pub graph: Graph,
    pub rows: Vec<KindRow>,
    /// All operands of the rows, before their results.
    pub nodes: Vec<Node>,
    /// The nodes that select branches depending on coordinates: conditions and integers. As long as
    /// none of them changes, nothing has jumped.
    pub sides: Vec<Node>,
    /// The distances of the branch selections from their changes.
    pub gaps: Vec<Node>,
    /// Values of time alone that only rustc can read, as nodes of the formula. In the graph they
    /// are laws of time, with indices from [`TIMED`] on.
    pub timed: Vec<Node>,
    /// Values of parameters alone that only rustc can read, as ((function, component), node of the
    /// formula).
    pub foreign: Vec<((usize, usize), Node)>,
}

/// One row, in local columns.
pub(super) struct KindRow {
    /// C.
    pub residual: Node,
    /// The local columns on which the row depends. A column that enters through a step has no
    /// slope, but the row depends on it.
    pub columns: Vec<usize>,
    /// ∂C/∂q_k as (k, node).
    pub slopes: Vec<(usize, Node)>,
    /// C_t.
    pub by_time: Node,
    /// g″(0) along the velocities, which is −Q_d.
    pub second: Node,
    /// g‴(0) along velocities and accelerations; `None` unless the jerk is computed.
    pub third: Option<Node>,
}

impl Kind {
    /// Differentiates the rows as they are written, with or without the terms of the jerk.
    pub(super) fn of(formula: &Formula, rows: usize, jerk: bool) -> Result<Kind, Obstacle> {
        if formula.rows.len() != rows {
            return Err(Obstacle::NoEquation);
        }
        let mut graph = Graph::default();
        let mut places = vec![Node::default(); formula.graph.len()];
        let mut timed = Vec::new();
        let mut foreign = Vec::new();
        for node in formula.graph.reachable(&formula.rows) {
            places[node.index()] = read(&mut graph, &formula.graph, node, &places, &mut timed)?;
            if let Op::Opaque(number, component) = graph.op(places[node.index()]) {
                foreign.push(((number, component), node));
            }
        }
        let residuals: Vec<Node> = formula.rows.iter().map(|row| places[row.index()]).collect();
        let residuals = looked_up(&mut graph, &residuals);
        let columns: Vec<Vec<Column>> =
            residuals.iter().map(|row| graph.columns(&[*row])).collect();
        let mut slopes: Vec<Vec<(usize, Node)>> = vec![Vec::new(); residuals.len()];
        for column in graph.columns(&residuals) {
            let mut partial = Partial::by_column(column);
            for (k, row) in
                residuals.iter().enumerate().filter(|(k, _)| columns[*k].contains(&column))
            {
                let slope = partial.of(&mut graph, *row);
                if !graph.is_zero(slope) {
                    slopes[k].push((column.argument, slope));
                }
            }
        }
        let mut by_time = Partial::by_time();
        let mut jets = Jets::default();
        let (sides, gaps) = sides(&mut graph, &residuals);
        let mut rows = Vec::with_capacity(residuals.len());
        for ((residual, columns), slopes) in residuals.into_iter().zip(columns).zip(slopes) {
            let by_time = by_time.of(&mut graph, residual);
            let second = jets.of(&mut graph, residual).second;
            let third = jerk.then(|| third(&mut graph, &mut jets, &slopes, second));
            let columns = columns.into_iter().map(|column| column.argument).collect();
            rows.push(KindRow { residual, columns, slopes, by_time, second, third });
        }
        let nodes = graph.reachable(&[outputs(&rows), sides.clone(), gaps.clone()].concat());
        Ok(Kind { graph, rows, nodes, sides, gaps, timed, foreign })
    }
}

/// Returns g‴(0) of g(s) = C(q + s q̇ + ½ s² q̈, t + s): the derivative of g″(0) along constant
/// velocities, plus three times that of C_q q̈.
fn third(graph: &mut Graph, jets: &mut Jets, slopes: &[(usize, Node)], second: Node) -> Node {
    let zero = graph.zero();
    let three = graph.constant(3.0);
    let straight = slopes.iter().fold(zero, |sum, (column, slope)| {
        let rate = graph.input(Input::Rate(*column, SECOND));
        let product = graph.mul(*slope, rate);
        graph.add(sum, product)
    });
    let bent = jets.first(graph, second);
    let along = jets.first(graph, straight);
    let along = graph.mul(three, along);
    graph.add(bent, along)
}

/// Returns the nodes that select branches of these rows depending on coordinates, and their
/// distances from the changes.
fn sides(graph: &mut Graph, rows: &[Node]) -> (Vec<Node>, Vec<Node>) {
    let mut sides = Vec::new();
    let mut gaps = Vec::new();
    for node in graph.reachable(rows) {
        let Some(choice) = Choice::of(graph, node) else { continue };
        let side = choice.node(graph);
        if graph.depends(side).on_q && !sides.contains(&side) {
            sides.push(side);
            gaps.extend(choice.gaps(graph));
        }
    }
    gaps.retain(|gap| graph.depends(*gap).on_q);
    (sides, gaps)
}

/// Returns all requested nodes.
fn outputs(rows: &[KindRow]) -> Vec<Node> {
    let of = |row: &KindRow| {
        let own = [row.residual, row.by_time, row.second].into_iter();
        own.chain(row.third)
            .chain(row.slopes.iter().map(|(_, slope)| *slope))
            .collect::<Vec<Node>>()
    };
    rows.iter().flat_map(of).collect()
}

/// Converts one operation of a formula.
fn read(
    to: &mut Graph,
    from: &Graph,
    node: Node,
    places: &[Node],
    timed: &mut Vec<Node>,
) -> Result<Node, Obstacle> {
    let of = |node: Node| places[node.index()];
    Ok(match from.op(node) {
        Op::Input(Input::Column(k)) => to.input(Input::State(k, SELF)),
        Op::Input(input @ (Input::Time | Input::Parameter(_))) => to.input(input),
        Op::Law(law, x, order) => to.law(law, of(x), order),
        // The nearest f64, as in compiled kernels.
        Op::Decimal(k) => from
            .decimals
            .get(k)
            .map(|decimal| to.constant(decimal.nearest))
            .ok_or(Obstacle::NoEquation)?,
        Op::Opaque(number, component) => {
            let operands: Vec<Node> =
                from.opaques[number].iter().map(|operand| of(*operand)).collect();
            if operands.iter().any(|operand| to.depends(*operand).on_q) {
                return Err(Obstacle::ForeignFunction);
            }
            if operands.iter().any(|operand| to.depends(*operand).on_t) {
                timed.push(node);
                let t = to.input(Input::Time);
                return Ok(to.law(TIMED + timed.len() - 1, t, 0));
            }
            if to.opaques.len() <= number {
                to.opaques.resize(number + 1, Vec::new());
            }
            to.opaques[number] = operands;
            to.opaque(number, component)
        }
        op => to.rebuilt(op, of).ok_or(Obstacle::NoEquation)?,
    })
}
