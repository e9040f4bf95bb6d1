//! How far a measure may be off where dimensions have tolerances: the linear stack, and what the mechanism
//! itself does at the two corners that the stack calls the worst.

use std::fmt;

use crate::ask::measure::{Extreme, Measure};
use crate::model::dimension::DimensionError;
use crate::model::error::Result;
use crate::model::units::Units;
use crate::solve::motion::Motion;
use crate::system::System;

/// Beyond this share the corners are told to differ from the stack.   \[-\]
const MISLED: f64 = 0.05;

/// How far a measure may be off at one time, and by which dimensions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tolerance {
    /// The measure.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The time.   \[s\]
    pub t: f64,
    /// Its value with all dimensions as they are.
    pub nominal: f64,
    /// The shares of the dimensions, the largest first.
    pub contributions: Vec<Contribution>,
    /// The values that the mechanism itself has where all dimensions are off by their tolerances to the side
    /// that makes the measure small, and to the other one; `None` where it cannot be assembled there.
    pub corners: [Option<f64>; 2],
    units: Units,
}

/// The share that one dimension has in a measure that is off.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Contribution {
    /// The dimension.
    pub name: String,
    /// Its unit, a word.
    pub unit: String,
    /// T: it may be off by ± this.
    pub tolerance: f64,
    /// s: the derivative of the measure by it.
    pub slope: f64,
}

impl Contribution {
    /// s T: how far the measure is off where the dimension is larger by its tolerance.
    pub fn off(&self) -> f64 {
        self.slope * self.tolerance
    }
}

impl System {
    /// How far a measure of a motion may be off, at the time at which that is worst: with s_i the exact
    /// derivatives by the dimensions that have a tolerance T_i ([`crate::Dimension::tolerance`]),
    ///
    /// ```text
    /// worst case  Σ |s_i| T_i        RSS  √(Σ s_i² T_i²)
    /// ```
    ///
    /// (E. J. Haug, *Computer Aided Kinematics and Dynamics*, 1989, for the derivatives), and beside them
    /// what the mechanism does where all dimensions are off the worst way ([`Tolerance::corners`]).
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("slider-crank");
    /// let a = m.dimension("crank", 0.1)?.tolerance(1e-4);
    /// let b = m.dimension("rod", 0.3)?.tolerance(2e-4);
    /// let (crank, rod) = (m.link("crank", a)?, m.link("rod", b)?);
    /// let slider = m.planar("slider", pose(a + b, 0.0, 0.0))?;
    /// m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    /// m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    /// m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
    /// m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, 0.0), (0.0, 1.0), 0.0))?;
    /// m.add("motor", drive_angle(crank, Law::linear(0.3, 1.0)))?;
    /// let system = m.build()?;
    /// let motion = system.run(linspace(0.0, 6.0, 61))?;
    /// let outer = system.extremes(&motion, slider.x())?.max();
    /// let tolerance = system.tolerance_of(&motion, slider.x(), &outer)?;
    /// assert!((tolerance.worst_case() - 3e-4).abs() < 1e-15); // crank and rod in line
    /// assert_eq!(tolerance.contributions[0].name, "rod");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: no dimension that has a tolerance; those of [`System::sensitivities`] and
    /// [`crate::Sensitivities::of`].
    pub fn tolerance(&self, motion: &Motion, what: impl Measure) -> Result<Tolerance> {
        let stacked = self.stacked(motion, &what)?;
        let worst = |k: usize| stacked.off.iter().map(|off| off[k].abs()).sum::<f64>();
        let more = |best: usize, k: usize| if worst(k) > worst(best) { k } else { best };
        let k = (0..motion.len()).fold(0, more);
        let t = motion.times()[k];
        let at = |system: &System, q: &[f64]| system.value_at(&what, q, t);
        self.told(stacked, k, &|system| at(system, motion.q(k)))
    }

    /// The same of an extreme of the measure ([`System::extremes`]): of its value, wherever in time it moves.
    ///
    /// Errors: those of [`System::tolerance`].
    pub fn tolerance_of(&self, motion: &Motion, what: impl Measure, extreme: &Extreme) -> Result<Tolerance> {
        let pose = self.at(motion, extreme.t)?;
        let stacked = self.stacked(&pose, &what)?;
        // The rate vanishes at an extreme, so its value changes as the measure does at a fixed time.
        self.told(stacked, 0, &|system| system.extreme_near(&what, motion, extreme))
    }

    /// The derivatives of the measure over a motion, times the tolerances.
    fn stacked(&self, motion: &Motion, what: &dyn Measure) -> Result<Stacked> {
        let dimensions = self.toleranced();
        if dimensions.is_empty() || motion.is_empty() {
            let reason = "none of them has a tolerance; give one by `m.dimension(…)?.tolerance(…)`";
            return Err(DimensionError::invalid("dimensions", reason));
        }
        let names = dimensions.iter().map(|(name, ..)| name);
        let by = self.sensitivities(motion, names)?.each(what)?;
        let quantity = what.of(self, motion)?;
        let off = by.iter().zip(&dimensions);
        Ok(Stacked {
            off: off.map(|(by, (_, tolerance, _))| scaled(&by.value, *tolerance)).collect(),
            slopes: by.into_iter().map(|by| by.value).collect(),
            dimensions,
            name: quantity.value.name().to_string(),
            unit: quantity.value.unit().to_string(),
            times: motion.times().to_vec(),
            nominal: quantity.value.values().to_vec(),
        })
    }

    /// The table of time k; `value` is the measure in a mechanism with other dimensions.
    fn told(&self, stacked: Stacked, k: usize, value: &dyn Fn(&System) -> Option<f64>) -> Result<Tolerance> {
        let nominal = stacked.nominal[k];
        let here = value(self);
        let corner = |side: f64| {
            let off = stacked.dimensions.iter().zip(&stacked.off);
            let moved = off.map(|((name, tolerance, _), off)| (name, side * tolerance * off[k].signum()));
            let there = value(&self.off(moved)?)?;
            // One pose alone does not count turns: both are taken from one.
            Some(nominal + (there - here?)).filter(|value| value.is_finite())
        };
        let corners = [corner(-1.0), corner(1.0)];
        let slopes = stacked.slopes.iter().map(|slopes| slopes[k]);
        let mut contributions: Vec<Contribution> = slopes
            .zip(stacked.dimensions)
            .map(|(slope, (name, tolerance, unit))| Contribution { name, unit, tolerance, slope })
            .collect();
        contributions.sort_by(|a, b| b.off().abs().total_cmp(&a.off().abs()));
        Ok(Tolerance {
            name: stacked.name,
            unit: stacked.unit,
            t: stacked.times[k],
            nominal,
            contributions,
            corners,
            units: self.unit_words().clone(),
        })
    }

    /// The measure at t in the assembly next to q; `None` if there is none.
    fn value_at(&self, what: &dyn Measure, q: &[f64], t: f64) -> Option<f64> {
        let mut system = self.clone();
        system.set_initial(q).ok()?;
        let pose = system.run([t]).ok()?;
        what.of(&system, &pose).ok()?.value.values().first().copied()
    }

    /// The extreme of the same kind that is next in time, or the end of the run where the extreme is one.
    fn extreme_near(&self, what: &dyn Measure, motion: &Motion, extreme: &Extreme) -> Option<f64> {
        let mut system = self.clone();
        system.set_initial(motion.q(0)).ok()?;
        let moved = system.run(motion.times()).ok()?;
        let asked = |motion: &Motion| what.of(&system, motion);
        let values = what.of(&system, &moved).ok()?;
        let ends = [0, moved.len() - 1].map(|k| (moved.times()[k], values.value.values()[k]));
        if let Some((_, value)) = ends.into_iter().find(|(t, _)| *t == extreme.t) {
            return Some(value);
        }
        let extremes = system.extremes(&moved, asked).ok()?;
        let same = extremes.all().iter().filter(|other| other.is_max == extreme.is_max);
        let near = same.min_by(|a, b| (a.t - extreme.t).abs().total_cmp(&(b.t - extreme.t).abs()));
        near.map(|near| near.value)
    }
}

fn scaled(all: &[f64], by: f64) -> Vec<f64> {
    all.iter().map(|x| x * by).collect()
}

/// The stack over all times.
struct Stacked {
    /// Name, tolerance and unit of each dimension.
    dimensions: Vec<(String, f64, String)>,
    slopes: Vec<Vec<f64>>,
    off: Vec<Vec<f64>>,
    name: String,
    unit: String,
    times: Vec<f64>,
    nominal: Vec<f64>,
}

impl Tolerance {
    /// Σ |s_i| T_i: all dimensions off the worst way.   \[unit of the measure\]
    pub fn worst_case(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().abs()).sum()
    }

    /// √(Σ s_i² T_i²): what it is off as often as each dimension is off by its tolerance, where these are
    /// independent and normal.   \[unit of the measure\]
    pub fn rss(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().powi(2)).sum::<f64>().sqrt()
    }

    /// |s_i| T_i / Σ |s_j| T_j of a contribution; 0 where nothing is off.   \[-\]
    pub fn share(&self, one: &Contribution) -> f64 {
        share(one.off().abs(), self.worst_case())
    }

    /// s_i² T_i² / Σ s_j² T_j² of a contribution; 0 where nothing is off.   \[-\]
    pub fn share_of_variance(&self, one: &Contribution) -> f64 {
        share(one.off().powi(2), self.rss().powi(2))
    }

    /// How far the corner that is farther off is beyond the worst case of the stack, as a share of that;
    /// below zero where both are nearer. `None` where one of them cannot be assembled.   \[-\]
    pub fn misled(&self) -> Option<f64> {
        let [low, high] = self.corners.map(|corner| corner.map(|value| (value - self.nominal).abs()));
        Some(low?.max(high?) / self.worst_case() - 1.0).filter(|share| share.is_finite())
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// A number with so many digits, as short as it can be.
fn digits(x: f64, count: usize) -> f64 {
    format!("{x:.count$e}").parse().unwrap_or(x)
}

impl fmt::Display for Tolerance {
    /// "slide (0.312 m at 0.418 s): ± 0.00041 worst case, ± 0.00027 RSS.", and a line for each dimension.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tolerance { name, unit, .. } = self;
        writeln!(
            f,
            "{name} ({} {unit} at {} {}): ± {} worst case, ± {} RSS.",
            digits(self.nominal, 4),
            digits(self.t, 4),
            self.units.time(),
            digits(self.worst_case(), 2),
            digits(self.rss(), 2)
        )?;
        let longest = self.contributions.iter().map(|one| one.name.chars().count()).max().unwrap_or(0);
        for one in &self.contributions {
            let off = digits(one.off(), 2);
            writeln!(
                f,
                "  {:longest$}  {:3.0} %  {}{}   ± {} {}",
                one.name,
                100.0 * self.share(one),
                if off < 0.0 { "−" } else { "+" },
                off.abs(),
                one.tolerance,
                one.unit
            )?;
        }
        write!(f, "  Shares are of the worst case; signs are those of a larger dimension.")?;
        match (self.corners, self.misled()) {
            ([Some(low), Some(high)], Some(misled)) if misled > MISLED => write!(
                f,
                "\n  At the worst corners it is off by {} and +{}: the stack misleads by {:.0} %.",
                digits(low - self.nominal, 2),
                digits(high - self.nominal, 2),
                100.0 * misled
            ),
            ([Some(_), Some(_)], _) => Ok(()),
            _ => {
                write!(f, "\n  At a corner that the stack calls the worst the mechanism cannot be assembled.")
            }
        }
    }
}
