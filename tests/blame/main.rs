//! Where an equation ceases to be finite: the sub-expression as the user wrote it, its place, and
//! the values that went into it.

mod derivatives;
mod dual;
mod language;
mod messages;
mod values;

use kin::error::FailureKind;
use kin::extend::blame::{Culprit, Found, Part};
use kin::prelude::*;
use kin::{Error, Result};

/// The question that a test asks the system.
#[derive(Clone, Copy)]
pub enum Ask {
    C,
    Cq,
    Ct,
    Qd,
}

/// A system of bare coordinates `x`, `y`, … and one constraint `slot` that `make` builds on them.
pub fn system<C: Constraint + 'static>(n: usize, make: impl FnOnce(&[Coordinate]) -> C) -> System {
    let mut m = Mechanism::new("test");
    let coordinates: Vec<Coordinate> =
        ["x", "y", "z"][..n].iter().map(|name| m.length(name, 1.0).unwrap()).collect();
    m.add("slot", make(&coordinates)).unwrap();
    // The question needs no square system; the other constraints only make one that can be built.
    (1..n).for_each(|k| {
        assert!(m.add(&format!("hold {k}"), drive(coordinates[k], Law::constant(1.0))).is_ok())
    });
    m.build().unwrap()
}

fn failed(system: &System, ask: Ask, q: &[f64], t: f64) -> Error {
    let failed = |result: Result<()>| result.expect_err("nothing failed");
    match ask {
        Ask::C => failed(system.residual(q, t).map(drop)),
        Ask::Cq => failed(system.jacobian(q, t).map(drop)),
        Ask::Ct => failed(system.c_t(q, t).map(drop)),
        Ask::Qd => failed(system.acceleration_rhs(q, &vec![1.0; q.len()], t).map(drop)),
    }
}

/// The culprit of a term that is not finite.
pub fn culprit(system: &System, ask: Ask, q: &[f64], t: f64) -> Culprit {
    let asked = ["C", "C_q", "C_t", "Q_d"][ask as usize];
    let error = failed(system, ask, q, t);
    let Some(FailureKind::NotFinite { culprit, constraint, quantity, .. }) = error.kind() else {
        panic!("{error}")
    };
    assert_eq!((constraint.as_str(), *quantity), ("slot", asked));
    culprit.clone()
}

/// The expression found must be this one, stand where the error says, and come from these
/// coordinates, parameters and time.
pub fn check(
    culprit: &Culprit,
    source: &str,
    file: &str,
    expected: (&str, Part, &[(&str, f64)]),
) -> Found {
    let (expression, part, inputs) = expected;
    let found = culprit.found.clone().unwrap_or_else(|| panic!("nothing found: {culprit}"));
    assert_eq!((found.expression.as_str(), found.part), (expression, part));
    let place = found.source.expect("no place");
    assert!(place.file.replace('\\', "/").ends_with(file), "{place}");
    let line = source.lines().nth(place.line as usize - 1).unwrap_or_default();
    let there: String = line.chars().skip(place.column as usize - 1).collect();
    assert!(there.starts_with(expression), "{place} is {there}");
    let named: Vec<(&str, f64)> =
        culprit.inputs.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    assert_eq!(named, inputs, "{culprit}");
    found
}

/// A test of one expression: the constraint's body is one line of the file.
#[macro_export]
macro_rules! blames {
    ($name:ident, $n:literal, $make:expr, $ask:ident, at $q:expr, $t:expr => $expression:expr, $part:ident, $inputs:expr) => {
        #[test]
        fn $name() {
            let system = $crate::system($n, $make);
            let culprit = $crate::culprit(&system, $crate::Ask::$ask, &$q, $t);
            let expected: &[(&str, f64)] = &$inputs;
            let source = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", file!()));
            $crate::check(
                &culprit,
                source,
                file!(),
                ($expression, kin::extend::blame::Part::$part, expected),
            );
        }
    };
}
