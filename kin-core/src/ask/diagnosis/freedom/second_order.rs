//! Finds the freedoms that exist to first order only, and the distance that play allows, by a
//! second-order test.
//!
//! A motion q + s n + s² w with C_q n = 0 stays on C = 0 to second order only if l · (C_q n)_q n =
//! 0 for each l with lᵀ C_q = 0 (R. Connelly, W. Whiteley, Second-order rigidity and prestress
//! stability, SIAM J. Discrete Math. 9, 1996). If a combination of the l makes the quadratic form l
//! · (C_q n)_q n definite in n, no direction remains: the structure is rigid, but shaky.

use super::super::examined::Examined;
use crate::coordinates::layout::Kind;
use crate::coordinates::units::Unit;
use crate::linear::dense;
use crate::outcome::verdict::Play;

/// Values below this are rounding; rows, coordinates and vectors are of order 1. \[-\]
const FLAT: f64 = 1e-6;

/// The largest number of left null vectors whose signs are combined: 2ⁿ combinations.
const COMBINED: usize = 5;

/// Returns the left null vectors in units of the rows as they are written: l · C is of order 1.
fn stresses(examined: &Examined<'_>) -> Vec<Vec<f64>> {
    let norms = &examined.measures().norms;
    let scaled = examined.here.dependent.iter().map(|(_, vector)| dense(vector, norms.len()));
    scaled.map(|y| y.iter().zip(norms).map(|(y, norm)| y / norm).collect()).collect()
}

/// Returns (C_q v)_q v at the pose and a constant time. The list is empty if it is not finite.
fn curvature(examined: &Examined<'_>, v: &[f64]) -> Vec<f64> {
    let rhs = examined.model().second_order(examined.q, examined.t, v, 0.0).unwrap_or_default();
    rhs.into_iter().map(|x| -x).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns true if the second order holds all these motions and each combination of them: a
/// combination of the forms l · (C_q n)_q n is definite.
pub(super) fn holds(examined: &Examined<'_>, directions: &[Vec<f64>]) -> bool {
    let stresses = stresses(examined);
    if stresses.is_empty() || directions.is_empty() {
        return false;
    }
    let forms: Vec<Vec<Vec<f64>>> = forms(examined, directions, &stresses);
    let count = forms.len().min(COMBINED);
    // Each form alone, then sums of all with either sign.
    forms.iter().any(|form| is_definite(form))
        || (0..1_usize << count.saturating_sub(1)).any(|signs| {
            let mut sum = vec![vec![0.0; directions.len()]; directions.len()];
            for (k, form) in forms.iter().take(count).enumerate() {
                let sign = if signs >> k & 1 == 1 { -1.0 } else { 1.0 };
                let add = |(sum, form): (&mut Vec<f64>, &Vec<f64>)| {
                    sum.iter_mut().zip(form).for_each(|(sum, x)| *sum += sign * x);
                };
                sum.iter_mut().zip(form).for_each(add);
            }
            is_definite(&sum)
        })
}

/// Returns for each left null vector the symmetric matrix of its form over the directions, by
/// polarisation.
fn forms(
    examined: &Examined<'_>,
    directions: &[Vec<f64>],
    stresses: &[Vec<f64>],
) -> Vec<Vec<Vec<f64>>> {
    let count = directions.len();
    let mut forms = vec![vec![vec![0.0; count]; count]; stresses.len()];
    let own: Vec<Vec<f64>> = directions.iter().map(|v| curvature(examined, v)).collect();
    for i in 0..count {
        for j in 0..=i {
            let mixed: Vec<f64> = if i == j {
                own[i].clone()
            } else {
                let sum: Vec<f64> =
                    directions[i].iter().zip(&directions[j]).map(|(a, b)| a + b).collect();
                let whole = curvature(examined, &sum);
                whole
                    .iter()
                    .zip(&own[i])
                    .zip(&own[j])
                    .map(|((whole, a), b)| 0.5 * (whole - a - b))
                    .collect()
            };
            for (form, stress) in forms.iter_mut().zip(stresses) {
                (form[i][j], form[j][i]) = (dot(stress, &mixed), dot(stress, &mixed));
            }
        }
    }
    forms
}

/// Returns true if a symmetric matrix or its negative has a Cholesky factor with pivots above
/// rounding.
fn is_definite(form: &[Vec<f64>]) -> bool {
    [1.0, -1.0].into_iter().any(|sign| {
        let mut a: Vec<Vec<f64>> =
            form.iter().map(|row| row.iter().map(|x| sign * x).collect()).collect();
        let size = a.iter().flatten().fold(FLAT, |m, x| m.max(x.abs()));
        (0..a.len()).all(|k| {
            let pivot = a[k][k];
            if !(pivot > FLAT * size && pivot > FLAT) {
                return false;
            }
            let (done, rest) = a.split_at_mut(k + 1);
            for row in rest {
                let factor = row[k] / pivot;
                row.iter_mut().zip(&done[k]).skip(k).for_each(|(x, own)| *x -= factor * own);
            }
            true
        })
    })
}

/// Returns the distance of a motion n of first order if the joints have play.
///
/// With errors e of the rows, l · C(q + s n + s² w) = ½ s² l · (C_q n)_q n = l · e to leading
/// order. Joints with a play ε allow l · e of at most ε Λ. Λ is the sum over all joints of the
/// force |l| times the change of its rows per length. So |s| ≤ √(2 ε Λ / |l · (C_q n)_q n|), and
/// the smallest bound of all l counts.
pub(super) fn play(examined: &Examined<'_>, v: &[f64]) -> Option<Play> {
    /// The assumed play, as a share of the mechanism's length. \[-\]
    const SHARE: f64 = 1e-4;
    let model = examined.model();
    let sizes = &examined.measures().sizes;
    let metre = model.layout.units.iter().position(|unit| *unit == Unit::Metre)?;
    let play = 10.0_f64.powf((SHARE * sizes[metre]).log10().round());
    let curvature = curvature(examined, v);
    let per_length = per_length(examined);
    let reach = |stress: Vec<f64>| {
        let bend = dot(&stress, &curvature).abs();
        let forces = model.equations.blocks.iter().map(|block| {
            block.rows().map(|row| (stress[row] * per_length[row]).powi(2)).sum::<f64>().sqrt()
        });
        let forces: f64 = forces.sum();
        (bend > FLAT && forces > 0.0).then(|| (2.0 * play * forces / bend).sqrt())
    };
    let s = stresses(examined).into_iter().filter_map(reach).reduce(f64::min)?;
    let moves = model.layout.items.iter().map(|item| {
        let own = &v[item.first..item.first + item.kind.coordinates().len()];
        let norm = |part: &[f64]| s * part.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (moves, turns) = match item.kind {
            Kind::Planar => (norm(&own[..2]), norm(&own[2..])),
            // |ṗ| of Euler parameters is half of the angular velocity.
            Kind::Spatial => (norm(&own[..3]), 2.0 * norm(&own[3..])),
            Kind::Length => (norm(own), 0.0),
            Kind::Angle => (0.0, norm(own)),
        };
        Play { body: item.name.clone(), play, moves, turns }
    });
    // Of two bodies that move equally far Kin names the first.
    let further = |a: &Play, b: &Play| {
        let close = (a.moves - b.moves).abs() <= 1e-6 * a.moves.max(b.moves);
        if close { b.turns > (1.0 + 1e-6) * a.turns } else { b.moves > a.moves }
    };
    let largest = moves.reduce(|best, next| if further(&best, &next) { next } else { best });
    largest.filter(|play| play.moves.is_finite() && play.turns.is_finite())
}

/// Returns for each row its change per displacement of a point: the largest of its derivatives by
/// lengths, one value for all components of a vector.
fn per_length(examined: &Examined<'_>) -> Vec<f64> {
    let model = examined.model();
    let mut most = vec![0.0_f64; model.m()];
    let Ok(point) = model.linearize(examined.q, examined.t) else { return most };
    let lengths = model.entries(&point.values);
    for (row, _, value) in
        lengths.filter(|(_, column, _)| model.layout.units[*column] == Unit::Metre)
    {
        most[row] = most[row].max(value.abs());
    }
    most
}
