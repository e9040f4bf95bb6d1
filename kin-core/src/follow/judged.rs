//! What a step is judged by, on x² + x + y = t, x + y = 0: det C_q is 2 x, and so is the smaller pivot beside entries of 1; of a miss v Newton and
//! Kantorovich estimate v/x.

use super::check::{Check, Objection};
use crate::fours::Fours;
use crate::newton::{Newton, Options, Steps};
use crate::{Mechanism, System, constraint};

#[constraint]
fn square(x: Coord, y: Coord, t: Time) -> [f64; 2] {
    [x * x + x + y - t, x + y]
}

fn system() -> System {
    let mut m = Mechanism::new("square");
    let x = m.length("x", 1.0).expect("a new name");
    let y = m.length("y", -1.0).expect("a new name");
    m.add("c", square(x, y)).expect("adds");
    m.build().expect("builds")
}

/// At x, without rates.
fn stand(newton: &mut Newton<'_>, x: f64) {
    (newton.q[0], newton.q[1]) = (x, -x);
    newton.solve(x * x, Steps::Full).expect("solves");
    newton.qd.iter_mut().chain(newton.qdd.iter_mut()).for_each(|rate| *rate = 0.0);
}

/// Whether a step to `to` after one was accepted at `before` counts as missed, where the prediction misses by so much.
fn is_missed(before: f64, to: f64, miss: f64) -> bool {
    let (system, options) = (system(), Options::default());
    let mut newton = Newton::new(&system, &options);
    let mut check = Check::new(&system);
    stand(&mut newton, 1.0);
    stand(&mut newton, before);
    check.accept(&newton);
    stand(&mut newton, to);
    let still = Fours::new(2, 0.0);
    let mut from = Fours::new(2, 0.0);
    (from[0], from[1]) = (to - miss, miss - to);
    matches!(check.judge(&mut newton, 1.0, [&from, &still, &still]), Err(Objection::Missed(_)))
}

#[test]
fn a_miss_is_held_against_the_smaller_pivot() {
    assert!(!is_missed(1.0, 1.0, 0.04));
    for (before, to) in [(1.0, 0.01), (0.01, 0.01)] {
        assert!(is_missed(before, to, 0.004), "{before} {to}");
        assert!(!is_missed(before, to, 1e-4));
    }
}

#[test]
fn a_larger_miss_is_safe_while_second_order_terms_are_small() {
    for to in [1.0, 0.5] {
        assert!(!is_missed(1.0, to, 0.2 * to), "{to}");
        for share in [0.3, 0.6, 1.5] {
            assert!(is_missed(1.0, to, share * to), "{to} {share}");
        }
    }
}
