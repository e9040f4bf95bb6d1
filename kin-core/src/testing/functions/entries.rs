//! Facts of an entry are true of its function.

use kin_graph::functions::{Growth, Place};
use kin_graph::{Function, rules};

use super::digits::Digits;
use super::points::{Point, numbers};
use super::{Complaints, is_near, units};

pub fn check(complaints: &mut Complaints, f: Function, points: &[Point]) {
    values(complaints, f, points);
    domain(complaints, f);
    places(complaints, f);
    slopes(complaints, f, points);
    growth(complaints, f, points);
}

/// `value` is right within `error`, and within `range`.
fn values(complaints: &mut Complaints, f: Function, points: &[Point]) {
    let facts = f.facts();
    let name = f.name();
    for point in points {
        let x = point.x;
        let found = f.value()(point.x);
        let Some(exact) = point.value() else { continue };
        let allowed = units(exact, (facts.error)(x.abs()));
        complaints.unless(is_near(found, exact, &allowed), || {
            format!("{name}: its value at {x:e} is {found:e}, further off than its `error`")
        });
        let [least, most] = facts.range.map(|x| x.clamp(-f64::MAX, f64::MAX));
        let is_within = (facts.range[0].is_infinite() || *exact >= Digits::new(least))
            && (facts.range[1].is_infinite() || *exact <= Digits::new(most));
        complaints
            .unless(is_within, || format!("{name}: its value at {x:e} is beyond its `range`"));
    }
    complaints.unless(f.value()(f64::NAN).is_nan(), || format!("{name} of NaN is a number"));
}

/// Values end where `domain` ends.
fn domain(complaints: &mut Complaints, f: Function) {
    let name = f.name();
    let value = f.value();
    let [from, to] = f.facts().domain;
    for (end, outside) in [(from, from.next_down()), (to, to.next_up())] {
        if end.is_infinite() {
            continue;
        }
        let is_pole = f.facts().poles.contains(&Place::At(end));
        complaints
            .unless(value(outside).is_nan(), || format!("{name} has a value beyond its `domain`"));
        complaints.unless(value(end).is_infinite() == is_pole && !value(end).is_nan(), || {
            format!(
                "{name} at the end of its `domain`, {end}: a pole, or none, but its `poles` do not say so"
            )
        });
    }
    for x in [-1e3, -3.0, -0.5, 0.5, 3.0, 1e3] {
        let is_inside = from <= x && x <= to;
        complaints.unless(value(x).is_nan() != is_inside, || {
            format!("{name} at {x} is not as its `domain` says")
        });
    }
}

/// `extrema` have their values, at `poles` it jumps or is very large, where it is `steep` its value
/// is finite.
fn places(complaints: &mut Complaints, f: Function) {
    let facts = f.facts();
    let name = f.name();
    let value = f.value();
    for (place, extremum) in facts.extrema {
        for x in numbers(*place) {
            let at = value(x);
            let beside = [value(x - 1e-3), value(x + 1e-3)];
            complaints.unless((at - extremum).abs() <= 1e-9 * (1.0 + extremum.abs()), || {
                format!("{name}: its extremum at {x} is {at}, not {extremum}")
            });
            complaints.unless((beside[0] < at) == (beside[1] < at), || {
                format!("{name}: what is among its `extrema` at {x} is none")
            });
        }
    }
    for x in facts.poles.iter().flat_map(|place| numbers(*place)) {
        let jump = (value(x.next_up()) - value(x.next_down())).abs();
        complaints.unless(jump > 1.0 || jump.is_nan(), || format!("{name}: at {x} it has no pole"));
    }
    for x in facts.steep {
        let at = value(*x);
        let slope = rules::slope(f, *x, at);
        complaints.unless(at.is_finite() && slope.is_infinite(), || {
            format!("{name}: at {x} it is {at} with the slope {slope}, which is not `steep`")
        });
    }
}

/// Its slope is finite where its value is, but where it is `steep`.
fn slopes(complaints: &mut Complaints, f: Function, points: &[Point]) {
    for point in points.iter().filter(|point| point.value().is_some()) {
        let x = point.x;
        let y = f.value()(point.x);
        let slope = rules::slope(f, x, y);
        let is_known = !y.is_finite() || slope.is_finite() || f.facts().steep.contains(&x);
        let is_large =
            point.exact.get(1).is_some_and(|slope| slope.clone().abs() > Digits::new(1e150));
        complaints.unless(is_known || is_large, || {
            format!(
                "{}: its slope at {x:e} is {slope}, but it is not among its `steep` points",
                f.name()
            )
        });
    }
}

/// Its values at large arguments are as `growth` says.
fn growth(complaints: &mut Complaints, f: Function, points: &[Point]) {
    let facts = f.facts();
    let value = f.value();
    let far = [-1100.0, 1100.0].map(value).into_iter().filter(|y| !y.is_nan());
    let bursts = far.clone().any(f64::is_infinite);
    let end = value(f64::MAX);
    let is_so = match facts.growth {
        Growth::Ordinary => !bursts,
        Growth::Bounded => {
            points.iter().map(|point| value(point.x)).all(|y| y.is_nan() || y.abs() <= 10.0)
        }
        Growth::Logarithmic => !bursts && (end.is_nan() || end.abs() <= 1100.0),
        Growth::Bursting => bursts,
    };
    complaints.unless(is_so, || format!("{}: its `growth` is not {:?}", f.name(), facts.growth));
}
