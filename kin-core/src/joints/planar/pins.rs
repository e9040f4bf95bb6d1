//! Joints that hold points and angles.

use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// A body that does not move: R = r, θ = θ0.      \[m, m, rad\]
///
/// Removes 3 freedoms. `r`: R; `theta`: θ0. The lecture's ground is a body with this constraint at
/// the origin ("Constraint Equations").
///
/// Signs: `theta` counter-clockwise from the global x-axis.
#[constraint]
pub fn fixed(j: Planar, r: Vec2, theta: f64) -> (f64, f64, f64) {
    let x = j.r.x - r.x;
    let y = j.r.y - r.y;
    let turn = j.theta - theta;
    (x, y, turn)
}

/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      \[m\]
///
/// Removes 2 freedoms. `u_i`, `u_j`: local position of P in either body. Lecture, "Constraint
/// Library: Revolute"; Shabana, *Computational Dynamics*, 3rd ed., section 3.4. Measure: `angle`,
/// θ_i − θ_j.
///
/// Signs: the angle is the turn of i in j, counter-clockwise positive, zero where their x-axes are
/// parallel, and never wrapped.
#[constraint]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

/// Rigid connection: r_Pi − r_Pj = 0 and θ_i − θ_j − θ0 = 0.      \[m, rad\]
///
/// Removes 3 freedoms. `u_i`, `u_j`: local position of P in either body; `theta0`: θ0. Shabana,
/// section 3.4.
///
/// Signs: `theta0` is the turn of i in j, counter-clockwise positive.
#[constraint]
pub fn weld(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, theta0: f64) -> (Vec2, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let turn = i.theta - j.theta - theta0;
    (point, turn)
}

/// Rod without mass between two pins: (|r_Pi − r_Pj|² − l²)/(2 l) = 0.      \[m\]
///
/// Removes 1 freedom. `u_i`, `u_j`: the pins; `length`: l. Near the solution this is |r_Pi − r_Pj|
/// − l, but it has no singular slope where the pins meet. Haug, *Computer Aided Kinematics and
/// Dynamics*, section 3.3.
///
/// Signs: none; `length` is above zero, and the rod may point anywhere.
#[constraint]
#[require(length > 0.0, "a rod needs a length above zero; pins that coincide are `revolute`")]
pub fn distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, length: f64) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    0.5 * (d.norm_squared() / length - length)
}

/// Bodies at a fixed angle: θ_i − θ_j − θ0 = 0.      \[rad\]
///
/// Removes 1 freedom. `theta0`: θ0, which is not wrapped: a full turn is another angle. Lecture,
/// "Constraint Library: Prismatic", its first row.
///
/// Signs: `theta0` is the turn of i in j, counter-clockwise positive.
#[constraint]
pub fn angle(i: Planar, j: Planar, theta0: f64) -> f64 {
    i.theta - j.theta - theta0
}

/// Parallel directions: h_i × h_j = 0.      \[–\]
///
/// Removes 1 freedom. `h_i`, `h_j`: local directions, whose lengths scale the row. The equation
/// holds for opposite directions too; a position found with h_i · h_j < 0 is an error. Shabana,
/// section 3.4.
///
/// Signs: h_i and h_j point the same way; the row is positive where h_j is counter-clockwise of
/// h_i.
#[constraint]
#[require(h_i.norm() > 0.0 && h_j.norm() > 0.0, "a direction needs a length above zero")]
#[branch(i.direction(h_i).dot(j.direction(h_j)) > 0.0, "its directions are opposite: h_i · h_j < 0")]
pub fn parallel(i: Planar, j: Planar, h_i: Vec2, h_j: Vec2) -> f64 {
    i.direction(h_i).cross(j.direction(h_j))
}
