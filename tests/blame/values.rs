//! Values that are infinite or no number.

use kin::error::FailureKind;
use kin::prelude::*;

use crate::blames;

#[constraint]
fn quotient(x: Coord, y: Coord, k: f64) -> f64 {
    k / (x - y) + x
}
blames!(division_by_zero, 2, |q| quotient(q[0], q[1], 3.0), C, at [0.5, 0.5], 0.0 => "k / (x - y)", Value, [("x", 0.5), ("y", 0.5), ("slot.k", 3.0)]);

#[constraint]
fn root(x: Coord, edge: f64) -> f64 {
    1.0 + (x - edge).sqrt()
}
blames!(root_of_less_than_nothing, 1, |q| root(q[0], 0.2), C, at [0.1], 0.0 => "(x - edge).sqrt()", Value, [("x", 0.1), ("slot.edge", 0.2)]);

#[constraint]
fn arcs(x: Coord, y: Coord) -> [f64; 2] {
    [(2.0 * x).asin() + y, y.acos() - x]
}
blames!(arc_sine_beyond_one, 2, |q| arcs(q[0], q[1]), C, at [0.6, 0.0], 0.0 => "(2.0 * x).asin()", Value, [("x", 0.6)]);
blames!(arc_cosine_beyond_one, 2, |q| arcs(q[0], q[1]), C, at [0.0, -1.5], 0.0 => "y.acos()", Value, [("y", -1.5)]);

#[constraint]
fn logarithms(x: Coord, y: Coord) -> (f64, f64, f64) {
    (x.ln() + y, x.log2() * y, (y - 1.0).ln_1p() + x)
}
blames!(logarithm_of_zero, 2, |q| logarithms(q[0], q[1]), C, at [0.0, 1.0], 0.0 => "x.ln()", Value, [("x", 0.0)]);
blames!(logarithm_near_one_of_zero, 2, |q| logarithms(q[0], q[1]), C, at [1.0, 0.0], 0.0 => "(y - 1.0).ln_1p()", Value, [("y", 0.0)]);

#[constraint]
fn powers(x: Coord, n: f64) -> (f64, f64, f64) {
    (x.powf(n), x.powi(-2) + x, x.recip())
}
blames!(broken_power_of_less_than_nothing, 1, |q| powers(q[0], 0.5), C, at [-1.0], 0.0 => "x.powf(n)", Value, [("x", -1.0), ("slot.n", 0.5)]);
blames!(negative_power_of_zero, 1, |q| powers(q[0], 2.0), C, at [0.0], 0.0 => "x.powi(-2)", Value, [("x", 0.0)]);

#[constraint]
fn overflow(x: Coord, y: Coord) -> f64 {
    let big = x.exp();
    y + big * big
}
blames!(product_that_overflows, 2, |q| overflow(q[0], q[1]), C, at [400.0, 1.0], 0.0 => "big * big", Value, [("x", 400.0)]);
blames!(exponential_that_overflows, 2, |q| overflow(q[0], q[1]), C, at [800.0, 1.0], 0.0 => "x.exp()", Value, [("x", 800.0)]);

#[constraint]
fn hyperbolic(x: Coord) -> (f64, f64, f64) {
    (x.acosh(), x.atanh() + x, x % 0.0)
}
blames!(inverse_hyperbolic_cosine_below_one, 1, |q| hyperbolic(q[0]), C, at [0.5], 0.0 => "x.acosh()", Value, [("x", 0.5)]);
blames!(inverse_hyperbolic_tangent_at_one, 1, |q| hyperbolic(q[0]), C, at [1.0], 0.0 => "x.atanh()", Value, [("x", 1.0)]);

#[constraint]
fn of_time(x: Coord, t: Time, period: f64) -> f64 {
    x - (1.0 - t / period).ln()
}
blames!(time_is_among_the_inputs, 1, |q| of_time(q[0], 2.0), C, at [1.0], 2.0 => "(1.0 - t / period).ln()", Value, [("slot.period", 2.0), ("t", 2.0)]);

#[constraint]
fn remainders(x: Coord, y: Coord) -> (f64, f64) {
    (x % y, x + (x - y).log(y))
}
blames!(remainder_of_a_division_by_zero, 2, |q| remainders(q[0], q[1]), C, at [1.0, 0.0], 0.0 => "x % y", Value, [("x", 1.0), ("y", 0.0)]);
blames!(logarithm_to_a_base, 2, |q| remainders(q[0], q[1]), C, at [1.0, 2.0], 0.0 => "(x - y).log(y)", Value, [("x", 1.0), ("y", 2.0)]);

/// An infinite number on the way does no harm where the result is finite: the blame goes to what
/// came through.
#[constraint]
fn harmless(x: Coord, y: Coord) -> f64 {
    (1.0 / x).atan() + y.sqrt()
}
blames!(the_one_that_came_through, 2, |q| harmless(q[0], q[1]), C, at [0.0, -1.0], 0.0 => "y.sqrt()", Value, [("y", -1.0)]);

#[constraint]
fn infinite_difference(x: Coord, y: Coord) -> f64 {
    1.0 / x - 1.0 / y
}
blames!(the_first_of_two, 2, |q| infinite_difference(q[0], q[1]), C, at [0.0, 0.0], 0.0 => "1.0 / x", Value, [("x", 0.0)]);

#[constraint]
fn of_a_body(b: Planar, u: Vec2, r: f64) -> Vec2 {
    let d = b.point(u);
    d / (d.norm() - r)
}

#[test]
fn coordinates_and_parameters_have_the_names_of_the_mechanism() {
    let mut m = Mechanism::new("disc");
    let disc = m.planar("disc", pose(0.0, 0.0, 0.0)).unwrap();
    m.add("rim", of_a_body(disc, vec2(0.3, 0.4), 0.5)).unwrap();
    m.add("motor", drive_angle(disc, Law::ramp(1.0))).unwrap();
    let error = m.build().unwrap().residual(&[0.0, 0.0, 0.0], 0.0).unwrap_err();
    let Some(FailureKind::NotFinite { culprit, row, .. }) = error.kind() else { panic!("{error}") };
    let names: Vec<&str> = culprit.inputs.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["disc.R_x", "disc.R_y", "disc.theta", "rim.u.x", "rim.u.y", "rim.r"]);
    assert_eq!(
        (culprit.found.as_ref().unwrap().expression.as_str(), row.as_str()),
        ("d / (d.norm() - r)", "x")
    );
    assert_eq!(culprit.found.as_ref().unwrap().operands, [0.3, 0.0]);
}
