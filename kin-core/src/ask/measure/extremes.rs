//! Extremes of a measure: dead centres, strokes, time ratios.

use super::Measure;
use super::roots::{Root, Search, Zero};
use crate::model::error::Result;
use crate::solve::motion::Motion;
use crate::system::System;

/// A motion whose first and last value and rate differ by less than this share of the largest comes back to its start.   \[-\]
const CLOSED: f64 = 1e-9;

/// Where a measure turns round.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Extreme {
    /// When.   \[s\]
    pub t: f64,
    /// Its value there, in its own unit.
    pub value: f64,
    /// Whether it is a maximum.
    pub is_max: bool,
}

/// The extremes of a measure over a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    name: String,
    unit: String,
    all: Vec<Extreme>,
    /// Time and value at the first time and at the last.
    ends: [(f64, f64); 2],
    closed: bool,
}

impl System {
    /// Where a measure of a motion turns round, its rate being zero, with times and values as exact as poses can be solved. Of an output these
    /// are its dead centres: `system.extremes(&motion, rocker.theta())?`.
    ///
    /// `what` is a name, a coordinate or a function of a motion ([`Measure`]). Two extremes within one step of the grid are found where rates
    /// and second rates at its ends show them; where the measure rests before it turns round, the first time of the rest on the grid is told.
    ///
    /// Errors: those of [`System::measure`] and [`System::at`].
    pub fn extremes(&self, motion: &Motion, what: impl Measure) -> Result<Extremes> {
        let search = Search::new(self, motion, &what, Zero::Rate)?;
        let extreme = |Root { t, x, rises }: Root| Extreme { t, value: x, is_max: !rises };
        let all = search.all()?.into_iter().map(extreme).collect();
        let (x, rate) = (search.grid.value.values(), search.grid.rate.values());
        let end = |all: &[f64]| [all.first(), all.last()].map(|x| x.copied().unwrap_or(f64::NAN));
        let (times, values) = (end(motion.times()), end(x));
        let comes_back = |all: &[f64]| {
            let size = all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            matches!(all, [first, .., last] if (first - last).abs() <= CLOSED * size)
        };
        Ok(Extremes {
            name: search.grid.value.name().to_string(),
            unit: search.grid.value.unit().to_string(),
            all,
            ends: [(times[0], values[0]), (times[1], values[1])],
            closed: comes_back(x) && comes_back(rate),
        })
    }
}

impl Extremes {
    /// Name of the measure.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its unit.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// All of them in the order of the motion.
    pub fn all(&self) -> &[Extreme] {
        &self.all
    }

    /// The largest value of the motion and its time, be it an extreme or an end of the run.
    pub fn max(&self) -> (f64, f64) {
        self.best(|value, other| value > other)
    }

    /// The smallest value of the motion and its time, be it an extreme or an end of the run.
    pub fn min(&self) -> (f64, f64) {
        self.best(|value, other| value < other)
    }

    /// Largest less smallest value: the stroke of a slider, the swing of a rocker.
    pub fn stroke(&self) -> f64 {
        self.max().0 - self.min().0
    }

    /// How much longer the slower stroke takes than the quicker one, at least 1; `None` where the motion does not show both strokes.
    ///
    /// Where the run comes back to its start (one period), both strokes are those between the largest and the smallest value; else the ones between
    /// the first three extremes.
    pub fn time_ratio(&self) -> Option<f64> {
        let [(from, _), (to, _)] = self.ends;
        let (one, other) = match self.all[..] {
            [_, _, ..] if self.closed => {
                let one = (self.max().1 - self.min().1).abs();
                (one, (to - from).abs() - one)
            }
            [a, b, c, ..] => ((b.t - a.t).abs(), (c.t - b.t).abs()),
            _ => return None,
        };
        Some(one.max(other) / one.min(other)).filter(|ratio| ratio.is_finite())
    }

    /// Value and time of the one that no other is better than.
    fn best(&self, better: impl Fn(f64, f64) -> bool) -> (f64, f64) {
        let [first, last] = self.ends.map(|(t, value)| (value, t));
        let extremes = self.all.iter().map(|extreme| (extreme.value, extreme.t));
        extremes.chain([last]).fold(first, |best, next| if better(next.0, best.0) { next } else { best })
    }
}
