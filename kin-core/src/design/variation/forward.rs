//! q_p, q̇_p and q̈_p of each name as outputs of a tape.

use kin_graph::{Graph, Node};

use super::nodes::{JetCells, NodeJet, Variation};
use crate::design::along::Prepared;
use crate::program::{Elimination, Guarded, IntoRows, take};
use crate::solve::motion::Motion;

/// Fills the lists of each name, one an order, with a row for each time of a motion; gives the times that are
/// left to the walk. `None` where there is no tape, and all are left.
pub(in crate::design) fn forward(
    prepared: &Prepared<'_>,
    motion: &Motion,
    lists: Vec<&mut [f64]>,
) -> Option<Vec<usize>> {
    let n = motion.names().len();
    let sink = IntoRows(lists.into_iter().map(|list| (list, n)).collect());
    tape(prepared, motion)?.run(motion, &|_| None, sink)
}

/// The tape, its elimination chosen at the first time.
pub(super) fn tape(prepared: &Prepared<'_>, motion: &Motion) -> Option<Guarded> {
    Variation::of(prepared).ok()?.guarded(prepared.system, motion, |graph, elimination, [by_q, by_p]| {
        by_p.iter().flat_map(|by_p| solved(graph, elimination, (by_q, by_p)).concat()).collect()
    })
}

/// q_p, q̇_p and q̈_p: J q_p = −P, J q̇_p = −Ṗ − J̇ q_p, J q̈_p = −P̈ − 2 J̇ q̇_p − J̈ q_p.
fn solved(
    graph: &mut Graph,
    elimination: &Elimination<'_>,
    (by_q, by_p): (&[JetCells], &[(usize, NodeJet)]),
) -> [Vec<Node>; 3] {
    let mut found: [Vec<Node>; 3] = Default::default();
    let two = graph.constant(2.0);
    for order in 0..3 {
        let mut b = vec![graph.zero(); by_q.len()];
        for (row, jet) in by_p {
            b[*row] = graph.sub(b[*row], jet[order]);
        }
        for (b, cells) in b.iter_mut().zip(by_q) {
            for (column, [_, first, second]) in cells {
                if order == 1 {
                    take(graph, b, *first, found[0][*column]);
                }
                if order == 2 {
                    let twice = graph.mul(two, found[1][*column]);
                    take(graph, b, *first, twice);
                    take(graph, b, *second, found[0][*column]);
                }
            }
        }
        found[order] = elimination.solve(graph, &b);
    }
    found
}
