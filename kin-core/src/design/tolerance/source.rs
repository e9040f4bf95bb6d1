//! Describes a source of deviation: a dimension, or the two dimensions of a clearance.

use crate::dimensions::Distribution;
use crate::system::dimensions::Toleranced;

/// A dimension with a tolerance, or the two of a clearance, by their indices among all.
pub(super) struct Source {
    pub name: String,
    pub unit: String,
    pub tolerance: f64,
    pub distribution: Distribution,
    pub parts: Vec<usize>,
}

/// The share of one dimension in the deviation of a measure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Contribution {
    /// The dimension or the clearance.
    pub name: String,
    /// The unit of the dimension, as text.
    pub unit: String,
    /// The tolerance T: the dimension deviates by at most ± T.
    pub tolerance: f64,
    /// The distribution of the dimension.
    pub distribution: Distribution,
    /// The derivative s of the measure by the dimension; for a clearance, the derivative by the
    /// play in the worst direction.
    pub slope: f64,
}

impl Contribution {
    /// Returns s T: the deviation of the measure if the dimension is larger by its tolerance.
    pub fn off(&self) -> f64 {
        self.slope * self.tolerance
    }

    /// Returns |s| σ: the standard deviation of the measure if no other dimension deviates.
    pub fn sigma(&self) -> f64 {
        self.slope.abs() * self.distribution.sigma(self.tolerance)
    }
}

/// Returns the sources of all dimensions with a tolerance. `distribution` applies to dimensions
/// without a distribution.
pub(super) fn sources(all: Vec<Toleranced>, distribution: Distribution) -> Vec<Source> {
    let mut sources: Vec<Source> = Vec::new();
    let mut discs: Vec<(String, usize)> = Vec::new();
    for (k, one) in all.into_iter().enumerate() {
        if let Some(clearance) = &one.clearance {
            if let Some((_, place)) = discs.iter().find(|(known, _)| known == clearance) {
                sources[*place].parts.push(k);
                continue;
            }
            discs.push((clearance.clone(), sources.len()));
        }
        sources.push(Source {
            name: one.clearance.unwrap_or(one.name),
            unit: one.unit,
            tolerance: one.tolerance,
            distribution: one.distribution.unwrap_or(distribution),
            parts: vec![k],
        });
    }
    sources
}

impl Source {
    /// Returns |s| T, from the derivatives by all dimensions.
    pub(super) fn off(&self, slope: impl Fn(usize) -> f64) -> f64 {
        self.tolerance * self.parts.iter().map(|k| slope(*k).powi(2)).sum::<f64>().sqrt()
    }

    /// Returns the changes of its parts that make the measure as large as possible.
    pub(super) fn worst(&self, slopes: &[f64]) -> Vec<(usize, f64)> {
        let size = self.parts.iter().map(|k| slopes[*k].powi(2)).sum::<f64>().sqrt();
        let direction = |k: usize| match self.parts[..] {
            [_] => slopes[k].signum(),
            [first, ..] if size == 0.0 => f64::from(k == first),
            _ => slopes[k] / size,
        };
        self.parts.iter().map(|k| (*k, self.tolerance * direction(*k))).collect()
    }

    pub(super) fn contribution(self, slopes: &[f64]) -> Contribution {
        let slope = match self.parts[..] {
            [k] => slopes[k],
            _ => self.off(|k| slopes[k]) / self.tolerance,
        };
        let Source { name, unit, tolerance, distribution, .. } = self;
        Contribution { name, unit, tolerance, distribution, slope }
    }
}
