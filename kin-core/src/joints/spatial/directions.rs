//! Defines joints that hold directions and leave points free.

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Keeps an axis of body i parallel to an axis of body j: f_i · h_j = g_i · h_j = 0. \[–, –\]
///
/// Removes 2 freedoms. `h_i` and `h_j` are the axes. f_i and g_i are the two directions across h_i;
/// the length of h_j scales the rows. Opposite axes satisfy the equations too, so a position found
/// with h_i · h_j < 0 is an error. Source: Haug, section 9.4.
///
/// Signs: h_i and h_j point in the same direction.
#[constraint]
#[require(h_j.norm() > 0.0, "the axis in body j must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
pub fn parallel(i: Spatial, j: Spatial, h_i: Axis, h_j: Vec3) -> (f64, f64) {
    let h = j.direction(h_j);
    let f = i.direction(h_i.f).dot(h);
    let g = i.direction(h_i.g).dot(h);
    (f, g)
}

/// Keeps a direction of body i perpendicular to a direction of body j: h_i · h_j = 0. \[–\]
///
/// Removes 1 freedom. `h_i` and `h_j` are the directions; their lengths scale the row. As a
/// primitive this joint has the name dot-1. Source: Haug, section 9.4.
///
/// Signs: the row is positive where the angle between h_i and h_j is less than 90°.
#[constraint]
#[require(h_i.norm() > 0.0 && h_j.norm() > 0.0, "the directions must not be zero")]
pub fn perpendicular(i: Spatial, j: Spatial, h_i: Vec3, h_j: Vec3) -> f64 {
    i.direction(h_i).dot(j.direction(h_j))
}

/// Holds a direction of body i at a constant angle to a direction of body j: h_i · h_j − cos α = 0.
/// \[–\]
///
/// Removes 1 freedom. `h_i` and `h_j` are the directions. `alpha` is the angle α between the
/// directions, strictly between 0 and π \[rad\]. At 0 and π the derivative of the row is zero; use
/// `parallel` instead. Source: Haug, section 9.4.
///
/// Signs: the angle has no sign, so h_i can be anywhere on a cone about h_j. The row is positive
/// where the angle is less than α.
#[constraint]
#[require(alpha > 0.0 && alpha < std::f64::consts::PI, "the angle must be above 0 and below π; for the angles 0 and π use `parallel`")]
pub fn angle(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis, alpha: f64) -> f64 {
    i.direction(h_i.h).dot(j.direction(h_j.h)) - alpha.cos()
}
