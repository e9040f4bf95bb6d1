//! Defines the drivers of coordinates and planar bodies.

use crate::law::Law;
use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Makes a coordinate follow a law of time: q − f(t) = 0. \[unit of q\]
///
/// `q` is a scalar coordinate or a coordinate of a body: `body.theta()`, `body.x()`. `law` is f.
/// Source: lecture notes, "Driving Constraints".
///
/// Signs: each coordinate has its usual sign. R_x and R_y of a body are global coordinates, and θ
/// of a body is positive counter-clockwise.
#[constraint]
pub fn drive(q: Coord, law: Law, t: Time) -> f64 {
    q - law.at(t)
}

/// Makes the angle of a body follow a law of time: θ − f(t) = 0. \[rad\]
///
/// `law` is f \[rad\]. Kin does not wrap angles, so the law can count full revolutions. Source:
/// lecture notes, "Driving Constraints".
///
/// Signs: θ is counter-clockwise positive, from the global x-axis to the x-axis of the body.
#[constraint]
pub fn drive_angle(body: Planar, law: Law, t: Time) -> f64 {
    body.theta - law.at(t)
}

/// Makes the angle between two bodies follow a law of time: θ_i − θ_j − f(t) = 0. \[rad\]
///
/// `law` is f \[rad\]; the law can count full revolutions. Use this driver for a motor on body j
/// that turns body i. Source: Haug, section 3.5.
///
/// Signs: the angle is the rotation of i relative to j, counter-clockwise positive.
#[constraint]
pub fn drive_relative_angle(i: Planar, j: Planar, law: Law, t: Time) -> f64 {
    i.theta - j.theta - law.at(t)
}

/// Makes a displacement along a line of body j follow a law of time: h_j · (s − ū_j) − f(t) = 0,
/// where s is P_i in the frame of j. \[m\]
///
/// `u_i` is the local position of P_i in body i \[m\]. `u_j` is the point of body j where the
/// displacement is zero \[m\]. `h_j` is the direction of the line in body j, of any length. `law`
/// is f \[m\]. Use this driver for a cylinder or a linear motor. Source: Haug, section 3.5.
///
/// Signs: the displacement grows as P_i moves along h_j in j.
#[constraint]
#[require(h_j.norm() > 0.0, "the direction of the slide must not be zero")]
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

/// Makes the distance of two points follow a law of time: |r_Pi − r_Pj| − f(t) = 0. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `law` is f
/// \[m\]. The law must remain positive, because the distance has no derivative where the points
/// coincide. Use this driver for a hydraulic cylinder. Source: Haug, section 3.5.
///
/// Signs: the distance is always positive.
#[constraint]
pub fn drive_distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, law: Law, t: Time) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - law.at(t)
}

/// Makes a point of a body follow a path: r_P − (f1(t), f2(t)) = 0. \[m\]
///
/// `u` is the local position of P \[m\]. `path_x` and `path_y` are f1 and f2 \[m\]. Source: lecture
/// notes, "Driving Constraints".
///
/// Signs: the laws give global coordinates.
#[constraint]
pub fn drive_point(body: Planar, u: Vec2, path_x: Law, path_y: Law, t: Time) -> Vec2 {
    let path = Vec2::new(path_x.at(t), path_y.at(t));
    body.point(u) - path
}

/// Makes one coordinate of a point follow a law of time: n · r_P − f(t) = 0. \[m\]
///
/// `u` is the local position of P \[m\]. `n` is the global direction of the coordinate, of any
/// length. `law` is f \[m\]. Source: Haug, section 3.5.
///
/// Signs: the coordinate grows along `n`, from the global origin.
#[constraint]
#[require(n.norm() > 0.0, "the direction must not be zero")]
pub fn drive_point_along(body: Planar, u: Vec2, n: Vec2, law: Law, t: Time) -> f64 {
    n.normalize().dot(body.point(u)) - law.at(t)
}
