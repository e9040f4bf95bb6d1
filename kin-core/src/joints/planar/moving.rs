//! Defines joints with a point that moves in its body.

use crate::law::Law;
use crate::numbers::algebra::{Vec2, vec2};
use kin_macros::constraint;

/// Holds a point that moves in body i by laws of time on a point of body j: R_i + A_i ū_i(t) − R_j
/// − A_j ū_j = 0. \[m\]
///
/// Removes 2 freedoms. `x_i` and `y_i` are the laws of the local position ū_i(t) in body i \[m\].
/// `u_j` is the local position in body j \[m\]. The derivatives of the equation contain the
/// relative velocity A ū̇ and the Coriolis term 2 θ̇ A_θ ū̇. Source: lecture notes, "Moving Point
/// on Rigid Body".
///
/// Signs: the laws give coordinates in the frame of body i.
#[constraint]
pub fn moving_point(i: Planar, j: Planar, x_i: Law, y_i: Law, u_j: Vec2, t: Time) -> Vec2 {
    i.point(vec2(x_i.at(t), y_i.at(t))) - j.point(u_j)
}

/// Holds a point that moves along a path in body i on a point of body j: R_i + A_i ū_i(s) − R_j −
/// A_j ū_j = 0. \[m\]
///
/// Removes 2 freedoms and adds one coordinate, `s` along the path, so the joint removes 1 freedom
/// in total. `x_i` and `y_i` are the laws of the local position ū_i(s) in body i \[m\]. `u_j` is
/// the local position in body j \[m\]. Use this joint for a block in a curved slot. Source: lecture
/// notes, "Moving Point on Rigid Body".
///
/// Signs: the laws give coordinates in the frame of body i. `s` grows in the direction of the path.
#[constraint]
pub fn point_on_path(i: Planar, j: Planar, s: Coord, x_i: Law, y_i: Law, u_j: Vec2) -> Vec2 {
    i.point(vec2(x_i.at(s), y_i.at(s))) - j.point(u_j)
}
