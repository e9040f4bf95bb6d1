//! Builds the program: all results of a step, as nodes of one graph of time and torn coordinates.
//!
//! The stage `time` contains all nodes that depend on time alone. The stage `correct` computes the
//! next iterate of the torn coordinates. The stage `rates` computes all coordinates with q̇ and q̈.
//! The stage `verify` computes C as the user wrote it, at the found coordinates; no term of this C
//! can cancel against the computation of the coordinates.

use kin_graph::differentiate::Partial;
use kin_graph::{Function, Graph, Input, LeafUse, Node, Source, evaluate};

use super::eliminate::Elimination;
use super::gather::{Differences, Free, Whole, gather};
use super::kind::{SECOND, SELF};
use super::reduce::Reduced;
use super::refusal::{Obstacle, Refusal};
use super::substitute::{Order, substitute};
use crate::law::Law;
use crate::system::System;

/// The error of coordinates in branch selections, as a share of themselves and of their sizes.
/// \[-\]
const NEAR: f64 = 1e-12;

/// The position at which an elimination is chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose<'a> {
    pub t: f64,
    pub q: &'a [f64],
    /// s_j, the characteristic size of each coordinate.
    pub sizes: &'a [f64],
}

/// A whole mechanism as straight-line stages. Inputs are time, [`Input::State`] of torn
/// coordinates, and in `verify` [`Input::Column`] of all coordinates.
pub(crate) struct Program {
    /// The graph of all stages.
    pub graph: Graph,
    /// The laws of the graph, by their indices.
    pub laws: Vec<Law>,
    /// The numbers and laws that differ from case to case.
    pub free: Free,
    /// The coordinates that Newton's method computes, by their indices in the system.
    pub torn: Vec<usize>,
    /// For each torn coordinate its correction, from C_q Δq = −C.
    pub correction: Vec<Node>,
    /// The remaining rows, by their indices in the system.
    pub rows: Vec<usize>,
    /// For each remaining row −C with all explicit coordinates substituted.
    pub left: Vec<Node>,
    /// For each block of the elimination its pivots and determinants.
    pub guards: Vec<Vec<Node>>,
    /// The values of the guards at the position at which the elimination was chosen.
    pub chosen: Vec<Vec<f64>>,
    /// The coordinates, by their indices in the system.
    pub values: Vec<Node>,
    /// The last correction of each coordinate.
    pub corrections: Vec<Node>,
    /// q̇ of each coordinate.
    pub rates: Vec<Node>,
    /// q̈ of each coordinate.
    pub second_rates: Vec<Node>,
    /// q⃛ of each coordinate; empty unless the jerk is computed.
    pub third_rates: Vec<Node>,
    /// The nodes that select branches depending on coordinates: conditions and integers.
    pub sides: Vec<Node>,
    /// C as written, at the coordinates `values`, one node for each row of the system.
    pub verify: Vec<Node>,
    /// The sizes of the blocks that are solved together.
    pub blocks: Vec<usize>,
}

/// Makes the program of a system with its elimination chosen at a pose, with or without q⃛.
pub(crate) fn program(system: &System, pose: Pose<'_>, jerk: bool) -> Result<Program, Refusal> {
    program_of_cases(system, pose, jerk, Differences::default())
}

/// Makes one program for many cases, of which the system is one. Numbers that differ between cases
/// become inputs.
pub(crate) fn program_of_cases(
    system: &System,
    pose: Pose<'_>,
    jerk: bool,
    differences: Differences,
) -> Result<Program, Refusal> {
    if system.n_equations() != system.n_coordinates() {
        return Err(Refusal::whole(Obstacle::Redundant));
    }
    let mut whole = gather(system, jerk, differences)?;
    let slopes = slopes(&whole, pose);
    let undecided = undecided(&mut whole, pose.sizes);
    whole.sides.extend(undecided);
    let order = substitute(&mut whole, &slopes, pose.sizes);
    let (mut reduced, values) = Reduced::new(&whole, &order);
    let elimination = eliminated(&mut reduced, &whole, &order, pose).map_err(Refusal::whole)?;
    let mut program = finished(&whole, &order, (reduced, values), [&elimination; 4]);
    program.chosen =
        program.guards.iter().map(|own| numbers(&program.graph, own, &whole.at(pose))).collect();
    Ok(program)
}

/// Eliminates the remaining rows after substitution.
pub(super) fn eliminated<'o>(
    reduced: &mut Reduced<'_>,
    whole: &Whole,
    order: &'o Order,
    pose: Pose<'_>,
) -> Result<Elimination<'o>, Obstacle> {
    let cells: Vec<Vec<(usize, Node)>> = whole
        .rows
        .iter()
        .map(|row| row.slopes.iter().map(|(column, slope)| (*column, reduced.of(*slope))).collect())
        .collect();
    let at = |graph: &Graph, nodes: &[Node]| numbers(graph, nodes, &whole.at(pose));
    Elimination::new(&mut reduced.graph, order, &cells, pose.sizes, at)
}

/// Builds all stages. The elimination is used once for each of its right sides: those of
/// corrections, q̇, q̈ and q⃛. `values` are the nodes of coordinates.
///
/// The phases are: the corrections from −C, the velocities from −C_t, the accelerations and jerk,
/// the branch selections, and the check of C as written.
pub(super) fn finished(
    whole: &Whole,
    order: &Order,
    (mut reduced, values): (Reduced<'_>, Vec<Node>),
    [elimination, of_rates, of_second_rates, of_third_rates]: [&Elimination<'_>; 4],
) -> Program {
    // Explicit rows are satisfied by substitution.
    let zero = reduced.graph.zero();
    let mut b = vec![zero; whole.rows.len()];
    for &row in &order.rows {
        let residual = reduced.of(whole.rows[row].residual);
        b[row] = reduced.graph.neg(residual);
    }
    let left = order.rows.iter().map(|row| b[*row]).collect();
    let corrections = elimination.solve(&mut reduced.graph, &b);
    let b = opposite(&mut reduced, whole.rows.iter().map(|row| row.by_time));
    let rates = of_rates.solve(&mut reduced.graph, &b);
    rates
        .iter()
        .enumerate()
        .for_each(|(column, rate)| reduced.put(Input::Rate(column, SELF), *rate));
    let b = opposite(&mut reduced, whole.rows.iter().map(|row| row.second));
    let second_rates = of_second_rates.solve(&mut reduced.graph, &b);
    let third_rates = third_rates(&mut reduced, whole, &second_rates, of_third_rates);
    let sides = sides(&mut reduced, whole);
    let columns: Vec<Node> =
        (0..whole.n).map(|column| reduced.graph.input(Input::Column(column))).collect();
    reduced.rewrite(
        columns.iter().enumerate().map(|(column, node)| (Input::State(column, SELF), *node)),
    );
    let verify = whole.rows.iter().map(|row| reduced.of(row.residual)).collect();
    let graph = reduced.graph;
    let guards = elimination.guards();
    Program {
        correction: order.torn.iter().map(|column| corrections[*column]).collect(),
        guards,
        chosen: Vec::new(),
        blocks: elimination.sizes(),
        graph,
        torn: order.torn.clone(),
        rows: order.rows.clone(),
        left,
        values,
        corrections,
        rates,
        second_rates,
        third_rates,
        sides,
        verify,
        laws: whole.laws.clone(),
        free: whole.free.clone(),
    }
}

/// Solves q⃛ of C_q q⃛ = −g‴(0), if the rows contain its terms.
fn third_rates(
    reduced: &mut Reduced<'_>,
    whole: &Whole,
    second_rates: &[Node],
    elimination: &Elimination<'_>,
) -> Vec<Node> {
    let Some(third) = whole.rows.iter().map(|row| row.third).collect::<Option<Vec<Node>>>() else {
        return Vec::new();
    };
    for (column, rate) in second_rates.iter().enumerate() {
        reduced.put(Input::Rate(column, SECOND), *rate);
    }
    let b = opposite(reduced, third.into_iter());
    elimination.solve(&mut reduced.graph, &b)
}

/// Returns the nodes that select branches and are not constant, each once.
fn sides(reduced: &mut Reduced<'_>, whole: &Whole) -> Vec<Node> {
    let mut sides: Vec<Node> = whole.sides.iter().map(|side| reduced.of(*side)).collect();
    sides.retain(|side| reduced.graph.known_value(*side).is_none());
    sides.sort_unstable();
    sides.dedup();
    sides
}

/// Returns for each gap a node that is 1, or NaN if the gap is so small that rounding of
/// coordinates closes it. Single steps then decide the branch, so that engines do not differ.
fn undecided(whole: &mut Whole, sizes: &[f64]) -> Vec<Node> {
    let graph = &mut whole.graph;
    let mut nodes = Vec::new();
    for gap in whole.gaps.drain(..) {
        let mut allowed = graph.zero();
        for column in graph.columns(&[gap]) {
            let slope = Partial::by_column(column).of(graph, gap);
            let coordinate = graph.input(Input::State(column.argument, column.part));
            let [slope, coordinate] =
                [slope, coordinate].map(|node| graph.call(Function::Abs, node));
            let [rounding, size] = [NEAR, NEAR * sizes.get(column.argument).unwrap_or(&1.0)]
                .map(|x| graph.constant(x));
            let share = graph.mul(rounding, coordinate);
            let share = graph.add(share, size);
            let share = graph.mul(slope, share);
            allowed = graph.add(allowed, share);
        }
        let gap = graph.call(Function::Abs, gap);
        let left = graph.sub(gap, allowed);
        // The root of a negative number is NaN, and so is its sign.
        let root = graph.call(Function::Sqrt, left);
        nodes.push(graph.call(Function::Signum, root));
    }
    nodes
}

/// Returns the nodes with opposite signs.
fn opposite(reduced: &mut Reduced<'_>, nodes: impl Iterator<Item = Node>) -> Vec<Node> {
    nodes
        .map(|node| {
            let node = reduced.of(node);
            reduced.graph.neg(node)
        })
        .collect()
}

/// Returns the slopes of all rows at a pose.
pub(super) fn slopes(whole: &Whole, pose: Pose<'_>) -> Vec<Vec<f64>> {
    let nodes: Vec<Node> =
        whole.rows.iter().flat_map(|row| row.slopes.iter().map(|(_, slope)| *slope)).collect();
    let mut all = numbers(&whole.graph, &nodes, &whole.at(pose)).into_iter();
    whole.rows.iter().map(|row| all.by_ref().take(row.slopes.len()).collect()).collect()
}

/// Returns the values of nodes.
pub(crate) fn numbers(graph: &Graph, nodes: &[Node], source: &impl Source<f64>) -> Vec<f64> {
    let results = evaluate(graph, nodes, source);
    nodes.iter().map(|node| results.number(*node).unwrap_or(f64::NAN)).collect()
}

/// A pose as the input of a graph.
pub(crate) struct At<'a> {
    pub pose: Pose<'a>,
    pub laws: &'a [Law],
    /// The values of free parameters.
    pub free: &'a [f64],
}

impl Whole {
    /// Returns a pose of the gathered case.
    pub(super) fn at<'a>(&'a self, pose: Pose<'a>) -> At<'a> {
        At { pose, laws: &self.laws, free: &self.free.values }
    }
}

impl Source<f64> for At<'_> {
    fn input(&self, input: Input) -> f64 {
        match input {
            Input::State(column, _) | Input::Column(column) => {
                self.pose.q.get(column).copied().unwrap_or(f64::NAN)
            }
            Input::Time => self.pose.t,
            Input::Parameter(k) => self.free.get(k).copied().unwrap_or(f64::NAN),
            _ => f64::NAN,
        }
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        law_at(self.laws, law, x, order)
    }

    fn opaque(&self, _: usize, _: usize, _: Vec<f64>) -> f64 {
        f64::NAN
    }

    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        f64::NAN
    }
}

/// Returns a derivative of a law, by its index.
pub(super) fn law_at(laws: &[Law], law: usize, x: f64, order: u8) -> f64 {
    let at = |law: &Law| {
        if order == 4 { Some(law.fourth(x)) } else { law.jet(x).get(usize::from(order)).copied() }
    };
    laws.get(law).and_then(at).unwrap_or(f64::NAN)
}

#[cfg(test)]
impl Program {
    /// Returns all requested nodes, stage by stage.
    pub(crate) fn outputs(&self) -> Vec<Node> {
        let stages = [
            &self.correction,
            &self.left,
            &self.values,
            &self.corrections,
            &self.rates,
            &self.second_rates,
            &self.third_rates,
            &self.sides,
            &self.verify,
        ];
        stages.into_iter().flatten().chain(self.guards.iter().flatten()).copied().collect()
    }
}
