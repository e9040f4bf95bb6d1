//! Computes bounds of a spline over many knots at once, with a few operations for each interval.

use super::{Ends, Spline};
use crate::numbers::enclosure::{Interval, ONE, Series};

/// From this number of intervals on, the coarser bounds below replace those of each polynomial.
const MANY: usize = 16;

/// Bounds of f, f′, f″ and f‴.
type Bounds = [Interval; 4];

impl Spline {
    /// Returns bounds of the spline over an interval with many knots, or `None` if it has few
    /// knots. For a spline that repeats the interval is in one period.
    pub(super) fn over_many(&self, x: &Series) -> Option<Series> {
        let [lo, hi] = x.values();
        let last = self.table.len() - 1;
        let before = |x: f64| self.table.partition_point(|(knot, _)| *knot <= x);
        let first = self.table[0].0;
        let end = self.table[last].0;
        let from = before(lo).saturating_sub(1);
        let to = before(hi).min(last);
        if x.is_open() || to.saturating_sub(from) < MANY {
            return None;
        }
        let mut all = (from..to).map(|k| self.bounds(k)).reduce(hull)?;
        // Outside a table that does not repeat the spline is straight. In a table that repeats only
        // rounding leads outside.
        let zero = Interval::from(0.0);
        for (knot, beyond) in [(0, lo.min(first) - first), (last, hi.max(end) - end)]
            .into_iter()
            .filter(|(_, beyond)| *beyond != 0.0)
        {
            let there = self.cubic(
                knot.min(last - 1),
                &Series::variable(Interval::from(self.table[knot].0), ONE, 2),
            );
            // Its beginning is in hand.
            all = hull(
                all,
                [there.at(0) + there.at(1) * Interval::from(beyond), there.at(1), zero, zero],
            );
        }
        // The curvature jumps where a clamped spline becomes a straight line.
        let jumps = matches!(self.ends, Ends::Clamped { .. }) && (lo <= first || hi >= end);
        let known = all.map(|bounds| [bounds.lo(), bounds.hi()]);
        Some(x.chain(&known[..if jumps { 3 } else { 4 }]))
    }

    /// Returns bounds of the spline over interval k. The spline differs from the straight line
    /// through both points by at most h²/8 times the largest curvature. Its slope differs from that
    /// of the line by at most h/2 times the largest curvature.
    fn bounds(&self, k: usize) -> Bounds {
        let number = |x: f64| Interval::from(x);
        let (x0, y0) = self.table[k];
        let (x1, y1) = self.table[k + 1];
        let [m0, m1] = [k, k + 1].map(|k| number(self.curvature[k]) + Interval::ball(self.error));
        let h = number(x1) - number(x0);
        let m = m0.hull(m1);
        let most = number(m.mag()) * h;
        let bulge = Interval::ball((most * h).mag() / 8.0);
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
    use crate::law::Law;
    use crate::numbers::random::Random;

    /// Inside of these bounds are all jets, and they are not wider than a few times what is inside.
    #[test]
    fn bounds_over_many_knots_hold_every_jet() {
        let mut random = Random::new(7);
        let mut y = || random.number();
        let mut table: Vec<(f64, f64)> = (0..60)
            .map(|k| (0.1 * f64::from(k) + 0.02 * y(), (0.3 * f64::from(k)).sin() + 0.1 * y()))
            .collect();
        let clamped = Ends::Clamped { start: 0.3, end: -2.0 };
        for ends in [Ends::Natural, clamped, Ends::Periodic] {
            if let (Ends::Periodic, Some((_, first))) = (ends, table.first().copied()) {
                table.iter_mut().last().into_iter().for_each(|(_, y)| *y = first);
            }
            let law = Law::spline(&table, ends);
            for (lo, hi) in [(1.03, 4.4), (-1.0, 9.0), (0.0, 3.0), (3.0, 7.5), (-40.0, 70.0)] {
                let series = law.over(&Series::variable(Interval::new(lo, hi), ONE, 7)).unwrap();
                let known =
                    if ends == clamped && (lo <= table[0].0 || hi >= table[59].0) { 3 } else { 4 };
                assert_eq!(series.len(), known, "{ends:?} {lo} {hi}");
                let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
                for k in 0..=4000 {
                    let jet = law.jet(lo + (hi - lo) * f64::from(k) / 4000.0);
                    for (order, factor) in [1.0, 1.0, 2.0, 6.0].into_iter().enumerate().take(known)
                    {
                        let bounds = series.at(order);
                        let f = jet[order] / factor;
                        assert!(
                            bounds.lo() - 1e-12 <= f && f <= bounds.hi() + 1e-12,
                            "{ends:?} {lo} {hi}: {order} {f} {bounds:?}"
                        );
                        seen[order] = [seen[order][0].min(f), seen[order][1].max(f)];
                    }
                }
                for (order, [least, most]) in seen.into_iter().enumerate().take(known) {
                    assert!(
                        series.at(order).radius() <= 3.0 * (0.5 * (most - least) + 1e-9),
                        "{ends:?} {lo} {hi}: {order}"
                    );
                }
            }
        }
    }

    #[test]
    fn few_knots_are_looked_at_one_by_one() {
        let table: Vec<(f64, f64)> = (0..40).map(|k| (f64::from(k), f64::from(k % 3))).collect();
        let spline = Spline::new(super::super::Points { table, ends: Ends::Natural });
        let over = |lo: f64, hi: f64| {
            spline.over_many(&Series::variable(Interval::new(lo, hi), ONE, 7)).is_some()
        };
        assert!(!over(2.5, 4.5) && !over(2.5, 16.5) && over(2.5, 17.5) && over(-5.0, 50.0));
    }

    /// Each interval by itself: all jets inside, and as wide as the formulas say.
    #[test]
    fn bounds_of_each_interval() {
        let mut random = Random::new(9);
        let mut x = -3.0;
        let table: Vec<(f64, f64)> = (0..40)
            .map(|_| {
                x += 0.05 + random.number().abs();
                (x, random.number() * 10_f64.powf(2.0 * random.number()))
            })
            .collect();
        for ends in [Ends::Natural, Ends::Clamped { start: 30.0, end: -2.0 }] {
            let spline = Spline::new(super::super::Points { table: table.clone(), ends });
            for k in 0..39 {
                let (x0, y0) = table[k];
                let (x1, y1) = table[k + 1];
                let bounds = spline.bounds(k);
                for place in (0..=100).map(|j| x0 + (x1 - x0) * f64::from(j) / 100.0) {
                    for (f, bounds) in spline.inside(k, place).into_iter().zip(bounds) {
                        let slack = 1e-12 * (1.0 + bounds.mag());
                        assert!(
                            bounds.lo() - slack <= f && f <= bounds.hi() + slack,
                            "{ends:?} {k} {place}: {f} {bounds:?}"
                        );
                    }
                }
                let h = x1 - x0;
                let [m0, m1] = [k, k + 1].map(|k| spline.curvature[k]);
                let most = h * m0.abs().max(m1.abs());
                let widths = [
                    0.5 * (y1 - y0).abs() + h * most / 8.0,
                    0.5 * most,
                    0.5 * (m1 - m0).abs(),
                    0.0,
                ];
                for (bounds, width) in bounds.into_iter().zip(widths) {
                    let room =
                        1e-11 * (1.0 + bounds.mag()) + 10.0 * spline.error * (1.0 / h + h * h);
                    assert!(
                        bounds.radius() <= width * (1.0 + 1e-9) + room,
                        "{ends:?} {k}: {width} {bounds:?}"
                    );
                }
            }
        }
    }

    /// An interval that ends at knots takes nothing from beyond them but the curvature's jump of a
    /// clamped end; straight on there is no curvature.
    #[test]
    fn bounds_that_end_at_knots() {
        let parabola = |x: f64| x * x - 3.0 * x;
        let table: Vec<(f64, f64)> = (0..40)
            .map(|k| (0.5 * f64::from(k) - 3.0, parabola(0.5 * f64::from(k) - 3.0)))
            .collect();
        let first = -3.0;
        let end = 16.5;
        let law = Law::spline(&table, Ends::Clamped { start: -9.0, end: 30.0 });
        let over =
            |lo: f64, hi: f64| law.over(&Series::variable(Interval::new(lo, hi), ONE, 7)).unwrap();
        for (lo, hi, known) in [
            (-2.75, 16.25, 4),
            (first, 16.25, 3),
            (-2.75, end, 3),
            (first, end, 3),
            (-3.25, 10.0, 3),
            (0.0, 20.0, 3),
        ] {
            let series = over(lo, hi);
            assert_eq!(series.len(), known, "{lo} {hi}");
            let curvature = Interval::new(if lo < first || hi > end { 0.0 } else { 1.0 }, 1.0);
            assert!(
                (series.at(2).lo() - curvature.lo()).abs() < 1e-9
                    && (series.at(2).hi() - 1.0).abs() < 1e-9,
                "{lo} {hi} {:?}",
                series.at(2)
            );
            let slope = |x: f64| 2.0 * x.clamp(first, end) - 3.0;
            assert!(
                (series.at(1).lo() - slope(lo)).abs() <= 1.01
                    && (series.at(1).hi() - slope(hi)).abs() <= 1.01,
                "{lo} {hi} {:?}",
                series.at(1)
            );
            let value =
                |x: f64| if x > end { parabola(end) + 30.0 * (x - end) } else { parabola(x) };
            assert!(
                series.at(0).hi() >= value(hi) - 1e-9
                    && series.at(0).hi() <= value(hi.max(end.min(hi + 0.5))).max(18.0) + 0.3,
                "{lo} {hi} {:?}",
                series.at(0)
            );
        }
        // The bounds over an interval do not contain the pieces before its first knot.
        let mut wild = table.clone();
        wild[3].1 = 1e6;
        let calm = Spline::new(super::super::Points { table: wild, ends: Ends::Natural });
        let from = |lo: f64| {
            calm.over_many(&Series::variable(Interval::new(lo, 12.0), ONE, 7)).unwrap().at(2).mag()
        };
        assert!(from(calm.table[14].0) < 0.5 * from(calm.table[14].0 - 1e-9));
    }
}
