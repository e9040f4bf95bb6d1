//! Constraints that run on dual numbers.

use kin::prelude::*;

use crate::blames;

#[constraint(dual)]
fn root(x: Coord, y: Coord, t: Time) -> f64 {
    let harmless = (1.0 / x).atan();
    harmless + (y - 0.2).sqrt() - t.sqrt()
}
blames!(value, 2, |q| root(q[0], q[1]), C, at [0.0, 0.1], 1.0 => "(y - 0.2).sqrt()", Value, [("y", 0.1)]);
blames!(slope, 2, |q| root(q[0], q[1]), Cq, at [1.0, 0.2], 1.0 => "(y - 0.2).sqrt()", Slope, [("y", 0.2)]);
blames!(slope_in_time, 2, |q| root(q[0], q[1]), Ct, at [1.0, 1.0], 0.0 => "t.sqrt()", Slope, [("t", 0.0)]);
blames!(value_behind_a_slope, 2, |q| root(q[0], q[1]), Cq, at [0.0, 1.0], 1.0 => "1.0 / x", Value, [("x", 0.0)]);

#[constraint]
fn repeated(x: Coord, y: Coord, n: usize) -> f64 {
    let mut sum = y;
    let mut k = 0;
    while k < n {
        sum += 1.0 / (x - k as f64);
        k += 1;
    }
    sum
}
blames!(turn_of_a_while, 2, |q| repeated(q[0], q[1], 4), C, at [2.0, 1.0], 0.0 => "1.0 / (x - k as f64)", Value, [("x", 2.0)]);

fn bent<D: Dual>(u: Real<D>) -> Real<D> {
    (u - 1.0).sqrt() + 2.0
}

#[constraint(dual)]
fn calls(x: Coord, y: Coord, f: Law) -> (f64, f64, Vec2) {
    let inside = |u: f64| u.ln();
    let d = vec2(x, y);
    (bent(x), inside(y) + f.at(x), d.normalize() * d.norm())
}
blames!(generic_function, 2, |q| calls(q[0], q[1], Law::ramp(1.0)), C, at [0.5, 1.0], 0.0 => "bent(x)", Value, [("x", 0.5)]);
blames!(closure, 2, |q| calls(q[0], q[1], Law::ramp(1.0)), C, at [1.5, 0.0], 0.0 => "u.ln()", Value, [("y", 0.0)]);
blames!(law, 2, |q| calls(q[0], q[1], edge()), C, at [3.0, 1.0], 0.0 => "f.at(x)", Value, [("x", 3.0)]);

/// Not a number beyond x = 2.
#[law]
fn edge(x: f64) -> f64 {
    (2.0 - x).sqrt()
}

#[constraint(dual)]
fn length(x: Coord, y: Coord) -> f64 {
    vec2(x, y).norm() - 1.0
}
blames!(length_of_nothing, 2, |q| length(q[0], q[1]), Cq, at [0.0, 0.0], 0.0 => "vec2(x, y).norm()", Slope, [("x", 0.0), ("y", 0.0)]);

#[constraint(dual)]
fn bent_twice(x: Coord) -> f64 {
    x.powf(1.5)
}
blames!(second_derivative, 1, |q| bent_twice(q[0]), Qd, at [0.0], 0.0 => "x.powf(1.5)", Curvature, [("x", 0.0)]);

/// Lists, iterators, borrows: the marks must not get in their way.
#[constraint]
fn lists(x: Coord, y: Coord, n: usize) -> f64 {
    let mut all = Vec::new();
    for k in 0..n {
        all.push(x * (k + all.len()) as f64 - y);
    }
    all.iter_mut().for_each(|value| *value += 1.0);
    let largest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = all.iter().map(|value| value.abs().sqrt()).sum();
    largest.sqrt() + total
}
blames!(value_made_by_an_iterator, 2, |q| lists(q[0], q[1], 3), C, at [0.0, 2.0], 0.0 => "largest.sqrt()", Value, [("x", 0.0), ("y", 2.0)]);
