//! Driving constraints: what a motor or a prescribed path asks for, as an equation with time in it.

use crate::algebra::Vec2;
use crate::law::Law;
use kin_macros::constraint;

/// A coordinate follows a law of time: q − f(t) = 0.      \[unit of q\]
///
/// Any bare coordinate, or one of a body's: `body.theta()`, `body.x()`. Lecture, "Driving Constraints": simple driver.
#[constraint(lanes)]
pub fn drive(q: Coord, law: Law, t: Time) -> f64 {
    q - law.at(t)
}

/// The angle of a body follows a law of time: θ − f(t) = 0.      \[rad\]
///
/// Counter-clockwise positive; angles are not wrapped, so the law may go on for any number of turns. Lecture, "Driving Constraints".
#[constraint(lanes)]
pub fn drive_angle(body: Planar, law: Law, t: Time) -> f64 {
    body.theta - law.at(t)
}

/// A point of a body follows a path: r_P − (f1(t), f2(t)) = 0.      \[m\]
///
/// `u`: local position of P. Lecture, "Driving Constraints": complex driver.
#[constraint(lanes)]
pub fn drive_point(body: Planar, u: Vec2, path_x: Law, path_y: Law, t: Time) -> Vec2 {
    let path = Vec2::new(path_x.at(t), path_y.at(t));
    body.point(u) - path
}
