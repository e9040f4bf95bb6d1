//! C_qᵀ λ = b as nodes, by the same elimination: U and L change places, and everything goes the
//! other way.

use kin_graph::{Graph, Node};

use super::cofactors::Cofactors;
use super::eliminate::{Block, Elimination};
use super::reduce::over;

impl Elimination<'_> {
    /// λ of C_qᵀ λ = b, by rows of the whole; b by coordinates.
    pub(crate) fn solve_transposed(&self, graph: &mut Graph, b: &[Node]) -> Vec<Node> {
        let (mut b, mut lambda) = (b.to_vec(), vec![graph.zero(); b.len()]);
        // No row that is left has a coordinate that is given, once multiples of the given rows are
        // taken out.
        for (own, cells) in self.order.explicit.iter().zip(&self.given).rev() {
            let part = over(graph, b[own.column], own.factor);
            lambda[own.row] = part;
            cells.iter().for_each(|(column, slope)| take(graph, &mut b[*column], *slope, part));
        }
        for block in self.blocks.iter().rev() {
            let own = block.solve_transposed(graph, &mut b);
            for (row, part) in own {
                lambda[self.order.rows[row]] = part;
                let others = self.cells[row].iter().filter(|(column, _)| !block.has(**column));
                others.for_each(|(column, cell)| take(graph, &mut b[*column], *cell, part));
            }
        }
        for (row, multipliers) in self.multipliers.iter().enumerate() {
            let part = lambda[self.order.rows[row]];
            for (k, multiplier) in multipliers {
                take(graph, &mut lambda[self.order.explicit[*k].row], *multiplier, part);
            }
        }
        lambda
    }
}

impl Block {
    /// λ of its rows; b of its columns is used up.
    fn solve_transposed(&self, graph: &mut Graph, b: &mut [Node]) -> Vec<(usize, Node)> {
        let mut own: Vec<(usize, Node)> = Vec::new();
        for pivot in &self.pivots {
            let part = graph.mul(b[pivot.column], pivot.inverse);
            pivot.upper.iter().for_each(|(column, cell)| take(graph, &mut b[*column], *cell, part));
            own.push((pivot.row, part));
        }
        let rest: Vec<Node> = self.cofactors.columns.iter().map(|column| b[*column]).collect();
        own.extend(
            self.cofactors.rows.iter().copied().zip(self.cofactors.solve_transposed(graph, &rest)),
        );
        for (k, pivot) in self.pivots.iter().enumerate().rev() {
            for (row, multiplier) in &pivot.lower {
                let Some((_, part)) = own.iter().find(|(known, _)| known == row) else { continue };
                let part = *part;
                take(graph, &mut own[k].1, *multiplier, part);
            }
        }
        own
    }
}

impl Cofactors {
    /// λ of its rows, b by its columns.
    fn solve_transposed(&self, graph: &mut Graph, b: &[Node]) -> Vec<Node> {
        let zero = graph.zero();
        let mut part = |row: usize| {
            let sum = self.adjugate.iter().zip(b).fold(zero, |sum, (cofactors, b)| {
                let product = graph.mul(cofactors[row], *b);
                graph.add(sum, product)
            });
            graph.mul(sum, self.inverse)
        };
        (0..self.rows.len()).map(&mut part).collect()
    }
}

/// x −= a b
pub(crate) fn take(graph: &mut Graph, x: &mut Node, a: Node, b: Node) {
    let product = graph.mul(a, b);
    *x = graph.sub(*x, product);
}
