//! Defines links without mass: one constraint replaces a link and the two joints at its ends.

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Replaces a link with a hinge on body i and a ball joint on body j: h_i · d = 0 and (|d|² −
/// l²)/(2 l) = 0 with d = r_Pj − r_Pi. \[m, m\]
///
/// Removes 2 freedoms. `u_i` is a point of the hinge \[m\] and `h_i` its direction in body i; the
/// length of h_i scales the first row. `u_j` is the centre of the ball in body j \[m\]. `length` is
/// l, from the hinge to the ball \[m\]. The ball is in the plane through u_i perpendicular to the
/// hinge. Source: Haug, section 9.4.
///
/// Signs: the first row is positive where the ball is on the side to which h_i points.
#[constraint]
#[require(length > 0.0, "the length of the link must be above zero")]
#[require(h_i.norm() > 0.0, "the axis of the hinge must not be zero")]
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

/// Replaces a link with a hinge at each end: h_i · d = 0, h_j · d = 0, (|d|² − l²)/(2 l) = 0 and
/// h_j · (b cos α − h_i sin α) = 0 with d = r_Pj − r_Pi and b = d × h_i / l. \[m, m, m, –\]
///
/// Removes 4 freedoms. `u_i`, `h_i` and `u_j`, `h_j` are a point \[m\] and the direction of each
/// hinge. `length` is l, the length of the common normal \[m\]. `twist` is α, the angle from h_i to
/// h_j about d \[rad\]; the twist is zero for parallel hinges (the link of Denavit and Hartenberg).
/// An opposite h_j satisfies the equations too, so a position with an opposite h_j is an error.
/// Source: Haug, section 9.4.
///
/// Signs: d points from i to j. `twist` is right-handed about d and rotates h_i into h_j.
#[constraint]
#[require(length > 0.0, "the length of the link must be above zero")]
#[branch(
    {
        let d = j.point(u_j) - i.point(u_i);
        let h = i.direction(h_i.h);
        j.direction(h_j.h).dot(h * twist.cos() + d.cross(h) * (twist.sin() / length)) > 0.0
    },
    "the second hinge points in the opposite direction"
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

/// Replaces a link with a hinge on body i and a sleeve on body j: h_i · d = 0, (|d|² − l²)/(2 l) =
/// 0 and h_j · (b cos α − h_i sin α) = 0 with b = d × h_i / l. \[m, m, –\]
///
/// Removes 3 freedoms. The vector d is the part of r_Pj − r_Pi perpendicular to h_j. `u_i` and
/// `h_i` are a point \[m\] and the direction of the hinge in body i. `u_j` and `h_j` are a point
/// \[m\] and the direction of the axis in body j on which the sleeve rotates and slides. `length`
/// is l, the length of the common normal \[m\]. `twist` is α, the angle from h_i to h_j about d
/// \[rad\]. An opposite h_j satisfies the equations too, so a position with an opposite h_j is an
/// error. Source: Haug, section 9.4.
///
/// Signs: d points from i to the axis of j. `twist` is right-handed about d and rotates h_i into
/// h_j.
#[constraint]
#[require(length > 0.0, "the length of the link must be above zero")]
#[branch(
    {
        let d = j.point(u_j) - i.point(u_i);
        let h = i.direction(h_i.h);
        let k = j.direction(h_j.h);
        k.dot(h * twist.cos() + (d - k * k.dot(d)).cross(h) * (twist.sin() / length)) > 0.0
    },
    "the sleeve points in the opposite direction"
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

/// Keeps a point of body i at a constant distance from an axis of body j: ((f_j · d)² + (g_j · d)²
/// − l²)/(2 l) = 0 with d = r_Pi − r_Pj. \[m\]
///
/// Removes 1 freedom. The joint replaces a link with a ball joint on body i and a sleeve on body j.
/// `u_i` is the centre of the ball in body i \[m\]. `u_j` and `h_j` are a point \[m\] and the
/// direction of the axis in body j. `length` is the distance l \[m\]. Use this joint also for a
/// point on a cylinder of radius l. Source: Haug, section 9.4.
///
/// Signs: the row is positive outside the cylinder.
#[constraint]
#[require(length > 0.0, "the length of the link must be above zero")]
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
