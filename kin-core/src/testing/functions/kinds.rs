//! A function in numbers with derivatives, in tapes over lanes, in emitted code: the value is that
//! of f64 to the last bit, and derivatives are those of 60 digits.

use kin_graph::{Function, Number};

use super::digits::Digits;
use super::points::Point;
use super::{Complaints, is_near};
use crate::model::blame::jet::Jet;
use crate::numbers::lanes::Lanes;
use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, HyperDual64, Real};
use crate::program::tests::functions::in_lanes;

/// Of derivatives this share may be lost, of what they are and of what a change of the argument in
/// its last places would make of them.   \[-\]
const LOST: f64 = 1e-12;

pub fn check(complaints: &mut Complaints, f: Function, points: &[Point]) {
    for point in points {
        let x = point.x;
        let plain = f.value()(point.x);
        for (kind, found) in KINDS.map(|(kind, of)| (kind, of(f, x))) {
            same(complaints, f, kind, x, found[0], plain);
            for (order, found) in found.iter().enumerate().skip(1) {
                derivative(complaints, f, point, kind, order, *found);
            }
        }
        same(complaints, f, "constants", x, Real::<Dual64>::from(x).call(f).0.re, plain);
        same(complaints, f, "emitted code", x, emitted(f)(x), plain);
    }
    lanes(complaints, f, points);
}

type Kind = (&'static str, fn(Function, f64) -> Vec<f64>);

/// Numbers along x + s: their value and derivatives.
const KINDS: [Kind; 6] = [
    ("f64", |f, x| vec![Real(x).call(f).0]),
    ("first order", |f, x| {
        let y = Real(Dual64::new(x, 1.0)).call(f).0;
        vec![y.re, y.eps]
    }),
    ("second order", |f, x| {
        let y = Real(Dual2_64::new(x, 1.0, 0.0)).call(f).0;
        vec![y.re, y.v1, y.v2]
    }),
    ("third order", |f, x| {
        let y = Real(Dual3_64::new(x, 1.0, 0.0, 0.0)).call(f).0;
        vec![y.re, y.v1, y.v2, y.v3]
    }),
    ("mixed second order", |f, x| {
        let y = Real(HyperDual64::new(x, 1.0, 1.0, 0.0)).call(f).0;
        vec![y.re, y.eps1, y.eps1eps2]
    }),
    ("blame", |f, x| {
        let y = Jet::moving(x, [1.0, 0.0]).call(f);
        let [first, second] = y.slopes.unwrap_or_default();
        vec![y.value, first, second]
    }),
];

fn same(complaints: &mut Complaints, f: Function, kind: &str, x: f64, found: f64, plain: f64) {
    complaints
        .unless(found.to_bits() == plain.to_bits() || found.is_nan() && plain.is_nan(), || {
            format!("{}, {kind}: its value at {x:e} is {found:e}, not {plain:e}", f.name())
        });
}

fn derivative(
    complaints: &mut Complaints,
    f: Function,
    point: &Point,
    kind: &str,
    order: usize,
    found: f64,
) {
    let name = f.name();
    let x = point.x;
    let Some(exact) = point.exact.get(order) else {
        // Of what has a value and no slope, none is told.
        let is_told = point.exact.len() == 1 && found.is_finite();
        complaints.unless(!is_told, || {
            format!("{name}, {kind}: derivative {order} at {x:e} is {found:e}, but there is none")
        });
        return;
    };
    let size = |k: usize| point.exact[k].clone().abs();
    let power = |n: i32| Digits::new(x.abs()).powi(n);
    let by_argument = (1..point.exact.len())
        .filter(|k| x != 0.0 || *k == order)
        .map(|k| size(k) * power(k as i32 - order as i32))
        .fold(Digits::new(0.0), |most, size| if size > most { size } else { most });
    let allowed = (size(order) + by_argument) * Digits::new(LOST) + Digits::new(1e-300);
    // Nothing is known of a derivative that is too large for a number, or beyond one that is.
    let overflows = (0..=order).any(|k| size(k) > Digits::new(f64::MAX)) && !found.is_finite();
    let is_huge = size(order) > Digits::new(1e150) && !found.is_nan();
    complaints.unless(overflows || is_huge || is_near(found, exact, &allowed), || {
        format!("{name}, {kind}: derivative {order} at {x:e} is {found:e}")
    });
}

macro_rules! of_one {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        /// The function that emitted code calls.
        fn emitted(f: Function) -> fn(f64) -> f64 {
            match f { $(Function::$variant => crate::emitted::math::$method),* }
        }
    };
}

kin_graph::functions_of_one!(of_one);

/// In lanes values may differ as far as the entry allows both to be off.
fn lanes(complaints: &mut Complaints, f: Function, points: &[Point]) {
    let numbers: Vec<[f64; 1]> = points.iter().map(|point| [point.x]).collect();
    for lanes in [2, 4, 8] {
        let found = in_lanes(Lanes::Only(lanes), &numbers, |graph, [x]| graph.call(f, x));
        for ([x], found) in numbers.iter().zip(found.unwrap_or_default()) {
            let plain = f.value()(*x);
            let allowed = 0.5 * (f.facts().error)(x.abs()) * f64::EPSILON * plain.abs();
            let is_same = found.to_bits() == plain.to_bits() || found.is_nan() && plain.is_nan();
            complaints.unless(is_same || (found - plain).abs() <= allowed, || {
                format!(
                    "{}, {lanes} lanes: its value at {x:e} is {found:e}, not {plain:e}",
                    f.name()
                )
            });
        }
    }
}
