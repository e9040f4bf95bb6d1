//! Writes q_p, q̇_p and q̈_p of each requested name as outputs of a tape.
//!
//! With δ = q_p the variation of C by p is C_q δ + C_p, which is zero at all times. C_q δ is the
//! tangent of C along δ, and Kin differentiates this tangent by time directly. So Kin does not need
//! the many entries of C_q.

use kin_graph::differentiate::{Jet, Jets};
use kin_graph::{Graph, Input, Node};

use super::nodes::{Gathered, JetCells, moved, put_rates};
use crate::design::along::Prepared;
use crate::law::Law;
use crate::program::{Elimination, Guarded, IntoRows, Masks, Reduced, SELF};
use crate::solve::motion::Motion;

/// Fills the lists of each name, one for each order, with a row for each time of a motion. Returns
/// the times that remain for the computation time by time. Returns `None` if there is no tape; then
/// all times remain.
pub(in crate::design) fn forward(
    prepared: &Prepared<'_>,
    motion: &Motion,
    lists: Vec<&mut [f64]>,
) -> Option<Vec<usize>> {
    let n = motion.names().len();
    let sink = IntoRows(lists.into_iter().map(|list| (list, n)).collect());
    tape(prepared, motion)?.run(motion, &|_| None, sink)
}

/// Makes the tape; its elimination is chosen at the first time.
pub(super) fn tape(prepared: &Prepared<'_>, motion: &Motion) -> Option<Guarded> {
    let system = prepared.system;
    if system.is_redundant() || system.n_equations() != system.n_coordinates() {
        return None;
    }
    let varied = Varied::of(Gathered::of(prepared).ok()?.by_turns(prepared.system));
    let begin = (*motion.times().first()?, motion.q(0));
    let mut reduced = Reduced::of_all(&varied.graph);
    put_rates(&mut reduced, varied.n, 2 * varied.n);
    let zero = reduced.graph.zero();
    (0..varied.n).for_each(|j| reduced.put(Input::Rate(3 * varied.n + j, SELF), zero));
    let mut row = |row: &Vec<(usize, Node)>| -> Vec<(usize, Node)> {
        row.iter().map(|(column, cell)| (*column, reduced.of(*cell))).collect()
    };
    let cells: Vec<Vec<(usize, Node)>> = varied.by_q.iter().map(&mut row).collect();
    let by_p = moved(&mut reduced, &varied.by_p);
    let made = (std::mem::take(&mut reduced.graph), varied.laws.clone());
    Guarded::new(prepared.system, begin, made, &cells, |graph, elimination, masks| {
        std::mem::swap(graph, &mut reduced.graph);
        let mut solved = |by_p| varied.solved(&mut reduced, (elimination, masks), by_p).concat();
        let outputs = by_p.iter().flat_map(&mut solved).collect();
        std::mem::swap(graph, &mut reduced.graph);
        outputs
    })
}

/// C_q δ with two time derivatives, as nodes of one graph. In this graph δ_j is coordinate n + j,
/// and the acceleration of coordinate k is the velocity of coordinate 2 n + k.
struct Varied {
    graph: Graph,
    laws: Vec<Law>,
    n: usize,
    by_q: Vec<Vec<(usize, Node)>>,
    by_p: Vec<JetCells>,
    /// The first and second time derivatives of each row.
    rows: Vec<[Node; 2]>,
}

impl Varied {
    fn of(Gathered { mut whole, residuals, by_q, by_p }: Gathered) -> Self {
        let n = whole.n;
        let mut tangents = Jets::default();
        let tangents: Vec<Node> =
            residuals.into_iter().map(|row| tangents.first(&mut whole.graph, row)).collect();
        let mut varied = Reduced::of_all(&whole.graph);
        let zero = varied.graph.zero();
        varied.put(Input::TimeRate, zero);
        for j in 0..n {
            let delta = varied.graph.input(Input::State(n + j, SELF));
            varied.put(Input::Rate(j, SELF), delta);
        }
        let mut cells = |row: Vec<(usize, Node)>| -> Vec<(usize, Node)> {
            row.into_iter().map(|(k, cell)| (k, varied.of(cell))).collect()
        };
        let by_q = by_q.into_iter().map(&mut cells).collect();
        let by_p: Vec<Vec<(usize, Node)>> = by_p.into_iter().map(&mut cells).collect();
        let tangents: Vec<Node> = tangents.into_iter().map(|row| varied.of(row)).collect();
        let mut graph = varied.graph;
        let mut jets = Jets::along_curve(2 * n);
        let mut jet = |node: Node| {
            let Jet { first, second } = jets.of(&mut graph, node);
            [node, first, second]
        };
        let rows =
            tangents.into_iter().map(&mut jet).map(|[_, first, second]| [first, second]).collect();
        let mut jets =
            |own: Vec<(usize, Node)>| own.into_iter().map(|(k, node)| (k, jet(node))).collect();
        let by_p = by_p.into_iter().map(&mut jets).collect();
        Varied { graph, laws: whole.laws, n, by_q, by_p, rows }
    }

    /// Solves J q_p = −P, J q̇_p = −Ṗ − J̇ q_p, J q̈_p = −P̈ − 2 J̇ q̇_p − J̈ q_p.
    fn solved(
        &self,
        reduced: &mut Reduced<'_>,
        (elimination, masks): (&Elimination<'_>, &mut Masks),
        by_p: &JetCells,
    ) -> [Vec<Node>; 3] {
        let n = self.n;
        let zero = reduced.graph.zero();
        let mut found: [Vec<Node>; 3] = Default::default();
        for order in 0..3_usize {
            let mut b = vec![zero; n];
            if let Some(order) = order.checked_sub(1) {
                for (b, row) in b.iter_mut().zip(&self.rows) {
                    let own = reduced.of(row[order]);
                    *b = reduced.graph.neg(own);
                }
            }
            for (row, jet) in by_p {
                b[*row] = reduced.graph.sub(b[*row], jet[order]);
            }
            let b = masks.all(&mut reduced.graph, &b);
            let solved = elimination.solve(&mut reduced.graph, &b);
            found[order] = masks.all(&mut reduced.graph, &solved);
            // A derivative is zero until it is solved.
            let delta = |(j, node): (usize, &Node)| (Input::State(n + j, SELF), *node);
            let rate = |(j, node): (usize, &Node)| (Input::Rate(n + j, SELF), *node);
            match order {
                0 => {
                    let still = (0..n).map(|j| (Input::Rate(n + j, SELF), zero));
                    reduced.replace(found[0].iter().enumerate().map(delta).chain(still));
                }
                1 => reduced.replace(found[1].iter().enumerate().map(rate)),
                _ => {}
            }
        }
        found
    }
}
