//! Computes the second-order term of a stack of tolerances.

use super::super::feature::Followed;
use super::source::Source;
use crate::ask::measure::Measure;
use crate::outcome::error::Result;

/// The step of the differences, in tolerances. It is small compared with the nonlinearity of the
/// measure, and rounding of the gradients stays below 1e-12 of the linear stack. \[-\]
const STEP: f64 = 1.0 / 64.0;

/// The second-order term of a stack of tolerances.
///
/// The matrix H contains the second derivatives of the measure by the dimensions:
///
/// ```text
/// mean shift  ½ Σ H_ii σ_i²
/// variance    Σ s_i² σ_i² + ¼ Σ H_ii² (μ4_i − σ_i⁴) + ½ Σ_(i≠j) H_ij² σ_i² σ_j²
/// ```
///
/// The formulas are valid for independent dimensions with symmetric distributions; σ_i² and μ4_i
/// are the second and fourth moments. The two components of a disc are not independent, so Kin uses
/// their joint moments. Kin computes H from differences of the exact gradient with Richardson
/// extrapolation, to about nine correct digits.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SecondOrder {
    /// The dimensions of the rows and columns of H: the dimensions with a tolerance, and both
    /// dimensions of each clearance.
    pub names: Vec<String>,
    /// H, symmetric, row by row. \[unit of the measure per unit of both dimensions\]
    pub hessian: Vec<Vec<f64>>,
    /// The mean of the measure minus its nominal value. \[unit of the measure\]
    pub mean_shift: f64,
    /// The standard deviation of the measure. \[unit of the measure\]
    pub sigma: f64,
}

/// Computes the second-order term. Returns `None` if the mechanism cannot be assembled near its
/// dimensions.
pub(super) fn order<M: Measure>(
    followed: &Followed<'_, M>,
    sources: &[Source],
    names: &[String],
    slopes: &[f64],
) -> Result<Option<SecondOrder>> {
    let n = names.len();
    let mut hessian = vec![vec![0.0; n]; n];
    for source in sources {
        for k in &source.parts {
            let Some(column) = column(followed, names, *k, source.tolerance)? else {
                return Ok(None);
            };
            hessian[*k] = column;
        }
    }
    let mean = |i: usize, j: usize| 0.5 * (hessian[i][j] + hessian[j][i]);
    let hessian: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| mean(i, j)).collect()).collect();
    let [mean_shift, variance] = moments(sources, slopes, &hessian);
    let told = SecondOrder { names: names.to_vec(), hessian, mean_shift, sigma: variance.sqrt() };
    Ok(Some(told).filter(|told| told.mean_shift.is_finite() && told.sigma.is_finite()))
}

/// Returns the derivatives of the gradient by dimension k: central differences at two steps,
/// extrapolated.
fn column<M: Measure>(
    followed: &Followed<'_, M>,
    names: &[String],
    k: usize,
    tolerance: f64,
) -> Result<Option<Vec<f64>>> {
    let mut slopes = Vec::new();
    for h in [STEP * tolerance, 0.5 * STEP * tolerance] {
        let mut sides = Vec::new();
        for side in [h, -h] {
            let Some(system) = followed.system.off([(&names[k], side)]) else { return Ok(None) };
            let Some(gradient) = followed.gradient(&system, names)? else { return Ok(None) };
            // The rounded step is the one that was taken.
            let taken = system.parameter(&names[k])? - followed.system.parameter(&names[k])?;
            sides.push((taken, gradient));
        }
        let (plus, above) = &sides[0];
        let (minus, below) = &sides[1];
        let slope = |i: usize| (above[i] - below[i]) / (plus - minus);
        slopes.push((0..names.len()).map(slope).collect::<Vec<f64>>());
    }
    let extrapolated =
        slopes[0].iter().zip(&slopes[1]).map(|(wide, near)| (4.0 * near - wide) / 3.0);
    Ok(Some(extrapolated.collect()))
}

/// Returns the mean shift and the variance.
fn moments(sources: &[Source], slopes: &[f64], hessian: &[Vec<f64>]) -> [f64; 2] {
    let [mut mean, mut variance] = [0.0; 2];
    let of = |source: &Source| {
        let [second, fourth] = source.distribution.moments();
        let t = source.tolerance;
        [second * t.powi(2), fourth * t.powi(4)]
    };
    for source in sources {
        let [second, fourth] = of(source);
        mean += 0.5 * second * source.parts.iter().map(|k| hessian[*k][*k]).sum::<f64>();
        variance += second * source.parts.iter().map(|k| slopes[*k].powi(2)).sum::<f64>();
        variance += match source.parts[..] {
            // For x and y of a disc E(x² y²) is a third of E(x⁴).
            [x, y] => {
                let xx = hessian[x][x];
                let yy = hessian[y][y];
                let xy = hessian[x][y];
                let square = fourth * (xx * xx + yy * yy + (2.0 * xx * yy + 4.0 * xy * xy) / 3.0);
                0.25 * (square - (second * (xx + yy)).powi(2))
            }
            _ => {
                let own = |k: &usize| 0.25 * hessian[*k][*k].powi(2) * (fourth - second * second);
                source.parts.iter().map(own).sum::<f64>()
            }
        };
        for other in sources.iter().filter(|other| !std::ptr::eq(*other, source)) {
            let pairs = source
                .parts
                .iter()
                .flat_map(|i| other.parts.iter().map(|j| hessian[*i][*j].powi(2)));
            variance += 0.5 * second * of(other)[0] * pairs.sum::<f64>();
        }
    }
    [mean, variance]
}
