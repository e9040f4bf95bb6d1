//! How far a measure may be off where dimensions have tolerances: the linear stack with its
//! second-order term, what the mechanism itself does at the corners that are the worst, samples of
//! it, and a proof.

mod proved;
mod samples;
mod second;
mod source;
mod text;
mod worst;

pub use proved::Proved;
pub use samples::{Samples, Sampling};
pub use second::SecondOrder;
pub use source::Contribution;
pub use worst::{Off, Searched};

use super::feature::{Feature, Followed};
use crate::ask::measure::Measure;
use crate::model::dimension::{DimensionError, Distribution};
use crate::model::error::Result;
use crate::model::units::Units;
use crate::solve::motion::Motion;
use crate::system::System;
use source::{Source, sources};

/// How far a measure may be off, and by which dimensions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tolerance {
    /// The measure.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The number of it that is asked for.
    pub feature: Feature,
    /// The time; of a stroke that of the largest value.   \[s\]
    pub t: f64,
    /// Its value with all dimensions as they are.
    pub nominal: f64,
    /// The shares of the dimensions, the largest first.
    pub contributions: Vec<Contribution>,
    /// The least and the largest value that the mechanism itself has in the box of tolerances,
    /// wherever it was looked at: at its centre, at corners, and where the second order has an
    /// extreme on a face or inside ([`Searched`]). Both are `None` where it cannot be assembled at
    /// one of these places: then there is no worst case.
    pub corners: [Option<f64>; 2],
    /// Where in the box the mechanism was looked at, and where it is worst.
    pub searched: Searched,
    /// The second-order term; `None` where the mechanism cannot be assembled beside its dimensions.
    pub second_order: Option<SecondOrder>,
    /// Bounds over all mechanisms within the tolerances, where a proof was asked for
    /// ([`System::tolerance_proved`]).
    pub proved: Option<Proved>,
    units: Units,
}

impl System {
    /// How far a measure of a motion may be off, at the time at which that is worst: with s_i the
    /// exact derivatives by the dimensions that have a tolerance T_i
    /// ([`crate::Dimension::tolerance`]),
    ///
    /// ```text
    /// worst case  Σ |s_i| T_i        RSS  √(Σ s_i² T_i²)        σ = √(Σ s_i² σ_i²)
    /// ```
    ///
    /// (E. J. Haug, *Computer Aided Kinematics and Dynamics*, 1989, for the derivatives), and
    /// beside them the second-order term ([`SecondOrder`]) and what the mechanism does where all
    /// dimensions are off the worst way ([`Tolerance::corners`]). The play of a clearance counts as
    /// one dimension: T its radius, s the length of the gradient by its two parts.
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
    /// let extremes = system.extremes(&motion, slider.x())?;
    /// let outer = system.tolerance_of(&motion, slider.x(), extremes.max())?;
    /// assert!((outer.worst_case() - 3e-4).abs() < 1e-15); // crank and rod in line
    /// assert_eq!(outer.contributions[0].name, "rod");
    /// let stroke = system.tolerance_of(&motion, slider.x(), &extremes)?;
    /// assert!((stroke.worst_case() - 2e-4).abs() < 1e-15); // 2 · crank, whatever the rod is
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: no dimension that has a tolerance; those of [`System::sensitivities`] and
    /// [`crate::design::Sensitivities::of`].
    pub fn tolerance(&self, motion: &Motion, what: impl Measure) -> Result<Tolerance> {
        let (sources, names) = self.sources_of_error(None)?;
        let by = self.sensitivities(motion, &names)?.each(&what)?;
        let off =
            |k: usize| sources.iter().map(|source| source.off(|i| by[i].value[k])).sum::<f64>();
        let more = |best: usize, k: usize| if off(k) > off(best) { k } else { best };
        let worst = (0..motion.len()).fold(0, more);
        self.tolerance_of(motion, what, motion.times().get(worst).copied().unwrap_or(f64::NAN))
    }

    /// The same of one number that the measure has over the motion ([`Feature`]): its value at a
    /// time (`0.5`), an extreme (`extremes.max()`) wherever in time that moves, its stroke
    /// (`&extremes`).
    ///
    /// Errors: those of [`System::tolerance`] and [`System::at`].
    pub fn tolerance_of(
        &self,
        motion: &Motion,
        what: impl Measure,
        of: impl Into<Feature>,
    ) -> Result<Tolerance> {
        self.stack_of(motion, &what, of.into(), false)
    }

    /// The same with a proof ([`Tolerance::proved`]): bounds, by interval arithmetic, that hold for
    /// every mechanism whose dimensions are within their tolerances, each of which is shown to be
    /// assembled on the branch of the motion. They are halved until they are within some half per
    /// cent of what is attained, or no longer get nearer.
    ///
    /// Errors: those of [`System::tolerance_of`]; [`crate::Error::CannotBeProved`] where some
    /// mechanism of the box may not be assembled, with its dimensions, and of what no bounds are
    /// known: measures that are no coordinates, laws whose coefficients have a tolerance, and what
    /// [`System::prove`] refuses.
    pub fn tolerance_proved(
        &self,
        motion: &Motion,
        what: impl Measure,
        of: impl Into<Feature>,
    ) -> Result<Tolerance> {
        self.stack_of(motion, &what, of.into(), true)
    }

    fn stack_of(
        &self,
        motion: &Motion,
        what: &impl Measure,
        feature: Feature,
        proof: bool,
    ) -> Result<Tolerance> {
        let (sources, names) = self.sources_of_error(None)?;
        let followed = Followed::new(self, motion, what, &feature)?;
        let slopes =
            followed.gradient(self, &names)?.unwrap_or_else(|| vec![f64::NAN; names.len()]);
        let proved =
            proof.then(|| proved::proved(&followed, &sources, &names, &slopes)).transpose()?;
        let second_order = second::order(&followed, &sources, &names, &slopes)?;
        let (corners, searched) =
            worst::worst(&followed, &sources, &names, &slopes, second_order.as_ref());
        let mut contributions: Vec<Contribution> =
            sources.into_iter().map(|source| source.contribution(&slopes)).collect();
        contributions.sort_by(|a, b| b.off().abs().total_cmp(&a.off().abs()));
        let Followed { name, unit, nominal, .. } = followed;
        let t = feature.t();
        let units = self.unit_words().clone();
        Ok(Tolerance {
            name,
            unit,
            feature,
            t,
            nominal,
            contributions,
            corners,
            searched,
            second_order,
            proved,
            units,
        })
    }

    /// All that may be off, with the names of all dimensions in it; an error if nothing may.
    fn sources_of_error(
        &self,
        distribution: Option<Distribution>,
    ) -> Result<(Vec<Source>, Vec<String>)> {
        let dimensions = self.toleranced();
        if dimensions.is_empty() {
            let reason = "none of them has a tolerance, or moves anything; give one by `m.dimension(…)?.tolerance(…)`";
            return Err(DimensionError::invalid("dimensions", reason));
        }
        let names = dimensions.iter().map(|one| one.name.clone()).collect();
        Ok((sources(dimensions, distribution.unwrap_or_default()), names))
    }
}

impl Tolerance {
    /// Σ |s_i| T_i: all dimensions off the worst way, to first order. It says nothing where slopes
    /// vanish or a part of the box cannot be assembled: see [`Tolerance::attained`].   \[unit of
    /// the measure\]
    pub fn worst_case(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().abs()).sum()
    }

    /// √(Σ s_i² T_i²): what it is off as often as each dimension is off by its tolerance, where
    /// these are independent and normal.   \[unit of the measure\]
    pub fn rss(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().powi(2)).sum::<f64>().sqrt()
    }

    /// √(Σ s_i² σ_i²), to first order, with σ_i that of each dimension's distribution.   \[unit of
    /// the measure\]
    pub fn sigma(&self) -> f64 {
        self.contributions.iter().map(|one| one.sigma().powi(2)).sum::<f64>().sqrt()
    }

    /// |s_i| T_i / Σ |s_j| T_j of a contribution; 0 where nothing is off.   \[-\]
    pub fn share(&self, one: &Contribution) -> f64 {
        share(one.off().abs(), self.worst_case())
    }

    /// s_i² σ_i² / Σ s_j² σ_j² of a contribution; 0 where nothing is off.   \[-\]
    pub fn share_of_variance(&self, one: &Contribution) -> f64 {
        share(one.sigma().powi(2), self.sigma().powi(2))
    }

    /// How far the measure itself is off at the worst places that were looked at, |value − nominal|
    /// of the one that is farther off. `None` where a part of the box cannot be assembled.   \[unit
    /// of the measure\]
    pub fn attained(&self) -> Option<f64> {
        let [low, high] =
            self.corners.map(|corner| corner.map(|value| (value - self.nominal).abs()));
        Some(low?.max(high?))
    }

    /// How far that is beyond the worst case of the stack, as a share of the stack; below zero
    /// where both places are nearer. `None` where a part of the box cannot be assembled, or all
    /// slopes are zero.   \[-\]
    pub fn misled(&self) -> Option<f64> {
        Some(self.attained()? / self.worst_case() - 1.0).filter(|share| share.is_finite())
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
