//! How far off the platform's functions are, against values of 60 digits at their worst arguments
//! (`accuracy/generate.py`): bounds rest on that.

use kin_graph::functions::ALLOWED;
use kin_graph::{Function, Function2, Number};

use crate::numbers::enclosure::interval::Interval;
use crate::numbers::enclosure::series::Series;
use crate::numbers::real::Real;
use crate::testing::functions::worst_arguments;

/// A function at some arguments: its value is `nearest + rest`, to 32 digits.
struct Value {
    name: String,
    arguments: Vec<f64>,
    nearest: f64,
    rest: f64,
}

fn values() -> impl Iterator<Item = Value> {
    worst_arguments().map(|(name, arguments, nearest, rest)| Value {
        name,
        arguments,
        nearest,
        rest,
    })
}

impl Value {
    /// By f64, and with bounds.
    fn computed(&self) -> (f64, Interval) {
        let thin = |k: usize| Series::constant(Interval::from(self.arguments[k]));
        let real = |k: usize| Real(self.arguments[k]);
        match (Function::named(&self.name), Function2::named(&self.name)) {
            (Some(f), _) => (real(0).call(f).0, thin(0).call(f).value()),
            (_, Some(f)) => (real(0).call2(f, real(1)).0, thin(0).call2(f, thin(1)).value()),
            _ => panic!("no function `{}`", self.name),
        }
    }
}

/// Half of what bounds allow is enough, on this platform and with room for others.
#[test]
fn functions_are_right_to_half_of_what_is_allowed() {
    let mut worst: Vec<(String, f64)> = Vec::new();
    for value in values() {
        let (found, _) = value.computed();
        let off =
            ((found - value.nearest) - value.rest).abs() / (f64::EPSILON * value.nearest.abs());
        let allowed = Function::named(&value.name)
            .map_or(ALLOWED, |f| (f.facts().error)(value.arguments[0].abs()));
        assert!(
            off <= 0.5 * allowed,
            "{} of {:?} is {found:e}, off by {off} of its last place",
            value.name,
            value.arguments
        );
        match worst.last_mut() {
            Some((name, most)) if *name == value.name => *most = most.max(off),
            _ => worst.push((value.name, off)),
        }
    }
    println!("{worst:?}");
    assert_eq!(worst.len(), 24, "{worst:?}");
}

#[test]
fn bounds_hold_the_exact_value() {
    for value in values() {
        let (_, bounds) = value.computed();
        let inside =
            bounds.lo() - value.nearest <= value.rest && bounds.hi() - value.nearest >= value.rest;
        assert!(inside, "{} of {:?} is not within {bounds:?}", value.name, value.arguments);
        // a power is the exponential of a product: it is known as well as that
        let size = if value.name == "Powf" || value.name == "Exp2" { 800.0 } else { 1.0 };
        let places = bounds.radius() / (f64::EPSILON * value.nearest.abs());
        let is_narrow = places <= 40.0 * size
            || value.arguments[0].abs() > 1e3
            || value.name.starts_with("Log")
            || value.name == "Tan";
        assert!(is_narrow, "{} of {:?}: {places} places", value.name, value.arguments);
    }
}
