//! Solves up to three equations in as many unknowns, by cofactors.

use std::collections::BTreeMap;

use kin_graph::{Graph, Node};

/// A small system, with its inverse as cofactors divided by the determinant.
pub(super) struct Cofactors {
    /// The rows, by their indices among the remaining rows.
    pub rows: Vec<usize>,
    /// The coordinates of the unknowns.
    pub columns: Vec<usize>,
    /// The determinant; it is a guard and gives the orientation.
    pub determinant: Node,
    /// One divided by the determinant.
    pub(super) inverse: Node,
    /// The adjugate, one list for each unknown.
    pub(super) adjugate: Vec<Vec<Node>>,
}

impl Cofactors {
    /// The largest number of rows that are solved by cofactors.
    pub(super) const MOST: usize = 3;

    /// Creates the system from rows with their entries by columns.
    pub(super) fn new(
        graph: &mut Graph,
        rows: Vec<(usize, BTreeMap<usize, Node>)>,
        columns: Vec<usize>,
    ) -> Self {
        let zero = graph.zero();
        let cell = |i: usize, j: usize| rows[i].1.get(&columns[j]).copied().unwrap_or(zero);
        let n = rows.len();
        let mut minor = |[a, b]: [usize; 2], [c, d]: [usize; 2]| {
            let one = graph.mul(cell(a, c), cell(b, d));
            let two = graph.mul(cell(a, d), cell(b, c));
            graph.sub(one, two)
        };
        let adjugate: Vec<Vec<Node>> = match n {
            0 => Vec::new(),
            1 => vec![vec![graph.constant(1.0)]],
            2 => {
                let b = graph.neg(cell(0, 1));
                let c = graph.neg(cell(1, 0));
                vec![vec![cell(1, 1), b], vec![c, cell(0, 0)]]
            }
            // The cyclic order gives the signs.
            _ => (0..3)
                .map(|j| {
                    (0..3)
                        .map(|i| minor([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]))
                        .collect()
                })
                .collect(),
        };
        let first = |graph: &mut Graph| {
            (0..n).fold(zero, |sum, j| {
                let product = graph.mul(cell(0, j), adjugate[j][0]);
                graph.add(sum, product)
            })
        };
        let one = graph.constant(1.0);
        let determinant = if n == 0 { one } else { first(graph) };
        let inverse = graph.div(one, determinant);
        Cofactors {
            rows: rows.iter().map(|(row, _)| *row).collect(),
            columns,
            determinant,
            inverse,
            adjugate,
        }
    }

    /// Returns the unknowns.
    pub(super) fn solve(&self, graph: &mut Graph, b: &[Node]) -> Vec<Node> {
        let zero = graph.zero();
        let mut unknown = |cofactors: &Vec<Node>| {
            let sum = cofactors.iter().zip(b).fold(zero, |sum, (cofactor, b)| {
                let product = graph.mul(*cofactor, *b);
                graph.add(sum, product)
            });
            graph.mul(sum, self.inverse)
        };
        self.adjugate.iter().map(&mut unknown).collect()
    }
}
