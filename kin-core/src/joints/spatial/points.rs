//! Defines joints that hold points on points, lines, planes and spheres.

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Holds point P of body i on point P of body j, as a ball joint does: R_i + A_i ū_i − R_j − A_j
/// ū_j = 0. \[m\]
///
/// Removes 3 freedoms. `u_i` and `u_j` are the local positions of P in body i and body j \[m\]. The
/// name of this primitive is at-point. Source: lecture notes, "Spherical Joint Constraint".
///
/// Signs: the rows are the global components of the vector from P_j to P_i.
#[constraint]
pub fn spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> Vec3 {
    i.point(u_i) - j.point(u_j)
}

/// Holds two points at a constant distance, as a rod without mass does: (|r_Pi − r_Pj|² − l²)/(2 l)
/// = 0. \[m\]
///
/// Removes 1 freedom. `u_i` and `u_j` are the local positions of the points in body i and body j
/// \[m\]. `length` is the positive length l of the rod \[m\]. A rod between a ball joint and a
/// universal joint has the same equation. Near the solution the row is |r_Pi − r_Pj| − l, but the
/// derivative of the row also exists where the points coincide. Source: Haug, section 9.4.
///
/// Signs: the rod may point in any direction.
#[constraint]
#[require(length > 0.0, "the length of the rod must be above zero; for points at the same place use `spherical`")]
pub fn distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, length: f64) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    0.5 * (d.norm_squared() / length - length)
}

/// Keeps a point of body i on a line of body j: f_j · d = g_j · d = 0 with d = r_Pi − r_Pj. \[m,
/// m\]
///
/// Removes 2 freedoms. `u_i` is the local position of the point in body i \[m\]. `u_j` is a point
/// of the line \[m\] and `h_j` the direction of the line in body j. f_j and g_j are two directions
/// perpendicular to h_j. Source: Haug, section 9.4. Measure: `slide`, h_j · d.
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

/// Keeps a point of body i in a plane of body j: h_j · (r_Pi − r_Pj) = 0. \[m\]
///
/// Removes 1 freedom. `u_i` is the local position of the point in body i \[m\]. `u_j` is a point of
/// the plane \[m\] and `h_j` the normal of the plane in body j; its length scales the row. As a
/// primitive this joint has the name dot-2. Source: Haug, section 9.4.
///
/// Signs: the row is positive where the point is on the side to which h_j points.
#[constraint]
#[require(h_j.norm() > 0.0, "the normal of the plane must not be zero")]
pub fn point_in_plane(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Vec3) -> f64 {
    j.direction(h_j).dot(i.point(u_i) - j.point(u_j))
}

/// Holds one global coordinate of a point at a constant value: n · r_P − c = 0. \[m\]
///
/// Removes 1 freedom. `u` is the local position of P \[m\]. `n` is the global direction of the
/// coordinate; its length scales the row and c. `value` is c \[m\]. Source: Haug, section 9.4.
///
/// Signs: c grows along `n`.
#[constraint]
#[require(n.norm() > 0.0, "the direction must not be zero")]
pub fn point_coordinate(body: Spatial, u: Vec3, n: Vec3, value: f64) -> f64 {
    n.dot(body.point(u)) - value
}
