//! Distributions of a dimension within its tolerance.

use serde::{Deserialize, Serialize};

/// The distribution of a dimension with tolerance ± T around its nominal value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Distribution {
    /// Normal with σ = T/3: 0.27 % of all values deviate by more than T.
    #[default]
    Normal,
    /// Normal with σ = T/3, without the values that deviate by more than T, because inspection
    /// removes them.
    TruncatedNormal,
    /// Uniform from −T to T.
    Uniform,
    /// Uniform in the disc of radius T, for the two dimensions of a clearance
    /// ([`crate::Mechanism::clearance`]).
    Disc,
}

/// φ(3) and 2 Φ(3) − 1 of the normal distribution.
const AT_THREE: [f64; 2] = [4.431_848_411_938_007_5e-3, 0.997_300_203_936_739_8];

impl Distribution {
    /// Returns E(x²) and E(x⁴) for T = 1. \[-\]
    pub(crate) fn moments(self) -> [f64; 2] {
        let [density, inside] = AT_THREE;
        match self {
            Distribution::Normal => [1.0 / 9.0, 3.0 / 81.0],
            // Integration by parts from −a to a gives E(x²) = 1 − 2 a φ(a)/Z and E(x⁴) = 3 − 2 (a³
            // + 3 a) φ(a)/Z with a = 3.
            Distribution::TruncatedNormal => {
                [(1.0 - 6.0 * density / inside) / 9.0, (3.0 - 72.0 * density / inside) / 81.0]
            }
            Distribution::Uniform => [1.0 / 3.0, 1.0 / 5.0],
            Distribution::Disc => [1.0 / 4.0, 1.0 / 8.0],
        }
    }

    /// Returns the standard deviation of a dimension with this tolerance. \[unit of the dimension\]
    pub fn sigma(self, tolerance: f64) -> f64 {
        self.moments()[0].sqrt() * tolerance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the moments with sums over a fine grid of the densities.
    #[test]
    fn moments_are_those_of_the_densities() {
        let sums = |density: &dyn Fn(f64) -> f64, reach: f64| {
            let n = 200_000;
            let at = |k: i32| reach * (f64::from(k) + 0.5) / f64::from(n);
            let sum =
                |power: i32| -> f64 { (-n..n).map(|k| density(at(k)) * at(k).powi(power)).sum() };
            [sum(2) / sum(0), sum(4) / sum(0)]
        };
        let normal = |x: f64| (-4.5 * x * x).exp();
        for (distribution, found) in [
            (Distribution::Normal, sums(&normal, 4.0)),
            (Distribution::TruncatedNormal, sums(&normal, 1.0)),
            (Distribution::Uniform, sums(&|_| 1.0, 1.0)),
            (Distribution::Disc, sums(&|x| (1.0 - x * x).sqrt(), 1.0)),
        ] {
            for (own, found) in distribution.moments().into_iter().zip(found) {
                assert!((own - found).abs() < 1e-7 * own, "{distribution:?}: {own} {found}");
            }
        }
    }
}
