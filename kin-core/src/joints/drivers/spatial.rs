//! Drivers of spatial bodies.

use crate::algebra::{Axis, EulerParameters, Vec3, vec3};
use crate::law::Law;
use kin_macros::constraint;

/// The turn of body i in body j follows a law of time: the turn of f_i from f_j about h_j, taken back by f(t), is zero.      \[rad\]
///
/// `h_i`, `h_j`: the common axis in either body, held parallel by a joint; f_i and f_j are where the angle counts from. What is measured is turned
/// back by the law and what remains is driven to zero: any number of turns, and no jump where a measured angle has its cut.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
pub fn drive_turn(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis, law: Law, t: Time) -> f64 {
    let f = i.direction(h_i.f);
    let (x, y) = (f.dot(j.direction(h_j.f)), f.dot(j.direction(h_j.g)));
    let (sin, cos) = law.at(t).sin_cos();
    (y * cos - x * sin).atan2(x * cos + y * sin)
}

/// A slide follows a law of time: h_j · (r_Pi − r_Pj) − f(t) = 0.      \[m\]
///
/// `u_i`: P_i; `u_j`: from where, `h_j`: along which direction in body j. A cylinder or a linear motor.
#[constraint]
pub fn drive_slide(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis, law: Law, t: Time) -> f64 {
    j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j)) - law.at(t)
}

/// The distance of two points follows a law of time: |r_Pi − r_Pj| − f(t) = 0.      \[m\]
///
/// `u_i`, `u_j`: the points. The law must stay above zero: where the points meet there is no slope. A leg of a Stewart platform.
#[constraint]
pub fn drive_distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, law: Law, t: Time) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - law.at(t)
}

/// A point of a body follows a path: r_P − (f1(t), f2(t), f3(t)) = 0.      \[m\]
///
/// `u`: local position of P. Lecture, "Driving Constraints": complex driver.
#[constraint]
pub fn drive_point(body: Spatial, u: Vec3, path_x: Law, path_y: Law, path_z: Law, t: Time) -> Vec3 {
    body.point(u) - vec3(path_x.at(t), path_y.at(t), path_z.at(t))
}

/// One coordinate of a point follows a law of time: n · r_P − f(t) = 0.      \[m\]
///
/// `u`: local position of P; `n`: the global direction along which it is measured.
#[constraint]
pub fn drive_point_along(body: Spatial, u: Vec3, n: Axis, law: Law, t: Time) -> f64 {
    n.h.dot(body.point(u)) - law.at(t)
}

/// Body i turns in body j about an axis by a law of time: the vector part of p(t)* p_j* p_i is zero, p(t) = (cos f/2, h_j sin f/2).      \[–\]
///
/// Three rows. `h_j`: the axis in body j; at f = 0 both frames have the same directions. Any number of turns.
#[constraint]
pub fn drive_rotation(i: Spatial, j: Spatial, h_j: Axis, law: Law, t: Time) -> Vec3 {
    let (sin, cos) = (0.5 * law.at(t)).sin_cos();
    let back = EulerParameters::new(cos, -sin * h_j.h.x, -sin * h_j.h.y, -sin * h_j.h.z);
    back.product(j.p.conjugate().product(i.p)).vector()
}

/// Body i is turned in body j by yaw, pitch and roll, laws of time: the vector part of p(t)* p_j* p_i is zero, p = p_z(yaw) p_y(pitch) p_x(roll).      \[–\]
///
/// Three rows: an orientation path. First roll about x, then pitch about y, then yaw about z, all axes those of body j; the same as yaw, pitch and
/// roll about the axes as they move along. Any number of turns.
#[constraint]
pub fn drive_orientation(i: Spatial, j: Spatial, yaw: Law, pitch: Law, roll: Law, t: Time) -> Vec3 {
    let (sz, cz) = (0.5 * yaw.at(t)).sin_cos();
    let (sy, cy) = (0.5 * pitch.at(t)).sin_cos();
    let (sx, cx) = (0.5 * roll.at(t)).sin_cos();
    let p_z = EulerParameters::new(cz, 0.0, 0.0, sz);
    let p_yx = EulerParameters::new(cy, 0.0, sy, 0.0).product(EulerParameters::new(cx, sx, 0.0, 0.0));
    p_z.product(p_yx).conjugate().product(j.p.conjugate().product(i.p)).vector()
}
