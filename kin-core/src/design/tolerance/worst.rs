//! The corner of the box of tolerances at which a measure is worst.

use super::super::feature::Followed;
use super::source::Source;
use crate::ask::measure::Measure;

/// Corners that are tried one after the other.
const CORNERS: usize = 12;

/// The value at the corner that the derivatives call the largest (`side` 1) or the smallest (−1); on from
/// there as long as the derivatives at a corner call another one worse and it is. `None` where the mechanism
/// cannot be assembled at the first of them.
pub(super) fn corner<M: Measure>(
    followed: &Followed<'_, M>,
    sources: &[Source],
    names: &[String],
    slopes: &[f64],
    side: f64,
) -> Option<f64> {
    let at = |slopes: &[f64]| -> Vec<f64> {
        let mut moved = vec![0.0; names.len()];
        let worst = sources.iter().flat_map(|source| source.worst(slopes));
        worst.for_each(|(k, by)| moved[k] = side * by);
        moved
    };
    let value = |moved: &[f64]| {
        let system = followed.system.off(names.iter().zip(moved.iter().copied()))?;
        followed.value(&system).filter(|value| value.is_finite()).map(|value| (value, system))
    };
    let mut moved = at(slopes);
    let (mut best, mut system) = value(&moved)?;
    for _ in 0..CORNERS {
        let Ok(Some(slopes)) = followed.gradient(&system, names) else { break };
        let next = at(&slopes);
        if next == moved {
            break;
        }
        match value(&next) {
            Some((better, there)) if side * better > side * best => {
                (best, system, moved) = (better, there, next);
            }
            _ => break,
        }
    }
    Some(best)
}
