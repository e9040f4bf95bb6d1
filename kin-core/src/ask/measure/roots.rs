//! Where a measure, or its rate, is zero between the times of a motion: safeguarded Newton steps on poses that are solved anew.

use super::Measure;
use super::between::step_of;
use crate::model::error::Result;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// Numbers below this share of the largest are zero but for rounding.   \[-\]
const ROUNDING: f64 = 1e-13;

/// Steps of one search: Newton takes a handful, halving at most about sixty.
const STEPS: usize = 100;

/// A quantity passes a value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Crossing {
    /// When.   \[s\]
    pub t: f64,
    /// Whether it is below the value before and above it after.
    pub rises: bool,
}

/// What is to be zero: x less a level, or ẋ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Zero {
    Value(f64),
    Rate,
}

/// A zero: the time, x and ẋ there, and whether what is zero grows from below to above in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    pub t: f64,
    pub x: f64,
    pub rises: bool,
}

/// A measure of a motion, on the grid and between its times.
pub(super) struct Search<'a, M> {
    system: &'a System,
    motion: &'a Motion,
    what: &'a M,
    pub grid: Quantity,
    zero: Zero,
    /// Numbers below this are zero.
    small: f64,
}

/// One end of an interval: the time, what is to be zero there, and its derivative.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    f: f64,
    slope: f64,
}

impl<'a, M: Measure> Search<'a, M> {
    pub(super) fn new(system: &'a System, motion: &'a Motion, what: &'a M, zero: Zero) -> Result<Self> {
        system.own(motion)?;
        let grid = what.of(system, motion)?;
        let [x, rates, ..] = grid.orders();
        let largest = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let small = match zero {
            Zero::Value(level) => ROUNDING * largest(x).max(level.abs()),
            Zero::Rate => ROUNDING * largest(rates),
        };
        Ok(Search { system, motion, what, grid, zero, small })
    }

    /// All zeros in the order of the motion. Of a rest only the first time is told, and only where the sign differs on either side.
    pub(super) fn all(&self) -> Result<Vec<Root>> {
        let mut roots = Vec::new();
        let mut last: Option<(usize, End)> = None;
        for k in 0..self.motion.len() {
            let end = self.on_grid(k);
            if end.f.abs() <= self.small {
                continue;
            }
            match last {
                Some((before, from)) if from.f.signum() != end.f.signum() => match k - before {
                    1 | 2 => roots.push(self.root(from, end)?),
                    _ => roots.push(self.told(self.on_grid(before + 1).t, from, self.grid.value.values()[before + 1])),
                },
                Some((before, from)) if before + 1 == k => roots.extend(self.hidden(from, end)?.into_iter().flatten()),
                _ => {}
            }
            last = Some((k, end));
        }
        Ok(roots)
    }

    fn on_grid(&self, k: usize) -> End {
        let at = |all: &[f64]| all.get(k).copied().unwrap_or(f64::NAN);
        let [x, rate, second, _] = self.grid.orders();
        self.end(self.motion.times()[k], [at(x), at(rate), at(second)])
    }

    fn end(&self, t: f64, [x, rate, second]: [f64; 3]) -> End {
        match self.zero {
            Zero::Value(level) => End { t, f: x - level, slope: rate },
            Zero::Rate => End { t, f: rate, slope: second },
        }
    }

    /// x, ẋ and ẍ at a time between those of the grid. Turns are counted on from the time of the grid before it.
    fn between(&self, t: f64) -> Result<[f64; 3]> {
        let k = step_of(self.motion.times(), t).unwrap_or(0);
        let mut two = Motion::new(self.system, 2);
        let known = self.motion.times()[k];
        self.system.add_between(self.motion, k, known, &mut two)?;
        self.system.add_between(self.motion, k, t, &mut two)?;
        let here = self.what.of(self.system, &two)?;
        let [x, rate, second, _] = here.orders();
        let last = |all: &[f64]| all.last().copied().unwrap_or(f64::NAN);
        let turned = self.grid.value.values()[k] - x.first().copied().unwrap_or(f64::NAN);
        Ok([last(x) + turned, last(rate), last(second)])
    }

    /// Two zeros within a step over which the sign stays: where the cubic through values and slopes at the ends dips to the other side, and
    /// so does the pose solved there.
    fn hidden(&self, from: End, to: End) -> Result<Option<[Root; 2]>> {
        let h = to.t - from.t;
        let Some(s) = dip([from.f, h * from.slope], [to.f, h * to.slope]) else { return Ok(None) };
        let t = from.t + s * h;
        let middle = self.end(t, self.between(t)?);
        if middle.f.abs() <= self.small || middle.f.signum() == from.f.signum() {
            return Ok(None);
        }
        Ok(Some([self.root(from, middle)?, self.root(middle, to)?]))
    }

    /// The zero between two times with different signs.
    fn root(&self, from: End, to: End) -> Result<Root> {
        let (mut low, mut high) = (from, to);
        let mut t = low.t + (high.t - low.t) * (low.f / (low.f - high.f));
        for _ in 0..STEPS {
            let x = self.between(t)?;
            let here = self.end(t, x);
            let step = here.f / here.slope;
            let near = 2.0 * f64::EPSILON * t.abs().max((to.t - from.t).abs());
            if here.f == 0.0 || step.abs() <= near || (high.t - low.t).abs() <= near || !here.f.is_finite() {
                return Ok(self.told(t, from, x[0]));
            }
            if here.f.signum() == low.f.signum() {
                low = here
            } else {
                high = here
            }
            let newton = t - step;
            let inside = (newton - low.t) * (newton - high.t) < 0.0;
            t = if inside { newton } else { 0.5 * (low.t + high.t) };
        }
        Ok(self.told(t, from, self.between(t)?[0]))
    }

    /// A zero at time t, where `from` lies before it in the order of the motion.
    fn told(&self, t: f64, from: End, x: f64) -> Root {
        Root { t, x, rises: (from.f < 0.0) == (from.t <= t) }
    }
}

/// Where the cubic with these values and slopes at s = 0 and s = 1, of one sign, has its dip towards zero, if it crosses it.
fn dip([f0, g0]: [f64; 2], [f1, g1]: [f64; 2]) -> Option<f64> {
    if g0 * f0 >= 0.0 || g1 * f1 <= 0.0 {
        return None;
    }
    let cubic = 2.0 * (f0 - f1) + g0 + g1;
    let square = -3.0 * (f0 - f1) - 2.0 * g0 - g1;
    // 3 c s² + 2 b s + g0 = 0; the slope changes sign once between the ends.
    let root = (square * square - 3.0 * cubic * g0).max(0.0).sqrt();
    let candidates = [(-square + root) / (3.0 * cubic), g0 / (-square - root), g0 / (-square + root), (-square - root) / (3.0 * cubic)];
    let s = candidates
        .into_iter()
        .find(|s| *s > 0.0 && *s < 1.0 && ((3.0 * cubic * s + 2.0 * square) * s + g0).abs() < 1e-6 * (g0.abs() + g1.abs()))?;
    let value = f0 + s * (g0 + s * (square + s * cubic));
    (value * f0 < 0.0).then_some(s)
}

impl System {
    /// The times at which a measure of a motion passes a value, as exactly as poses can be solved, in the order of the motion.
    ///
    /// `what` is a name, a coordinate or a function of a motion ([`Measure`]). Two crossings within one step of the grid are found where values
    /// and rates at its ends show them. Errors: those of [`System::measure`] and [`System::at`].
    pub fn crossings(&self, motion: &Motion, what: impl Measure, value: f64) -> Result<Vec<Crossing>> {
        let roots = Search::new(self, motion, &what, Zero::Value(value))?.all()?;
        Ok(roots.into_iter().map(|Root { t, rises, .. }| Crossing { t, rises }).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dip_below_zero_within_a_step() {
        // (s − 0.3)(s − 0.7) at 0 and 1
        let s = dip([0.21, -1.0], [0.21, 1.0]).unwrap();
        assert!((s - 0.5).abs() < 1e-12);
        let s = dip([-0.21, 1.0], [-0.21, -1.0]).unwrap();
        assert!((s - 0.5).abs() < 1e-12);
        // s² + 1 stays above, and so does a line
        assert_eq!((dip([1.0, -0.1], [1.0, 0.1]), dip([1.0, -0.5], [0.5, -0.5])), (None, None));
        // (s − 0.2)(s − 0.4)(s + 1)
        let s = dip([0.08, -0.52], [0.96, 2.0 * 1.4 + 0.48 - 0.0]);
        assert!(s.is_some_and(|s| s > 0.2 && s < 0.45), "{s:?}");
    }

    /// The crossings of a level by a law, on a grid.
    fn crossings(law: crate::Law, times: &[f64], level: f64) -> Vec<(f64, bool)> {
        let mut m = crate::Mechanism::new("slider");
        let x = m.length("x", law.at(times[0])).unwrap();
        m.add("motor", crate::joints::drivers::drive(x, law)).unwrap();
        let system = m.build().unwrap();
        let motion = system.run(times).unwrap();
        let all = system.crossings(&motion, x, level).unwrap();
        all.into_iter().map(|Crossing { t, rises }| (t, rises)).collect()
    }

    /// What is zero at a time of the grid is told once and at that time, where the sign differs on either side; at the ends and where it only touches
    /// zero it is not.
    #[test]
    fn zeros_at_times_of_the_grid() {
        let line = crate::Law::linear(-2.0, 1.0);
        for times in [vec![0.0, 1.0, 2.0, 3.0], vec![3.0, 2.0, 1.0, 0.0], vec![1.0, 2.0, 2.5]] {
            let found = crossings(line.clone(), &times, 0.0);
            assert!(found.len() == 1 && (found[0].0 - 2.0).abs() < 1e-12 && found[0].1, "{times:?}: {found:?}");
        }
        assert_eq!(crossings(line.clone(), &[2.0, 3.0, 4.0], 0.0), []);
        assert_eq!(crossings(line, &[0.0, 1.0, 2.0], 0.0), []);
        // (t − 2)², at a time of the grid
        let touching = crate::Law::polynomial(&[4.0, -4.0, 1.0]);
        assert_eq!(crossings(touching, &[0.0, 1.0, 2.0, 3.0], 0.0), []);
        // down through 0 at 1, up again at 3
        let bowl = crate::Law::polynomial(&[3.0, -4.0, 1.0]);
        let found = crossings(bowl, &[0.0, 1.0, 2.0, 3.0, 4.0], 0.0);
        let near = |k: usize, t: f64, rises: bool| found.get(k).is_some_and(|f| (f.0 - t).abs() < 1e-12 && f.1 == rises);
        assert!(found.len() == 2 && near(0, 1.0, false) && near(1, 3.0, true), "{found:?}");
    }

    /// Of a rest on the level the first time is told, if the sign differs on either side.
    #[test]
    fn rests_on_the_level() {
        let rise = |first: f64, second: f64| {
            let up = crate::Law::cycloidal(first, 1.0);
            crate::Law::constant(-1.0) + up + crate::Law::cycloidal(second, 1.0).shifted(4.0)
        };
        let times: Vec<f64> = (0..=12).map(|k| 0.5 * f64::from(k)).collect();
        let found = crossings(rise(1.0, 1.0), &times, 0.0);
        assert!(found.len() == 1 && (found[0].0 - 1.0).abs() < 1e-12 && found[0].1, "{found:?}");
        // back to where it came from
        assert_eq!(crossings(rise(1.0, -0.5), &times, 0.0), []);
        // one time of the grid within the rest, two, and three
        for (count, step) in [(1, 2.5), (2, 1.5), (3, 1.0)] {
            let times: Vec<f64> = (0..=6).map(|k| step * f64::from(k)).filter(|t| *t < 8.0).collect();
            let resting = times.iter().filter(|t| (1.0..=4.0).contains(*t)).count();
            let found = crossings(rise(1.0, 1.0), &times, 0.0);
            assert!(found.len() <= 1 && resting >= count.min(1), "{found:?}");
            assert!(found.iter().all(|found| (1.0..=4.0).contains(&found.0) && found.1), "{step}: {found:?}");
            assert_eq!(found.len(), 1, "{step}");
        }
    }
}
