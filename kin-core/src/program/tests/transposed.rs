//! The transposed elimination solves C_qᵀ λ = b, whatever its blocks are.

use kin_graph::{Graph, Node};

use super::models::systems;
use crate::linspace;
use crate::numbers::random::Random;
use crate::program::Differences;
use crate::program::eliminate::Elimination;
use crate::program::gather::gather;
use crate::program::stages::{At, Pose, numbers, slopes};
use crate::program::substitute::substitute;
use crate::system::{System, scale};

/// The largest entry of C_qᵀ λ − b, of the sum of the sizes of its terms; λ by an elimination that
/// is chosen at another position. Nothing where a pivot has faded since.
fn left(system: &System, [chosen, here]: [(f64, &[f64]); 2], seed: u64) -> Option<f64> {
    let sizes = |(t, q): (f64, &[f64])| {
        let point = system.model().linearize(q, t).expect("finite");
        scale::sizes(system.layout(), system.equations(), &point.values, (q, t), system.links())
    };
    let own = sizes(chosen);
    let pose = Pose { t: chosen.0, q: chosen.1, sizes: &own };
    let mut whole = gather(system, false, Differences::default()).expect("gathers");
    let values = slopes(&whole, pose);
    let order = substitute(&mut whole, &values, pose.sizes);
    let cells: Vec<Vec<(usize, Node)>> = whole.rows.iter().map(|row| row.slopes.clone()).collect();
    let mut graph = whole.graph.clone();
    let laws = &whole.laws;
    let at =
        |graph: &Graph, nodes: &[Node], pose| numbers(graph, nodes, &At { pose, laws, free: &[] });
    let chosen = |graph: &Graph, nodes: &[Node]| at(graph, nodes, pose);
    let elimination =
        Elimination::new(&mut graph, &order, &cells, pose.sizes, chosen).expect("eliminates");
    let mut random = Random::new(seed);
    let b: Vec<f64> = (0..whole.n).map(|_| random.number()).collect();
    let nodes: Vec<Node> = b.iter().map(|b| graph.constant(*b)).collect();
    let lambda = elimination.solve_transposed(&mut graph, &nodes);
    let now = Pose { t: here.0, q: here.1, sizes: &own };
    let guards: Vec<Node> = elimination.guards().concat();
    let fades = |(now, mark): (f64, f64)| now.abs() < 0.01 * mark.abs();
    if at(&graph, &guards, now).into_iter().zip(at(&graph, &guards, pose)).any(fades) {
        return None;
    }
    let lambda = at(&graph, &lambda, now);
    let (mut sums, mut sizes): (Vec<f64>, Vec<f64>) =
        (b.iter().map(|b| -b).collect(), b.iter().map(|b| b.abs()).collect());
    for (row, lambda) in cells.iter().zip(lambda) {
        let nodes: Vec<Node> = row.iter().map(|(_, cell)| *cell).collect();
        for ((column, _), value) in row.iter().zip(at(&graph, &nodes, now)) {
            sums[*column] += value * lambda;
            sizes[*column] += (value * lambda).abs();
        }
    }
    let share = |(sum, size): (&f64, &f64)| if *size == 0.0 { 0.0 } else { sum.abs() / size };
    Some(sums.iter().zip(&sizes).map(share).fold(0.0, |m, x| if x <= m { m } else { x }))
}

#[test]
fn the_transpose_is_solved_with_the_elimination_of_the_matrix() {
    let mut solved = 0;
    let mut blocks = 0;
    for (name, system) in systems() {
        let Ok(motion) = system.run(linspace(0.0, 0.5, 26)) else { continue };
        if system.is_redundant() {
            continue;
        }
        blocks = blocks.max(
            system
                .compile()
                .map_or(0, |compiled| compiled.blocks().iter().copied().max().unwrap_or(0)),
        );
        for k in (0..motion.len()).step_by(5) {
            let poses = [0, k].map(|k| (motion.times()[k], motion.q(k)));
            let Some(left) = left(&system, poses, k as u64) else { continue };
            assert!(left < 1e-10, "{name} at {k}: {left:e}");
            solved += 1;
        }
    }
    // Given rows alone, cofactors, and pivots with cofactors after them.
    assert!(solved > 60 && blocks > 3, "{solved} {blocks}");
}
