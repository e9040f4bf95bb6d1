//! Drivers of coordinates and planar bodies.

use crate::model::law::Law;
use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// A coordinate follows a law of time: q − f(t) = 0.      \[unit of q\]
///
/// Any bare coordinate, or one of a body's: `body.theta()`, `body.x()`. Lecture, "Driving
/// Constraints": simple driver.
///
/// Signs: those of the coordinate; a body's R_x, R_y are global, its θ is counter-clockwise
/// positive.
#[constraint]
pub fn drive(q: Coord, law: Law, t: Time) -> f64 {
    q - law.at(t)
}

/// The angle of a body follows a law of time: θ − f(t) = 0.      \[rad\]
///
/// Angles are not wrapped, so the law may go on for any number of turns. Lecture, "Driving
/// Constraints".
///
/// Signs: counter-clockwise positive, from the global x-axis to the body's.
#[constraint]
pub fn drive_angle(body: Planar, law: Law, t: Time) -> f64 {
    body.theta - law.at(t)
}

/// The angle between two bodies follows a law of time: θ_i − θ_j − f(t) = 0.      \[rad\]
///
/// Any number of turns. A motor on body j that turns body i. Haug, section 3.5.
///
/// Signs: the turn of i in j, counter-clockwise positive.
#[constraint]
pub fn drive_relative_angle(i: Planar, j: Planar, law: Law, t: Time) -> f64 {
    i.theta - j.theta - law.at(t)
}

/// A slide follows a law of time: h_j · (s − ū_j) − f(t) = 0, s the point P_i as body j sees
/// it.   \[m\]
///
/// `u_i`: P_i; `u_j`: from where, `h_j`: along which direction in body j, of any length. A cylinder
/// or a linear motor. Haug, section 3.5.
///
/// Signs: the slide grows as P_i moves along h_j in j.
#[constraint]
#[require(h_j.norm() > 0.0, "the slide needs a direction with a length above zero")]
pub fn drive_slide(
    i: Planar,
    j: Planar,
    u_i: Vec2,
    u_j: Vec2,
    h_j: Vec2,
    law: Law,
    t: Time,
) -> f64 {
    let s = j.local(i.point(u_i)) - u_j;
    h_j.normalize().dot(s) - law.at(t)
}

/// The distance of two points follows a law of time: |r_Pi − r_Pj| − f(t) = 0.      \[m\]
///
/// `u_i`, `u_j`: the points. The law must stay above zero: where the points meet there is no slope.
/// A hydraulic cylinder. Haug, section 3.5.
///
/// Signs: none; a distance is above zero.
#[constraint]
pub fn drive_distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, law: Law, t: Time) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - law.at(t)
}

/// A point of a body follows a path: r_P − (f1(t), f2(t)) = 0.      \[m\]
///
/// `u`: local position of P. Lecture, "Driving Constraints": complex driver.
///
/// Signs: the laws are global coordinates.
#[constraint]
pub fn drive_point(body: Planar, u: Vec2, path_x: Law, path_y: Law, t: Time) -> Vec2 {
    let path = Vec2::new(path_x.at(t), path_y.at(t));
    body.point(u) - path
}

/// One coordinate of a point follows a law of time: n · r_P − f(t) = 0.      \[m\]
///
/// `u`: local position of P; `n`: the global direction along which it is measured, of any length.
/// Haug, section 3.5.
///
/// Signs: the coordinate grows along `n`, from the global origin.
#[constraint]
#[require(n.norm() > 0.0, "the direction needs a length above zero")]
pub fn drive_point_along(body: Planar, u: Vec2, n: Vec2, law: Law, t: Time) -> f64 {
    n.normalize().dot(body.point(u)) - law.at(t)
}
