//! The list of functions × all kinds of numbers: every function at ordinary, worst and nasty
//! points, values and slopes held against those of 60 digits, against one another, and against what
//! its entry says.

mod bounds;
mod digits;
mod entries;
mod kinds;
mod points;
mod two;

use kin_graph::{Function, Number, rules};

use digits::{Digits, Taylor};
use points::Point;
pub use points::worst_arguments;

/// Faults that were found, each with the name of the function and the point.
#[derive(Default)]
struct Complaints(Vec<String>);

impl Complaints {
    fn unless(&mut self, holds: bool, what: impl FnOnce() -> String) {
        if !holds {
            self.0.push(what());
        }
    }

    fn assert_none(self) {
        let shown = self.0.iter().take(40).cloned().collect::<Vec<_>>().join("\n");
        assert!(self.0.is_empty(), "{} complaints:\n{shown}", self.0.len());
    }
}

/// |found − exact| in units of what is allowed.
fn is_near(found: f64, exact: &Digits, allowed: &Digits) -> bool {
    if !found.is_finite() {
        // Too large for a number is what is nearly so.
        return found.is_infinite() && exact.clone().abs() > Digits::new(0.99 * f64::MAX);
    }
    (Digits::new(found) - exact.clone()).abs() <= allowed.clone()
}

/// So many units in the last place of a number, or the smallest normal one.
fn units(of: &Digits, number: f64) -> Digits {
    of.clone().abs() * Digits::new(number * f64::EPSILON) + Digits::new(f64::MIN_POSITIVE)
}

/// The whole test: what an entry lacks, or has wrong, is told by the name of the function.
#[test]
fn every_function_of_one_number_in_every_kind_of_number() {
    let mut complaints = Complaints::default();
    for &f in Function::ALL {
        let points = points::of(f);
        entries::check(&mut complaints, f, &points);
        kinds::check(&mut complaints, f, &points);
        bounds::check(&mut complaints, f, &points);
    }
    complaints.assert_none();
}

#[test]
fn every_function_of_two_numbers_in_every_kind_of_number() {
    let mut complaints = Complaints::default();
    two::check(&mut complaints);
    complaints.assert_none();
}

/// The 60 digits themselves: those of another library (mpmath) at the worst arguments that are
/// known.
#[test]
fn digits_are_those_of_another_library() {
    let mut complaints = Complaints::default();
    for (name, arguments, nearest, rest) in worst_arguments() {
        let Some(f) = Function::named(&name) else { continue };
        let found = Digits::new(arguments[0]).call(f);
        let exact = Digits::sum(nearest, rest);
        let off = (found - exact.clone()).abs();
        complaints
            .unless(off <= exact.abs() * Digits::new(1e-31), || format!("{name} of {arguments:?}"));
    }
    complaints.assert_none();
}

/// The slope that the rule gives is that of the value, both in 60 digits.
#[test]
fn every_rule_is_the_slope_of_its_function() {
    let mut complaints = Complaints::default();
    for &f in Function::ALL {
        for Point { x, .. } in points::of(f).iter().filter(|point| point.is_smooth(f)) {
            if *x != 0.0 && !(1e-100..1e100).contains(&x.abs()) {
                continue; // The differences would need more digits.
            }
            let h = Digits::new(1e-60 * if *x == 0.0 { 1.0 } else { x.abs().min(1.0) });
            let at = |x: Digits| x.call(f);
            let exact = Digits::new(*x);
            let rise = at(exact.clone() + h.clone()) - at(exact.clone() - h.clone());
            let central = rise / (h.clone() + h);
            let value = at(exact.clone());
            let slope = rules::slope(f, exact, value.clone());
            let allowed = (slope.clone().abs() + value.abs()) * Digits::new(1e-30);
            complaints.unless((slope - central).abs() <= allowed, || {
                format!("{}: its rule is not its slope at {x:e}", f.name())
            });
        }
    }
    complaints.assert_none();
}

/// The derivatives of f at x, from its value on.
fn derivatives(f: Function, x: f64) -> Vec<Digits> {
    Taylor::variable(x).call(f).derivatives()
}
