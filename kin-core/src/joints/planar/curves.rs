//! Points and faces on curves given as laws: slots and cams.

use std::f64::consts::TAU;

use crate::model::law::Law;
use crate::numbers::algebra::{Vec2, vec2};
use kin_macros::constraint;

/// A point of body i stays on the curve y = f(x) of body j: s_y − f(s_x) = 0, s the point as body j
/// sees it.
///    \[m\]
///
/// Removes 1 freedom. `u_i`: the point; `curve`: f. Measures: `slide`, s_x; `angle`, θ_i − θ_j.
///
/// Signs: the slide grows along x of body j, the row along its y; the angle is the turn of i in j,
/// counter-clockwise positive.
#[constraint]
#[measure(slide = j.local(i.point(u_i)).x, "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn point_on_curve(i: Planar, j: Planar, u_i: Vec2, curve: Law) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - curve.at(s.x)
}

/// Cam with a knife-edge follower: |s| − ρ(φ) = 0, s the tip and φ its angle as the cam sees
/// them.   \[m\]
///
/// Removes 1 freedom. `tip`: local to the follower; `profile`: ρ, the distance of the cam's edge
/// from the origin of its frame at the angle φ; it has to be 2π-periodic. Norton, *Cam Design and
/// Manufacturing Handbook*. Measure: `contact`, φ.
///
/// Signs: φ is counter-clockwise positive from the cam's own x-axis: as the cam turns
/// counter-clockwise under a tip that stands still, φ falls. The row is positive outside of the
/// cam.
#[constraint]
#[require(profile.is_periodic(TAU), "the profile of a cam is a law of an angle: it has to repeat after 2π; make it `periodic` with that period")]
#[measure(contact = cam.local(follower.point(tip)).y.atan2(cam.local(follower.point(tip)).x), "rad", turns)]
pub fn cam_knife_edge(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let s = cam.local(follower.point(tip));
    s.norm() - profile.at(s.y.atan2(s.x))
}

/// Cam with a flat-faced follower: n · (r_P − R_cam) − h(ψ) = 0, n the face's normal and ψ its
/// angle as the cam sees it.   \[m\]
///
/// Removes 1 freedom. `u`: a point P of the face, `n`: the direction across the face away from the
/// cam, both local to the follower; `support`: h, the distance from the origin of the cam's frame
/// to the edge's tangent whose normal stands at ψ; it has to be 2π-periodic. For a follower that
/// slides, h is base radius plus lift (Norton, *Cam Design and Manufacturing Handbook*). The point
/// of contact, which moves on the face by h′, is not needed.
///
/// Signs: ψ is counter-clockwise positive from the cam's own x-axis; the row is positive where the
/// face is off the cam.
#[constraint]
#[require(support.is_periodic(TAU), "the profile of a cam is a law of an angle: it has to repeat after 2π; make it `periodic` with that period")]
#[require(n.norm() > 0.0, "the normal of the face needs a length above zero")]
pub fn cam_flat_face(cam: Planar, follower: Planar, u: Vec2, n: Vec2, support: Law) -> f64 {
    let normal = n.normalize();
    let psi = follower.theta - cam.theta + normal.y.atan2(normal.x);
    follower.direction(normal).dot(follower.point(u) - cam.r) - support.at(psi)
}

/// Cam with a roller: s − ρ e(φ) − r n(φ) = 0, s the roller's centre as the cam sees it, n the
/// normal of the edge at φ.   \[m, m\]
///
/// Removes 2 freedoms and adds one, the angle `phi` of the point of contact as the cam sees it: 1
/// in all. `centre`: of the roller, local to the follower; `radius`: r; `profile`: ρ(φ), the
/// distance of the edge from the origin of the cam's frame, 2π-periodic. With T = (ρ′, ρ) in the
/// directions e(φ) and across, n = (ρ, −ρ′)/|T|. A hollow edge must be less curved than the roller.
/// Norton.
///
/// Signs: φ is counter-clockwise positive from the cam's own x-axis; n points out of the cam, to
/// the roller's side.
#[constraint]
#[require(profile.is_periodic(TAU), "the profile of a cam is a law of an angle: it has to repeat after 2π; make it `periodic` with that period")]
#[require(radius >= 0.0, "the radius of a roller cannot be below zero")]
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
