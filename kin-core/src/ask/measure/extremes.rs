//! Finds the extremes of a measure: dead centres, strokes, time ratios.

use super::Measure;
use super::roots::{Root, Search, Zero};
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::System;

/// The relative difference that counts as rounding. A motion whose first and last value and
/// derivative differ by less returns to its start; values that differ by less are one dead centre;
/// a smaller derivative at an end is zero. \[-\]
const CLOSED: f64 = 1e-9;

/// A time at which a measure has an extreme: the measure changes direction, or the run begins or
/// ends.
///
/// Only [`Extremes::max`] and [`Extremes::min`] return an end of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Extreme {
    /// The time. \[s\]
    pub t: f64,
    /// The value, in the unit of the measure.
    pub value: f64,
    /// True for a maximum, false for a minimum.
    pub is_max: bool,
}

/// The extremes of a measure over a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    name: String,
    unit: String,
    all: Vec<Extreme>,
    /// The time and value at the first time and at the last time.
    ends: [(f64, f64); 2],
    /// For each end whether the measure rests there.
    rests: [bool; 2],
    closed: bool,
    /// The name of the unit of time.
    time_unit: String,
}

/// Two times of an extreme coincide within this share of the motion's span, because a written time
/// has lost some digits. \[-\]
const SAME_TIME: f64 = 1e-9;

impl Extreme {
    /// Creates a maximum from its time \[s\] and value, for a maximum that you already know.
    ///
    /// Calls that accept an extreme, such as [`crate::design::Sensitivities::extreme`], find the
    /// extreme on the motion by its time and kind.
    pub fn maximum(t: f64, value: f64) -> Extreme {
        Extreme { t, value, is_max: true }
    }

    /// Creates a minimum from its time \[s\] and value, for a minimum that you already know.
    pub fn minimum(t: f64, value: f64) -> Extreme {
        Extreme { t, value, is_max: false }
    }
}

impl System {
    /// Returns the extremes of a measure over a motion: the times at which the derivative of the
    /// measure changes its sign.
    ///
    /// Kin solves the pose at each extreme, so times and values have the accuracy of the solver.
    ///
    /// The extremes of the angle of an output link are its dead centres:
    /// `system.extremes(&motion, rocker.theta())?`. The argument `what` is a name, a coordinate or
    /// a function of a motion ([`Measure`]).
    ///
    /// The grid of times may be coarse. If the motion between two times is not smooth enough (a law
    /// that returns, a crank with several revolutions), Kin solves more poses until quintic
    /// polynomials through neighbouring poses follow the motion. Kin can miss oscillations below a
    /// millionth of the measure's range. If the measure rests before it changes direction, the
    /// extreme is at the beginning of the rest.
    ///
    /// Errors: those of [`System::measure`] and [`System::at`]; the motion has more events between
    /// two times than Kin can follow.
    pub fn extremes(&self, motion: &Motion, what: impl Measure) -> Result<Extremes> {
        self.own_as_it_is(motion)?;
        let fine = self.fine(motion, Some(&what))?;
        let search = Search::new(self, &fine, &what, Zero::Rate)?;
        let extreme = |Root { t, x, rises }: Root| Extreme { t, value: x, is_max: !rises };
        let all = search.all()?.into_iter().map(extreme).collect();
        let x = search.grid.value.values();
        let rate = search.grid.rate.values();
        let end = |all: &[f64]| [all.first(), all.last()].map(|x| x.copied().unwrap_or(f64::NAN));
        let times = end(motion.times());
        let values = end(x);
        let comes_back = |all: &[f64]| {
            let size = all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            matches!(all, [first, .., last] if (first - last).abs() <= CLOSED * size)
        };
        let fastest = rate.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let rests = end(rate).map(|rate| rate.abs() <= CLOSED * fastest);
        Ok(Extremes {
            name: search.grid.value.name().to_string(),
            unit: search.grid.value.unit().to_string(),
            all,
            ends: [(times[0], values[0]), (times[1], values[1])],
            rests,
            closed: comes_back(x) && comes_back(rate),
            time_unit: motion.unit_words().time().to_string(),
        })
    }
}

impl Extremes {
    /// Returns the name of the measure.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the unit of the measure.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Returns all extremes in the order of the motion.
    pub fn all(&self) -> &[Extreme] {
        &self.all
    }

    /// Returns the maximum with the largest value, at an extreme or at an end of the run.
    pub fn max(&self) -> Extreme {
        self.best(true, |value, other| value > other)
    }

    /// Returns the minimum with the smallest value, at an extreme or at an end of the run.
    pub fn min(&self) -> Extreme {
        self.best(false, |value, other| value < other)
    }

    /// Returns the largest minus the smallest value: the stroke of a slider, the swing of a rocker.
    pub fn stroke(&self) -> f64 {
        self.max().value - self.min().value
    }

    /// Returns the time of the slower stroke divided by that of the quicker one, over one full
    /// cycle. \[-\]
    ///
    /// The ratio is at least 1. The result is `None` if the run contains no full cycle. One stroke
    /// leads from the largest to the smallest value, the other stroke leads back. Each stroke ends
    /// when the measure first reaches the value. A rest is part of the stroke after the rest.
    ///
    /// A run contains a full cycle in two cases. In the first case the run reaches the largest, the
    /// smallest and again the largest value, or the reverse. An end of the run at which the measure
    /// rests also counts as an extreme. In the second case the run returns to its start in value
    /// and derivative. If the run contains several cycles, the result is for the first cycle.
    pub fn time_ratio(&self) -> Option<f64> {
        let [(from, _), (to, _)] = self.ends;
        let centres = self.dead_centres();
        let strokes = match centres[..] {
            // The run may begin after the value of the first dead centre.
            [_, a, b, c, ..] | [a, b, c] => [(b.t - a.t).abs(), (c.t - b.t).abs()],
            [a, b] if self.closed => {
                let one = (b.t - a.t).abs();
                [one, (to - from).abs() - one]
            }
            _ => return None,
        };
        let [one, other] = strokes;
        Some(one.max(other) / one.min(other)).filter(|ratio| ratio.is_finite())
    }

    /// Returns the largest and the smallest value alternately, each where it is first reached after
    /// the other.
    fn dead_centres(&self) -> Vec<Extreme> {
        let max = self.max().value;
        let min = self.min().value;
        let same = CLOSED * (max - min) + 1e-12 * max.abs().max(min.abs());
        let end = |k: usize| self.rests[k].then_some(self.ends[k]);
        let all = self.all.iter().map(|extreme| (extreme.t, extreme.value));
        let all = end(0).into_iter().chain(all).chain(end(1));
        let mut found: Vec<Extreme> = Vec::new();
        for (t, value) in all {
            let is_max = value >= max - same;
            let is_dead = (is_max || value <= min + same) && max - min > 2.0 * same;
            if is_dead && found.last().is_none_or(|last| last.is_max != is_max) {
                found.push(Extreme { t, value, is_max });
            }
        }
        found
    }

    /// Returns the extreme at the time of a given one, and true if the measure changes direction
    /// there. The largest and the smallest value at the ends of the run are included. Errors: there
    /// is no extreme of this kind at that time.
    pub(crate) fn find(&self, extreme: &Extreme) -> Result<(Extreme, bool)> {
        let Extreme { t, is_max, .. } = *extreme;
        let best = if is_max { self.max() } else { self.min() };
        let far = |one: &Extreme| (one.t - t).abs();
        let turns =
            self.all.iter().copied().filter(|one| one.is_max == is_max).map(|one| (one, true));
        let nearest = turns.chain([(best, false)]).min_by(|a, b| far(&a.0).total_cmp(&far(&b.0)));
        let (nearest, turns) = nearest.unwrap_or((best, false));
        let [(first, _), (last, _)] = self.ends;
        if far(&nearest) <= SAME_TIME * (last - first).abs().max(t.abs()) {
            return Ok((nearest, turns));
        }
        let word = if is_max { "maximum" } else { "minimum" };
        let s = &self.time_unit;
        let reason = format!(
            "the measure has no {word} at t = {t} {s}. The nearest {word} is at t = {} {s}. Choose an extreme that `system.extremes` returns",
            nearest.t
        );
        Err(Error::InvalidConstraint {
            constraint: self.name.clone(),
            kind: "extreme".to_string(),
            reason,
        })
    }

    /// Returns the extreme such that no other is better.
    fn best(&self, is_max: bool, better: impl Fn(f64, f64) -> bool) -> Extreme {
        let [first, last] = self.ends.map(|(t, value)| Extreme { t, value, is_max });
        let extremes = self.all.iter().map(|extreme| Extreme { is_max, ..*extreme });
        extremes
            .chain([last])
            .fold(first, |best, next| if better(next.value, best.value) { next } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Extremes at times with values, the ends, and whether it comes back.
    fn extremes(all: &[(f64, f64)], ends: [(f64, f64); 2], closed: bool) -> Extremes {
        let all = all
            .iter()
            .map(|(t, value)| Extreme { t: *t, value: *value, is_max: *value > 0.0 })
            .collect();
        let rests = [false; 2];
        let [name, unit, time_unit] = ["slide", "m", "s"].map(str::to_string);
        Extremes { name, unit, all, ends, rests, closed, time_unit }
    }

    /// Value and time.
    fn value_and_time(extreme: Extreme) -> (f64, f64) {
        (extreme.value, extreme.t)
    }

    /// Of equal values the first one counts, be it an extreme or an end.
    #[test]
    fn the_largest_and_the_smallest_value() {
        let found = extremes(
            &[(1.0, 2.0), (2.0, -3.0), (3.0, 2.0), (4.0, -3.0)],
            [(0.0, 0.5), (5.0, 0.0)],
            false,
        );
        assert_eq!(
            (
                value_and_time(found.max()),
                value_and_time(found.min()),
                found.stroke(),
                found.name(),
                found.unit()
            ),
            ((2.0, 1.0), (-3.0, 2.0), 5.0, "slide", "m")
        );
        let ends = extremes(&[(1.0, 2.0), (2.0, -3.0)], [(0.0, 2.0), (5.0, -3.0)], false);
        assert_eq!(
            (value_and_time(ends.max()), value_and_time(ends.min())),
            ((2.0, 0.0), (-3.0, 2.0))
        );
        let ends = extremes(&[(1.0, 2.0), (2.0, -3.0)], [(0.0, -4.0), (5.0, 3.0)], false);
        assert_eq!(
            (value_and_time(ends.max()), value_and_time(ends.min()), ends.stroke()),
            ((3.0, 5.0), (-4.0, 0.0), 7.0)
        );
    }

    /// Whichever stroke comes first, forwards and backwards, and wherever time begins.
    #[test]
    fn the_slower_stroke_beside_the_quicker_one() {
        for sign in [1.0, -1.0] {
            let at = |t: f64| sign * (t + 2.0);
            let closed = |a: f64, b: f64, first: f64| {
                extremes(&[(at(a), first), (at(b), -first)], [(at(0.0), 0.0), (at(8.0), 0.0)], true)
            };
            for (a, b, ratio) in [(1.0, 3.0, 3.0), (1.0, 7.0, 3.0), (2.0, 6.0, 1.0)] {
                assert_eq!(
                    (closed(a, b, 1.0).time_ratio(), closed(a, b, -1.0).time_ratio()),
                    (Some(ratio), Some(ratio))
                );
            }
            let open = |all: &[(f64, f64)]| {
                extremes(
                    &all.iter().map(|(t, x)| (at(*t), *x)).collect::<Vec<_>>(),
                    [(at(0.0), 1.0), (at(20.0), -1.0)],
                    false,
                )
            };
            assert_eq!(open(&[(1.0, 2.0), (2.0, -2.0), (6.0, 2.0)]).time_ratio(), Some(4.0));
            assert_eq!(
                open(&[(1.0, 2.0), (7.0, -2.0), (9.0, 2.0), (15.0, -2.0)]).time_ratio(),
                Some(3.0)
            );
            // Lesser extremes are on the way; a value that is reached again counts where it was
            // first.
            let lesser = [(1.0, 2.0), (2.0, -1.0), (3.0, 1.0), (5.0, -2.0), (6.0, 2.0)];
            assert_eq!(open(&lesser).time_ratio(), Some(4.0));
            let twice = [(1.0, 2.0), (2.0, 1.0), (3.0, 2.0), (5.0, -2.0), (6.0, 2.0)];
            assert_eq!(open(&twice).time_ratio(), Some(4.0));
            // Less than a cycle, values that drift, no time between two.
            assert_eq!(open(&[(1.0, 2.0), (7.0, -2.0)]).time_ratio(), None);
            assert_eq!(
                open(&[(1.0, 2.0), (2.0, -2.0), (6.0, 2.1), (7.0, -3.0)]).time_ratio(),
                None
            );
            assert_eq!(open(&[(1.0, 2.0), (1.0, -2.0), (9.0, 2.0)]).time_ratio(), None);
            // Begun at a dead centre.
            let mut begun = closed(1.0, 7.0, 0.5);
            begun.all = vec![Extreme { t: at(2.0), value: -1.0, is_max: false }];
            begun.ends = [(at(0.0), 1.0), (at(8.0), 1.0)];
            assert_eq!(begun.time_ratio(), None);
            begun.rests = [true; 2];
            assert_eq!(begun.time_ratio(), Some(3.0));
        }
        assert_eq!(extremes(&[(1.0, 1.0)], [(0.0, 0.0), (8.0, 0.0)], true).time_ratio(), None);
    }

    /// A motion comes back where both the value and the rate do.
    #[test]
    fn whether_a_motion_comes_back() {
        let closed = |law: crate::Law, to: f64, count: usize| {
            let mut m = crate::Mechanism::new("slider");
            let x = m.length("x", law.at(0.0)).unwrap();
            m.add("motor", crate::joints::drivers::drive(x, law)).unwrap();
            let system = m.build().unwrap();
            let motion = system.run(crate::linspace(0.0, to, 21)).unwrap();
            let found = system.extremes(&motion, x).unwrap();
            assert_eq!(found.all().len(), count);
            found.closed
        };
        // t (t − 1) (t − 3) is 0 at both ends and has rates 3 and 6; the sine on a slope comes back
        // with its rate alone
        assert!(!closed(crate::Law::polynomial(&[0.0, 3.0, -4.0, 1.0]), 3.0, 2));
        let turn = std::f64::consts::TAU;
        let sine = crate::Law::sine(1.0, 1.0, 0.3);
        assert!(
            !closed(sine.clone() + crate::Law::ramp(0.1), turn, 2)
                && closed(sine.clone(), turn, 2)
                && closed(-1e6 * sine.clone(), turn, 2)
        );
        assert!(
            closed(sine.clone() + crate::Law::ramp(1e-10 / turn), turn, 2)
                && !closed(sine + crate::Law::ramp(3e-9 / turn), turn, 2)
        );
    }
}
