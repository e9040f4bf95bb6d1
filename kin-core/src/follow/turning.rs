//! Turning points: where dt/ds changes its sign there is no solution beyond t*, and two branches meet.

use super::curve::{Curve, Place};
use super::root::root;

/// dt/ds, by the measures, at which the search ends: t is off by its square.   \[-\]
const ENOUGH: f64 = 1e-12;

/// The place between `here` and one that is `s` further on, where dt/ds vanishes, and how far on it is.
pub(super) fn locate(curve: &mut Curve<'_>, here: &Place, next: &Place, s: f64) -> Option<(Place, f64)> {
    let time = curve.sizes[curve.model.n()];
    let found = root((0.0, here.dt() / time), (s, next.dt() / time), ENOUGH, |s| Some(curve.at(here, s)?.0.dt() / time))?;
    Some((curve.at(here, found)?.0, found))
}

/// The place between `here` and one that is `s` further on, where the time is `to`.
pub(super) fn at_time(curve: &mut Curve<'_>, here: &Place, next: &Place, s: f64, to: f64) -> Option<Place> {
    let enough = 4.0 * f64::EPSILON * to.abs();
    let found = root((0.0, here.t() - to), (s, next.t() - to), enough, |s| Some(curve.at(here, s)?.0.t() - to))?;
    Some(curve.at(here, found)?.0)
}

/// x between two places near one another, where dt/ds of the curve interpolated between them vanishes: for where the curve cannot be followed itself.
pub(super) fn between(here: &Place, next: &Place, s: f64) -> Option<Vec<f64>> {
    let end = |place: &Place, k: usize| [place.x[k], s * place.dx[k], 0.5 * s * s * place.ddx[k]];
    let along = |k: usize| quintic(end(here, k), end(next, k));
    let time = along(here.x.len() - 1);
    let rate = |u: f64| (1..6).rev().fold(0.0, |sum, k| sum * u + k as f64 * time[k]);
    let u = root((0.0, rate(0.0)), (1.0, rate(1.0)), 0.0, |u| Some(rate(u)))?;
    Some((0..here.x.len()).map(|k| along(k).iter().rev().fold(0.0, |sum, c| sum * u + c)).collect())
}

/// Coefficients over 0 ≤ u ≤ 1 of the polynomial of fifth degree with value, slope and half the second derivative given at both ends.
fn quintic([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 6] {
    let (p, q, r) = (x - a - b - c, y - b - 2.0 * c, z - c);
    [a, b, c, 10.0 * p - 4.0 * q + r, -15.0 * p + 7.0 * q - 2.0 * r, 6.0 * p - 3.0 * q + r]
}
