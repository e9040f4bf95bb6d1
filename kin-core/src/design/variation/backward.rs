//! The gradient of one number by all names as outputs of a tape.

use kin_graph::differentiate::{Jet, Jets};
use kin_graph::{Graph, Input, Node};

use super::nodes::{Gathered, JetCells, NodeJet, moved, put_rates};
use crate::design::adjoint::Weights;
use crate::design::along::Prepared;
use crate::model::law::Law;
use crate::program::{Elimination, Guarded, Masks, Reduced, Summed, take};
use crate::solve::motion::Motion;

/// Adds the terms of all times to the gradient; gives the times that are left to the walk. `None` where there
/// is no tape, and all are left.
pub(in crate::design) fn adjoint(
    prepared: &Prepared<'_>,
    motion: &Motion,
    weights: &Weights,
    gradient: &mut [f64],
) -> Option<Vec<usize>> {
    let n = motion.names().len();
    let weight = |input| match input {
        Input::Parameter(k) if k >= n => Some(((&weights[k / n - 1][..], n), k % n)),
        _ => None,
    };
    tape(prepared, motion, weights)?.run(motion, &weight, Summed(gradient))
}

/// The tape, its elimination chosen at the first time. A coordinate that has no weight at any time is not
/// read.
pub(super) fn tape(prepared: &Prepared<'_>, motion: &Motion, weights: &Weights) -> Option<Guarded> {
    let n = motion.names().len();
    let weighs = |order: usize, j: usize| weights[order].iter().skip(j).step_by(n).any(|x| *x != 0.0);
    let AlongTime { graph, laws, by_q, by_p } =
        AlongTime::of(Gathered::of(prepared).ok()?.by_turns(prepared.system));
    let begin = (*motion.times().first()?, motion.q(0));
    let cell = |(column, jet): &(usize, NodeJet)| (*column, jet[0]);
    let cells: Vec<Vec<(usize, Node)>> = by_q.iter().map(|row| row.iter().map(cell).collect()).collect();
    Guarded::new(prepared.system, begin, (graph, laws), &cells, |graph, elimination, masks| {
        let zero = graph.zero();
        let mut weight = |order: usize, j: usize| {
            if weighs(order, j) { graph.input(Input::Parameter((order + 1) * n + j)) } else { zero }
        };
        let w = [0, 1, 2].map(|order| (0..n).map(|j| weight(order, j)).collect::<Vec<Node>>());
        let lambda = multipliers(graph, (elimination, masks), &by_q, w);
        by_p.iter().map(|by_p| term(graph, &lambda, by_p)).collect()
    })
}

/// C_q and C_p with two derivatives by time, as nodes of one graph.
struct AlongTime {
    graph: Graph,
    laws: Vec<Law>,
    /// By rows.
    by_q: Vec<JetCells>,
    /// By the names that are asked for.
    by_p: Vec<JetCells>,
}

impl AlongTime {
    fn of(Gathered { mut whole, by_q, by_p, .. }: Gathered) -> Self {
        let mut jets = Jets::along_curve(whole.n);
        let mut jet = |(k, node): (usize, Node)| {
            let Jet { first, second } = jets.of(&mut whole.graph, node);
            (k, [node, first, second])
        };
        let mut cells = |cells: Vec<(usize, Node)>| cells.into_iter().map(&mut jet).collect();
        let by_q: Vec<JetCells> = by_q.into_iter().map(&mut cells).collect();
        let by_p: Vec<JetCells> = by_p.into_iter().map(&mut cells).collect();
        let mut reduced = Reduced::of_all(&whole.graph);
        put_rates(&mut reduced, whole.n, whole.n);
        let (by_q, by_p) = (moved(&mut reduced, &by_q), moved(&mut reduced, &by_p));
        AlongTime { graph: reduced.graph, laws: whole.laws, by_q, by_p }
    }
}

/// λ₀, λ₁ and λ₂: Jᵀ λ₂ = F_q̈, Jᵀ λ₁ = F_q̇ − 2 J̇ᵀ λ₂, Jᵀ λ₀ = F_q − J̇ᵀ λ₁ − J̈ᵀ λ₂.
fn multipliers(
    graph: &mut Graph,
    (elimination, masks): (&Elimination<'_>, &mut Masks),
    by_q: &[JetCells],
    [mut w0, mut w1, w2]: [Vec<Node>; 3],
) -> [Vec<Node>; 3] {
    let mut solve = |graph: &mut Graph, w: &[Node]| {
        let w = masks.all(graph, w);
        let solved = elimination.solve_transposed(graph, &w);
        masks.all(graph, &solved)
    };
    let two = graph.constant(2.0);
    let second = solve(graph, &w2);
    for (cells, lambda) in by_q.iter().zip(&second) {
        let twice = graph.mul(two, *lambda);
        for (column, jet) in cells {
            take(graph, &mut w1[*column], jet[1], twice);
            take(graph, &mut w0[*column], jet[2], *lambda);
        }
    }
    let first = solve(graph, &w1);
    for (cells, lambda) in by_q.iter().zip(&first) {
        cells.iter().for_each(|(column, jet)| take(graph, &mut w0[*column], jet[1], *lambda));
    }
    [solve(graph, &w0), first, second]
}

/// −(λ₀ · C_p + λ₁ · Ċ_p + λ₂ · C̈_p)
fn term(graph: &mut Graph, lambda: &[Vec<Node>; 3], by_p: &[(usize, NodeJet)]) -> Node {
    let mut sum = graph.zero();
    for (row, jet) in by_p {
        lambda.iter().zip(jet).for_each(|(lambda, c_p)| take(graph, &mut sum, *c_p, lambda[*row]));
    }
    sum
}
