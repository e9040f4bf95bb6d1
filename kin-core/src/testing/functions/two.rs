//! Functions of two numbers: f64, numbers with derivatives, blame, lanes, series, against 60
//! digits.

use std::f64::consts::TAU;

use kin_graph::functions::{ALLOWED, Growth};
use kin_graph::{Function2, Number};

use super::bounds::holds;
use super::digits::{Digits, Taylor};
use super::{Complaints, is_near, units};
use crate::model::blame::jet::Jet;
use crate::numbers::enclosure::interval::Interval;
use crate::numbers::enclosure::series::{ORDER, Series};
use crate::numbers::lanes::Lanes;
use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, Real};
use crate::program::tests::functions::in_lanes;

const NUMBERS: [f64; 12] = [-7.5, -2.3, -1.0, -0.4, 0.3, 0.5, 1.0, 1.9, 2.0, 5.75, 1e3, 1e9];
const NASTY: [f64; 8] =
    [0.0, -0.0, 5e-324, 1e-300, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
/// The point moves along (1, −0.75).
const ALONG: [f64; 2] = [1.0, -0.75];

pub fn check(complaints: &mut Complaints) {
    for &f in Function2::ALL {
        let pairs = |numbers: &'static [f64], others: &'static [f64]| {
            numbers.iter().flat_map(move |x| others.iter().map(move |y| (*x, *y)))
        };
        for (x, y) in pairs(&NUMBERS, &NUMBERS).filter(|(x, y)| is_ordinary(f, *x, *y)) {
            ordinary(complaints, f, [x, y]);
        }
        let nasty =
            pairs(&NASTY, &NASTY).chain(pairs(&NASTY, &NUMBERS)).chain(pairs(&NUMBERS, &NASTY));
        let all: Vec<(f64, f64)> = nasty.chain(pairs(&NUMBERS, &NUMBERS)).collect();
        for (x, y) in &all {
            let plain = f.value()(*x, *y);
            same(complaints, f, "constants", [*x, *y], Real(*x).call2(f, Real(*y)).0, plain);
            let moved = Real(Dual64::new(*x, 1.0)).call2(f, Real(Dual64::new(*y, 1.0)));
            same(complaints, f, "first order", [*x, *y], moved.0.re, plain);
            same(complaints, f, "emitted code", [*x, *y], emitted(f)(*x, *y), plain);
        }
        lanes(complaints, f, &all);
        entry(complaints, f);
    }
}

/// True if there is a value with slopes to all sides.
fn is_ordinary(f: Function2, x: f64, y: f64) -> bool {
    let value = f.value()(x, y);
    let whole = |x: f64| (x - x.round()).abs() < 1e-9;
    value.is_finite()
        && value.abs() < 1e200
        && match f {
            Function2::Powf => x > 0.0 && value > 1e-200,
            Function2::Max | Function2::Min => x != y,
            Function2::Rem | Function2::RemEuclid | Function2::DivEuclid => !whole(x / y),
            _ => true,
        }
}

/// Facts of an entry are true of its function.
fn entry(complaints: &mut Complaints, f: Function2) {
    let name = f.name();
    let value = f.value();
    let facts = f.facts();
    let others = NUMBERS.iter().filter(|y| y.abs() < 10.0);
    let jumps = others.clone().any(|y| jumps(&|x| value(x, *y)) || jumps(&|x| value(*y, x)));
    complaints.unless(jumps == facts.jumps, || {
        format!(
            "{name}: it {}, but its `jumps` says otherwise",
            if jumps { "jumps" } else { "does not jump" }
        )
    });
    const FAR: [f64; 4] = [-1100.0, -0.5, 0.5, 1100.0];
    let far = FAR.iter().flat_map(|x| FAR.map(|y| value(*x, y))).filter(|z| !z.is_nan());
    let (most, burst) = far
        .fold((0.0_f64, false), |(most, burst), z| (most.max(z.abs()), burst || z.is_infinite()));
    let is_so = match facts.growth {
        Growth::Ordinary => !burst,
        Growth::Bounded => most <= 10.0,
        Growth::Logarithmic => !burst && most <= 1100.0,
        Growth::Bursting => burst,
    };
    complaints.unless(is_so, || format!("{name}: its `growth` is not {:?}", facts.growth));
}

/// True if a function jumps within ±10 between two finite values that are no whole turns apart:
/// halving what lies between two places does not make the difference of its values small.
fn jumps(f: &dyn Fn(f64) -> f64) -> bool {
    const STEPS: usize = 640;
    let place = |k: usize| -10.003 + 20.0 * k as f64 / STEPS as f64;
    (0..STEPS).any(|k| {
        let mut low = place(k);
        let mut high = place(k + 1);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let is_below = (f(middle) - f(low)).abs() > (f(high) - f(middle)).abs();
            *(if is_below { &mut high } else { &mut low }) = middle;
        }
        let jump = (f(high) - f(low)).abs();
        let turns = jump / TAU;
        jump.is_finite()
            && jump > 0.01
            && (turns - turns.round()).abs() > 1e-6
            && f(high).abs() < 1e6
    })
}

fn same(
    complaints: &mut Complaints,
    f: Function2,
    kind: &str,
    at: [f64; 2],
    found: f64,
    plain: f64,
) {
    // Of two zeros either may be the larger.
    let is_same = found == plain || found.is_nan() && plain.is_nan();
    complaints
        .unless(is_same, || format!("{}, {kind}: {found:e}, not {plain:e}, at {at:?}", f.name()));
}

fn ordinary(complaints: &mut Complaints, f: Function2, at: [f64; 2]) {
    let name = f.name();
    let [x, y] = at.map(Taylor::constant);
    let moving = |mut series: Taylor, along: f64| {
        series.0[1] = Digits::new(along);
        series
    };
    let exact = moving(x, ALONG[0]).call2(f, moving(y, ALONG[1])).derivatives();
    let plain = f.value()(at[0], at[1]);
    // The value of x − n y is off by as much as x is.
    let size =
        exact[0].clone().abs() + Digits::new(if f.facts().exact { 0.0 } else { at[0].abs() });
    let size = if matches!(f, Function2::RemEuclid) { size } else { exact[0].clone() };
    complaints.unless(is_near(plain, &exact[0], &units(&size, ALLOWED)), || {
        format!("{name}: its value at {at:?} is {plain:e}")
    });
    let third = |k: usize| Real(Dual3_64::new(at[k], ALONG[k], 0.0, 0.0));
    let third = third(0).call2(f, third(1)).0;
    let second = |k: usize| Real(Dual2_64::new(at[k], ALONG[k], 0.0));
    let second = second(0).call2(f, second(1)).0;
    let jet = Jet::moving(at[0], [ALONG[0], 0.0]).call2(f, Jet::moving(at[1], [ALONG[1], 0.0]));
    let slopes = jet.slopes.unwrap_or_default();
    let found = [
        ("third order", vec![third.re, third.v1, third.v2, third.v3]),
        ("second order", vec![second.re, second.v1, second.v2]),
        ("blame", vec![jet.value, slopes[0], slopes[1]]),
    ];
    let most = exact.iter().map(|x| x.clone().abs()).reduce(|a, b| if a > b { a } else { b });
    let most = most.unwrap_or(Digits::new(0.0));
    for (kind, found) in found {
        same(complaints, f, kind, at, found[0], plain);
        for (order, (found, exact)) in found.iter().zip(&exact).enumerate().skip(1) {
            let allowed = most.clone() * Digits::new(1e-11) + Digits::new(1e-300);
            complaints.unless(is_near(*found, exact, &allowed), || {
                format!("{name}, {kind}: derivative {order} at {at:?} is {found:e}")
            });
        }
    }
    series(complaints, f, at, &exact);
}

/// The coefficients of its series hold the derivatives.
fn series(complaints: &mut Complaints, f: Function2, at: [f64; 2], exact: &[Digits]) {
    let variable =
        |k: usize| Series::variable(Interval::from(at[k]), Interval::from(ALONG[k]), ORDER + 1);
    let found = variable(0).call2(f, variable(1));
    let mut factorial = 1.0;
    for (k, exact) in exact.iter().enumerate().take(found.len()) {
        factorial *= (k as f64).max(1.0);
        complaints.unless(holds(found.at(k) * Interval::from(factorial), exact), || {
            format!("{}: coefficient {k} at {at:?} is {:?}", f.name(), found.at(k))
        });
    }
    complaints.unless(found.len() > 3, || {
        format!("{}: of its series at {at:?} only {} coefficients are known", f.name(), found.len())
    });
}

macro_rules! of_two {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        /// The function that emitted code calls.
        fn emitted(f: Function2) -> fn(f64, f64) -> f64 {
            match f { $(Function2::$variant => crate::emitted::math::$method),* }
        }
    };
}

kin_graph::functions_of_two!(of_two);

fn lanes(complaints: &mut Complaints, f: Function2, pairs: &[(f64, f64)]) {
    for lanes in [2, 4, 8] {
        let rows: Vec<[f64; 2]> = pairs.iter().map(|(x, y)| [*x, *y]).collect();
        let found = in_lanes(Lanes::Only(lanes), &rows, |graph, [x, y]| graph.call2(f, x, y));
        for ([x, y], found) in rows.iter().zip(found.unwrap_or_default()) {
            same(complaints, f, "lanes", [*x, *y], found, f.value()(*x, *y));
        }
    }
}
