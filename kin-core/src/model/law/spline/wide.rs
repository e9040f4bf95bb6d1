//! A spline over many of its knots at once: what points and curvatures of each interval allow, in a few operations an interval.

use super::{Ends, Spline};
use crate::numbers::enclosure::{Interval, ONE, Series};

/// So many intervals are many.
const MANY: usize = 16;

/// Bounds of f, f′, f″ and f‴.
type Bounds = [Interval; 4];

impl Spline {
    /// The spline with bounds over an interval with many knots in it, of one period of it where it repeats; `None` where there are few.
    pub(super) fn over_many(&self, x: &Series) -> Option<Series> {
        let ([lo, hi], last) = (x.values(), self.table.len() - 1);
        let before = |x: f64| self.table.partition_point(|(knot, _)| *knot <= x);
        let (first, end) = (self.table[0].0, self.table[last].0);
        let (from, to) = (before(lo).saturating_sub(1), before(hi).min(last));
        if x.is_open() || to.saturating_sub(from) < MANY {
            return None;
        }
        let mut all = (from..to).map(|k| self.bounds(k)).reduce(hull)?;
        // Straight on from the ends; where it repeats, by rounding alone.
        let zero = Interval::from(0.0);
        for (knot, beyond) in [(0, lo.min(first) - first), (last, hi.max(end) - end)].into_iter().filter(|(_, beyond)| *beyond != 0.0) {
            let there = self.cubic(knot.min(last - 1), &Series::variable(Interval::from(self.table[knot].0), ONE, 2));
            let way = Interval::from(beyond).hull(zero);
            all = hull(all, [there.at(0) + there.at(1) * way, there.at(1), zero, zero]);
        }
        // Where a clamped one goes over into its line its curvature jumps.
        let jumps = matches!(self.ends, Ends::Clamped { .. }) && (lo <= first || hi >= end);
        let known = all.map(|bounds| [bounds.lo(), bounds.hi()]);
        Some(x.chain(&known[..if jumps { 3 } else { 4 }]))
    }

    /// What the spline can be over interval k: from the line through both points by no more than h²/8 times the largest curvature, its slope from
    /// that of the line by no more than h/2 times that.
    fn bounds(&self, k: usize) -> Bounds {
        let number = |x: f64| Interval::from(x);
        let ((x0, y0), (x1, y1)) = (self.table[k], self.table[k + 1]);
        let [m0, m1] = [k, k + 1].map(|k| number(self.curvature[k]) + Interval::ball(self.error));
        let (h, m) = (number(x1) - number(x0), m0.hull(m1));
        let most = number(m.mag()) * h;
        let bulge = Interval::ball((most * h).mag() / 8.0 * (1.0 + 1e-15));
        let slope = (number(y1) - number(y0)) / h + Interval::ball(most.mag() / 2.0);
        [number(y0).hull(number(y1)) + bulge, slope, m, (m1 - m0) / h]
    }
}

fn hull(a: Bounds, b: Bounds) -> Bounds {
    std::array::from_fn(|k| a[k].hull(b[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::law::Law;
    use crate::numbers::random::Random;

    /// Inside of these bounds are all jets, and they are not wider than a few times what is inside.
    #[test]
    fn bounds_over_many_knots_hold_every_jet() {
        let mut random = Random::new(7);
        let mut y = || random.number();
        let mut table: Vec<(f64, f64)> =
            (0..60).map(|k| (0.1 * f64::from(k) + 0.02 * y(), (0.3 * f64::from(k)).sin() + 0.1 * y())).collect();
        let clamped = Ends::Clamped { start: 0.3, end: -2.0 };
        for ends in [Ends::Natural, clamped, Ends::Periodic] {
            if let (Ends::Periodic, Some((_, first))) = (ends, table.first().copied()) {
                table.iter_mut().last().into_iter().for_each(|(_, y)| *y = first);
            }
            let law = Law::spline(&table, ends);
            for (lo, hi) in [(1.03, 4.4), (-1.0, 9.0), (0.0, 3.0), (3.0, 7.5), (-40.0, 70.0)] {
                let series = law.over(&Series::variable(Interval::new(lo, hi), ONE, 7)).unwrap();
                let known = if ends == clamped && (lo <= table[0].0 || hi >= table[59].0) { 3 } else { 4 };
                assert_eq!(series.len(), known, "{ends:?} {lo} {hi}");
                let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
                for k in 0..=4000 {
                    let jet = law.jet(lo + (hi - lo) * f64::from(k) / 4000.0);
                    for (order, factor) in [1.0, 1.0, 2.0, 6.0].into_iter().enumerate().take(known) {
                        let (bounds, f) = (series.at(order), jet[order] / factor);
                        assert!(bounds.lo() - 1e-12 <= f && f <= bounds.hi() + 1e-12, "{ends:?} {lo} {hi}: {order} {f} {bounds:?}");
                        seen[order] = [seen[order][0].min(f), seen[order][1].max(f)];
                    }
                }
                for (order, [least, most]) in seen.into_iter().enumerate().take(known) {
                    assert!(series.at(order).radius() <= 3.0 * (0.5 * (most - least) + 1e-9), "{ends:?} {lo} {hi}: {order}");
                }
            }
        }
    }

    #[test]
    fn few_knots_are_looked_at_one_by_one() {
        let table: Vec<(f64, f64)> = (0..40).map(|k| (f64::from(k), f64::from(k % 3))).collect();
        let spline = Spline::new(super::super::Points { table, ends: Ends::Natural });
        let over = |lo: f64, hi: f64| spline.over_many(&Series::variable(Interval::new(lo, hi), ONE, 7)).is_some();
        assert!(!over(2.5, 4.5) && !over(2.5, 16.5) && over(2.5, 19.5) && over(-5.0, 50.0));
    }
}
