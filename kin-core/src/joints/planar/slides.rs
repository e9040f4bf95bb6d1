//! Defines joints in which a point or a body slides.

use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Lets body i slide along a line of body j without rotation: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi −
/// r_Pj) = 0. \[rad, m\]
///
/// Removes 2 freedoms. `u_i` and `u_j` are local positions of a point on the line of sliding in
/// body i and body j \[m\]. `h_i` is the local direction in body i perpendicular to the line; its
/// length scales the second row. `theta0` is the angle θ0 between the bodies \[rad\]. Source:
/// lecture notes, "Constraint Library: Prismatic". Measure: `slide`, the distance of P_i from P_j
/// along the line.
///
/// Signs: the slide grows as i moves in j with h_i on its left. If h_i is the y-axis of body i, the
/// slide grows along the x-axis of body i. `theta0` is the rotation of i relative to j,
/// counter-clockwise positive.
#[constraint]
#[require(h_i.norm() > 0.0, "the direction across the slide must not be zero")]
#[measure(slide = -(i.direction(h_i).perp().dot(i.point(u_i) - j.point(u_j))) / h_i.norm(), "m")]
pub fn prismatic(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    let turn = i.theta - j.theta - theta0;
    let offset = h_i.dot(u_i) + i.direction(h_i).dot(i.r - j.point(u_j));
    (turn, offset)
}

/// Keeps a point of body i on a line of body j: h_j × (s − ū_j) = 0, where s is the point in the
/// frame of j. \[m\]
///
/// Removes 1 freedom. `u_i` is the local position of the point in body i \[m\]. `u_j` is a point of
/// the line in body j \[m\]. `h_j` is the direction of the line; its length scales the row. Source:
/// Haug, section 3.3, revolute–translational joint. Measures: `slide`, the distance of the point
/// from ū_j along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the slide grows along h_j. The row is positive to the left of h_j. The angle is the
/// rotation of i relative to j, counter-clockwise positive.
#[constraint]
#[require(h_j.norm() > 0.0, "the direction of the line must not be zero")]
#[measure(slide = h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm(), "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn point_on_line(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    h_j.cross(s - u_j)
}

/// Keeps a pin of body i in a straight slot of body j from A to B: (B − A) × (s − A)/|B − A| = 0,
/// where s is the pin in the frame of j. \[m\]
///
/// Removes 1 freedom. `u_i` is the local position of the pin in body i \[m\]. `a_j` and `b_j` are
/// the ends A and B of the slot's centre line in body j \[m\]. The ends do not stop the pin: a run
/// reports an event where the pin passes an end. Measures: `slide`, the distance of the pin from A;
/// `angle`, θ_i − θ_j.
///
/// Signs: the slide grows from A towards B. The row is positive to the left of the direction from A
/// to B. The angle is the rotation of i relative to j, counter-clockwise positive.
#[constraint]
#[require((b_j - a_j).norm() > 0.0, "the ends of the slot must be different points")]
#[measure(slide = (b_j - a_j).dot(j.local(i.point(u_i)) - a_j) / (b_j - a_j).norm(), "m", ends = (0.0, (b_j - a_j).norm()))]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn pin_in_slot(i: Planar, j: Planar, u_i: Vec2, a_j: Vec2, b_j: Vec2) -> f64 {
    let s = j.local(i.point(u_i));
    (b_j - a_j).normalize().cross(s - a_j)
}

/// Keeps a point of body i on a circle of body j: (|s − c_j|² − ρ²)/(2 ρ) = 0, where s is the point
/// in the frame of j. \[m\]
///
/// Removes 1 freedom. `u_i` is the local position of the point in body i \[m\]. `c_j` is the centre
/// of the circle in body j \[m\]. `radius` is the radius ρ \[m\]. Use this joint for a circular
/// slot. Source: Haug, section 3.3. Measure: `angle`, the direction from the centre to the point.
///
/// Signs: the angle is counter-clockwise positive from the x-axis of body j. The row is positive
/// outside the circle.
#[constraint]
#[require(radius > 0.0, "the radius of the circle must be above zero")]
#[measure(angle = (j.local(i.point(u_i)) - c_j).y.atan2((j.local(i.point(u_i)) - c_j).x), "rad", turns)]
pub fn point_on_circle(i: Planar, j: Planar, u_i: Vec2, c_j: Vec2, radius: f64) -> f64 {
    let s = i.point(u_i) - j.point(c_j);
    0.5 * (s.norm_squared() / radius - radius)
}
