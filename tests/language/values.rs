//! Bindings, arithmetic, vectors, matrices, tuples, arrays.

use kin::check::{any_coord as c, any_planar as p, any_spatial as s};
use kin::prelude::*;

use crate::reads;

#[constraint]
fn shadowed(a: Coord, k: f64) -> f64 {
    let a = a + k;
    let a = a * a;
    2.0 * a - 1.0
}
reads!(shadowing_and_literals_on_either_side, Symbolic, shadowed(c(), 1.0), at [2.0], 0.0 => [17.0]);

#[constraint]
fn mutable_argument(mut a: Coord, k: f64) -> f64 {
    a += k;
    a *= a;
    a /= 2.0;
    a -= 1.0;
    a
}
reads!(compound_assignment_to_an_argument, Symbolic, mutable_argument(c(), 1.0), at [3.0], 0.0 => [7.0]);

#[constraint]
fn taken_apart(b: Planar) -> (f64, f64) {
    let p = b.point(vec2(1.0, 0.0));
    let (x, y) = (b.r.x, b.r.y);
    let Vec2 { x: px, y: py } = p;
    (px * x, py - y)
}
reads!(tuples_and_structs_taken_apart, Symbolic, taken_apart(p()), at [2.0, 5.0, 0.0], 0.0 => [6.0, 0.0]);

#[constraint]
fn block_values(a: Coord) -> f64 {
    let z = {
        let w = a * 2.0;
        w * w
    };
    let a = (z + 1.0).sqrt();
    a + if z > 1.0 { 1.0 } else { z } * a
}
reads!(blocks_are_values, Symbolic, block_values(c()), at [0.0], 0.0 => [1.0]);

#[constraint]
fn matrices(b: Planar, turn: Mat2) -> Vec2 {
    let m = b.a() * turn * Mat2::rotation(0.5) - Mat2::identity() * 2.0;
    m.transpose() * &b.r + m.column(0) * m.determinant() - m.row(1) / 2.0
}
reads!(matrix_algebra, Symbolic, matrices(p(), Mat2::new(0.0, 0.0, 0.0, 0.0)), at [1.0, 3.0, 0.2], 0.0 => [-10.0, -5.0]);

#[constraint]
fn spatial_algebra(b: Spatial, u: Vec3) -> (Vec3, f64) {
    let e = b.p.vector();
    let skewed = e.cross(b.a().transpose() * vec3(0.0, 1.0, 0.0)) + b.local(u).component_mul(&u);
    (skewed, b.a()[(0, 1)] + b.a.m12 + b.p[2] + b.a().trace() * b.p.norm())
}
reads!(spatial_states, Symbolic, spatial_algebra(s(), vec3(1.0, 2.0, 3.0)), at [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 0.0 => [1.0, 4.0, 9.0, 3.0]);

#[constraint]
fn vector_methods(i: Planar, j: Planar, u: Vec2) -> [f64; 4] {
    let d = i.point(u) - j.local(&u);
    let n = d.normalize().perp();
    [
        n.dot(&u),
        d.cross(n),
        d.lerp(&u, 0.25).norm_squared(),
        (-d).component_div(vec2(2.0, 4.0)).norm(),
    ]
}
reads!(vector_methods_by_value_and_reference, Symbolic, vector_methods(p(), p(), vec2(1.0, 0.0)),
    at [3.0, 4.0, 0.0, 0.0, 0.0, 0.0], 0.0 => [-0.8, 5.0, 15.25, 3.25_f64.sqrt()]);

#[constraint]
fn changed_in_place(b: Planar) -> (Vec2, f64) {
    let mut v = b.r;
    v.x += 2.0;
    let factor = v.x;
    v[1] *= factor;
    let mut all = [v, v * 2.0];
    all[1].y -= 1.0;
    let mut pair = (all[0], 0.5);
    pair.1 += all[1].y;
    (pair.0, pair.1)
}
reads!(fields_and_elements_assigned, Symbolic, changed_in_place(p()), at [1.0, 2.0, 0.0], 0.0 => [3.0, 6.0, 11.5]);

#[constraint]
fn weighted(q: [Coord; 3], w: [f64; 3], at: [[f64; 2]; 2]) -> (f64, f64) {
    let sum = q.iter().zip(w.iter()).map(|(q, w)| q * w).sum::<f64>();
    let product: f64 = q.iter().map(|q| 1.0 + q * q).product();
    (sum + at[1][0] * q[0], product - at[0][1])
}
reads!(arrays_of_coordinates_and_numbers, Symbolic, weighted([c(), c(), c()], [1.0, 2.0, 3.0], [[0.0, 1.0], [2.0, 3.0]]),
    at [1.0, 2.0, 3.0], 0.0 => [16.0, 99.0]);

#[constraint]
fn points_of_an_array(b: Planar, us: [Vec2; 3]) -> Vec2 {
    let mut mean = Vec2::zeros();
    for u in us {
        mean += b.point(u);
    }
    mean / us.len() as f64
}
reads!(arrays_of_vectors, Symbolic, points_of_an_array(p(), [vec2(3.0, 0.0), vec2(0.0, 3.0), vec2(0.0, 0.0)]), at [1.0, 1.0, 0.0], 0.0 => [2.0, 2.0]);

#[constraint]
fn of_time(a: Coord, t: Time) -> (f64, f64) {
    let (sin, cos) = (2.0 * t).sin_cos();
    (a * sin + cos * t, a - t.powi(3) / (1.0 + t))
}
reads!(time_in_several_ways, Symbolic, of_time(c()), at [2.0], 0.0 => [0.0, 2.0]);

#[constraint]
fn odd_names(r#type: Coord, t0: Coord, at: Coord, s: f64, x: f64) -> f64 {
    let c = r#type * t0;
    let qd = at + x;
    let i_x = c + qd * s;
    let t1 = 0.5;
    i_x - t1
}
reads!(names_that_emitted_code_uses_too, Symbolic, odd_names(c(), c(), c(), 2.0, 1.0), at [2.0, 3.0, 4.0], 0.0 => [15.5]);

#[constraint]
fn functions_as_paths(a: Coord, b: Coord) -> f64 {
    f64::hypot(a, b)
        + f64::max(a, 0.5)
        + a.rem_euclid(1.5)
        + 2.0f64.powf(a)
        + f64::atan2(b, a).sin()
        + f64::powi(b, 3)
}
reads!(functions_by_their_paths, Symbolic, functions_as_paths(c(), c()), at [3.0, 4.0], 0.0 => [5.0 + 3.0 + 8.0 + 0.8 + 64.0]);

#[constraint]
fn parameter_first(a: Coord, k: f64) -> f64 {
    k.max(a)
        + k.atan2(a)
        + (k - 1.0).abs() * a
        + k.mul_add(a, 1.0)
        + a.clamp(-0.5, 0.5)
        + a.copysign(-1.0)
        + k.recip()
}
reads!(parameters_as_receivers, Symbolic, parameter_first(c(), 1.0), at [1.0], 0.0 => [1.0 + std::f64::consts::FRAC_PI_4 + 2.0 + 0.5 - 1.0 + 1.0]);

#[constraint]
fn rows_by_name(i: Planar, j: Planar) -> (Vec2, f64) {
    let gap = i.r - j.r;
    let turn = i.theta - j.theta;
    (gap, turn)
}
reads!(a_tuple_of_named_rows, Symbolic, rows_by_name(p(), p()), at [1.0, 2.0, 3.0, 0.5, 0.5, 0.5], 0.0 => [0.5, 1.5, 2.5]);

#[constraint]
fn returned(a: Coord, b: Coord) -> [_; 2] {
    let gap = a - b;
    return [gap, a];
}
reads!(the_last_return_is_the_value, Symbolic, returned(c(), c()), at [3.0, 1.0], 0.0 => [2.0, 3.0]);

#[constraint]
fn annotated(b: Planar, k: f64) -> f64 {
    let v: Vec2 = b.r * k;
    let (x, y): (f64, f64) = (v.x, v.y);
    let all: [f64; 2] = [x, y];
    let _unused: f64 = 2.0;
    all[0] + all[1] + b.theta.to_degrees().to_radians()
}
reads!(types_written_out, Symbolic, annotated(p(), 2.0), at [1.0, 2.0, 0.5], 0.0 => [6.5]);

#[constraint]
fn powers(a: Coord) -> f64 {
    let b = a * a + 1.0;
    b.powi(-2) + b.powi(5) / b.powf(2.5) + b.sqrt().cbrt() + b.ln().exp_m1() + b.log(3.0) * b.log2()
        - b.recip()
}
reads!(powers_roots_logarithms, Symbolic, powers(c()), at [0.0], 0.0 => [2.0]);

#[constraint(dual)]
fn time_by_another_name(t: Coord, tau: Time) -> f64 {
    t - 3.0 * tau
}
reads!(a_coordinate_called_t_is_not_time, Dual, time_by_another_name(c()), at [1.0], 2.0 => [-5.0]);

#[constraint]
fn loop_closure(q: Coord, x: Coord, value: Planar, l: f64) -> f64 {
    l * q.cos() - x + value.theta
}
reads!(an_argument_called_q, Symbolic, loop_closure(c(), c(), p(), 2.0), at [0.0, 0.5, 0.0, 0.0, 1.0], 0.0 => [2.5]);
