//! A source of error: a dimension, or the two of a clearance.

use crate::model::dimension::Distribution;
use crate::system::dimensions::Toleranced;

/// A dimension that may be off, or the two of a clearance, by their numbers among all.
pub(super) struct Source {
    pub name: String,
    pub unit: String,
    pub tolerance: f64,
    pub distribution: Distribution,
    pub parts: Vec<usize>,
}

/// The share that one dimension has in a measure that is off.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Contribution {
    /// The dimension, or the clearance.
    pub name: String,
    /// Its unit, a word.
    pub unit: String,
    /// T: it may be off by ± this.
    pub tolerance: f64,
    /// Its distribution.
    pub distribution: Distribution,
    /// s: the derivative of the measure by it; of a clearance by a play that is turned the worst
    /// way.
    pub slope: f64,
}

impl Contribution {
    /// s T: how far the measure is off where the dimension is larger by its tolerance.
    pub fn off(&self) -> f64 {
        self.slope * self.tolerance
    }

    /// |s| σ: the standard deviation of the measure if nothing else is off.
    pub fn sigma(&self) -> f64 {
        self.slope.abs() * self.distribution.sigma(self.tolerance)
    }
}

/// Those of all dimensions that may be off; `distribution` is that of dimensions that name none.
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
    /// |s| T, from the derivatives by all dimensions.
    pub(super) fn off(&self, slope: impl Fn(usize) -> f64) -> f64 {
        self.tolerance * self.parts.iter().map(|k| slope(*k).powi(2)).sum::<f64>().sqrt()
    }

    /// Changes of its parts by which the measure becomes as large as it can.
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
