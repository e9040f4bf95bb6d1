//! Where a measure, or its rate, is zero between the times of a motion: safeguarded Newton steps on poses
//! that are solved anew.

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
    /// True if x is below the value before and above it after.
    pub rises: bool,
}

/// The function whose zeros are searched: x less a level, or ẋ.
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
        system.own_as_it_is(motion)?;
        let grid = what.of(system, motion)?;
        let [x, rates, ..] = grid.orders();
        let largest = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let small = match zero {
            Zero::Value(_) => ROUNDING * largest(x),
            Zero::Rate => ROUNDING * largest(rates),
        };
        Ok(Search { system, motion, what, grid, zero, small })
    }

    /// All zeros in the order of the motion. Of a rest only the first time is told, and only where the sign
    /// differs on either side.
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
                    _ => roots.push(self.found_at(
                        self.on_grid(before + 1).t,
                        from,
                        self.grid.value.values()[before + 1],
                    )),
                },
                // Also beside a time of the grid at which it is zero.
                Some((_, from)) => roots.extend(self.hidden(from, end)?.into_iter().flatten()),
                None => {}
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

    /// x, ẋ and ẍ at a time between those of the grid. Turns are counted on from the time of the grid before
    /// it.
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

    /// Two zeros between two times over which the sign stays: where the cubic through values and slopes at
    /// the ends dips to the other side, and so does the pose solved there.
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
        let (mut low, mut high) = (from.t, to.t);
        let near = 2.0 * f64::EPSILON * low.abs().max(high.abs());
        let mut t = low + (high - low) * (from.f / (from.f - to.f));
        for _ in 0..STEPS {
            let x = self.between(t)?;
            let here = self.end(t, x);
            *if here.f.signum() == from.f.signum() { &mut low } else { &mut high } = t;
            let newton = t - here.f / here.slope;
            let inside = (newton - low) * (newton - high) <= 0.0;
            let next = if inside { newton } else { 0.5 * (low + high) };
            if here.f == 0.0 || (next - t).abs() <= near {
                return Ok(self.found_at(t, from, x[0]));
            }
            t = next;
        }
        Ok(self.found_at(t, from, self.between(t)?[0]))
    }

    /// A zero at time t, where `from` lies before it in the order of the motion.
    fn found_at(&self, t: f64, from: End, x: f64) -> Root {
        Root { t, x, rises: from.f.is_sign_negative() == (t - from.t).is_sign_positive() }
    }
}

/// Where the cubic with these values and slopes at s = 0 and s = 1, the values of one sign, has its dip
/// towards zero, if it crosses it.
fn dip([f0, g0]: [f64; 2], [f1, g1]: [f64; 2]) -> Option<f64> {
    let sign = f0.signum();
    let [f0, g0, f1, g1] = [f0, g0, f1, g1].map(|x| sign * x);
    let cubic = 2.0 * (f0 - f1) + g0 + g1;
    let square = 3.0 * (f1 - f0) - 2.0 * g0 - g1;
    // 3 c s² + 2 b s + g0 = 0, where the slope grows: by the form in which nothing cancels
    let root = (square * square - 3.0 * cubic * g0).sqrt();
    let s = if square > 0.0 { -g0 / (square + root) } else { (root - square) / (3.0 * cubic) };
    let value = f0 + s * (g0 + s * (square + s * cubic));
    ((0.0..1.0).contains(&s) && value < 0.0).then_some(s)
}

impl System {
    /// The times at which a measure of a motion passes a value, as exactly as poses can be solved, in the
    /// order of the motion.
    ///
    /// `what` is a name, a coordinate or a function of a motion ([`Measure`]). Two crossings within one step
    /// of the grid are found where values and rates at its ends show them. Errors: those of
    /// [`System::measure`] and [`System::at`].
    pub fn crossings(&self, motion: &Motion, what: impl Measure, value: f64) -> Result<Vec<Crossing>> {
        let roots = Search::new(self, motion, &what, Zero::Value(value))?.all()?;
        Ok(roots.into_iter().map(|Root { t, rises, .. }| Crossing { t, rises }).collect())
    }
}

#[cfg(test)]
mod tests;
