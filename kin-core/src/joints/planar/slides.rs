//! Joints that let something slide.

use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Sliding joint: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi − r_Pj) = 0.      \[rad, m\]
///
/// Removes 2 freedoms. `u_i`, `u_j`: local positions of a point on the slide in either body; `h_i`:
/// local direction in body i perpendicular to the slide (its length scales the second row);
/// `theta0`: θ0. Lecture, "Constraint Library: Prismatic". What is fixed in body i is written in
/// its own frame, h_i · A_i ū_i = h̄_i · ū_i: the same equation, with a quarter less to compute.
/// Measure: `slide`, how far P_i is from P_j along the slide.
///
/// Signs: the slide grows as i moves in j with h_i to the left of its way (h_i along y: to the
/// right, along x of body i). `theta0` is the turn of i in j, counter-clockwise positive.
#[constraint]
#[require(h_i.norm() > 0.0, "the direction across the slide needs a length above zero")]
#[measure(slide = -(i.direction(h_i).perp().dot(i.point(u_i) - j.point(u_j))) / h_i.norm(), "m")]
pub fn prismatic(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    let turn = i.theta - j.theta - theta0;
    let offset = h_i.dot(u_i) + i.direction(h_i).dot(i.r - j.point(u_j));
    (turn, offset)
}

/// A point of body i stays on a line of body j: h_j × (s − ū_j) = 0, s the point as body j sees
/// it.   \[m\]
///
/// Removes 1 freedom. `u_i`: the point; `u_j`: a point of the line, `h_j`: its direction, whose
/// length scales the row. Haug, section 3.3: revolute–translational joint. Measures: `slide`, the
/// point's way from ū_j along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the slide grows along h_j, the row to the left of it; the angle is the turn of i in j,
/// counter-clockwise positive.
#[constraint]
#[require(h_j.norm() > 0.0, "the line needs a direction with a length above zero")]
#[measure(slide = h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm(), "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn point_on_line(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    h_j.cross(s - u_j)
}

/// A pin of body i in a straight slot of body j, from A to B: (B − A) × (s − A)/|B − A| = 0, s the
/// pin as body j sees it.   \[m\]
///
/// Removes 1 freedom. `u_i`: the pin; `a_j`, `b_j`: the ends of the slot's centre line. The ends do
/// not stop the pin: a run tells by an event when it passes one. Measures: `slide`, the pin's way
/// from A; `angle`, θ_i − θ_j.
///
/// Signs: the slide grows from A towards B, the row to the left of that; the angle is the turn of i
/// in j, counter-clockwise positive.
#[constraint]
#[require((b_j - a_j).norm() > 0.0, "the ends of the slot coincide")]
#[measure(slide = (b_j - a_j).dot(j.local(i.point(u_i)) - a_j) / (b_j - a_j).norm(), "m", ends = (0.0, (b_j - a_j).norm()))]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn pin_in_slot(i: Planar, j: Planar, u_i: Vec2, a_j: Vec2, b_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    (b_j - a_j).normalize().cross(s - a_j)
}

/// A point of body i stays on a circle of body j: (|s − c_j|² − ρ²)/(2 ρ) = 0, s the point as body
/// j sees it.
///    \[m\]
///
/// Removes 1 freedom. `u_i`: the point; `c_j`: the centre, `radius`: ρ. A circular slot, or a rod
/// of length ρ. Haug, section 3.3. Measure: `angle`, where the point stands on the circle.
///
/// Signs: the angle is counter-clockwise positive from the x-axis of body j; the row is positive
/// outside of the circle.
#[constraint]
#[require(radius > 0.0, "a circle needs a radius above zero")]
#[measure(angle = (j.local(i.point(u_i)) - c_j).y.atan2((j.local(i.point(u_i)) - c_j).x), "rad", turns)]
pub fn point_on_circle(i: Planar, j: Planar, u_i: Vec2, c_j: Vec2, radius: f64) -> f64 {
    let s = i.point(u_i) - j.point(c_j);
    0.5 * (s.norm_squared() / radius - radius)
}
