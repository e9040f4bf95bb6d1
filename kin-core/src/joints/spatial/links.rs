//! Links without mass: two joints and the body between them as one constraint.

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Link with a hinge on body i and a ball on body j: h_i · d = 0 and (|d|² − l²)/(2 l) = 0 with d =
/// r_Pj − r_Pi.   \[m, m\]
///
/// Removes 2 freedoms. `u_i`, `h_i`: the hinge, whose length scales the first row; `u_j`: the ball;
/// `length`: l. The ball is in the hinge's plane. Haug, section 9.4.
///
/// Signs: the first row is positive where the ball is on the side to which h_i points.
#[constraint]
#[require(length > 0.0, "a link needs a length above zero")]
#[require(h_i.norm() > 0.0, "the hinge needs an axis with a length above zero")]
pub fn revolute_spherical(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Vec3,
    length: f64,
) -> (f64, f64) {
    let d = j.point(u_j) - i.point(u_i);
    let plane = i.direction(h_i).dot(d);
    let rod = 0.5 * (d.norm_squared() / length - length);
    (plane, rod)
}

/// Link with a hinge at either end: h_i · d = 0, h_j · d = 0, (|d|² − l²)/(2 l) = 0 and h_j · (b
/// cos α − h_i sin α) = 0, d = r_Pj − r_Pi, b = d × h_i / l. \[m, m, m, –\]
///
/// Removes 4 freedoms. `u_i`, `h_i`, `u_j`, `h_j`: the hinges; `length`: l of the common normal;
/// `twist`: α, from h_i to h_j about d by the right-hand rule, zero for parallel hinges (Denavit
/// and Hartenberg's link). The equations hold for an opposite h_j too; a position found so is an
/// error. Haug, section 9.4.
///
/// Signs: d points from i to j; `twist` is right-handed about d and turns h_i into h_j.
#[constraint]
#[require(length > 0.0, "a link needs a length above zero")]
#[branch(
    {
        let d = j.point(u_j) - i.point(u_i);
        let h = i.direction(h_i.h);
        j.direction(h_j.h).dot(h * twist.cos() + d.cross(h) * (twist.sin() / length)) > 0.0
    },
    "its second hinge points the other way"
)]
pub fn revolute_revolute(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
    length: f64,
    twist: f64,
) -> [f64; 4] {
    let d = j.point(u_j) - i.point(u_i);
    let h_i = i.direction(h_i.h);
    let h_j = j.direction(h_j.h);
    let (sin, cos) = twist.sin_cos();
    let across = d.cross(h_i) * (cos / length) - h_i * sin;
    [h_i.dot(d), h_j.dot(d), 0.5 * (d.norm_squared() / length - length), h_j.dot(across)]
}

/// Link with a hinge on body i and a sleeve on an axis of body j: h_i · d = 0, (|d|² − l²)/(2 l) =
/// 0 and h_j · (b cos α − h_i sin α) = 0, d the part of r_Pj − r_Pi across h_j, b = d × h_i /
/// l.   \[m, m, –\]
///
/// Removes 3 freedoms. `u_i`, `h_i`: the hinge; `u_j`, `h_j`: the axis on which the sleeve turns
/// and slides; `length`: l of the common normal; `twist`: α, from h_i to h_j about d. The equations
/// hold for an opposite h_j too; a position found so is an error. Haug, section 9.4.
///
/// Signs: d points from i to the axis of j; `twist` is right-handed about d and turns h_i into h_j.
#[constraint]
#[require(length > 0.0, "a link needs a length above zero")]
#[branch(
    {
        let d = j.point(u_j) - i.point(u_i);
        let h = i.direction(h_i.h);
        let k = j.direction(h_j.h);
        k.dot(h * twist.cos() + (d - k * k.dot(d)).cross(h) * (twist.sin() / length)) > 0.0
    },
    "its sleeve points the other way"
)]
pub fn revolute_cylindrical(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
    length: f64,
    twist: f64,
) -> [f64; 3] {
    let s = j.point(u_j) - i.point(u_i);
    let h_i = i.direction(h_i.h);
    let h_j = j.direction(h_j.h);
    let d = s - h_j * h_j.dot(s);
    let (sin, cos) = twist.sin_cos();
    let across = d.cross(h_i) * (cos / length) - h_i * sin;
    [h_i.dot(d), 0.5 * (d.norm_squared() / length - length), h_j.dot(across)]
}

/// Link with a ball on body i and a sleeve on an axis of body j: ((f_j · d)² + (g_j · d)² − l²)/(2
/// l) = 0 with d = r_Pi − r_Pj.   \[m\]
///
/// Removes 1 freedom. `u_i`: the ball; `u_j`, `h_j`: the axis; `length`: l. A point on a cylinder
/// of radius l. Haug, section 9.4.
///
/// Signs: none; the row is positive outside of the cylinder.
#[constraint]
#[require(length > 0.0, "a link needs a length above zero")]
pub fn spherical_cylindrical(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_j: Axis,
    length: f64,
) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    let f = j.direction(h_j.f).dot(d);
    let g = j.direction(h_j.g).dot(d);
    0.5 * ((f * f + g * g) / length - length)
}
