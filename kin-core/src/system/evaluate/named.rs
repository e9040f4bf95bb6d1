//! Names the rows of a system in errors.

use super::{Bad, Block, Equations, Instant};
use crate::coordinates::layout::Layout;
use crate::model::blame::{Culprit, Term};
use crate::outcome::error::{Error, FailureKind};

impl Equations {
    /// Returns the constraint of a global row, and its local row.
    pub(crate) fn block_of(&self, row: usize) -> Option<(&Block, usize)> {
        let block = self.blocks.get(self.block_index(row)?)?;
        Some((block, row - block.rows().start))
    }

    /// Returns the index of the constraint of a global row.
    pub(crate) fn block_index(&self, row: usize) -> Option<usize> {
        let index = self.blocks.partition_point(|block| block.rows().end <= row);
        (index < self.blocks.len()).then_some(index)
    }

    /// Returns the name of the equation in a global row, such as `A.x`.
    pub(crate) fn equation(&self, row: usize) -> String {
        self.block_of(row).map(|(block, local)| block.equation(local)).unwrap_or_default()
    }

    /// Returns the constraints that can be satisfied on the wrong branch.
    pub(crate) fn branches(&self) -> &[usize] {
        &self.asked.branches
    }

    /// Returns what is wrong with a position in which a constraint is on the wrong branch, if it
    /// is.
    pub(crate) fn wrong_branch(&self, block: usize, instant: &Instant) -> Option<&str> {
        let block = self.blocks.get(block)?;
        block.constraint.wrong_branch(&self.at(block, instant))
    }

    /// Returns the first constraint on the wrong branch, such as one with an axis turned by 180°.
    #[inline]
    pub(crate) fn first_wrong(&self, instant: &Instant) -> Option<usize> {
        self.asked
            .branches
            .iter()
            .copied()
            .find(|block| self.wrong_branch(*block, instant).is_some())
    }

    /// Builds the error for a constraint on the wrong branch.
    pub(crate) fn closes_wrong(&self, block: usize, layout: &Layout, instant: &Instant) -> Error {
        let (name, kind) = self
            .blocks
            .get(block)
            .map(|block| (block.name.as_str(), block.constraint.facts().kind))
            .unwrap_or_default();
        let reason = self.wrong_branch(block, instant).unwrap_or_default().to_string();
        let constraint = name.to_string();
        let kind = kind.to_string();
        FailureKind::WrongBranch { constraint, kind, reason }.at(instant.t, &layout.words)
    }

    /// Builds the error for a value that is not finite at an instant.
    pub(crate) fn not_finite(&self, bad: Bad, layout: &Layout, instant: &Instant) -> Error {
        let found = self.block_of(bad.row);
        let culprit = found.map(|(block, row)| {
            let rates = self.rates(block, &instant.rates);
            Culprit::of(
                block,
                layout,
                self.at(block, instant),
                rates,
                row,
                Term::named(bad.quantity),
            )
        });
        let kind = FailureKind::NotFinite {
            constraint: found.map(|(block, _)| block.name.clone()).unwrap_or_default(),
            row: found.map(|(block, local)| block.row(local).to_string()).unwrap_or_default(),
            quantity: bad.quantity,
            culprit: culprit.unwrap_or_default(),
        };
        kind.at(instant.t, &layout.words)
    }
}
