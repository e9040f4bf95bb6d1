//! Branches, loops, functions, laws and what only rustc knows.

use kin::prelude::*;

use crate::blames;

#[constraint]
fn branch(x: Coord, y: Coord) -> f64 {
    let root = if x > 0.0 { x.sqrt() } else { (-y).sqrt() };
    root + (if x > 1.0 { 0.0 } else { y.ln() }) * 0.0 + y
}
blames!(branch_that_is_taken, 2, |q| branch(q[0], q[1]), C, at [-1.0, 2.0], 0.0 => "(-y).sqrt()", Value, [("y", 2.0)]);

#[constraint]
fn chosen(x: Coord, y: Coord, which: i32) -> f64 {
    match which {
        0 => x.ln(),
        1 if y > 0.0 => (y - x).sqrt(),
        _ => 1.0 / y,
    }
}
blames!(arm_with_a_guard, 2, |q| chosen(q[0], q[1], 1), C, at [2.0, 1.0], 0.0 => "(y - x).sqrt()", Value, [("x", 2.0), ("y", 1.0)]);
blames!(last_arm, 2, |q| chosen(q[0], q[1], 1), C, at [2.0, 0.0], 0.0 => "1.0 / y", Value, [("y", 0.0)]);

#[constraint]
fn unrolled(x: Coord, at: [f64; 3]) -> f64 {
    let mut sum = 0.0;
    for k in 0..3 {
        sum += 1.0 / (x - at[k]);
    }
    sum
}
blames!(turn_of_a_loop, 1, |q| unrolled(q[0], [1.0, 2.0, 3.0]), C, at [2.0], 0.0 => "1.0 / (x - at[k])", Value, [("x", 2.0), ("slot.at[1]", 2.0)]);

#[constraint]
fn helpers(x: Coord, y: Coord) -> f64 {
    fn half_root(u: f64) -> f64 {
        u.sqrt() / 2.0
    }
    let inverse = |u: f64| 1.0 / u;
    half_root(x - 1.0) + inverse(y)
}
blames!(function_inside_of_the_body, 2, |q| helpers(q[0], q[1]), C, at [0.0, 1.0], 0.0 => "u.sqrt()", Value, [("x", 0.0)]);
blames!(closure, 2, |q| helpers(q[0], q[1]), C, at [2.0, 0.0], 0.0 => "1.0 / u", Value, [("y", 0.0)]);

fn bent<D: Dual>(u: Real<D>) -> Real<D> {
    (u - 1.0).sqrt() + 2.0
}

fn both<D: Dual>(u: Real<D>, v: Real<D>) -> Vec2<Real<D>> {
    vec2(u.powf(1.5), v.powf(0.5))
}

#[constraint]
fn calls(x: Coord, y: Coord) -> (f64, Vec2) {
    let own = bent(x);
    let pair = both(4.0 - x, y);
    (own * 3.0 - y, pair)
}
blames!(value_of_a_generic_function, 2, |q| calls(q[0], q[1]), C, at [0.5, 1.0], 0.0 => "bent(x)", Value, [("x", 0.5)]);
blames!(slope_of_a_generic_function, 2, |q| calls(q[0], q[1]), Cq, at [1.0, 1.0], 0.0 => "bent(x)", Slope, [("x", 1.0)]);
blames!(slope_of_one_of_several_values, 2, |q| calls(q[0], q[1]), Cq, at [4.0, 0.0], 0.0 => "both(4.0 - x, y)", Slope, [("x", 4.0), ("y", 0.0)]);
blames!(second_derivative_of_a_generic_function, 2, |q| calls(q[0], q[1]), Qd, at [4.0, 1.0], 0.0 => "both(4.0 - x, y)", Curvature, [("x", 4.0), ("y", 1.0)]);

#[derive(Clone)]
struct Spec {
    gain: f64,
    list: Vec<f64>,
}

const NOTHING: f64 = f64::NAN;

fn plain(k: f64) -> f64 {
    k.ln()
}

#[constraint]
fn own_parameter(x: Coord, y: Coord, spec: Spec, k: f64) -> (f64, f64) {
    (x * spec.gain + spec.list[0] * y, y + plain(k - 1.0))
}
fn spec(gain: f64) -> Spec {
    Spec { gain, list: vec![1.0] }
}
blames!(field_of_a_parameter, 2, |q| own_parameter(q[0], q[1], spec(f64::NAN), 2.0), C, at [1.0, 1.0], 0.0 => "spec.gain", Value, []);
blames!(element_of_a_parameter, 2, |q| own_parameter(q[0], q[1], Spec { list: vec![f64::INFINITY], ..spec(1.0) }, 2.0), C, at [1.0, 1.0], 0.0 => "spec.list[0]", Value, []);
blames!(plain_function_of_a_parameter, 2, |q| own_parameter(q[0], q[1], spec(1.0), 1.0), C, at [1.0, 1.0], 0.0 => "plain(k - 1.0)", Value, [("slot.k", 1.0)]);

#[constraint]
fn constant(x: Coord) -> f64 {
    x + NOTHING
}
blames!(constant_of_the_module, 1, |q| constant(q[0]), C, at [1.0], 0.0 => "NOTHING", Value, []);

/// Not a number beyond x = 1.
#[law]
fn edge(x: f64) -> f64 {
    (1.0 - x).sqrt()
}

#[constraint]
fn by_law(x: Coord, y: Coord, profile: Law) -> (f64, f64) {
    (profile.at(x * y) + x, y + profile.slope(y))
}
blames!(law_that_gives_no_number, 2, |q| by_law(q[0], q[1], edge()), C, at [3.0, 0.5], 0.0 => "profile.at(x * y)", Value, [("x", 3.0), ("y", 0.5)]);
blames!(law_without_a_slope, 2, |q| by_law(q[0], q[1], edge()), Cq, at [2.0, 0.5], 0.0 => "profile.at(x * y)", Slope, [("x", 2.0), ("y", 0.5)]);
blames!(slope_of_a_law_as_a_value, 2, |q| by_law(q[0], q[1], edge()), C, at [0.5, 1.0], 0.0 => "profile.slope(y)", Value, [("y", 1.0)]);

#[constraint]
fn shadowed(x: Coord) -> f64 {
    let x = x - 1.0;
    let x = x.sqrt();
    1.0 / x
}
blames!(variable_of_the_same_name, 1, |q| shadowed(q[0]), C, at [1.0], 0.0 => "1.0 / x", Value, [("x", 1.0)]);
blames!(slope_of_the_inner_one, 1, |q| shadowed(q[0]), C, at [0.5], 0.0 => "x.sqrt()", Value, [("x", 0.5)]);

#[constraint]
fn assigned(x: Coord, y: Coord) -> f64 {
    let mut z = y;
    z /= x;
    z += 1.0;
    z
}
blames!(compound_assignment, 2, |q| assigned(q[0], q[1]), C, at [0.0, 1.0], 0.0 => "z /= x", Value, [("x", 0.0), ("y", 1.0)]);
