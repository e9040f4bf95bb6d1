//! Defines lower pairs (surface contact), universal joints and constant-velocity joints.

use std::f64::consts::TAU;

use crate::numbers::algebra::{Axis, EulerParameters, Vec3};
use kin_macros::constraint;

/// Holds a body at a given pose: R − r = 0 and vec(p0* p) = 0, where vec is the vector part of the
/// product. \[m, –\]
///
/// Removes 6 freedoms. `r` is the global position of the origin of the body frame \[m\]. `p0` are
/// the Euler parameters of the orientation; p0* is their conjugate. There is no second solution,
/// because a rotation by 180° has a vector part of length 1. Nikravesh, *Computer-Aided Analysis of
/// Mechanical Systems*, section 7.2.
///
/// Signs: `p0` rotates the global frame into the frame of the body. p0 and −p0 are the same
/// rotation.
#[constraint]
#[require(p0.norm() > 0.0, "at least one Euler parameter must differ from zero")]
pub fn fixed(j: Spatial, r: Vec3, p0: EulerParameters) -> (Vec3, Vec3) {
    let point = j.r - r;
    let turn = p0.conjugate().product(j.p).vector();
    (point, turn)
}

/// Holds body i rigidly on body j: r_Pi − r_Pj = 0 and vec(p_ij* p_j* p_i) = 0, where vec is the
/// vector part of the product. \[m, –\]
///
/// Removes 6 freedoms. `u_i` and `u_j` are the local positions of a common point P in body i and
/// body j \[m\]. `p_ij` are the Euler parameters of body i relative to body j; * is the conjugate.
/// There is no second solution, because a rotation by 180° has a vector part of length 1.
/// Nikravesh, *Computer-Aided Analysis of Mechanical Systems*, section 7.2.
///
/// Signs: `p_ij` rotates the frame of j into the frame of i.
#[constraint]
#[require(p_ij.norm() > 0.0, "at least one Euler parameter must differ from zero")]
pub fn weld(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, p_ij: EulerParameters) -> (Vec3, Vec3) {
    let point = i.point(u_i) - j.point(u_j);
    let turn = p_ij.conjugate().product(j.p.conjugate().product(i.p)).vector();
    (point, turn)
}

/// Joins two bodies by a hinge: r_Pi − r_Pj = 0 (at-point) and f_i · h_j = g_i · h_j = 0 (two
/// dot-1). \[m, –, –\]
///
/// Removes 5 freedoms. `u_i` and `u_j` are the local positions of a point P of the axis in body i
/// and body j \[m\]. `h_i` and `h_j` are the axis in body i and body j; f_i and g_i are the
/// directions across h_i. Opposite axes satisfy the equations too, so a position found with h_i ·
/// h_j < 0 is an error. Haug, section 9.4. Measure: `angle`, the angle from f_j to f_i.
///
/// Signs: the angle is the rotation of i relative to j, right-handed about h_j. `.zero(f_i, f_j)`
/// sets the zero of the angle: there f_i of body i lies along f_j of body j. By default f_i and f_j
/// are the directions that [`Axis::along`] chooses for h_i and h_j (x for z, y for x, z for y).
#[constraint]
#[require(h_j.norm() > 0.0, "the axis in body j must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
#[measure(angle = i.direction(h_i.f).dot(j.direction(h_j.axis().g)).atan2(i.direction(h_i.f).dot(j.direction(h_j.axis().f))), "rad", turns)]
pub fn revolute(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Vec3,
) -> (Vec3, f64, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let h = j.direction(h_j);
    let f = i.direction(h_i.f).dot(h);
    let g = i.direction(h_i.g).dot(h);
    (point, f, g)
}

/// Lets body i slide along an axis of body j without rotation: vec(p_ij* p_j* p_i) = 0 and f_i · d
/// = g_i · d = 0 (two dot-2) with d = r_Pi − r_Pj. \[–, m, m\]
///
/// Removes 5 freedoms. The function vec gives the vector part of a product of Euler parameters,
/// and * is the conjugate. `u_i` and `u_j` are points of the axis in body i and body j \[m\]. `h_i`
/// is the direction of the axis in body i; f_i and g_i are the directions across h_i. `p_ij` are
/// the Euler parameters of body i relative to body j. The equations have no second solution.
/// Source: Haug, section 9.4. Measure: `slide`, h_i · d.
///
/// Signs: the slide grows as i moves along h_i in j. `p_ij` rotates the frame of j into the frame
/// of i.
#[constraint]
#[require(p_ij.norm() > 0.0, "at least one Euler parameter must differ from zero")]
#[measure(slide = i.direction(h_i.h).dot(i.point(u_i) - j.point(u_j)), "m")]
pub fn prismatic(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    p_ij: EulerParameters,
) -> (Vec3, f64, f64) {
    let turn = p_ij.conjugate().product(j.p.conjugate().product(i.p)).vector();
    let d = i.point(u_i) - j.point(u_j);
    let f = i.direction(h_i.f).dot(d);
    let g = i.direction(h_i.g).dot(d);
    (turn, f, g)
}

/// Lets body i slide along an axis of body j and rotate about it: f_i · h_j = g_i · h_j = 0 (two
/// dot-1) and f_i · d = g_i · d = 0 (two dot-2) with d = r_Pi − r_Pj. \[–, –, m, m\]
///
/// Removes 4 freedoms. `u_i` and `u_j` are points of the axis in body i and body j \[m\]. `h_i` and
/// `h_j` are the axis in body i and body j. The equations h_i × h_j = 0 and h_i × d = 0 describe
/// the same joint (lecture notes, "Cylindrical Joint Constraint"). Kin uses the components of these
/// equations along f_i and g_i, the two directions across h_i, which keep full rank at every pose.
/// Opposite axes satisfy the equations too, so a position found with h_i · h_j < 0 is an error.
/// Measures: `angle`, the angle from f_j to f_i; `slide`, h_j · d.
///
/// Signs: the angle is the rotation of i relative to j, right-handed about h_j. `.zero(f_i, f_j)`
/// sets the zero of the angle, as for [`revolute`](fn@revolute). The slide grows as i moves along
/// h_j in j.
#[constraint]
#[require(h_j.norm() > 0.0, "the axis in body j must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
#[measure(angle = i.direction(h_i.f).dot(j.direction(h_j.axis().g)).atan2(i.direction(h_i.f).dot(j.direction(h_j.axis().f))), "rad", turns)]
#[measure(slide = j.direction(h_j).dot(i.point(u_i) - j.point(u_j)) / h_j.norm(), "m")]
pub fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3) -> [f64; 4] {
    let f = i.direction(h_i.f);
    let g = i.direction(h_i.g);
    let h = j.direction(h_j);
    let d = i.point(u_i) - j.point(u_j);
    [f.dot(h), g.dot(h), f.dot(d), g.dot(d)]
}

/// Joins two bodies by a universal joint: r_Pi − r_Pj = 0 (at-point) and h_i · h_j = 0 (dot-1).
/// \[m, –\]
///
/// Removes 4 freedoms. `u_i` and `u_j` are the local positions of the centre P of the cross in body
/// i and body j \[m\]. `h_i` and `h_j` are the two bars of the cross, each in the body in which it
/// rotates; their lengths scale the row. Source: lecture notes, "Universal Joint Constraint".
/// Measures: `angle_j`, the angle of the cross relative to body j about h_j; `angle_i`, the angle
/// of body i relative to the cross about h_i.
///
/// Signs: both angles are right-handed about their bars. Both angles are zero where the axes of
/// both frames are parallel. From this pose body i rotates by `angle_i` about its bar, and then
/// together with the cross by `angle_j` about the bar of j. If h_i and h_j are not perpendicular in
/// that pose, [`Vec3::axis_near`] gives the reference directions.
#[constraint]
#[require(h_i.norm() > 0.0 && h_j.norm() > 0.0, "the bars of the cross must not be zero")]
#[measure(angle_i = (-i.direction(h_i.axis_near(h_j).g).dot(j.direction(h_j))).atan2(i.direction(h_i.axis_near(h_j).f).dot(j.direction(h_j))), "rad", turns)]
#[measure(angle_j = j.direction(h_j.axis_near(h_i).g).dot(i.direction(h_i)).atan2(j.direction(h_j.axis_near(h_i).f).dot(i.direction(h_i))), "rad", turns)]
pub fn universal(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Vec3,
    h_j: Vec3,
) -> (Vec3, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let cross = i.direction(h_i).dot(j.direction(h_j));
    (point, cross)
}

/// Keeps a plane of body i on a plane of body j: f_i · h_j = g_i · h_j = 0 (two dot-1) and h_j ·
/// (r_Pi − r_Pj) = 0 (dot-2). \[–, –, m\]
///
/// Removes 3 freedoms. `u_i` and `u_j` are points of the common plane in body i and body j \[m\].
/// `h_i` and `h_j` are the normal of the plane in body i and body j. Opposite normals satisfy the
/// equations too, so a position found with h_i · h_j < 0 is an error. Haug, section 9.4. Measure:
/// `angle`, the angle from f_j to f_i.
///
/// Signs: the angle is the rotation of i relative to j, right-handed about h_j. `.zero(f_i, f_j)`
/// sets the zero of the angle, as for [`revolute`](fn@revolute). The last row is positive where P_i
/// is on the side to which h_j points.
#[constraint]
#[require(h_j.norm() > 0.0, "the normal in body j must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "the normals point in opposite directions: h_i · h_j < 0")]
#[measure(angle = i.direction(h_i.f).dot(j.direction(h_j.axis().g)).atan2(i.direction(h_i.f).dot(j.direction(h_j.axis().f))), "rad", turns)]
pub fn planar(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Vec3,
) -> (f64, f64, f64) {
    let h = j.direction(h_j);
    let f = i.direction(h_i.f).dot(h);
    let g = i.direction(h_i.g).dot(h);
    let height = h.dot(i.point(u_i) - j.point(u_j));
    (f, g, height)
}

/// Joins two bodies by a screw: f_j · h_i = g_j · h_i = 0, f_j · d = g_j · d = 0 and φ − 2π h_j ·
/// d/lead = 0 with d = r_Pi − r_Pj. \[–, –, m, m, rad\]
///
/// Removes 5 freedoms. φ is the angle from f_j to f_i about h_j. `u_i` and `u_j` are points of the
/// axis in body i and body j \[m\]. `h_i` and `h_j` are the axis in body i and body j, with f_i
/// along f_j where the points coincide. `lead` is the displacement of i along h_j for one
/// revolution about h_j \[m\]. Kin rotates f_i back by 2π h_j · d/lead and holds the remaining
/// angle at zero. The joint therefore counts full revolutions without a jump. Opposite axes satisfy
/// the equations too, so a position found with h_i · h_j < 0 is an error. If another joint holds
/// the axes in line, use [`thread`](fn@super::thread). Source: Haug, section 9.4. Measures:
/// `angle`, φ; `slide`, h_j · d.
///
/// Signs: the angle is the rotation of i relative to j, right-handed about h_j. The slide grows as
/// i moves along h_j in j. `lead` is positive for a right-hand thread.
#[constraint]
#[require(lead != 0.0, "the lead of the screw must not be zero; for a screw without lead use `revolute`")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
#[measure(angle = i.direction(h_i.f).dot(j.direction(h_j.g)).atan2(i.direction(h_i.f).dot(j.direction(h_j.f))), "rad", turns)]
#[measure(slide = j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j)), "m")]
pub fn screw(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
    lead: f64,
) -> [f64; 5] {
    let f = j.direction(h_j.f);
    let g = j.direction(h_j.g);
    let h = i.direction(h_i.h);
    let d = i.point(u_i) - j.point(u_j);
    let (sin, cos) = (TAU / lead * j.direction(h_j.h).dot(d)).sin_cos();
    let x = f.dot(i.direction(h_i.f));
    let y = g.dot(i.direction(h_i.f));
    [f.dot(h), g.dot(h), f.dot(d), g.dot(d), (y * cos - x * sin).atan2(x * cos + y * sin)]
}

/// Joins two shafts by a constant-velocity joint: r_Pi − r_Pj = 0 (at-point) and f_i · g_j − g_i ·
/// f_j = 0. \[m, –\]
///
/// Removes 4 freedoms. `u_i` and `u_j` are the local positions of the centre P in body i and body j
/// \[m\]. `h_i` and `h_j` are the shafts; where the shafts are in line, h_i equals h_j and f_i
/// equals f_j. The second equation allows i to bend against j about an axis across the shafts,
/// without twist. Both shafts therefore rotate by the same angle at every time. Shafts twisted by
/// 180° satisfy the equation too, so a position found with f_i · f_j + g_i · g_j < 0 is an error.
/// Source: Hunt, *Kinematic Geometry of Mechanisms*.
///
/// Signs: h_i and h_j point in the same direction along the drive line, from one shaft to the
/// other. With these directions both shafts rotate in the same direction.
#[constraint]
#[branch(
    i.direction(h_i.f).dot(j.direction(h_j.f)) + i.direction(h_i.g).dot(j.direction(h_j.g)) > 0.0,
    "the shafts are twisted by 180°: f_i · f_j + g_i · g_j < 0"
)]
pub fn constant_velocity(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
) -> (Vec3, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let twist =
        i.direction(h_i.f).dot(j.direction(h_j.g)) - i.direction(h_i.g).dot(j.direction(h_j.f));
    (point, twist)
}

/// Returns the axis of body i whose f makes the measured angle zero where f_i lies along f_j. The
/// angle in body j is measured from the f that Kin chooses for h_j.
fn zeroed(h_i: Axis, h_j: Vec3, f_i: Vec3, f_j: Vec3) -> Axis {
    let own = Axis::new(h_i.h, f_i);
    let other = Axis::along(h_j);
    let asked = Axis::new(h_j, f_j);
    // An angle measured from f_j is smaller by the angle from the chosen f to f_j.
    Axis::new(h_i.h, own.f * asked.f.dot(other.f) - own.g * asked.f.dot(other.g))
}

/// A joint whose measured angle has a zero that the user can choose.
macro_rules! zero_can_be_chosen {
    ($($joint:ident),*) => {$(
        impl $joint {
            /// Sets the zero of the measured angle: the angle is zero where the direction f_i of
            /// body i is along f_j of body j.
            ///
            /// Kin uses only the parts of f_i and f_j perpendicular to the axis. A second call
            /// replaces the directions of the first call. For global directions of the drawn pose,
            /// use `m.local_direction(body, f)`.
            ///
            /// [`Mechanism::add`](crate::Mechanism::add) returns an error if f_i or f_j lies along
            /// the axis.
            #[must_use]
            pub fn zero(mut self, f_i: impl Into<Vec3>, f_j: impl Into<Vec3>) -> Self {
                self.h_i = zeroed(self.h_i, self.h_j, f_i.into(), f_j.into());
                self
            }
        }
    )*};
}

zero_can_be_chosen!(revolute, cylindrical, planar);
