//! Solves C_qᵀ λ = b as nodes with the elimination of C_q: U and L exchange places, and the order
//! is reversed.

use kin_graph::{Graph, Node};

use super::cofactors::Cofactors;
use super::eliminate::{Block, Elimination};
use super::reduce::over;

impl Elimination<'_> {
    /// Returns λ of C_qᵀ λ = b, by rows of the whole system; b is indexed by coordinates.
    pub(crate) fn solve_transposed(&self, graph: &mut Graph, b: &[Node]) -> Vec<Node> {
        let (mut b, mut lambda) = (b.to_vec(), vec![graph.zero(); b.len()]);
        // No remaining row contains an explicit coordinate after multiples of the explicit rows are
        // subtracted.
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
    /// Returns λ of the block's rows. It uses up b of the block's columns.
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
    /// Returns λ of the block's rows, from b by its columns.
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

/// Replaces x by x − a b.
pub(crate) fn take(graph: &mut Graph, x: &mut Node, a: Node, b: Node) {
    let product = graph.mul(a, b);
    *x = graph.sub(*x, product);
}
