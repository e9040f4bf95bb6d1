//! Solves C_q x = b as nodes.
//!
//! First Kin eliminates the rows that determine a coordinate, from the last row to the first. Then
//! Kin solves the remaining blocks one after the other.
//!
//! Kin solves a block of up to three rows by cofactors. The determinant of such a block is both
//! guard and orientation, and no order of pivots can fail. For a larger block Kin chooses pivots by
//! Markowitz' count among the entries that are large at the guess, until two rows remain.

use std::collections::BTreeMap;

use kin_graph::{Graph, Node};

use super::blocks::blocks;
use super::cofactors::Cofactors;
use super::reduce::over;
use super::refusal::Obstacle;
use super::substitute::Order;

/// A pivot is at least this share of the largest entry in its row, at the guess. \[-\]
const THRESHOLD: f64 = 0.1;

/// The number of rows that remain of a block of more than [`Cofactors::MOST`] rows.
const LEFT: usize = 2;

/// An elimination may create [`FILL_FREE`] entries, plus [`FILL`] for each explicit row. A
/// mechanism with more entries is too large for one program.
const FILL: usize = 64;
const FILL_FREE: usize = 4096;

/// The entries of one row, by columns.
type Cells = BTreeMap<usize, Node>;

/// The elimination of C_q, by rows of the whole system and coordinates.
pub(crate) struct Elimination<'a> {
    /// The rows that determine a coordinate, and the torn coordinates.
    pub(super) order: &'a Order,
    /// For each row that determines a coordinate its other entries.
    pub(super) given: Vec<Vec<(usize, Node)>>,
    /// For each remaining row its entries in torn coordinates.
    pub(super) cells: Vec<Cells>,
    /// For each remaining row the rows that are subtracted from it, with their multipliers.
    pub(super) multipliers: Vec<Vec<(usize, Node)>>,
    /// The blocks of the remaining rows, in the order in which they are solved.
    pub(super) blocks: Vec<Block>,
}

/// Rows that are solved together.
pub(super) struct Block {
    /// The rows, by their indices among the remaining rows; the columns are coordinates.
    pub(super) rows: Vec<usize>,
    /// The pivots of a larger block, in order; empty for a block that cofactors solve.
    pub(super) pivots: Vec<Pivot>,
    /// The rows that remain after the pivots.
    pub(super) cofactors: Cofactors,
}

/// One pivot of a larger block.
pub(super) struct Pivot {
    pub(super) row: usize,
    pub(super) column: usize,
    /// One divided by the pivot.
    pub(super) inverse: Node,
    /// The pivot, which is a guard.
    pub(super) guard: Node,
    /// The multipliers of the rows below, as (row, multiplier).
    pub(super) lower: Vec<(usize, Node)>,
    /// The other entries of the pivot's row, as (column, entry).
    pub(super) upper: Vec<(usize, Node)>,
}

impl<'a> Elimination<'a> {
    /// Chooses the elimination. `slopes` contains the entries of each row of the whole system as
    /// nodes. `numbers` returns the values of nodes at the guess, in units of order 1 by
    /// coordinates.
    pub(crate) fn new(
        graph: &mut Graph,
        order: &'a Order,
        slopes: &[Vec<(usize, Node)>],
        sizes: &[f64],
        numbers: impl Fn(&Graph, &[Node]) -> Vec<f64>,
    ) -> Result<Self, Obstacle> {
        let mut all = Elimination {
            order,
            given: order
                .explicit
                .iter()
                .map(|own| {
                    slopes[own.row].iter().filter(|(k, _)| *k != own.column).copied().collect()
                })
                .collect(),
            cells: order.rows.iter().map(|row| slopes[*row].iter().copied().collect()).collect(),
            multipliers: vec![Vec::new(); order.rows.len()],
            blocks: Vec::new(),
        };
        all.take_given(graph)?;
        let pattern: Vec<Vec<usize>> =
            all.cells.iter().map(|cells| cells.keys().copied().collect()).collect();
        for (rows, columns) in blocks(&pattern).ok_or(Obstacle::SingularGuess)? {
            let block = all.block(graph, rows, columns, sizes, &numbers)?;
            all.blocks.push(block);
        }
        Ok(all)
    }

    /// Subtracts the rows that determine a coordinate from the remaining rows, the last one first:
    /// then no other such row contains its coordinate.
    fn take_given(&mut self, graph: &mut Graph) -> Result<(), Obstacle> {
        let mut readers: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (row, cells) in self.cells.iter().enumerate() {
            cells.keys().for_each(|column| readers.entry(*column).or_default().push(row));
        }
        let mut made = 0;
        let most = FILL_FREE + FILL * self.given.len();
        for (k, own) in self.order.explicit.iter().enumerate().rev() {
            for row in readers.remove(&own.column).unwrap_or_default() {
                let Some(cell) = self.cells[row].remove(&own.column) else { continue };
                let multiplier = over(graph, cell, own.factor);
                self.multipliers[row].push((k, multiplier));
                for &(column, slope) in &self.given[k] {
                    let change = graph.mul(multiplier, slope);
                    let known = self.cells[row].get(&column).copied();
                    let cell = match known {
                        Some(cell) => graph.sub(cell, change),
                        None => graph.neg(change),
                    };
                    if graph.is_zero(cell) {
                        self.cells[row].remove(&column);
                        continue;
                    }
                    self.cells[row].insert(column, cell);
                    if known.is_none() {
                        readers.entry(column).or_default().push(row);
                        made += 1;
                    }
                }
            }
            if made > most {
                return Err(Obstacle::Tangled);
            }
        }
        Ok(())
    }

    /// Chooses the pivots of a block by their values at the guess.
    fn block(
        &self,
        graph: &mut Graph,
        rows: Vec<usize>,
        columns: Vec<usize>,
        sizes: &[f64],
        numbers: &impl Fn(&Graph, &[Node]) -> Vec<f64>,
    ) -> Result<Block, Obstacle> {
        let mut active: BTreeMap<usize, Cells> = BTreeMap::new();
        let own = |(column, _): &(&usize, &Node)| columns.contains(column);
        for &row in &rows {
            active.insert(
                row,
                self.cells[row].iter().filter(own).map(|(column, cell)| (*column, *cell)).collect(),
            );
        }
        let mut pivots = Vec::new();
        let most = if rows.len() <= Cofactors::MOST { Cofactors::MOST } else { LEFT };
        let mut left = columns;
        while active.len() > most {
            let (row, column) =
                choose(graph, &active, sizes, numbers).ok_or(Obstacle::SingularGuess)?;
            left.retain(|known| *known != column);
            pivots.push(pivot(graph, &mut active, row, column));
        }
        let cofactors = Cofactors::new(graph, active.into_iter().collect(), left);
        Ok(Block { rows, pivots, cofactors })
    }

    /// Returns the guards, block by block: pivots and determinants. The signs of their products are
    /// the orientations.
    pub(crate) fn guards(&self) -> Vec<Vec<Node>> {
        let of = |block: &Block| {
            block
                .pivots
                .iter()
                .map(|pivot| pivot.guard)
                .chain([block.cofactors.determinant])
                .collect()
        };
        self.blocks.iter().map(of).collect()
    }

    /// Returns the sizes of the blocks.
    pub(super) fn sizes(&self) -> Vec<usize> {
        self.blocks.iter().map(|block| block.rows.len()).collect()
    }

    /// Returns x of C_q x = b, by coordinates; b is indexed by rows of the whole system.
    pub(crate) fn solve(&self, graph: &mut Graph, b: &[Node]) -> Vec<Node> {
        let mut x = vec![graph.zero(); b.len()];
        let rhs: Vec<Node> = (0..self.cells.len()).map(|row| self.rest(graph, row, b)).collect();
        for block in &self.blocks {
            self.solve_block(graph, block, &rhs, &mut x);
        }
        for (own, cells) in self.order.explicit.iter().zip(&self.given) {
            let sum = cells.iter().fold(b[own.row], |sum, (column, slope)| {
                let product = graph.mul(*slope, x[*column]);
                graph.sub(sum, product)
            });
            x[own.column] = over(graph, sum, own.factor);
        }
        x
    }

    /// Returns the right side of a remaining row.
    fn rest(&self, graph: &mut Graph, row: usize, b: &[Node]) -> Node {
        self.multipliers[row].iter().fold(b[self.order.rows[row]], |sum, (k, multiplier)| {
            let product = graph.mul(*multiplier, b[self.order.explicit[*k].row]);
            graph.sub(sum, product)
        })
    }

    fn solve_block(&self, graph: &mut Graph, block: &Block, rhs: &[Node], x: &mut [Node]) {
        let mut known: BTreeMap<usize, Node> = BTreeMap::new();
        for &row in &block.rows {
            let sum = self.cells[row].iter().filter(|(column, _)| !block.has(**column)).fold(
                rhs[row],
                |sum, (column, cell)| {
                    let product = graph.mul(*cell, x[*column]);
                    graph.sub(sum, product)
                },
            );
            known.insert(row, sum);
        }
        for pivot in &block.pivots {
            let own = known[&pivot.row];
            for (row, multiplier) in &pivot.lower {
                let product = graph.mul(*multiplier, own);
                let sum = graph.sub(known[row], product);
                known.insert(*row, sum);
            }
        }
        let b: Vec<Node> = block.cofactors.rows.iter().map(|row| known[row]).collect();
        for (column, node) in block.cofactors.columns.iter().zip(block.cofactors.solve(graph, &b)) {
            x[*column] = node;
        }
        for pivot in block.pivots.iter().rev() {
            let sum = pivot.upper.iter().fold(known[&pivot.row], |sum, (column, cell)| {
                let product = graph.mul(*cell, x[*column]);
                graph.sub(sum, product)
            });
            x[pivot.column] = graph.mul(sum, pivot.inverse);
        }
    }
}

impl Block {
    /// Returns true if the block solves for that coordinate.
    pub(super) fn has(&self, column: usize) -> bool {
        self.cofactors.columns.contains(&column)
            || self.pivots.iter().any(|pivot| pivot.column == column)
    }
}

/// Returns the next pivot of a block: the cheapest one that is not small in its row.
fn choose(
    graph: &Graph,
    active: &BTreeMap<usize, Cells>,
    sizes: &[f64],
    numbers: &impl Fn(&Graph, &[Node]) -> Vec<f64>,
) -> Option<(usize, usize)> {
    let all: Vec<(usize, usize, Node)> = active
        .iter()
        .flat_map(|(row, cells)| cells.iter().map(|(column, cell)| (*row, *column, *cell)))
        .collect();
    let nodes: Vec<Node> = all.iter().map(|(_, _, cell)| *cell).collect();
    let values: Vec<f64> = numbers(graph, &nodes)
        .iter()
        .zip(&all)
        .map(|(x, (_, column, _))| (x * sizes[*column]).abs())
        .collect();
    let (mut tops, mut counts): (BTreeMap<usize, f64>, BTreeMap<usize, usize>) = Default::default();
    for ((row, column, _), value) in all.iter().zip(&values) {
        let top = tops.entry(*row).or_default();
        *top = top.max(*value);
        *counts.entry(*column).or_default() += 1;
    }
    let cost = |row: &usize, column: &usize| (active[row].len() - 1) * (counts[column] - 1);
    let possible = all
        .iter()
        .zip(&values)
        .filter(|((row, _, _), value)| **value > 0.0 && **value >= THRESHOLD * tops[row]);
    let best = possible
        .min_by(|((r, c, _), x), ((s, d, _), y)| cost(r, c).cmp(&cost(s, d)).then(y.total_cmp(x)));
    best.map(|((row, column, _), _)| (*row, *column))
}

/// Eliminates a pivot from the active rows.
fn pivot(
    graph: &mut Graph,
    active: &mut BTreeMap<usize, Cells>,
    row: usize,
    column: usize,
) -> Pivot {
    let mut own = active.remove(&row).unwrap_or_default();
    let guard = own.remove(&column).unwrap_or_default();
    let one = graph.constant(1.0);
    let inverse = graph.div(one, guard);
    let mut lower = Vec::new();
    for (other, cells) in active.iter_mut() {
        let Some(cell) = cells.remove(&column) else { continue };
        let multiplier = graph.mul(cell, inverse);
        lower.push((*other, multiplier));
        for (k, upper) in &own {
            let change = graph.mul(multiplier, *upper);
            let cell = match cells.get(k) {
                Some(known) => graph.sub(*known, change),
                None => graph.neg(change),
            };
            cells.insert(*k, cell);
        }
    }
    Pivot { row, column, inverse, guard, lower, upper: own.into_iter().collect() }
}
