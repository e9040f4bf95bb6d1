//! Computes the deviation of a measure for dimensions with tolerances: linear and second-order
//! tolerance stacks, the mechanism at the worst corners, samples, and a proof.

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
use crate::coordinates::units::Units;
use crate::dimensions::Distribution;
use crate::outcome::DimensionError;
use crate::outcome::error::Result;
use crate::outcome::error::surface::Surface;
use crate::solve::motion::Motion;
use crate::system::System;
use source::{Source, sources};

/// The deviation of a measure within the tolerances of the dimensions, and the share of each
/// dimension.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tolerance {
    /// The name of the measure.
    pub name: String,
    /// The unit of the measure.
    pub unit: String,
    /// The feature of the measure.
    pub feature: Feature,
    /// The time of the feature; for a stroke, the time of the largest value. \[s\]
    pub t: f64,
    /// The value of the feature at the nominal dimensions. \[unit of the measure\]
    pub nominal: f64,
    /// The shares of the dimensions, the largest first.
    pub contributions: Vec<Contribution>,
    /// The smallest and the largest value of the feature at the tested points of the box of
    /// tolerances. \[unit of the measure\]
    ///
    /// Kin computes the mechanism at the centre, at corners, and at points on faces or inside the
    /// box where the second-order term suggests an extreme ([`Searched`]). Both values are `None`
    /// if the mechanism cannot be assembled at a tested point, because no worst case exists.
    pub corners: [Option<f64>; 2],
    /// The points of the box at which Kin computed the mechanism, and the worst points.
    pub searched: Searched,
    /// The second-order term; `None` if the mechanism cannot be assembled near its nominal
    /// dimensions.
    pub second_order: Option<SecondOrder>,
    /// Bounds over all mechanisms within the tolerances; `None` unless [`System::tolerance_proved`]
    /// computed the result.
    pub proved: Option<Proved>,
    units: Units,
}

impl System {
    /// Computes the deviation of a measure of a motion at the worst time, for dimensions with
    /// tolerances.
    ///
    /// s_i are the exact derivatives by the dimensions that have a tolerance T_i
    /// ([`crate::Dimension::tolerance`]):
    ///
    /// ```text
    /// worst case  Σ |s_i| T_i        RSS  √(Σ s_i² T_i²)        σ = √(Σ s_i² σ_i²)
    /// ```
    ///
    /// Source of the derivatives: E. J. Haug, *Computer Aided Kinematics and Dynamics*, 1989. The
    /// result also contains the second-order term ([`SecondOrder`]) and the values at the worst
    /// combinations of deviations ([`Tolerance::corners`]). Kin treats a clearance as one
    /// dimension: T is its radius, and s is the length of the gradient by its two components.
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
    /// Errors: no dimension has a tolerance; those of [`System::sensitivities`] and
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

    /// Computes the deviation of one feature of a measure over the motion ([`Feature`]).
    ///
    /// A feature is the value at a time (`0.5`), the value of an extreme (`extremes.max()`), or the
    /// stroke (`&extremes`). The time of an extreme may change with the dimensions.
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

    /// Computes the deviation of one feature with proved bounds ([`Tolerance::proved`]).
    ///
    /// Kin computes the bounds by interval arithmetic. The bounds are valid for every mechanism
    /// whose dimensions are within their tolerances. Kin proves that each of these mechanisms can
    /// be assembled on the branch of the motion. Kin bisects the box of tolerances until the bounds
    /// are within about half a per cent of an attained value, or improve no further.
    ///
    /// Errors: those of [`System::tolerance_of`], and [`crate::Error::CannotBeProved`] in these
    /// cases:
    ///
    /// * Kin cannot prove that a mechanism in the box can be assembled (the error contains its
    ///   dimensions);
    /// * the measure is not a coordinate;
    /// * a coefficient of a law has a tolerance;
    /// * [`System::prove`] does not support the mechanism.
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

    /// Returns all sources of error and the names of their dimensions. Errors: there is no source.
    fn sources_of_error(
        &self,
        distribution: Option<Distribution>,
    ) -> Result<(Vec<Source>, Vec<String>)> {
        let dimensions = self.toleranced();
        if dimensions.is_empty() {
            let call = Surface::chosen().tolerance();
            let reason = format!(
                "no dimension that changes the motion has a tolerance. Give a tolerance by {call}"
            );
            return Err(DimensionError::invalid(DimensionError::ALL, reason));
        }
        let names = dimensions.iter().map(|one| one.name.clone()).collect();
        Ok((sources(dimensions, distribution.unwrap_or_default()), names))
    }
}

impl Tolerance {
    /// Returns Σ |s_i| T_i, the worst case of all dimensions to first order. \[unit of the
    /// measure\]
    ///
    /// This worst case is meaningless if the derivatives s_i are zero, or if the mechanism cannot
    /// be assembled in a part of the box. In these cases use [`Tolerance::attained`].
    pub fn worst_case(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().abs()).sum()
    }

    /// Returns √(Σ s_i² T_i²), the root sum of squares of the deviations. \[unit of the measure\]
    ///
    /// If the dimensions are independent and normal, the measure exceeds this deviation as often as
    /// each dimension exceeds its tolerance.
    pub fn rss(&self) -> f64 {
        self.contributions.iter().map(|one| one.off().powi(2)).sum::<f64>().sqrt()
    }

    /// Returns √(Σ s_i² σ_i²), the standard deviation to first order, with σ_i from the
    /// distribution of each dimension. \[unit of the measure\]
    pub fn sigma(&self) -> f64 {
        self.contributions.iter().map(|one| one.sigma().powi(2)).sum::<f64>().sqrt()
    }

    /// Returns |s_i| T_i / Σ |s_j| T_j, the share of a contribution in the worst case, or 0 if all
    /// deviations are zero. \[-\]
    pub fn share(&self, one: &Contribution) -> f64 {
        share(one.off().abs(), self.worst_case())
    }

    /// Returns s_i² σ_i² / Σ s_j² σ_j², the share of a contribution in the variance, or 0 if all
    /// deviations are zero. \[-\]
    pub fn share_of_variance(&self, one: &Contribution) -> f64 {
        share(one.sigma().powi(2), self.sigma().powi(2))
    }

    /// Returns the largest |value − nominal| of the feature at the tested points of the box of
    /// tolerances. \[unit of the measure\]
    ///
    /// Returns `None` if the mechanism cannot be assembled at a tested point.
    pub fn attained(&self) -> Option<f64> {
        let [low, high] =
            self.corners.map(|corner| corner.map(|value| (value - self.nominal).abs()));
        Some(low?.max(high?))
    }

    /// Returns the difference of the attained deviation from the linear stack, as a share of the
    /// stack. \[-\]
    ///
    /// The result is negative if the attained deviation is smaller than the linear stack. Returns
    /// `None` if the mechanism cannot be assembled at a tested point, or if all derivatives are
    /// zero.
    pub fn misled(&self) -> Option<f64> {
        Some(self.attained()? / self.worst_case() - 1.0).filter(|share| share.is_finite())
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
