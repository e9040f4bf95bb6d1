//! Defines joints that keep a point or a face on a curve given as a law: slots and cams.

use std::f64::consts::TAU;

use crate::law::Law;
use crate::numbers::algebra::{Vec2, vec2};
use kin_macros::constraint;

/// Keeps a point of body i on the curve y = f(x) of body j: s_y − f(s_x) = 0, where s is the point
/// in the frame of j. \[m\]
///
/// Removes 1 freedom. `u_i` is the local position of the point in body i \[m\]. `curve` is the law
/// f \[m\]. Use this joint for a curved slot. Measures: `slide`, s_x; `angle`, θ_i − θ_j.
///
/// Signs: the slide grows along the x-axis of body j, the row along its y-axis. The angle is the
/// rotation of i relative to j, counter-clockwise positive.
#[constraint]
#[measure(slide = j.local(i.point(u_i)).x, "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn point_on_curve(i: Planar, j: Planar, u_i: Vec2, curve: Law) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - curve.at(s.x)
}

/// Keeps the tip of a knife-edge follower on a cam: |s| − ρ(φ) = 0, where s is the tip in the cam's
/// frame and φ the angle of s. \[m\]
///
/// Removes 1 freedom. `tip` is the local position of the tip in the follower \[m\]. `profile` is
/// the law ρ: the distance of the cam's edge from the origin of the cam's frame at the angle φ
/// \[m\]. The profile must be 2π-periodic. Source: Norton, *Cam Design and Manufacturing Handbook*.
/// Measure: `contact`, φ.
///
/// Signs: φ is counter-clockwise positive from the x-axis of the cam. When the cam turns
/// counter-clockwise under a tip at rest, φ decreases. The row is positive outside the cam.
#[constraint]
#[require(profile.is_periodic(TAU), "the profile of a cam is a law of an angle and must repeat after 2π; make the law `periodic` with this period")]
#[measure(contact = cam.local(follower.point(tip)).y.atan2(cam.local(follower.point(tip)).x), "rad", turns)]
pub fn cam_knife_edge(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let s = cam.local(follower.point(tip));
    s.norm() - profile.at(s.y.atan2(s.x))
}

/// Keeps the face of a flat-faced follower on a cam: n · (r_P − R_cam) − h(ψ) = 0, where ψ is the
/// angle of the face's normal n in the cam's frame. \[m\]
///
/// Removes 1 freedom. `u` is the local position of a point P of the face in the follower \[m\]. `n`
/// is the normal of the face in the follower, pointing away from the cam. `support` is the law h:
/// the distance from the origin of the cam's frame to the tangent of the edge with a normal at the
/// angle ψ \[m\]. The law must be 2π-periodic. For a sliding follower h is the base radius plus the
/// lift (Norton, *Cam Design and Manufacturing Handbook*). The equation does not need the point of
/// contact, which moves on the face by h′.
///
/// Signs: ψ is counter-clockwise positive from the x-axis of the cam. The row is positive where a
/// gap separates the face from the cam.
#[constraint]
#[require(support.is_periodic(TAU), "the profile of a cam is a law of an angle and must repeat after 2π; make the law `periodic` with this period")]
#[require(n.norm() > 0.0, "the normal of the face must not be zero")]
pub fn cam_flat_face(cam: Planar, follower: Planar, u: Vec2, n: Vec2, support: Law) -> f64 {
    let normal = n.normalize();
    let psi = follower.theta - cam.theta + normal.y.atan2(normal.x);
    follower.direction(normal).dot(follower.point(u) - cam.r) - support.at(psi)
}

/// Keeps a roller follower on a cam: s − ρ e(φ) − r n(φ) = 0, where s is the roller's centre in the
/// cam's frame and n the normal of the edge at φ. \[m, m\]
///
/// Removes 2 freedoms and adds one coordinate, the angle `phi` of the point of contact in the cam's
/// frame, so the joint removes 1 freedom in total. `centre` is the local position of the roller's
/// centre in the follower \[m\]. `radius` is the radius r of the roller \[m\]. `profile` is the law
/// ρ(φ): the distance of the edge from the origin of the cam's frame \[m\]. The profile must be
/// 2π-periodic. The normal is n = (ρ, −ρ′)/|(ρ, ρ′)| in the directions e(φ) and across. The radius
/// of curvature of a concave edge must be larger than the radius of the roller. Source: Norton,
/// *Cam Design and Manufacturing Handbook*.
///
/// Signs: φ is counter-clockwise positive from the x-axis of the cam. The normal n points out of
/// the cam, towards the roller.
#[constraint]
#[require(profile.is_periodic(TAU), "the profile of a cam is a law of an angle and must repeat after 2π; make the law `periodic` with this period")]
#[require(radius >= 0.0, "the radius of the roller must not be below zero")]
pub fn cam_roller(
    cam: Planar,
    follower: Planar,
    phi: Coord,
    centre: Vec2,
    radius: f64,
    profile: Law,
) -> (f64, f64) {
    let s = cam.local(follower.point(centre));
    let e = vec2(phi.cos(), phi.sin());
    let rho = profile.at(phi);
    let slope = profile.slope(phi);
    let share = radius / (rho * rho + slope * slope).sqrt();
    let outwards = s.dot(e) - rho - share * rho;
    let along = e.cross(s) + share * slope;
    (outwards, along)
}
