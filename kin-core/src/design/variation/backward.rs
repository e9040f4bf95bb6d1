//! The gradient of one number by all names as outputs of a tape.

use kin_graph::{Graph, Input, Node};

use super::nodes::{JetCells, NodeJet, Variation};
use crate::design::adjoint::Weights;
use crate::design::along::Prepared;
use crate::program::{Elimination, Guarded, Summed, take};
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
    Variation::of(prepared).ok()?.guarded(prepared.system, motion, |graph, elimination, [by_q, by_p]| {
        let zero = graph.zero();
        let mut weight = |order: usize, j: usize| {
            if weighs(order, j) { graph.input(Input::Parameter((order + 1) * n + j)) } else { zero }
        };
        let w = [0, 1, 2].map(|order| (0..n).map(|j| weight(order, j)).collect::<Vec<Node>>());
        let lambda = multipliers(graph, elimination, by_q, w);
        by_p.iter().map(|by_p| term(graph, &lambda, by_p)).collect()
    })
}

/// λ₀, λ₁ and λ₂: Jᵀ λ₂ = F_q̈, Jᵀ λ₁ = F_q̇ − 2 J̇ᵀ λ₂, Jᵀ λ₀ = F_q − J̇ᵀ λ₁ − J̈ᵀ λ₂.
fn multipliers(
    graph: &mut Graph,
    elimination: &Elimination<'_>,
    by_q: &[JetCells],
    [mut w0, mut w1, w2]: [Vec<Node>; 3],
) -> [Vec<Node>; 3] {
    let two = graph.constant(2.0);
    let second = elimination.solve_transposed(graph, &w2);
    for (cells, lambda) in by_q.iter().zip(&second) {
        let twice = graph.mul(two, *lambda);
        for (column, jet) in cells {
            take(graph, &mut w1[*column], jet[1], twice);
            take(graph, &mut w0[*column], jet[2], *lambda);
        }
    }
    let first = elimination.solve_transposed(graph, &w1);
    for (cells, lambda) in by_q.iter().zip(&first) {
        cells.iter().for_each(|(column, jet)| take(graph, &mut w0[*column], jet[1], *lambda));
    }
    [elimination.solve_transposed(graph, &w0), first, second]
}

/// −(λ₀ · C_p + λ₁ · Ċ_p + λ₂ · C̈_p)
fn term(graph: &mut Graph, lambda: &[Vec<Node>; 3], by_p: &[(usize, NodeJet)]) -> Node {
    let mut sum = graph.zero();
    for (row, jet) in by_p {
        lambda.iter().zip(jet).for_each(|(lambda, c_p)| take(graph, &mut sum, *c_p, lambda[*row]));
    }
    sum
}
