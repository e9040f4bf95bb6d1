//! Points that move in their body.

use crate::model::law::Law;
use crate::numbers::algebra::{Vec2, vec2};
use kin_macros::constraint;

/// A point that moves in body i by laws of time is a point of body j: R_i + A_i ū_i(t) − R_j − A_j
/// ū_j = 0.
///    \[m\]
///
/// Removes 2 freedoms. `x_i`, `y_i`: ū_i(t); `u_j`: local position in body j. Relative velocity A
/// ū̇ and the Coriolis term 2 θ̇ A_θ ū̇ come from the equation. Lecture, "Moving Point on Rigid
/// Body".
///
/// Signs: the laws are coordinates in the frame of body i.
#[constraint]
pub fn moving_point(i: Planar, j: Planar, x_i: Law, y_i: Law, u_j: Vec2, t: Time) -> Vec2 {
    i.point(vec2(x_i.at(t), y_i.at(t))) - j.point(u_j)
}

/// A point that moves along a path in body i is a point of body j: R_i + A_i ū_i(s) − R_j − A_j
/// ū_j = 0.
///    \[m\]
///
/// Removes 2 freedoms and adds one, the coordinate `s` along the path: 1 in all. A block in a slot.
/// `x_i`, `y_i`: ū_i(s); `u_j`: local position in body j. Lecture, "Moving Point on Rigid Body".
///
/// Signs: the laws are coordinates in the frame of body i; `s` grows the way they run.
#[constraint]
pub fn point_on_path(i: Planar, j: Planar, s: Coord, x_i: Law, y_i: Law, u_j: Vec2) -> Vec2 {
    i.point(vec2(x_i.at(s), y_i.at(s))) - j.point(u_j)
}
