//! A function over intervals and in series of them: whatever is between the bounds of the argument,
//! values and derivatives are between those of the result; and bounds are known where the entry
//! says so.

use kin_graph::Function;
use kin_graph::functions::Place;

use super::Complaints;
use super::digits::Digits;
use super::points::Point;
use crate::numbers::enclosure::interval::{Interval, ONE};
use crate::numbers::enclosure::series::{ORDER, Series};

/// So many points that follow one another are within one interval.
const SPANS: [usize; 5] = [1, 2, 3, 7, 20];

pub fn check(complaints: &mut Complaints, f: Function, points: &[Point]) {
    let inside: Vec<&Point> = points.iter().filter(|point| point.x.is_finite()).collect();
    for span in SPANS {
        for points in inside.windows(span) {
            over(complaints, f, points);
        }
    }
    for point in points {
        thin(complaints, f, point);
    }
}

/// True if bounds hold a number.
pub fn holds(bounds: Interval, exact: &Digits) -> bool {
    let is_above = bounds.lo().is_infinite() || *exact >= Digits::new(bounds.lo());
    is_above && (bounds.hi().is_infinite() || *exact <= Digits::new(bounds.hi()))
}

/// Over the interval from the first to the last point.
fn over(complaints: &mut Complaints, f: Function, points: &[&Point]) {
    let [a, b] = [points[0].x, points[points.len() - 1].x];
    let x = Interval::new(a, b);
    let bounds = x.call(f);
    let series = Series::variable(x, ONE, ORDER + 1);
    let result = series.call(f);
    for point in points {
        let Some(exact) = point.value() else {
            let is_end = f.facts().domain.contains(&point.x) && bounds.lo() < bounds.hi();
            complaints.unless(!bounds.is_finite() || is_end, || {
                format!(
                    "{}: bounds from {a:e} to {b:e} are {bounds:?}, though it has no value at {:e}",
                    f.name(),
                    point.x
                )
            });
            continue;
        };
        complaints.unless(holds(bounds, exact), || {
            format!(
                "{}: bounds from {a:e} to {b:e} are {bounds:?} and do not hold its value at {:e}",
                f.name(),
                point.x
            )
        });
        if result.len() > 1 && point.is_smooth(f) {
            complaints.unless(holds(result.at(1), &point.exact[1]), || {
                format!(
                    "{}: bounds of its slope from {a:e} to {b:e} do not hold that at {:e}",
                    f.name(),
                    point.x
                )
            });
        }
    }
    samples(complaints, f, x, bounds);
}

/// At many numbers between the bounds f64's values are between those of the result.
fn samples(complaints: &mut Complaints, f: Function, x: Interval, bounds: Interval) {
    let mut is_finite = true;
    for k in 0..=16 {
        let at = x.lo() + (x.hi() - x.lo()) * f64::from(k) / 16.0;
        let value = f.value()(at.clamp(x.lo(), x.hi()));
        is_finite &= value.is_finite();
        let room = (f.facts().error)(x.mag()) * f64::EPSILON * value.abs();
        complaints.unless(
            !value.is_finite() || bounds.lo() - room <= value && value <= bounds.hi() + room,
            || {
                format!(
                    "{}: bounds over {x:?} are {bounds:?}, but its value at {at:e} is {value:e}",
                    f.name()
                )
            },
        );
        complaints.unless(!value.is_nan() || !bounds.is_finite(), || {
            format!("{}: bounds over {x:?} are {bounds:?}, but it has no value at {at:e}", f.name())
        });
    }
    let facts = f.facts();
    let jumps = facts.jumps.is_some_and(|steps| steps(x.lo()) != steps(x.hi()));
    let has_pole = facts.poles.iter().any(|pole| x.passes(*pole));
    complaints.unless(bounds.is_finite() || !is_finite || jumps || has_pole, || {
        format!("{}: nothing is known over {x:?}, where it has no pole", f.name())
    });
}

/// Of one number: bounds are narrow, and the coefficients hold the derivatives.
fn thin(complaints: &mut Complaints, f: Function, point: &Point) {
    let name = f.name();
    let x = point.x;
    let Some(exact) = point.value() else { return };
    let bounds = Interval::from(x).call(f);
    let value = f.value()(x);
    if value.is_finite() && value.abs() > 1e-290 && value.abs() < 1e300 {
        let places = bounds.radius() / (f64::EPSILON * value.abs());
        // Of large angles the number of turns is not known.
        let facts = f.facts();
        let named = facts.extrema.iter().map(|(place, _)| place).chain(facts.poles);
        let is_angle = named.into_iter().any(|place| matches!(place, Place::Quarters { .. }));
        complaints.unless(places <= 2.0 * (f.facts().error)(x.abs()) + 2.0 || is_angle, || {
            format!("{name}: bounds at {x:e} are {bounds:?}, {places} places wide")
        });
    }
    complaints.unless(holds(bounds, exact), || format!("{name}: bounds at {x:e} are {bounds:?}"));
    let series = Series::variable(Interval::from(x), ONE, ORDER + 1).call(f);
    let mut factorial = 1.0;
    for (k, exact) in point.exact.iter().enumerate() {
        factorial *= (k as f64).max(1.0);
        complaints.unless(holds(series.at(k) * Interval::from(factorial), exact), || {
            format!("{name}: coefficient {k} at {x:e} is {:?}", series.at(k))
        });
    }
    let is_steep = point.exact.get(1).is_some_and(|slope| slope.clone().abs() > Digits::new(1e6));
    let is_ordinary = point.is_smooth(f) && !is_steep && x.abs() < 1e2 && value.is_finite();
    complaints.unless(!is_ordinary || series.len() > 3, || {
        format!("{name}: of its series at {x:e} only {} coefficients are known", series.len())
    });
}
