//! Defines joints that hold points and angles.

use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Holds a body at a given position and angle: R − r = 0 and θ − θ0 = 0. \[m, m, rad\]
///
/// Removes 3 freedoms. `r` is the global position of the origin of the body frame \[m\]. `theta` is
/// the angle θ0 of the body \[rad\]. Use this joint for a second ground; the ground of Kin needs no
/// joint. Source: lecture notes, "Constraint Equations".
///
/// Signs: `theta` is counter-clockwise positive from the global x-axis.
#[constraint]
pub fn fixed(j: Planar, r: Vec2, theta: f64) -> (f64, f64, f64) {
    let x = j.r.x - r.x;
    let y = j.r.y - r.y;
    let turn = j.theta - theta;
    (x, y, turn)
}

/// Pins body i to body j at point P: R_i + A_i ū_i − R_j − A_j ū_j = 0. \[m\]
///
/// Removes 2 freedoms. `u_i` and `u_j` are the local positions of P in body i and body j \[m\].
/// Source: lecture notes, "Constraint Library: Revolute"; Shabana, *Computational Dynamics*, 3rd
/// ed., section 3.4. Measure: `angle`, θ_i − θ_j.
///
/// Signs: the angle is the rotation of i relative to j, counter-clockwise positive. The angle is
/// zero where the x-axes of both bodies are parallel, and counts full revolutions.
#[constraint]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

/// Holds body i rigidly on body j: r_Pi − r_Pj = 0 and θ_i − θ_j − θ0 = 0. \[m, rad\]
///
/// Removes 3 freedoms. `u_i` and `u_j` are the local positions of a common point P in body i and
/// body j \[m\]. `theta0` is the angle θ0 between the bodies \[rad\]. Source: Shabana, section 3.4.
///
/// Signs: `theta0` is the rotation of i relative to j, counter-clockwise positive.
#[constraint]
pub fn weld(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, theta0: f64) -> (Vec2, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let turn = i.theta - j.theta - theta0;
    (point, turn)
}

/// Holds two pins at a constant distance, as a rod without mass does: (|r_Pi − r_Pj|² − l²)/(2 l) =
/// 0. \[m\]
///
/// Removes 1 freedom. `u_i` and `u_j` are the local positions of the pins in body i and body j
/// \[m\]. `length` is the positive length l of the rod \[m\]. Near the solution the row is |r_Pi −
/// r_Pj| − l, but the derivative of the row also exists where the pins coincide. Source: Haug,
/// *Computer Aided Kinematics and Dynamics*, section 3.3.
///
/// Signs: the rod may point in any direction.
#[constraint]
#[require(length > 0.0, "the length of the rod must be above zero; for pins at the same point use `revolute`")]
pub fn distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, length: f64) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    0.5 * (d.norm_squared() / length - length)
}

/// Holds body i at a constant angle to body j: θ_i − θ_j − θ0 = 0. \[rad\]
///
/// Removes 1 freedom. `theta0` is the angle θ0 \[rad\]. Kin does not wrap the angle: θ0 and θ0 + 2π
/// are different angles. Source: lecture notes, "Constraint Library: Prismatic", first row.
///
/// Signs: `theta0` is the rotation of i relative to j, counter-clockwise positive.
#[constraint]
pub fn angle(i: Planar, j: Planar, theta0: f64) -> f64 {
    i.theta - j.theta - theta0
}

/// Keeps a direction of body i parallel to a direction of body j: h_i × h_j = 0. \[–\]
///
/// Removes 1 freedom. `h_i` and `h_j` are the local directions; their lengths scale the row.
/// Opposite directions satisfy the equation too, so a position found with h_i · h_j < 0 is an
/// error. Source: Shabana, section 3.4.
///
/// Signs: h_i and h_j point in the same direction. The row is positive where h_j is
/// counter-clockwise of h_i.
#[constraint]
#[require(h_i.norm() > 0.0 && h_j.norm() > 0.0, "the directions must not be zero")]
#[branch(i.direction(h_i).dot(j.direction(h_j)) > 0.0, "the directions are opposite: h_i · h_j < 0")]
pub fn parallel(i: Planar, j: Planar, h_i: Vec2, h_j: Vec2) -> f64 {
    i.direction(h_i).cross(j.direction(h_j))
}
