//! Values that are finite while a derivative is not.

use kin::prelude::*;

use crate::blames;

#[constraint]
fn root(x: Coord, t: Time) -> f64 {
    (x - 0.2).sqrt() - (t - 1.0).sqrt() + 0.1
}
blames!(slope_of_a_root_at_zero, 1, |q| root(q[0]), Cq, at [0.2], 2.0 => "(x - 0.2).sqrt()", Slope, [("x", 0.2)]);
blames!(slope_in_time, 1, |q| root(q[0]), Ct, at [1.2], 1.0 => "(t - 1.0).sqrt()", Slope, [("t", 1.0)]);
blames!(right_side_at_the_same_edge, 1, |q| root(q[0]), Qd, at [1.2], 1.0 => "(t - 1.0).sqrt()", Slope, [("t", 1.0)]);

#[constraint]
fn arcs(x: Coord, y: Coord) -> (f64, f64) {
    (x.asin() * 2.0, 1.0 - y.acos())
}
blames!(slope_of_the_arc_sine_at_one, 2, |q| arcs(q[0], q[1]), Cq, at [1.0, 0.5], 0.0 => "x.asin()", Slope, [("x", 1.0)]);
blames!(slope_of_the_arc_cosine_at_minus_one, 2, |q| arcs(q[0], q[1]), Cq, at [0.5, -1.0], 0.0 => "y.acos()", Slope, [("y", -1.0)]);

#[constraint]
fn angle(x: Coord, y: Coord) -> f64 {
    y.atan2(x) - 0.1
}
blames!(slope_of_an_angle_at_the_origin, 2, |q| angle(q[0], q[1]), Cq, at [0.0, 0.0], 0.0 => "y.atan2(x)", Slope, [("x", 0.0), ("y", 0.0)]);

#[constraint]
fn length(x: Coord, y: Coord, l: f64) -> (f64, f64) {
    let d = vec2(x, y);
    (d.norm() - l, x.hypot(y - 1.0) + x)
}
blames!(slope_of_a_length_of_nothing, 2, |q| length(q[0], q[1], 1.0), Cq, at [0.0, 0.0], 0.0 => "d.norm()", Slope, [("x", 0.0), ("y", 0.0)]);
blames!(slope_of_a_hypotenuse_of_nothing, 2, |q| length(q[0], q[1], 1.0), Cq, at [0.0, 1.0], 0.0 => "x.hypot(y - 1.0)", Slope, [("x", 0.0), ("y", 1.0)]);

#[constraint]
fn powers(x: Coord, n: f64) -> (f64, f64) {
    (x.powf(n) + x, (x - 1.0).cbrt())
}
blames!(slope_of_a_power_at_zero, 1, |q| powers(q[0], 0.5), Cq, at [0.0], 0.0 => "x.powf(n)", Slope, [("x", 0.0), ("slot.n", 0.5)]);
blames!(second_derivative_of_a_power_at_zero, 1, |q| powers(q[0], 1.5), Qd, at [0.0], 0.0 => "x.powf(n)", Curvature, [("x", 0.0), ("slot.n", 1.5)]);
blames!(slope_of_a_cube_root_at_zero, 1, |q| powers(q[0], 3.0), Cq, at [1.0], 0.0 => "(x - 1.0).cbrt()", Slope, [("x", 1.0)]);

/// The value of `1.0 / x` is infinite, that of the equation is not, and its slope is no number.
#[constraint]
fn through_a_finite_value(x: Coord) -> f64 {
    (1.0 / x).atan()
}
blames!(infinite_value_behind_a_slope, 1, |q| through_a_finite_value(q[0]), Cq, at [0.0], 0.0 => "1.0 / x", Value, [("x", 0.0)]);

#[constraint]
fn steep(x: Coord, y: Coord) -> f64 {
    let a = 1e200 * x;
    y + (a * a).atan()
}
blames!(square_that_overflows_only_in_a_derivative, 2, |q| steep(q[0], q[1]), Qd, at [1.0, 1.0], 0.0 => "a * a", Value, [("x", 1.0)]);

/// Of two lengths only that which changes has a slope.
#[constraint]
fn fixed_length(x: Coord, u: Vec2) -> f64 {
    u.norm() + (x * x).sqrt()
}
blames!(length_of_a_parameter_has_no_slope, 1, |q| fixed_length(q[0], vec2(0.0, 0.0)), Cq, at [0.0], 0.0 => "(x * x).sqrt()", Slope, [("x", 0.0)]);
