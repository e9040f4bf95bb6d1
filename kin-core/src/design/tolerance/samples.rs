//! Computes a measure in many mechanisms with random deviations of their dimensions (Monte Carlo).

use std::fmt;

use super::super::feature::{Feature, Followed, Term, first, orientation, unrescued};
use super::source::Source;
use super::text::digits;
use crate::ask::measure::{Measure, quintic};
use crate::dimensions::Distribution;
use crate::numbers::random::Random;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// The number of samples computed at once. Their values stay in memory, their motions do not.
const AT_ONCE: usize = 1 << 16;

/// The largest number of samples; each value needs memory.
const MOST: usize = 100_000_000;

/// The range in time of the search for extremes, as a multiple of the sum of the effects of all
/// dimensions. Normal dimensions can exceed their tolerance. \[-\]
const REACH: f64 = 2.0;

/// The number of steps towards a sample that cannot be assembled at once.
const WALK: u32 = 8;

/// The number of mechanisms, the seed of the random numbers, and the distribution of the
/// dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// The number of samples.
    pub count: usize,
    /// The seed of the random numbers. The same seed gives the same samples, on every machine and
    /// with any number of cores.
    pub seed: u64,
    /// The distribution of the dimensions to which the mechanism assigns no distribution.
    pub distribution: Distribution,
}

impl Default for Sampling {
    /// Returns 10 000 samples with seed 1, normal.
    fn default() -> Self {
        Sampling { count: 10_000, seed: 1, distribution: Distribution::Normal }
    }
}

/// The values of a measure in many mechanisms with random deviations of their dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    name: String,
    unit: String,
    sampling: Sampling,
    /// The values in increasing order.
    values: Vec<f64>,
}

impl System {
    /// Computes a feature of a measure ([`System::tolerance_of`]) in many mechanisms with random
    /// deviations of their dimensions.
    ///
    /// Each dimension has its distribution and is independent of the other dimensions. The result
    /// also counts the mechanisms that cannot be assembled. Kin computes the samples as a sweep, in
    /// SIMD lanes and on all cores. If a mechanism can be assembled only on another branch, beyond
    /// a singular position, Kin counts the mechanism as one that cannot be assembled.
    ///
    /// Errors: those of [`System::tolerance_of`]; the number of samples is zero or too large.
    pub fn samples(
        &self,
        motion: &Motion,
        what: impl Measure + Sync,
        of: impl Into<Feature>,
        sampling: &Sampling,
    ) -> Result<Samples> {
        if !(1..=MOST).contains(&sampling.count) {
            let reason = format!(
                "the number of samples is {}. Give a number from 1 to {MOST}",
                sampling.count
            );
            return Err(Error::InvalidOptions { reason });
        }
        let (sources, names) = self.sources_of_error(Some(sampling.distribution))?;
        let followed = Followed::new(self, motion, &what, &of.into())?;
        let slopes = |term: &Term| self.sensitivities(&term.pose, &names)?.each(&what);
        let windows = followed.terms.iter().map(|term| {
            let by = slopes(term)?;
            let second = what.of(self, &term.pose)?.second_rate;
            let moved = |k: usize| by[k].rate[0] / first(second.values());
            let reach: f64 = sources.iter().map(|source| source.off(moved)).sum();
            Ok(window(term, motion, REACH * reach))
        });
        let windows = windows.collect::<Result<Vec<_>>>()?;
        let mut random = Random::new(sampling.seed);
        let mut values = Vec::new();
        let mut open = sampling.count;
        while open > 0 {
            let count = open.min(AT_ONCE);
            open -= count;
            let off: Vec<Vec<f64>> =
                (0..count).map(|_| drawn(&sources, names.len(), &mut random)).collect();
            let mut sums = vec![Some(followed.nominal); count];
            for (term, times) in followed.terms.iter().zip(&windows) {
                let changes = changes(&followed, term, times, &names, &off)?;
                sums.iter_mut().zip(changes).for_each(|(sum, change)| {
                    *sum = sum.zip(change).map(|(sum, change)| sum + term.sign * change);
                });
            }
            values.extend(sums.into_iter().flatten().filter(|value| value.is_finite()));
        }
        values.sort_by(f64::total_cmp);
        let Followed { name, unit, .. } = followed;
        Ok(Samples { name, unit, sampling: *sampling, values })
    }
}

/// Returns the times at which samples of a term are computed: its time, and those around an
/// extreme.
fn window(term: &Term, motion: &Motion, reach: f64) -> Vec<f64> {
    let times = motion.times();
    let span = times.first().zip(times.last()).map_or(1.0, |(from, to)| (to - from).abs());
    match term.turn {
        None => vec![term.t],
        Some(_) => {
            let reach =
                if reach.is_finite() { reach.clamp(1e-5 * span, 0.05 * span) } else { 0.05 * span };
            vec![term.t - reach, term.t, term.t + reach]
        }
    }
}

/// Returns the deviation of each dimension in one sample.
fn drawn(sources: &[Source], count: usize, random: &mut Random) -> Vec<f64> {
    let mut off = vec![0.0; count];
    for source in sources {
        let t = source.tolerance;
        match (source.distribution, &source.parts[..]) {
            (Distribution::Disc, [x, y]) => {
                let [a, b, _] = in_disc(random);
                (off[*x], off[*y]) = (t * a, t * b);
            }
            (Distribution::Normal, _) => off[source.parts[0]] = t / 3.0 * normal(random),
            (Distribution::TruncatedNormal, _) => {
                let inside = |x: &f64| x.abs() <= 3.0;
                let x = std::iter::repeat_with(|| normal(random)).find(inside).unwrap_or(0.0);
                off[source.parts[0]] = t / 3.0 * x;
            }
            _ => off[source.parts[0]] = t * random.number(),
        }
    }
    off
}

/// Returns a point in the disc of radius 1, except its centre, and its squared distance from the
/// centre.
fn in_disc(random: &mut Random) -> [f64; 3] {
    let point = std::iter::repeat_with(|| {
        let x = random.number();
        let y = random.number();
        [x, y, x * x + y * y]
    });
    point
        .into_iter()
        .find(|[.., square]| *square > 0.0 && *square < 1.0)
        .unwrap_or([0.5, 0.0, 0.25])
}

/// Returns a normal number, by the polar method (G. Marsaglia, T. A. Bray, SIAM Review 6, 1964).
fn normal(random: &mut Random) -> f64 {
    let [x, _, square] = in_disc(random);
    x * (-2.0 * square.ln() / square).sqrt()
}

/// Returns the deviation of one term of a feature in some samples; `None` for samples that cannot
/// be assembled.
fn changes<M: Measure + Sync>(
    followed: &Followed<'_, M>,
    term: &Term,
    times: &[f64],
    names: &[String],
    off: &[Vec<f64>],
) -> Result<Vec<Option<f64>>> {
    let base = followed.system.guessed(term.pose.q(0));
    let nominal: Vec<f64> = names.iter().map(|name| base.parameter(name)).collect::<Result<_>>()?;
    let case = |off: &Vec<f64>| nominal.iter().zip(off).map(|(x, off)| x + off).collect();
    let cases: Vec<Vec<f64>> = off.iter().map(case).collect();
    let meant = orientation(&base, term.t, term.pose.q(0));
    base.sweep(names)?.options(unrescued()).run(&cases, times, |k, motion| {
        let system = base.off(names.iter().zip(off[k].iter().copied()))?;
        let posed = motion.ok().and_then(|motion| {
            let found = followed.what.of(&base, &motion).ok()?;
            let value = match term.turn {
                None => first(found.value.values()),
                Some(is_max) => turning(&found, times, is_max)?,
            };
            let middle = motion.len() / 2;
            let there = orientation(&system, motion.times()[middle], motion.q(middle));
            (there == meant).then_some(value)
        });
        let alone = || {
            let pose =
                followed.pose(term, &system).or_else(|| walked(followed, term, names, &off[k]))?;
            Some(first(followed.what.of(&system, &pose).ok()?.value.values()))
        };
        posed.or_else(alone).map(|there| followed.change(term, there))
    })
}

/// Returns the pose of a term at a fixed time, while all dimensions move to their values step by
/// step.
fn walked<M: Measure>(
    followed: &Followed<'_, M>,
    term: &Term,
    names: &[String],
    off: &[f64],
) -> Option<Motion> {
    let (None, mut pose) = (term.turn, term.pose.clone()) else { return None };
    for step in 1..=WALK {
        let part = f64::from(step) / f64::from(WALK);
        let system = followed.system.off(names.iter().zip(off.iter().map(|off| part * off)))?;
        let next = system.next_to(term.t, pose.q(0)).ok()?;
        let side = |q: &[f64]| orientation(&system, term.t, q);
        (side(next.q(0)) == orientation(followed.system, term.t, term.pose.q(0))).then_some(())?;
        pose = next;
    }
    Some(pose)
}

/// Returns the value of an extreme within these times, from the quintic polynomial through values,
/// velocities and accelerations at both ends of a step. Returns `None` if there is none.
fn turning(found: &Quantity, times: &[f64], is_max: bool) -> Option<f64> {
    let [x, rates, second, _] = found.orders();
    let side = if is_max { 1.0 } else { -1.0 };
    let k = (1..times.len()).find(|k| side * rates[k - 1] >= 0.0 && side * rates[*k] <= 0.0)?;
    let h = times[k] - times[k - 1];
    let ends = [k - 1, k].map(|k| [x[k], h * rates[k], h * h * second[k]]);
    let c = quintic(ends);
    let value = |u: f64| c.iter().rev().fold(0.0, |sum, c| sum * u + c);
    let slope = |u: f64| (1..6).rev().fold(0.0, |sum, k| sum * u + k as f64 * c[k]);
    let mut low = 0.0;
    let mut high = 1.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *if side * slope(middle) >= 0.0 { &mut low } else { &mut high } = middle;
    }
    Some(value(0.5 * (low + high))).filter(|value| value.is_finite())
}

impl Samples {
    /// Returns the feature of the measure, as text.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the unit of the measure.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Returns the number of samples, the seed, and the distribution of dimensions.
    pub fn sampling(&self) -> &Sampling {
        &self.sampling
    }

    /// Returns the values of the mechanisms that can be assembled, in increasing order. \[unit of
    /// the measure\]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the number of mechanisms that cannot be assembled.
    pub fn missing(&self) -> usize {
        self.sampling.count.saturating_sub(self.values.len())
    }

    /// Returns the share of mechanisms that cannot be assembled. \[-\]
    pub fn share_missing(&self) -> f64 {
        self.missing() as f64 / self.sampling.count as f64
    }

    /// Returns the mean over the mechanisms that can be assembled, or NaN if no mechanism can be
    /// assembled. \[unit of the measure\]
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Returns the standard deviation over the mechanisms that can be assembled, or NaN if fewer
    /// than two can be assembled. \[unit of the measure\]
    pub fn sigma(&self) -> f64 {
        let mean = self.mean();
        let n = self.values.len() as f64;
        let sum: f64 = self.values.iter().map(|value| (value - mean).powi(2)).sum();
        if n < 2.0 { f64::NAN } else { (sum / (n - 1.0)).sqrt() }
    }

    /// Returns the value below which a share `p` of the assembled mechanisms is, interpolated
    /// between two samples. \[unit of the measure\]
    ///
    /// The result is NaN if no mechanism can be assembled, or if p is not between 0 and 1.
    pub fn quantile(&self, p: f64) -> f64 {
        let Some(last) = self.values.len().checked_sub(1).filter(|_| (0.0..=1.0).contains(&p))
        else {
            return f64::NAN;
        };
        let place = p * last as f64;
        let k = (place.floor() as usize).min(last);
        let next = self.values[(k + 1).min(last)];
        self.values[k] + (place - k as f64) * (next - self.values[k])
    }
}

/// The shares of the printed quantiles: three σ of a normal distribution, 5 %, and the median.
const SHARES: [f64; 5] = [0.00135, 0.05, 0.5, 0.95, 0.99865];

impl fmt::Display for Samples {
    /// Writes "slider.R_x (m), 10000 samples of seed 1: mean 0.16958, σ 0.0000603.", quantiles, and
    /// the number of mechanisms that cannot be assembled.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sampling { count, seed, .. } = self.sampling;
        write!(f, "{} ({}), {count} samples of seed {seed}", self.name, self.unit)?;
        if !self.values.is_empty() {
            write!(f, ": mean {}, σ {}.", digits(self.mean(), 5), digits(self.sigma(), 2))?;
            let told = SHARES.map(|p| {
                format!("{} % below {}", digits(100.0 * p, 4), digits(self.quantile(p), 5))
            });
            write!(f, "\n  {}.", told.join(", "))?;
        }
        let missing = self.missing();
        let share = 100.0 * self.share_missing();
        match missing {
            0 => write!(f, "\n  All samples can be assembled."),
            _ => write!(f, "\n  {missing} samples ({} %) cannot be assembled.", digits(share, 2)),
        }
    }
}
