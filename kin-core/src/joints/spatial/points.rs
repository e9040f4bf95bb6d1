//! Points on points, lines, planes and spheres.

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Ball joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      \[m\]
///
/// Removes 3 freedoms. `u_i`, `u_j`: local position of P in either body. As a primitive it is
/// called at-point. Lecture, "Spherical Joint Constraint".
///
/// Signs: none; the rows are global components of the way from P_j to P_i.
#[constraint]
pub fn spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> Vec3 {
    i.point(u_i) - j.point(u_j)
}

/// Rod without mass between two balls: (|r_Pi − r_Pj|² − l²)/(2 l) = 0.      \[m\]
///
/// Removes 1 freedom. `u_i`, `u_j`: the balls; a rod between a ball and a universal joint has the
/// same equation. Near the solution this is
/// |r_Pi − r_Pj| − l, but it has no singular slope where the points meet. Haug, section 9.4.
///
/// Signs: none; `length` is above zero, and the rod may point anywhere.
#[constraint]
#[require(length > 0.0, "a rod needs a length above zero; points that coincide are `spherical`")]
pub fn distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, length: f64) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    0.5 * (d.norm_squared() / length - length)
}

/// Ball on a line: f_j · d = g_j · d = 0 with d = r_Pi − r_Pj.      \[m, m\]
///
/// Removes 2 freedoms. `u_i`: the ball; `u_j`: a point of the line, `h_j`: its direction; f_j and
/// g_j are across it. Haug, section 9.4. Measure: `slide`, h_j · d.
///
/// Signs: the slide grows as i moves along h_j in j.
#[constraint]
#[measure(slide = j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j)), "m")]
pub fn point_on_line(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis) -> (f64, f64) {
    let d = i.point(u_i) - j.point(u_j);
    let f = j.direction(h_j.f).dot(d);
    let g = j.direction(h_j.g).dot(d);
    (f, g)
}

/// Ball in a plane: h_j · (r_Pi − r_Pj) = 0.      \[m\]
///
/// Removes 1 freedom. `u_i`: the ball; `u_j`: a point of the plane, `h_j`: its normal, whose length
/// scales the row. As a primitive it is called dot-2. Haug, section 9.4.
///
/// Signs: the row is positive where the ball is on the side to which h_j points.
#[constraint]
#[require(h_j.norm() > 0.0, "the plane needs a normal with a length above zero")]
pub fn point_in_plane(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Vec3) -> f64 {
    j.direction(h_j).dot(i.point(u_i) - j.point(u_j))
}

/// One coordinate of a point: n · r_P − c = 0.      \[m\]
///
/// Removes 1 freedom. `u`: local position of P; `n`: the global direction along which it is
/// measured, whose length scales the row and `value`: c. Haug, section 9.4.
///
/// Signs: c grows along `n`.
#[constraint]
#[require(n.norm() > 0.0, "the direction needs a length above zero")]
pub fn point_coordinate(body: Spatial, u: Vec3, n: Vec3, value: f64) -> f64 {
    n.dot(body.point(u)) - value
}
