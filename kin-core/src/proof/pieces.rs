//! Functions of pieces with interval bounds.
//!
//! That the pieces of a law meet is taken from the law: it is told by their bounds, which have to touch at the seam. Numbers that are rounded (where a
//! piece begins, which value it begins with) stand for what is meant by them; a jump that is more than rounding is seen.

use super::interval::{Interval, ONE};
use super::series::{ORDER, Series, UNKNOWN};

/// More pieces than these at once say nothing that is of use.
const MOST: usize = 64;

impl Interval {
    /// x but for rounding in numbers of a size.
    pub(crate) fn near(x: f64, size: f64) -> Self {
        Interval::from(x) + Interval::ball(16.0 * f64::EPSILON * size)
    }
}

/// A function of x that is `piece(k, x)` between seam k − 1 and seam k; seams increase.
pub(crate) fn piecewise(x: &Series, seams: &[f64], piece: &dyn Fn(usize, &Series) -> Option<Series>) -> Option<Series> {
    if x.len() == 0 {
        return Some(UNKNOWN);
    }
    let seam = |k: usize| seams.get(k).map(|seam| Interval::near(*seam, *seam));
    let values = x.value();
    let first = (0..seams.len()).collect::<Vec<_>>().partition_point(|k| seam(*k).is_some_and(|seam| seam.hi() < values.lo()));
    let mut whole: Option<Series> = None;
    for k in first..=seams.len() {
        let from = k.checked_sub(1).and_then(seam).map_or(f64::NEG_INFINITY, Interval::lo);
        let to = seam(k).map_or(f64::INFINITY, Interval::hi);
        let Some(part) = values.common(Interval::new(from, to)) else { break };
        if k - first > MOST {
            return Some(UNKNOWN);
        }
        let y = piece(k, &x.with_value(part))?;
        whole = Some(match whole.zip(k.checked_sub(1).and_then(seam)) {
            None => y,
            Some((before, seam)) => {
                let there = Series::variable(seam, ONE, ORDER + 1);
                before.joined(&y, piece(k - 1, &there)?.agreement(&piece(k, &there)?))
            }
        });
    }
    let y = whole?;
    Some(if x.is_constant() && y.len() > 0 { Series::constant(y.value()) } else { y })
}

/// A function of x that is the same after every period: `one` of what x is beyond the last beginning of one.
pub(crate) fn repeated(x: &Series, start: f64, period: f64, one: &dyn Fn(&Series) -> Option<Series>) -> Option<Series> {
    let local = x.plus(-start);
    let periods = local.value() / Interval::from(period);
    let (first, last) = (periods.lo().floor(), periods.hi().floor());
    if !(last - first <= MOST as f64 && first.abs() < 1e9 && last.abs() < 1e9) {
        return Some(UNKNOWN);
    }
    let seams: Vec<f64> = (1..=(last - first) as u32).map(|k| (first + f64::from(k)) * period).collect();
    piecewise(&local, &seams, &|k, x| {
        let begin = Interval::from(first + k as f64) * Interval::from(period);
        let local = *x - Series::constant(begin);
        // what lies beside the period by rounding is that of its end
        let size = begin.mag().max(period);
        let inside = Interval::near(0.0, size).hull(Interval::near(period, size));
        local.value().common(inside).map_or(Some(UNKNOWN), |inside| one(&local.with_value(inside)))
    })
}
