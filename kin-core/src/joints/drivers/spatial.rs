//! Drivers of spatial bodies.

use crate::model::law::Law;
use crate::numbers::algebra::{Axis, EulerParameters, Vec3, vec3};
use kin_macros::constraint;

/// The turn of body i in body j follows a law of time: the turn of f_i from f_j about h_j, taken
/// back by f(t), is zero.   \[rad\]
///
/// `h_i`, `h_j`: the common axis in either body, held parallel by a joint; f_i and f_j are where
/// the angle counts from. What is measured is turned back by the law and what remains is driven to
/// zero: any number of turns, and no jump where a measured angle has its cut. Haug, section 9.5.
///
/// Signs: the turn of i in j is right-handed about h_j, zero where f_i lies along f_j.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
pub fn drive_turn(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis, law: Law, t: Time) -> f64 {
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    let (sin, cos) = law.at(t).sin_cos();
    (y * cos - x * sin).atan2(x * cos + y * sin)
}

/// A slide follows a law of time: h_j · (r_Pi − r_Pj) − f(t) = 0.      \[m\]
///
/// `u_i`: P_i; `u_j`: from where, `h_j`: along which direction in body j. A cylinder or a linear
/// motor. Haug, section 9.5.
///
/// Signs: the slide grows as P_i moves along h_j in j.
#[constraint]
pub fn drive_slide(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_j: Axis,
    law: Law,
    t: Time,
) -> f64 {
    j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j)) - law.at(t)
}

/// The distance of two points follows a law of time: |r_Pi − r_Pj| − f(t) = 0.      \[m\]
///
/// `u_i`, `u_j`: the points. The law must stay above zero: where the points meet there is no slope.
/// A leg of a Stewart platform. Haug, section 9.5.
///
/// Signs: none; a distance is above zero.
#[constraint]
pub fn drive_distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, law: Law, t: Time) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - law.at(t)
}

/// A point of a body follows a path: r_P − (f1(t), f2(t), f3(t)) = 0.      \[m\]
///
/// `u`: local position of P. Lecture, "Driving Constraints": complex driver.
///
/// Signs: the laws are global coordinates.
#[constraint]
pub fn drive_point(body: Spatial, u: Vec3, path_x: Law, path_y: Law, path_z: Law, t: Time) -> Vec3 {
    body.point(u) - vec3(path_x.at(t), path_y.at(t), path_z.at(t))
}

/// One coordinate of a point follows a law of time: n · r_P − f(t) = 0.      \[m\]
///
/// `u`: local position of P; `n`: the global direction along which it is measured. Haug, section
/// 9.5.
///
/// Signs: the coordinate grows along `n`, from the global origin.
#[constraint]
pub fn drive_point_along(body: Spatial, u: Vec3, n: Axis, law: Law, t: Time) -> f64 {
    n.h.dot(body.point(u)) - law.at(t)
}

/// Body i turns in body j about an axis by a law of time: the vector part of p(t)* p_j* p_i is
/// zero, p(t) = (cos f/2, h_j sin f/2).   \[–\]
///
/// Three rows. `h_j`: the axis in body j. Any number of turns. Nikravesh, *Computer-Aided Analysis
/// of Mechanical Systems*, ch. 6.
///
/// Signs: the turn of i in j is right-handed about h_j; at zero both frames have the same
/// directions.
#[constraint]
pub fn drive_rotation(i: Spatial, j: Spatial, h_j: Axis, law: Law, t: Time) -> Vec3 {
    let (sin, cos) = (0.5 * law.at(t)).sin_cos();
    let back = EulerParameters::new(cos, -sin * h_j.h.x, -sin * h_j.h.y, -sin * h_j.h.z);
    back.product(j.p.conjugate().product(i.p)).vector()
}

/// Body i is turned in body j by yaw, pitch and roll, laws of time: the vector part of p(t)* p_j*
/// p_i is zero, p = p_z(yaw) p_y(pitch) p_x(roll).   \[–\]
///
/// Three rows: an orientation path. First roll about x, then pitch about y, then yaw about z, all
/// axes those of body j; the same as yaw, pitch and roll about the axes as they move along. Any
/// number of turns. Shabana, *Computational Dynamics*, section 7.2.
///
/// Signs: each turn is right-handed about its axis; at zero both frames have the same directions.
#[constraint]
pub fn drive_orientation(i: Spatial, j: Spatial, yaw: Law, pitch: Law, roll: Law, t: Time) -> Vec3 {
    let (sz, cz) = (0.5 * yaw.at(t)).sin_cos();
    let (sy, cy) = (0.5 * pitch.at(t)).sin_cos();
    let (sx, cx) = (0.5 * roll.at(t)).sin_cos();
    let p_z = EulerParameters::new(cz, 0.0, 0.0, sz);
    let p_yx =
        EulerParameters::new(cy, 0.0, sy, 0.0).product(EulerParameters::new(cx, sx, 0.0, 0.0));
    p_z.product(p_yx).conjugate().product(j.p.conjugate().product(i.p)).vector()
}

/// General motion: a frame of body i moves in a frame of body j by six laws: r_Pi − r_Pj − A_j (x,
/// y, z)(t) = 0, and the vector part of p(t)* p_j* p_i is zero, p = p_z(yaw) p_y(pitch) p_x(roll),
/// A_j, p_i and p_j those of the frames.   \[m, –\]
///
/// Six rows. `u_i`, `p_i`, `u_j`, `p_j`: origin and Euler parameters of the frame in either body
/// (`EulerParameters::identity()`: the axes of the body itself). First roll about x, then pitch
/// about y, then yaw about z, all axes those of the frame in j; any number of turns. Another order
/// of turns is this one between other frames. Shabana, *Computational Dynamics*, section 7.2.
///
/// Signs: x, y, z grow along the axes of the frame in j; each turn is right-handed about its axis;
/// at zero both frames have the same directions.
#[constraint]
#[require(p_i.norm() > 0.0 && p_j.norm() > 0.0, "Euler parameters are not all zero")]
pub fn drive_motion(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    p_i: EulerParameters,
    p_j: EulerParameters,
    x: Law,
    y: Law,
    z: Law,
    yaw: Law,
    pitch: Law,
    roll: Law,
    t: Time,
) -> (Vec3, Vec3) {
    let frame_i = p_i.normalize();
    let frame_j = p_j.normalize();
    let place = frame_j.rotation() * vec3(x.at(t), y.at(t), z.at(t));
    let (sz, cz) = (0.5 * yaw.at(t)).sin_cos();
    let (sy, cy) = (0.5 * pitch.at(t)).sin_cos();
    let (sx, cx) = (0.5 * roll.at(t)).sin_cos();
    let p_z = EulerParameters::new(cz, 0.0, 0.0, sz);
    let p_yx =
        EulerParameters::new(cy, 0.0, sy, 0.0).product(EulerParameters::new(cx, sx, 0.0, 0.0));
    // How body i should stand in body j, taken back from how it stands there.
    let meant = frame_j.product(p_z.product(p_yx)).product(frame_i.conjugate());
    (
        i.point(u_i) - j.point(u_j + place),
        meant.conjugate().product(j.p.conjugate().product(i.p)).vector(),
    )
}
