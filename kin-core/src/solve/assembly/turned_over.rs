//! Corrects joints on the wrong branch, with an axis turned by 180°.
//!
//! Kin turns over one body of the joint, and then solves C = 0 again.

use super::search::{Found, descend};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::numbers::algebra::EulerParameters;
use crate::system::scaled::Model;

/// Returns a position on the right branch everywhere, from a position on a wrong one, or `None` if
/// it finds none.
pub(crate) fn mended(
    model: Model<'_>,
    q: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    steps: usize,
) -> Option<Found> {
    let mut wrong = wrong(&model, q, t, active);
    let mut here = q.to_vec();
    while let Some(&block) = wrong.first() {
        let better = starts(&model, &here, block, &|_| true).into_iter().find_map(|start| {
            let found =
                descend(model, &start, t, active, false, steps).filter(|found| found.met)?;
            let left = self::wrong(&model, &found.place.q, t, active);
            (left.len() < wrong.len()).then_some((found, left))
        });
        let (found, left) = better?;
        if left.is_empty() {
            return Some(found);
        }
        (here, wrong) = (found.place.q, left);
    }
    None
}

/// Returns the constraints on the wrong branch.
pub(crate) fn wrong(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
) -> Vec<usize> {
    if model.equations.branches().is_empty() {
        return Vec::new();
    }
    let instant = model.equations.instant_at(t, q);
    let all = model.equations.branches().iter().copied();
    all.filter(|k| {
        active(model.equations.blocks[*k].rows().start)
            && model.equations.wrong_branch(*k, &instant).is_some()
    })
    .collect()
}

/// Returns true if one of these constraints is on the wrong branch.
pub(super) fn any(model: &Model<'_>, q: &[f64], t: f64, blocks: &[usize]) -> bool {
    if blocks.is_empty() {
        return false;
    }
    let instant = model.equations.instant_at(t, q);
    blocks.iter().any(|block| model.equations.wrong_branch(*block, &instant).is_some())
}

/// Returns a start of a search with bodies turned over until none of these constraints is on the
/// wrong branch, or no rotation helps. Newton's method usually keeps the side on which it begins.
/// Only bodies that `may_turn` accepts, by their first coordinate, are rotated.
pub(super) fn righted(
    model: &Model<'_>,
    mut q: Vec<f64>,
    t: f64,
    blocks: &[usize],
    may_turn: &dyn Fn(usize) -> bool,
) -> Vec<f64> {
    if blocks.is_empty() {
        return q;
    }
    let mut instant = model.equations.instant_at(t, &q);
    let mut wrong = |q: &[f64]| -> Vec<usize> {
        model.equations.set_position(q, &mut instant);
        let wrong = |block: &&usize| model.equations.wrong_branch(**block, &instant).is_some();
        blocks.iter().filter(wrong).copied().collect()
    };
    let mut left = wrong(&q);
    let mut next = 0;
    while let Some(&block) = left.get(next) {
        let turned = starts(model, &q, block, may_turn).into_iter().map(|q| (wrong(&q), q));
        match turned
            .min_by_key(|(wrong, _)| wrong.len())
            .filter(|(fewer, _)| fewer.len() < left.len())
        {
            Some(better) => {
                (left, q) = better;
                next = 0;
            }
            None => next += 1,
        }
    }
    q
}

/// Returns the pose with each body of a constraint turned over: a planar body by 180°, a spatial
/// body by 180° about each axis of its frame. One of these axes is far from the intended axis.
fn starts(
    model: &Model<'_>,
    q: &[f64],
    block: usize,
    may_turn: &dyn Fn(usize) -> bool,
) -> Vec<Vec<f64>> {
    let mut all = Vec::new();
    for argument in model.equations.blocks[block].constraint.arguments() {
        let Some(Place::Own { first, .. }) = model.layout.place(&argument.target) else { continue };
        if !may_turn(first) {
            continue;
        }
        match argument.target {
            Target::Planar(_) => {
                let mut turned = q.to_vec();
                turned[first + 2] += std::f64::consts::PI;
                all.push(turned);
            }
            Target::Spatial(_) => {
                let p =
                    EulerParameters::new(q[first + 3], q[first + 4], q[first + 5], q[first + 6]);
                for (x, y, z) in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)] {
                    let over = p.product(EulerParameters::new(0.0, x, y, z));
                    let mut turned = q.to_vec();
                    turned[first + 3..first + 7]
                        .copy_from_slice(&[over.e0, over.e1, over.e2, over.e3]);
                    all.push(turned);
                }
            }
            Target::Coord(..) => {}
        }
    }
    all
}
