//! Finds turning points, where dt/ds changes its sign, no solution exists beyond t*, and two
//! branches meet.

use super::curve::{Curve, CurvePoint};
use super::root::root;

/// The search ends at this dt/ds in scaled units; the error of t is its square. \[-\]
const ENOUGH: f64 = 1e-12;

/// Returns the place with dt/ds = 0 between `here` and one that is `s` further on, and its
/// distance.
pub(super) fn locate(
    curve: &mut Curve<'_>,
    here: &CurvePoint,
    next: &CurvePoint,
    s: f64,
) -> Option<(CurvePoint, f64)> {
    let time = curve.sizes[curve.model.n()];
    let found = root((0.0, here.dt() / time), (s, next.dt() / time), ENOUGH, |s| {
        Some(curve.at(here, s)?.0.dt() / time)
    })?;
    Some((curve.at(here, found)?.0, found))
}

/// Returns the place with the time `to` between `here` and one that is `s` further on.
pub(super) fn at_time(
    curve: &mut Curve<'_>,
    here: &CurvePoint,
    next: &CurvePoint,
    s: f64,
    to: f64,
) -> Option<CurvePoint> {
    let enough = 4.0 * f64::EPSILON * to.abs();
    let found = root((0.0, here.t() - to), (s, next.t() - to), enough, |s| {
        Some(curve.at(here, s)?.0.t() - to)
    })?;
    Some(curve.at(here, found)?.0)
}

/// Returns x between two neighbouring places at which dt/ds of the interpolated curve vanishes. It
/// serves where the curve itself cannot be followed.
pub(super) fn between(here: &CurvePoint, next: &CurvePoint, s: f64) -> Option<Vec<f64>> {
    let end =
        |place: &CurvePoint, k: usize| [place.x[k], s * place.dx[k], 0.5 * s * s * place.ddx[k]];
    let along = |k: usize| quintic(end(here, k), end(next, k));
    let time = along(here.x.len() - 1);
    let rate = |u: f64| (1..6).rev().fold(0.0, |sum, k| sum * u + k as f64 * time[k]);
    let u = root((0.0, rate(0.0)), (1.0, rate(1.0)), 0.0, |u| Some(rate(u)))?;
    Some((0..here.x.len()).map(|k| along(k).iter().rev().fold(0.0, |sum, c| sum * u + c)).collect())
}

/// Returns the coefficients over 0 ≤ u ≤ 1 of the quintic polynomial with the given value, slope
/// and half of the second derivative at both ends.
fn quintic([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 6] {
    let p = x - a - b - c;
    let q = y - b - 2.0 * c;
    let r = z - c;
    [a, b, c, 10.0 * p - 4.0 * q + r, -15.0 * p + 7.0 * q - 2.0 * r, 6.0 * p - 3.0 * q + r]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mechanism, System, constraint};

    #[constraint]
    fn circle(x: Coord, t: Time) -> f64 {
        x * x + (t - 2.0) * (t - 2.0) - 1.0
    }

    fn system() -> System {
        let mut m = Mechanism::new("circle");
        let x = m.length("x", 1.0).expect("a new name");
        m.add("c", circle(x)).expect("adds");
        m.build().expect("builds")
    }

    /// Places at two angles of the circle, which turns round at t = 3 and x = 0.
    fn places(curve: &mut Curve<'_>, [a, b]: [f64; 2]) -> (CurvePoint, CurvePoint, f64) {
        let mut at = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            curve.place(vec![cos, 2.0 + sin], &[-sin, cos]).expect("is regular")
        };
        (at(a), at(b), b - a)
    }

    /// By the curve itself, by what is interpolated, and where the time is one that is asked for;
    /// whatever time is measured by.
    #[test]
    fn where_time_turns_round() {
        let system = system();
        let quarter = 0.5 * std::f64::consts::PI;
        for (time, [before, behind]) in
            [(1.0, [0.05, 0.03]), (1.0, [0.01, 0.1]), (0.5, [0.05, 0.03]), (1e3, [0.02, 0.02])]
        {
            let mut curve = Curve::new(&system, &[1.0], time);
            let (here, next, _) = places(&mut curve, [quarter - before, quarter + behind]);
            // The arc has another length in the units of the measures.
            let gone: Vec<f64> = here.x.iter().zip(&next.x).map(|(a, b)| b - a).collect();
            let s = curve.dot(&gone, &here.dx);
            let (place, found) = locate(&mut curve, &here, &next, s).expect("turns round");
            assert!(
                (place.t() - 3.0).abs() < 1e-15
                    && place.x[0].abs() < 1e-9
                    && found > 0.0
                    && found < 1.2 * s.abs(),
                "{time} {place:?}"
            );
        }
        let mut curve = Curve::new(&system, &[1.0], 1.0);
        let (here, next, s) = places(&mut curve, [quarter - 0.05, quarter + 0.03]);
        let x = between(&here, &next, s).expect("turns round");
        assert!(x[0].abs() < 1e-9 && (x[1] - 3.0).abs() < 1e-11, "{x:?}");
        let (here, next, s) = places(&mut curve, [0.3, 0.4]);
        assert!(between(&here, &next, s).is_none_or(|x| (x[1] - 3.0).abs() > 1e-3));
        let backwards = places(&mut curve, [0.4, 0.3]);
        let all = [2.3, 2.35, 2.0 + 0.3_f64.sin()].map(|to| (to, (here.clone(), next.clone(), s)));
        for (to, (here, next, s)) in
            all.into_iter().chain([(2.31, backwards.clone()), (2.38, backwards)])
        {
            let place = at_time(&mut curve, &here, &next, s, to).expect("comes to it");
            assert!(
                (place.t() - to).abs() <= 8.0 * f64::EPSILON * to
                    && (place.x[0] - (1.0 - (to - 2.0) * (to - 2.0)).sqrt()).abs() < 1e-14
            );
        }
    }

    /// Value, slope and half the second derivative at both ends are those given.
    #[test]
    fn a_polynomial_by_both_ends() {
        let begin = [1.0, -2.0, 0.5];
        let end = [3.0, 0.25, -4.0];
        let c = quintic(begin, end);
        let sum = |weight: fn(i32) -> i32| {
            (0..6).map(|k| f64::from(weight(k)) * c[k as usize]).sum::<f64>()
        };
        assert_eq!(
            ([c[0], c[1], c[2]], [sum(|_| 1), sum(|k| k), sum(|k| k * (k - 1) / 2)]),
            (begin, end)
        );
    }
}
