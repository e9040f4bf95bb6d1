//! Finds the zeros of a measure or of its derivative between the times of a motion, by safeguarded
//! Newton steps on solved poses.

use super::Measure;
use super::between::step_of;
use super::fine::Fine;
use super::fine::clock::breaks;
use super::fine::quintic::{Quintic, derivative, is_simple, value, zeros};
use crate::outcome::error::Result;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// Numbers below this share of the largest one are zero within rounding. \[-\]
const ROUNDING: f64 = 1e-13;

/// A quintic that comes closer to zero than this share of its size may represent a function that
/// crosses zero. \[-\]
const NEAR: f64 = 1e-5;

/// A zero at which a function rises by less than this share, over the steps beside it, is
/// flat.   \[-\]
const FLAT: f64 = 1e-4;

/// Steps of one search: Newton takes a handful, halving at most about sixty.
const STEPS: usize = 100;

/// A time at which a quantity passes a value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Crossing {
    /// The time. \[s\]
    pub t: f64,
    /// True if the quantity is below the value before this time and above the value after it.
    pub rises: bool,
}

/// The function whose zeros are searched: x minus a level, or ẋ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Zero {
    Value(f64),
    Rate,
}

/// A zero: the time, x and ẋ there, and whether the function grows with time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    pub t: f64,
    pub x: f64,
    pub rises: bool,
}

/// A measure of a motion, on the grid and between its times.
pub(super) struct Search<'a, M> {
    system: &'a System,
    /// The motion with enough times to show everything between those of the grid.
    fine: &'a Fine,
    what: &'a M,
    pub grid: Quantity,
    zero: Zero,
    /// Numbers below this value count as zero.
    small: f64,
}

/// An end of an interval: the time, the function there, its derivative, and x, ẋ, ẍ.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    f: f64,
    slope: f64,
    orders: [f64; 3],
}

impl<'a, M: Measure> Search<'a, M> {
    /// Creates a search between the times of a motion that [`System::fine`] has refined.
    pub(super) fn new(system: &'a System, fine: &'a Fine, what: &'a M, zero: Zero) -> Result<Self> {
        let grid = what.of(system, &fine.motion)?;
        let [x, rates, ..] = grid.orders();
        let largest = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let small = match zero {
            Zero::Value(_) => ROUNDING * largest(x),
            Zero::Rate => ROUNDING * largest(rates),
        };
        Ok(Search { system, fine, what, grid, zero, small })
    }

    /// Returns all zeros in the order of the motion. A rest counts once, at its first time, and
    /// only if the sign differs on its two sides.
    pub(super) fn all(&self) -> Result<Vec<Root>> {
        let mut roots = Vec::new();
        let mut last: Option<(usize, End)> = None;
        for k in 0..self.fine.motion.len() {
            let end = self.on_grid(k);
            if end.f.abs() <= self.small {
                continue;
            }
            match last {
                // Of a rest the first time counts.
                Some((before, from))
                    if from.f.signum() != end.f.signum()
                        && (k - before > 2
                            || k - before == 2 && is_flat(self.on_grid(k - 1), from, end)) =>
                {
                    let first = (self.on_grid(before + 1).t, self.grid.value.values()[before + 1]);
                    let next = self.on_grid((before + 2).min(k - 1)).t;
                    let (first, x) = self.seam(from.t, next)?.unwrap_or(first);
                    roots.push(self.found_at(first, from, x));
                }
                // Zeros next to a time of the grid that is a zero count too.
                Some((_, from)) => self.within(from, end, &mut roots)?,
                None => {}
            }
            last = Some((k, end));
        }
        Ok(roots)
    }

    fn on_grid(&self, k: usize) -> End {
        let at = |all: &[f64]| all.get(k).copied().unwrap_or(f64::NAN);
        let [x, rate, second, _] = self.grid.orders();
        self.end(self.fine.motion.times()[k], [at(x), at(rate), at(second)])
    }

    fn end(&self, t: f64, orders: [f64; 3]) -> End {
        let [x, rate, second] = orders;
        match self.zero {
            Zero::Value(level) => End { t, f: x - level, slope: rate, orders },
            Zero::Rate => End { t, f: rate, slope: second, orders },
        }
    }

    /// Returns x, ẋ and ẍ at a time between those of the grid. Revolutions count from the preceding
    /// time of the grid.
    fn between(&self, t: f64) -> Result<[f64; 3]> {
        let Fine { motion, changes } = self.fine;
        let k = step_of(motion.times(), t).unwrap_or(0);
        let mut two = Motion::new(self.system, 2);
        for t in [motion.times()[k], t] {
            self.system.add_between(motion, changes, (k, t), &mut two)?;
        }
        let here = self.what.of(self.system, &two)?;
        let [x, rate, second, _] = here.orders();
        let last = |all: &[f64]| all.last().copied().unwrap_or(f64::NAN);
        let turned = self.grid.value.values()[k] - x.first().copied().unwrap_or(f64::NAN);
        Ok([last(x) + turned, last(rate), last(second)])
    }

    /// Finds all zeros between two times that are no zeros themselves. If the quintic through both
    /// ends has more zeros than the signs show, or comes close to one, Kin solves the poses at its
    /// extremes.
    fn within(&self, from: End, to: End, roots: &mut Vec<Root>) -> Result<()> {
        let level = match self.zero {
            Zero::Value(level) => Some(level),
            Zero::Rate => None,
        };
        let c = Quintic::between([from.t, to.t], [from.orders, to.orders]).coefficients(level);
        let mut last = from;
        if !is_simple(&c, NEAR) {
            let largest = c.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
            for u in zeros(&derivative(&c)) {
                let turned = value(&c, u);
                if turned.signum() == last.f.signum() && turned.abs() > NEAR * largest {
                    continue;
                }
                let t = from.t + u * (to.t - from.t);
                let middle = self.end(t, self.between(t)?);
                if middle.f.abs() > self.small && middle.f.signum() != last.f.signum() {
                    roots.push(self.root(last, middle)?);
                    last = middle;
                }
            }
        }
        if last.f.signum() != to.f.signum() {
            roots.push(self.root(last, to)?);
        }
        Ok(())
    }

    /// Returns the zero between two times with different signs.
    fn root(&self, from: End, to: End) -> Result<Root> {
        let mut low = from.t;
        let mut high = to.t;
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
                break;
            }
            t = next;
        }
        let found = self.between(t)?;
        if is_flat(self.end(t, found), from, to)
            && let Some((seam, x)) = self.seam(from.t, to.t)?
        {
            return Ok(self.found_at(seam, from, x));
        }
        Ok(self.found_at(t, from, found[0]))
    }

    /// The first seam of two laws, after one time and not after another, at which f is zero, with
    /// the value of the measure: rounding hides a flat zero better than a millionth of a step.
    fn seam(&self, from: f64, to: f64) -> Result<Option<(f64, f64)>> {
        let motion = &self.fine.motion;
        let last = motion.len().saturating_sub(2);
        let [begin, end] = [from, to].map(|t| step_of(motion.times(), t).unwrap_or(0).min(last));
        for step in begin..=end {
            for (t, _) in breaks(self.system, motion, step) {
                if (t - from) * (to - t) < 0.0 || t == from {
                    continue;
                }
                let x = self.between(t)?;
                if self.end(t, x).f.abs() <= self.small {
                    return Ok(Some((t, x[0])));
                }
            }
        }
        Ok(None)
    }

    /// Returns the zero at time t, where `from` precedes it in the order of the motion.
    fn found_at(&self, t: f64, from: End, x: f64) -> Root {
        Root { t, x, rises: from.f.is_sign_negative() == (t - from.t).is_sign_positive() }
    }
}

/// True if a zero between two ends is flat: beside it f is lost in rounding, so that no search
/// comes nearer.
fn is_flat(zero: End, from: End, to: End) -> bool {
    let rise = zero.slope * (to.t - from.t);
    rise.abs() <= FLAT * from.f.abs().max(to.f.abs())
}

impl System {
    /// Returns the times at which a measure of a motion passes a value, in the order of the motion.
    ///
    /// Kin solves the pose at each crossing, so the times have the accuracy of the solver.
    ///
    /// The argument `what` is a name, a coordinate or a function of a motion ([`Measure`]). The
    /// grid of times may be coarse: if necessary, Kin solves more poses between two times, as
    /// [`System::extremes`] does.
    ///
    /// Errors: those of [`System::measure`] and [`System::at`]; the motion has more events between
    /// two times than Kin can follow.
    pub fn crossings(
        &self,
        motion: &Motion,
        what: impl Measure,
        value: f64,
    ) -> Result<Vec<Crossing>> {
        self.own_as_it_is(motion)?;
        let fine = self.fine(motion, Some(&what))?;
        let roots = Search::new(self, &fine, &what, Zero::Value(value))?.all()?;
        Ok(roots.into_iter().map(|Root { t, rises, .. }| Crossing { t, rises }).collect())
    }
}

#[cfg(test)]
mod tests;
