//! Computes the sign of the determinant of each block.
//!
//! Two solutions that meet at a singular position have different signs.
//!
//! C_q has diagonal blocks that follow one another (a crank, then each loop that the crank drives).
//! The determinant of C_q is the product of the determinants of the blocks. If two loops turn over
//! at the same time, the sign of the product does not change, but the signs of both blocks do. A
//! block is a set of pivots that reach one another through the structure, row by row. Its rows and
//! columns, and so its sign, do not depend on the choice of pivots.

use super::super::Linear;
use super::record::{Inverse, Pivot};

/// The data that determine the signs of determinants from the pivots of a replay.
#[derive(Debug, Default)]
pub(crate) struct Orientation {
    /// For each pivot that is not constant the place of one divided by it, and the index of its
    /// block.
    pub pivots: Vec<(u32, u32)>,
    /// For each block with such pivots, in the order of their first rows, true if the constant part
    /// of its determinant is negative.
    pub blocks: Vec<bool>,
    /// True if the constant part of the determinant of the whole matrix is negative.
    whole: bool,
}

impl Orientation {
    /// Computes the data from the pivots in their order. `constants` contains row, column and value
    /// of constant pivots, `places` row and column of all cells.
    pub(crate) fn new(
        pivots: &[Pivot],
        constants: &[(u32, u32, f64)],
        places: impl Iterator<Item = (u32, u32)>,
    ) -> Self {
        let mut negative = vec![None; pivots.len()];
        constants.iter().for_each(|&(row, _, value)| negative[row as usize] = Some(value < 0.0));
        let mut column_of = vec![0; pivots.len()];
        pivots.iter().for_each(|pivot| column_of[pivot.row as usize] = pivot.column as usize);
        let moving = |pivot: &&Pivot| negative[pivot.row as usize].is_none();
        let odd = |rows: &[usize]| {
            odd(rows, &column_of)
                ^ rows.iter().fold(false, |odd, row| odd ^ negative[*row].unwrap_or(false))
        };
        let mut found = Orientation {
            whole: odd(&(0..pivots.len()).collect::<Vec<_>>()),
            ..Orientation::default()
        };
        if pivots.iter().filter(moving).count() == 0 {
            return found;
        }
        let mut components = components(&column_of, places);
        components.retain(|rows| rows.iter().any(|row| negative[*row].is_none()));
        components.iter_mut().for_each(|rows| rows.sort_unstable());
        components.sort_unstable();
        let mut block_of = vec![0; pivots.len()];
        for (block, rows) in components.iter().enumerate() {
            rows.iter().for_each(|row| block_of[*row] = block as u32);
            found.blocks.push(odd(rows));
        }
        for pivot in pivots.iter().filter(moving) {
            if let Inverse::At(place) = pivot.inverse {
                found.pivots.push((place, block_of[pivot.row as usize]));
            }
        }
        found
    }
}

/// Returns true if the permutation of these rows to their columns, both in increasing order, is
/// odd.
fn odd(rows: &[usize], column_of: &[usize]) -> bool {
    let mut columns: Vec<usize> = rows.iter().map(|row| column_of[*row]).collect();
    columns.sort_unstable();
    let image = |k: usize| columns.partition_point(|column| *column < column_of[rows[k]]);
    let mut seen = vec![false; rows.len()];
    let mut odd = false;
    for first in 0..rows.len() {
        let mut k = first;
        while !std::mem::replace(&mut seen[k], true) {
            let next = image(k);
            odd ^= next != first;
            k = next;
        }
    }
    odd
}

/// Returns the sets of rows that reach one another. A row leads to the rows whose pivots are in its
/// columns (Kosaraju).
fn components(column_of: &[usize], places: impl Iterator<Item = (u32, u32)>) -> Vec<Vec<usize>> {
    let n = column_of.len();
    let mut row_of = vec![0; n];
    column_of.iter().enumerate().for_each(|(row, column)| row_of[*column] = row);
    let mut forward = vec![Vec::new(); n];
    let mut back = vec![Vec::new(); n];
    for (row, column) in places {
        let from = row as usize;
        let to = row_of[column as usize];
        forward[from].push(to);
        back[to].push(from);
    }
    let mut order = Vec::with_capacity(n);
    let mut seen = vec![false; n];
    (0..n).for_each(|first| visit(first, &forward, &mut seen, &mut order));
    seen.fill(false);
    let mut found = Vec::new();
    for first in order.into_iter().rev().collect::<Vec<_>>() {
        let mut component = Vec::new();
        visit(first, &back, &mut seen, &mut component);
        if !component.is_empty() {
            found.push(component);
        }
    }
    found
}

/// Appends the rows that are reachable from `first` and not visited, each after its successors.
fn visit(first: usize, next: &[Vec<usize>], seen: &mut [bool], order: &mut Vec<usize>) {
    if std::mem::replace(&mut seen[first], true) {
        return;
    }
    let mut stack = vec![(first, 0)];
    while let Some((node, k)) = stack.pop() {
        match next[node].get(k) {
            Some(&to) => {
                stack.push((node, k + 1));
                if !std::mem::replace(&mut seen[to], true) {
                    stack.push((to, 0));
                }
            }
            None => order.push(node),
        }
    }
}

impl Linear {
    /// Writes into `negative`, for each block whose determinant can change its sign, whether it is
    /// negative at the last factoring.
    pub(crate) fn orientation(&self, negative: &mut Vec<bool>) {
        negative.clear();
        let Some(recording) = &self.recording else { return };
        negative.extend_from_slice(&recording.orientation.blocks);
        for &(place, block) in &recording.orientation.pivots {
            negative[block as usize] ^= self.memory[place as usize] < 0.0;
        }
    }

    /// Returns true if the determinant of the whole matrix is negative at the last factoring.
    pub(crate) fn is_negative(&self) -> bool {
        let Some(recording) = &self.recording else { return false };
        let pivots = recording.orientation.pivots.iter();
        pivots.fold(recording.orientation.whole, |negative, &(place, _)| {
            negative ^ (self.memory[place as usize] < 0.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::random::Random;

    /// A matrix of that pattern with random numbers, and the sign of its determinant by nalgebra.
    fn signs(
        linear: &mut Linear,
        pattern: &[(usize, usize)],
        n: usize,
        random: &mut Random,
    ) -> bool {
        let mut dense = nalgebra::DMatrix::zeros(n, n);
        for (place, value) in pattern.iter().zip(linear.values_mut()) {
            *value = random.number();
            dense[*place] = *value;
        }
        dense.determinant() < 0.0
    }

    #[test]
    fn signs_are_those_of_the_determinant_whatever_pivots_were_chosen() {
        let pattern: Vec<(usize, usize)> = (0..25)
            .map(|k| (k / 5, k % 5))
            .filter(|(i, j)| (i + 2 * j) % 4 != 1 || i == j)
            .collect();
        let mut replayed = Linear::new(5, pattern.iter().copied().map(Some), &[]);
        let mut random = Random::new(7);
        let mut both = [0, 0];
        for _ in 0..200 {
            let negative = signs(&mut replayed, &pattern, 5, &mut random);
            let mut fresh = Linear::new(5, pattern.iter().copied().map(Some), &[]);
            fresh.values_mut().copy_from_slice(replayed.values());
            replayed.measure();
            if !replayed.factor() || !fresh.prepare() {
                continue;
            }
            assert_eq!((replayed.is_negative(), fresh.is_negative()), (negative, negative));
            let mut one = Vec::new();
            let mut other = Vec::new();
            replayed.orientation(&mut one);
            fresh.orientation(&mut other);
            assert_eq!(one, other);
            both[usize::from(negative)] += 1;
        }
        assert!(both[0] > 50 && both[1] > 50, "{both:?}");
    }

    #[test]
    fn blocks_that_turn_over_together_are_told_apart() {
        // Two blocks of two behind one another; what stands between them has no part in any
        // determinant.
        let pattern =
            [(0, 0), (0, 1), (1, 0), (1, 1), (0, 2), (1, 3), (2, 2), (2, 3), (3, 2), (3, 3)];
        let mut linear = Linear::new(4, pattern.map(Some), &[]);
        let mut of = |a: f64, b: f64| {
            linear.values_mut().copy_from_slice(&[1.0, a, 0.5, 1.0, 3.0, 4.0, 1.0, b, 0.5, 1.0]);
            linear.measure();
            assert!(linear.factor());
            let mut negative = Vec::new();
            linear.orientation(&mut negative);
            (negative, linear.is_negative())
        };
        assert_eq!(of(1.0, 1.0), (vec![false, false], false));
        assert_eq!(of(3.0, 3.0), (vec![true, true], false));
        assert_eq!(of(3.0, 1.0), (vec![true, false], true));
        assert_eq!(of(1.0, 3.0), (vec![false, true], true));
    }
}
