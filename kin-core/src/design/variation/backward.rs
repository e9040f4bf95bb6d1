//! Writes the gradient of one number by all requested names as outputs of a tape.

use kin_graph::differentiate::{Jet, Jets};
use kin_graph::{Function, Graph, Input, Node};

use super::nodes::{Gathered, JetCells, NodeJet, moved, put_rates};
use crate::design::adjoint::Weights;
use crate::design::agreement::{Agreement, TERMS};
use crate::design::along::Prepared;
use crate::design::solver::CONSISTENT;
use crate::law::Law;
use crate::program::{Asked, Elimination, Guarded, Masks, Reduced, Summed, take};
use crate::solve::motion::Motion;

/// Adds the terms of all times to the gradient, and returns the times that remain for the
/// computation time by time. Returns `None` if there is no tape; then all times remain.
pub(in crate::design) fn adjoint(
    prepared: &Prepared<'_>,
    agreement: Option<&Agreement>,
    motion: &Motion,
    weights: &Weights,
    gradient: &mut [f64],
) -> Option<Vec<usize>> {
    let n = motion.names().len();
    let weight = |input| match input {
        Input::Parameter(k) if k >= n => Some(((&weights[k / n - 1][..], n), k % n)),
        _ => None,
    };
    tape(prepared, agreement, motion, weights)?.run(motion, &weight, Summed(gradient))
}

/// Makes the tape; its elimination is chosen at the first time. The tape does not read coordinates
/// that have no weight at any time. For a redundant mechanism it returns a time at which redundant
/// equations may disagree.
pub(super) fn tape(
    prepared: &Prepared<'_>,
    agreement: Option<&Agreement>,
    motion: &Motion,
    weights: &Weights,
) -> Option<Guarded> {
    let n = motion.names().len();
    let m = prepared.system.n_equations();
    let rows: Vec<usize> = match agreement {
        Some(agreement) => agreement.rows.clone(),
        None => (0..m).collect(),
    };
    if rows.len() != n {
        return None;
    }
    let weighs =
        |order: usize, j: usize| weights[order].iter().skip(j).step_by(n).any(|x| *x != 0.0);
    let AlongTime { graph, laws, by_q, by_p } =
        AlongTime::of(Gathered::of(prepared).ok()?.by_turns(prepared.system));
    let begin = (*motion.times().first()?, motion.q(0));
    let cell = |(column, jet): &(usize, NodeJet)| (*column, jet[0]);
    let cells: Vec<Vec<(usize, Node)>> =
        rows.iter().map(|row| by_q[*row].iter().map(cell).collect()).collect();
    Guarded::limited(prepared.system, begin, (graph, laws), &cells, |graph, elimination, masks| {
        let zero = graph.zero();
        let mut weight = |order: usize, j: usize| {
            if weighs(order, j) { graph.input(Input::Parameter((order + 1) * n + j)) } else { zero }
        };
        let w = [0, 1, 2].map(|order| (0..n).map(|j| weight(order, j)).collect::<Vec<Node>>());
        let mut solver = Transposed { elimination, masks, rows: &rows, by_q: &by_q };
        let lambda = solver.multipliers(graph, vec![zero; m], w);
        let outputs = by_p.iter().map(|by_p| term(graph, &lambda, by_p)).collect();
        let limited = agreement.map_or_else(Vec::new, |agreement| {
            let shares = agreement.shares.iter().map(|share| graph.constant(*share)).collect();
            let nu = solver.multipliers(graph, shares, [(); 3].map(|()| vec![zero; n]));
            let names = by_p.iter().zip(&agreement.limits);
            names.flat_map(|(by_p, limits)| limited(graph, &nu, by_p, limits)).collect()
        });
        Asked { limited, outputs }
    })
}

/// C_q and C_p with two time derivatives, as nodes of one graph.
struct AlongTime {
    graph: Graph,
    laws: Vec<Law>,
    /// C_q, one list for each row, with columns.
    by_q: Vec<JetCells>,
    /// C_p, one list for each requested name, with rows.
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
        let by_q = moved(&mut reduced, &by_q);
        let by_p = moved(&mut reduced, &by_p);
        AlongTime { graph: reduced.graph, laws: whole.laws, by_q, by_p }
    }
}

/// A solver for multipliers, as nodes.
struct Transposed<'a> {
    elimination: &'a Elimination<'a>,
    masks: &'a mut Masks,
    /// The rows in use, by their indices in the elimination.
    rows: &'a [usize],
    by_q: &'a [JetCells],
}

impl Transposed<'_> {
    /// Returns λ₀, λ₁ and λ₂ with Jᵀ λ₂ = F_q̈, Jᵀ λ₁ = F_q̇ − 2 J̇ᵀ λ₂, Jᵀ λ₀ = F_q − J̇ᵀ λ₁ − J̈ᵀ
    /// λ₂. `fixed` is λ₂ in the rows that are not in use, and zero in the others.
    fn multipliers(
        &mut self,
        graph: &mut Graph,
        fixed: Vec<Node>,
        [mut w0, mut w1, mut w2]: [Vec<Node>; 3],
    ) -> [Vec<Node>; 3] {
        let by_q = self.by_q;
        for (cells, lambda) in by_q.iter().zip(&fixed) {
            cells.iter().for_each(|(column, jet)| take(graph, &mut w2[*column], jet[0], *lambda));
        }
        let two = graph.constant(2.0);
        let second = self.solved(graph, &w2, fixed);
        for (cells, lambda) in by_q.iter().zip(&second) {
            let twice = graph.mul(two, *lambda);
            for (column, jet) in cells {
                take(graph, &mut w1[*column], jet[1], twice);
                take(graph, &mut w0[*column], jet[2], *lambda);
            }
        }
        let none = vec![graph.zero(); by_q.len()];
        let first = self.solved(graph, &w1, none.clone());
        for (cells, lambda) in by_q.iter().zip(&first) {
            cells.iter().for_each(|(column, jet)| take(graph, &mut w0[*column], jet[1], *lambda));
        }
        [self.solved(graph, &w0, none), first, second]
    }

    /// Returns λ with Jᵀ λ = w in the rows in use; in the others λ stays as it is.
    fn solved(&mut self, graph: &mut Graph, w: &[Node], mut lambda: Vec<Node>) -> Vec<Node> {
        let w = self.masks.all(graph, w);
        let solved = self.elimination.solve_transposed(graph, &w);
        let solved = self.masks.all(graph, &solved);
        self.rows.iter().zip(solved).for_each(|(row, own)| lambda[*row] = own);
        lambda
    }
}

/// Returns −(λ₀ · C_p + λ₁ · Ċ_p + λ₂ · C̈_p).
fn term(graph: &mut Graph, lambda: &[Vec<Node>; 3], by_p: &[(usize, NodeJet)]) -> Node {
    let mut sum = graph.zero();
    for (row, jet) in by_p {
        lambda.iter().zip(jet).for_each(|(lambda, c_p)| take(graph, &mut sum, *c_p, lambda[*row]));
    }
    sum
}

/// Returns g, ġ and g̈ of `agreement.rs`, each with its limit: a small share of its terms plus the
/// bound of rounding.
fn limited(
    graph: &mut Graph,
    nu: &[Vec<Node>; 3],
    by_p: &[(usize, NodeJet)],
    limits: &[f64; 3],
) -> Vec<(Node, Node)> {
    let zero = graph.zero();
    let share = graph.constant(CONSISTENT);
    let mut all = Vec::new();
    for (terms, limit) in TERMS.into_iter().zip(limits) {
        let mut sum = zero;
        let mut size = zero;
        for (row, jet) in by_p {
            for (factor, of, by) in terms {
                let factor = graph.constant(*factor);
                let product = graph.mul(nu[*of][*row], jet[*by]);
                let term = graph.mul(factor, product);
                let own = graph.call(Function::Abs, term);
                (sum, size) = (graph.add(sum, term), graph.add(size, own));
            }
        }
        if sum != zero {
            let terms = graph.mul(share, size);
            let limit = graph.constant(*limit);
            all.push((sum, graph.add(terms, limit)));
        }
    }
    all
}
