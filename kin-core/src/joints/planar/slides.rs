//! Joints that let something slide.

use crate::algebra::Vec2;
use kin_macros::constraint;

/// Sliding joint: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi − r_Pj) = 0.      \[rad, m\]
///
/// Removes 2 freedoms. `u_i`, `u_j`: local positions of a point on the slide in either body; `h_i`: local direction in body i
/// perpendicular to the slide (its length scales the second row); `theta0`: θ_i − θ_j. Lecture, "Constraint Library: Prismatic". What is fixed
/// in body i is written in its own frame, h_i · A_i ū_i = h̄_i · ū_i: the same equation, with a quarter less to compute.
#[constraint(lanes)]
#[require(h_i.norm() > 0.0, "the direction across the slide needs a length above zero")]
pub fn prismatic(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    let turn = i.theta - j.theta - theta0;
    let offset = h_i.dot(u_i) + i.direction(h_i).dot(i.r - j.point(u_j));
    (turn, offset)
}

/// A point of body i stays on a line of body j: h_j × (s − ū_j) = 0, s the point as body j sees it.      \[m\]
///
/// Removes 1 freedom. `u_i`: the point; `u_j`: a point of the line, `h_j`: its direction, whose length scales the row. Positive to the left of
/// the line. Haug, section 3.3: revolute–translational joint.
#[constraint(lanes)]
#[require(h_j.norm() > 0.0, "the line needs a direction with a length above zero")]
pub fn point_on_line(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    h_j.cross(s - u_j)
}

/// A pin of body i in a straight slot of body j, from A to B: (B − A) × (s − A)/|B − A| = 0, s the pin as body j sees it.      \[m\]
///
/// Removes 1 freedom. `u_i`: the pin; `a_j`, `b_j`: the ends of the slot's centre line. The ends do not stop the pin: where it stands between
/// them is for the reader of the motion to see.
#[constraint(lanes)]
#[require((b_j - a_j).norm() > 0.0, "the ends of the slot coincide")]
pub fn pin_in_slot(i: Planar, j: Planar, u_i: Vec2, a_j: Vec2, b_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    (b_j - a_j).normalize().cross(s - a_j)
}

/// A point of body i stays on a circle of body j: (|s − c_j|² − ρ²)/(2 ρ) = 0, s the point as body j sees it.      \[m\]
///
/// Removes 1 freedom. `u_i`: the point; `c_j`: the centre, `radius`: ρ. A circular slot, or a rod of length ρ.
#[constraint(lanes)]
#[require(radius > 0.0, "a circle needs a radius above zero")]
pub fn point_on_circle(i: Planar, j: Planar, u_i: Vec2, c_j: Vec2, radius: f64) -> f64 {
    let s = i.point(u_i) - j.point(c_j);
    0.5 * (s.norm_squared() / radius - radius)
}
