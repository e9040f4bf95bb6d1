//! Computes features of a measure over a motion, for given dimensions.

use std::f64::consts::TAU;

use super::measured;
use crate::ask::measure::{Extreme, Extremes, Measure};
use crate::outcome::error::Result;
use crate::solve::motion::Motion;
use crate::solve::options::SolverOptions;
use crate::system::System;

/// The number of steps of time in which an extreme is followed.
const STEPS: usize = 40;

/// A number of a measure over a motion: its value at a time, an extreme, or its stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Feature {
    /// The value at this time. \[s\]
    At(f64),
    /// The value of an extreme. If dimensions change, the time of the extreme may change too.
    Extreme(Extreme),
    /// The largest minus the smallest value of the measure: a stroke, a swing, a lift. If
    /// dimensions change, the times of both extremes may change too.
    Stroke([Extreme; 2]),
}

impl From<f64> for Feature {
    fn from(t: f64) -> Self {
        Feature::At(t)
    }
}

impl From<Extreme> for Feature {
    fn from(extreme: Extreme) -> Self {
        Feature::Extreme(extreme)
    }
}

impl From<&Extreme> for Feature {
    fn from(extreme: &Extreme) -> Self {
        Feature::Extreme(*extreme)
    }
}

impl From<&Extremes> for Feature {
    /// Returns the stroke.
    fn from(extremes: &Extremes) -> Self {
        Feature::Stroke([extremes.max(), extremes.min()])
    }
}

impl Feature {
    /// Returns the time of the feature; for a stroke, the time of the largest value. \[s\]
    pub fn t(&self) -> f64 {
        match self {
            Feature::At(t) => *t,
            Feature::Extreme(extreme) | Feature::Stroke([extreme, _]) => extreme.t,
        }
    }

    /// Returns the feature with its extremes as they are on the motion. Errors: the motion has no
    /// such extreme.
    fn on_motion(&self, system: &System, motion: &Motion, what: &dyn Measure) -> Result<Feature> {
        let found = |extreme: &Extreme| -> Result<Extreme> {
            Ok(measured::on_motion(system, motion, what, extreme)?.0)
        };
        Ok(match self {
            Feature::At(t) => Feature::At(*t),
            Feature::Extreme(extreme) => Feature::Extreme(found(extreme)?),
            Feature::Stroke([most, least]) => Feature::Stroke([found(most)?, found(least)?]),
        })
    }
}

/// One value in a feature, which is a sum of such values.
pub(super) struct Term {
    pub sign: f64,
    pub t: f64,
    /// For an extreme, true for a maximum and false for a minimum; `None` for a fixed time.
    pub turn: Option<bool>,
    /// The pose at that time.
    pub pose: Motion,
    /// The measure at that pose alone, without the revolutions that only a motion counts.
    pub here: f64,
}

/// A feature of a measure, with all data to find it again for other dimensions.
pub(super) struct Followed<'a, M> {
    pub system: &'a System,
    pub motion: &'a Motion,
    pub what: &'a M,
    pub terms: Vec<Term>,
    pub name: String,
    pub unit: String,
    /// The value at the present dimensions.
    pub nominal: f64,
}

impl<'a, M: Measure> Followed<'a, M> {
    /// Creates the feature. Errors: those of [`System::at`] and of the measure; an extreme that the
    /// measure does not have on this motion.
    pub(super) fn new(
        system: &'a System,
        motion: &'a Motion,
        what: &'a M,
        feature: &Feature,
    ) -> Result<Self> {
        let feature = &feature.on_motion(system, motion, what)?;
        let ends = [motion.times().first(), motion.times().last()];
        let turn =
            |extreme: &Extreme| (!ends.contains(&Some(&extreme.t))).then_some(extreme.is_max);
        let places = match feature {
            Feature::At(t) => vec![(1.0, *t, None)],
            Feature::Extreme(extreme) => vec![(1.0, extreme.t, turn(extreme))],
            Feature::Stroke([most, least]) => {
                vec![(1.0, most.t, turn(most)), (-1.0, least.t, turn(least))]
            }
        };
        let mut terms = Vec::new();
        let mut named = (String::new(), String::new());
        for (sign, t, turn) in places {
            let pose = system.at(motion, t)?;
            let value = what.of(system, &pose)?.value;
            named = (value.name().to_string(), value.unit().to_string());
            terms.push(Term { sign, t, turn, pose, here: first(value.values()) });
        }
        let grid = |t: f64| motion.times().iter().position(|known| *known == t);
        let nominal = match feature {
            Feature::At(t) => match grid(*t) {
                Some(k) => {
                    what.of(system, motion)?.value.values().get(k).copied().unwrap_or(f64::NAN)
                }
                None => terms[0].here,
            },
            Feature::Extreme(extreme) => extreme.value,
            Feature::Stroke([most, least]) => most.value - least.value,
        };
        let (name, unit) = named;
        let name =
            if matches!(feature, Feature::Stroke(_)) { format!("stroke of {name}") } else { name };
        Ok(Followed { system, motion, what, terms, name, unit, nominal })
    }

    /// Returns the value for other dimensions, or `None` if the mechanism cannot be assembled.
    pub(super) fn value(&self, other: &System) -> Option<f64> {
        self.terms.iter().try_fold(self.nominal, |sum, term| {
            let pose = self.pose(term, other)?;
            let there = first(self.what.of(other, &pose).ok()?.value.values());
            Some(sum + term.sign * self.change(term, there))
        })
    }

    /// Returns the difference of a term from its present value. One pose alone does not count
    /// revolutions.
    pub(super) fn change(&self, term: &Term, there: f64) -> f64 {
        let change = there - term.here;
        if self.unit == "rad" { change - TAU * (change / TAU).round() } else { change }
    }

    /// Returns the exact derivatives by dimensions and parameters, for other dimensions. At an
    /// extreme the velocity vanishes, so the value changes like the measure at that time.
    ///
    /// Errors: those of [`System::sensitivities`] and of the measure. Returns `None` if the
    /// mechanism cannot be assembled.
    pub(super) fn gradient(&self, other: &System, names: &[String]) -> Result<Option<Vec<f64>>> {
        let mut sum = vec![0.0; names.len()];
        for term in &self.terms {
            let Some(pose) = self.pose(term, other) else { return Ok(None) };
            let by = other.sensitivities(&pose, names)?.each(self.what)?;
            sum.iter_mut().zip(&by).for_each(|(sum, by)| *sum += term.sign * first(&by.value));
        }
        Ok(Some(sum))
    }

    /// Returns the pose of a term for other dimensions.
    pub(super) fn pose(&self, term: &Term, other: &System) -> Option<Motion> {
        let found = match term.turn {
            None => other.next_to(term.t, term.pose.q(0)).ok(),
            Some(is_max) => {
                self.turned(term, other, is_max).or_else(|| self.searched(term, other, is_max))
            }
        };
        let orientation =
            |system: &System, pose: &Motion| orientation(system, pose.times()[0], pose.q(0));
        found.filter(|pose| orientation(self.system, &term.pose) == orientation(other, pose))
    }

    /// Returns the extreme nearest to that of the term, by Newton's method on the velocity.
    fn turned(&self, term: &Term, other: &System, is_max: bool) -> Option<Motion> {
        let [from, to] = [self.motion.times().first()?, self.motion.times().last()?];
        let span = (to - from).abs();
        let mut pose = other.next_to(term.t, term.pose.q(0)).ok()?;
        for _ in 0..STEPS {
            let t = pose.times()[0];
            let here = self.what.of(other, &pose).ok()?;
            let rate = first(here.rate.values());
            let second = first(here.second_rate.values());
            let step = -rate / second;
            if !step.is_finite() || step.abs() > 0.1 * span || (t - term.t).abs() > 0.25 * span {
                return None;
            }
            if step.abs() <= 4.0 * f64::EPSILON * (t.abs() + span) {
                return ((second < 0.0) == is_max).then_some(pose);
            }
            let next =
                |j: usize| pose.q(0)[j] + step * (pose.qd(0)[j] + 0.5 * step * pose.qdd(0)[j]);
            let q: Vec<f64> = (0..other.n_coordinates()).map(next).collect();
            let next = other.next_to(t + step, &q).ok()?;
            pose = next;
        }
        None
    }

    /// Returns the extreme of the same kind that is nearest in time, from a complete run.
    fn searched(&self, term: &Term, other: &System, is_max: bool) -> Option<Motion> {
        let motion = other
            .guessed(self.motion.q(0))
            .solver()
            .options(unrescued())
            .run(self.motion.times())
            .ok()?;
        let extremes =
            other.extremes(&motion, |motion: &Motion| self.what.of(other, motion)).ok()?;
        let same = extremes.all().iter().filter(|extreme| extreme.is_max == is_max);
        let near = same.min_by(|a, b| (a.t - term.t).abs().total_cmp(&(b.t - term.t).abs()))?;
        other.at(&motion, near.t).ok()
    }
}

/// Returns true if det C_q > 0. The sign changes at singular positions only. Returns `None` if
/// there is no sign.
pub(super) fn orientation(system: &System, t: f64, q: &[f64]) -> Option<bool> {
    let c_q = system.jacobian(q, t).ok().filter(|c_q| c_q.is_square())?;
    let lu = c_q.lu();
    let minus = (0..lu.u().nrows()).filter(|k| lu.u()[(*k, *k)] < 0.0).count();
    Some((minus % 2 == 0) == (lu.p().determinant::<f64>() > 0.0))
}

/// Returns options without a search of the whole space if there is no position near the guess.
pub(super) fn unrescued() -> SolverOptions {
    SolverOptions::new().rescue(false)
}

pub(super) fn first(all: &[f64]) -> f64 {
    all.first().copied().unwrap_or(f64::NAN)
}
