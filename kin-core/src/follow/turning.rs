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
