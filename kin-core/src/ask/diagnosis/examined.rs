//! Everything that Kin knows about a mechanism at a pose, before the report.

use super::generic::{Nearby, Walk};
use super::rank::Ranked;
use crate::coordinates::layout::Place;
use crate::outcome::verdict::{Change, Gap};
use crate::system::scaled::{Measures, Model};

/// Everything that Kin knows about a mechanism at a pose.
pub(super) struct Examined<'a> {
    pub walk: Walk<'a>,
    pub q: &'a [f64],
    pub t: f64,
    pub here: Ranked,
    pub nearby: Option<&'a Nearby>,
    pub gaps: &'a [Gap],
    /// Tested changes that would close the gaps.
    pub cures: &'a [Change],
    /// For each body or scalar coordinate the constraints that act on it, without norms of Euler
    /// parameters.
    pub acting: Vec<Vec<usize>>,
}

/// Returns for each body or scalar coordinate the constraints that act on it, without norms of
/// Euler parameters.
pub(super) fn acting(model: &Model<'_>) -> Vec<Vec<usize>> {
    let mut acting = vec![Vec::new(); model.layout.items.len()];
    let blocks = model.equations.blocks.iter().enumerate();
    for (k, block) in blocks.filter(|(_, block)| block.constraint.facts().kind != "euler_norm") {
        for argument in block.constraint.arguments() {
            if let Some(Place::Own { item, .. }) = model.layout.place(&argument.target) {
                acting[item].push(k);
            }
        }
    }
    acting.iter_mut().for_each(|blocks: &mut Vec<usize>| blocks.dedup());
    acting
}

impl<'a> Examined<'a> {
    pub(super) fn model(&self) -> &'a Model<'a> {
        self.walk.model
    }

    pub(super) fn measures(&self) -> &'a Measures {
        self.walk.measures
    }

    /// Returns true if an equation belongs to a constraint that cannot be satisfied.
    pub(super) fn open(&self, row: usize) -> bool {
        self.walk.open.contains(&row)
    }

    pub(super) fn nearby_rank(&self) -> usize {
        self.nearby.map_or(self.here.rank, |nearby| nearby.ranked.rank.max(self.here.rank))
    }

    /// Returns true if the k-th null vector of this side exists at nearby poses too.
    pub(super) fn persists(&self, k: usize, side: Side) -> bool {
        let lasting = match side {
            Side::Rows => self.model().m() - self.nearby_rank(),
            Side::Columns => self.model().n() - self.nearby_rank(),
        };
        k < lasting
    }
}

/// The side of a null vector: rows or columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    Rows,
    Columns,
}
