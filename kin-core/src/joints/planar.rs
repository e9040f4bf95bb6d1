//! Joints between planar bodies.

use crate::algebra::Vec2;
use kin_macros::constraint;

/// A body that does not move: R = r, θ = θ0.      \[m, m, rad\]
///
/// Removes 3 freedoms. The lecture's ground is a body with this constraint at the origin ("Constraint Equations").
#[constraint(lanes)]
pub fn fixed(j: Planar, r: Vec2, theta: f64) -> (f64, f64, f64) {
    let x = j.r.x - r.x;
    let y = j.r.y - r.y;
    let turn = j.theta - theta;
    (x, y, turn)
}

/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      \[m\]
///
/// Removes 2 freedoms. `u_i`, `u_j`: local position of P in either body. Lecture, "Constraint Library: Revolute"; Shabana,
/// *Computational Dynamics*, 3rd ed., section 3.4.
#[constraint(lanes)]
pub fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

/// Sliding joint: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi − r_Pj) = 0.      \[rad, m\]
///
/// Removes 2 freedoms. `u_i`, `u_j`: local positions of a point on the slide in either body; `h_i`: local direction in body i
/// perpendicular to the slide (its length scales the second row); `theta0`: θ_i − θ_j. Lecture, "Constraint Library: Prismatic". What is fixed
/// in body i is written in its own frame, h_i · A_i ū_i = h̄_i · ū_i: the same equation, with a quarter less to compute.
#[constraint(lanes)]
pub fn prismatic(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    let turn = i.theta - j.theta - theta0;
    let offset = h_i.dot(u_i) + i.direction(h_i).dot(i.r - j.point(u_j));
    (turn, offset)
}
