//! Joints whose parts touch in surfaces, and those that do the same by a cross or by balls.

use std::f64::consts::TAU;

use crate::numbers::algebra::{Axis, EulerParameters, Vec3};
use kin_macros::constraint;

/// A body that does not move: R − r = 0 and the vector part of p0* p is zero.      \[m, –\]
///
/// Removes 6 freedoms. `r`: position; `p0`: Euler parameters. There is no second solution: a turn
/// by 180° has a vector part of length 1. Nikravesh, *Computer-Aided Analysis of Mechanical
/// Systems*, section 7.2.
///
/// Signs: `p0` turns the global frame into the body's; p0 and −p0 are one turn.
#[constraint]
#[require(p0.norm() > 0.0, "Euler parameters are not all zero")]
pub fn fixed(j: Spatial, r: Vec3, p0: EulerParameters) -> (Vec3, Vec3) {
    let point = j.r - r;
    let turn = p0.conjugate().product(j.p).vector();
    (point, turn)
}

/// Rigid connection: r_Pi − r_Pj = 0 and the vector part of p_ij* p_j* p_i is zero.      \[m, –\]
///
/// Removes 6 freedoms. `u_i`, `u_j`: local position of P in either body; `p_ij`: Euler parameters
/// of body i as body j sees it. There is no second solution: a turn by 180° has a vector part of
/// length 1. Nikravesh, *Computer-Aided Analysis of Mechanical Systems*, section 7.2.
///
/// Signs: `p_ij` turns the frame of j into that of i.
#[constraint]
#[require(p_ij.norm() > 0.0, "Euler parameters are not all zero")]
pub fn weld(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, p_ij: EulerParameters) -> (Vec3, Vec3) {
    let point = i.point(u_i) - j.point(u_j);
    let turn = p_ij.conjugate().product(j.p.conjugate().product(i.p)).vector();
    (point, turn)
}

/// Hinge: r_Pi − r_Pj = 0 (at-point) and f_i · h_j = g_i · h_j = 0 (two dot-1).      \[m, –, –\]
///
/// Removes 5 freedoms. `u_i`, `u_j`: local position of P on the axis; `h_i`, `h_j`: the axis in
/// either body. The equations hold for opposite axes too; a position found with h_i · h_j < 0 is an
/// error. Haug, section 9.4. Measure: `angle`, the turn of f_i from f_j.
///
/// Signs: the angle is the turn of i in j, right-handed about h_j. Where it is zero is chosen by
/// `.zero(f_i, f_j)`: where f_i of body i lies along f_j of body j; unchosen these are the f that
/// [`Axis::along`] gives h_i and h_j (x for z, y for x, z for y).
#[constraint]
#[require(h_j.norm() > 0.0, "the axis in body j needs a length above zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
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

/// Sliding joint: the vector part of p_ij* p_j* p_i is zero, and f_i · d = g_i · d = 0 (two dot-2)
/// with d = r_Pi − r_Pj.   \[–, m, m\]
///
/// Removes 5 freedoms. `u_i`, `u_j`: points on the slide; `h_i`: its direction in body i; `p_ij`:
/// Euler parameters of body i as body j sees it. There is no second solution. Haug, section 9.4.
/// Measure: `slide`, h_i · d.
///
/// Signs: the slide grows as i moves along h_i in j; `p_ij` turns the frame of j into that of i.
#[constraint]
#[require(p_ij.norm() > 0.0, "Euler parameters are not all zero")]
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

/// Cylindrical joint: f_i · h_j = g_i · h_j = 0 (two dot-1) and f_i · d = g_i · d = 0 (two dot-2)
/// with d = r_Pi − r_Pj.   \[–, –, m, m\]
///
/// Removes 4 freedoms. `u_i`, `u_j`: points on the axis; `h_i`, `h_j`: the axis in either body.
/// These are h_i × h_j = 0 and h_i × d = 0 of the lecture ("Cylindrical Joint Constraint") in the
/// two directions across h_i, which keep full rank at every pose. The equations hold for opposite
/// axes too; a position found with h_i · h_j < 0 is an error. Measures: `angle`, the turn of f_i
/// from f_j; `slide`, h_j · d.
///
/// Signs: the angle is the turn of i in j, right-handed about h_j, its zero chosen as of
/// [`revolute`](fn@revolute). The slide grows as i moves along h_j in j.
#[constraint]
#[require(h_j.norm() > 0.0, "the axis in body j needs a length above zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
#[measure(angle = i.direction(h_i.f).dot(j.direction(h_j.axis().g)).atan2(i.direction(h_i.f).dot(j.direction(h_j.axis().f))), "rad", turns)]
#[measure(slide = j.direction(h_j).dot(i.point(u_i) - j.point(u_j)) / h_j.norm(), "m")]
pub fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3) -> [f64; 4] {
    let f = i.direction(h_i.f);
    let g = i.direction(h_i.g);
    let h = j.direction(h_j);
    let d = i.point(u_i) - j.point(u_j);
    [f.dot(h), g.dot(h), f.dot(d), g.dot(d)]
}

/// Universal joint: r_Pi − r_Pj = 0 (at-point) and h_i · h_j = 0 (dot-1).      \[m, –\]
///
/// Removes 4 freedoms. `u_i`, `u_j`: the centre P of the cross; `h_i`, `h_j`: the bars of the
/// cross, each in the body that it turns in; their lengths scale the row. Lecture, "Universal Joint
/// Constraint". Measures: `angle_j`, the turn of the cross in body j about h_j; `angle_i`, the turn
/// of body i on the cross about h_i.
///
/// Signs: both angles are right-handed about their bars, and zero where both frames have the same
/// directions: body i is turned by `angle_i` about its bar, and then with the cross by `angle_j`
/// about that of j. Bars that are not perpendicular as they are written: see [`Vec3::axis_near`].
#[constraint]
#[require(h_i.norm() > 0.0 && h_j.norm() > 0.0, "a bar of the cross needs a length above zero")]
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

/// Planar joint: f_i · h_j = g_i · h_j = 0 (two dot-1) and h_j · (r_Pi − r_Pj) = 0 (dot-2).   \[–,
/// –, m\]
///
/// Removes 3 freedoms. `u_i`, `u_j`: points of the common plane; `h_i`, `h_j`: its normal in either
/// body. The equations hold for opposite normals too; a position found with h_i · h_j < 0 is an
/// error. Haug, section 9.4. Measure: `angle`, the turn of f_i from f_j.
///
/// Signs: the angle is the turn of i in j, right-handed about h_j, its zero chosen as of
/// [`revolute`](fn@revolute). The last row is positive where P_i is on the side to which h_j
/// points.
#[constraint]
#[require(h_j.norm() > 0.0, "the normal in body j needs a length above zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j)) > 0.0, "its normals are opposite: h_i · h_j < 0")]
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

/// Screw: f_j · h_i = g_j · h_i = 0, f_j · d = g_j · d = 0 with d = r_Pi − r_Pj, and body i turns
/// by 2π h_j · d / lead.   \[–, –, m, m, rad\]
///
/// Removes 5 freedoms. `u_i`, `u_j`: points on the axis; `h_i`, `h_j`: the axis in either body,
/// with f_i over f_j where the points meet; `lead`: way of i along h_j per turn about h_j. The turn
/// of f_i is taken back by 2π h_j · d / lead and what is left is zero, so that any number of turns
/// is counted without a jump. The equations hold for opposite axes too; a position found with h_i ·
/// h_j < 0 is an error. Where another joint holds the axes in line: [`thread`](fn@super::thread).
/// Haug, section 9.4. Measures: `angle`, the turn of f_i from f_j; `slide`, h_j · d.
///
/// Signs: the angle is the turn of i in j, right-handed about h_j; the slide grows as i moves along
/// h_j in j; `lead` is above zero for a right-hand thread.
#[constraint]
#[require(lead != 0.0, "a screw needs a lead; without one it is a `revolute`")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
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

/// Constant-velocity joint: r_Pi − r_Pj = 0 (at-point) and f_i · g_j − g_i · f_j = 0.      \[m, –\]
///
/// Removes 4 freedoms. `u_i`, `u_j`: the centre P; `h_i`, `h_j`: the shafts, with the same
/// direction where they are in line, f_i over f_j. The second equation says that i is bent against
/// j about an axis across the shafts, without twist: both turn by the same angle at every moment.
/// It holds for shafts twisted by 180° too; a position found with f_i · f_j + g_i · g_j < 0 is an
/// error. Hunt, *Kinematic Geometry of Mechanisms*.
///
/// Signs: h_i and h_j point the same way along the drive line, from one shaft to the other; then
/// both turn the same way about them.
#[constraint]
#[branch(
    i.direction(h_i.f).dot(j.direction(h_j.f)) + i.direction(h_i.g).dot(j.direction(h_j.g)) > 0.0,
    "its shafts are twisted by 180°: f_i · f_j + g_i · g_j < 0"
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

/// The axis of body i with that f from which the angle in body j, measured from the f of Kin's
/// choice, is zero where f_i lies along f_j.
fn zeroed(h_i: Axis, h_j: Vec3, f_i: Vec3, f_j: Vec3) -> Axis {
    let own = Axis::new(h_i.h, f_i);
    let other = Axis::along(h_j);
    let asked = Axis::new(h_j, f_j);
    // An angle measured from f_j is less by the turn of f_j itself.
    Axis::new(h_i.h, own.f * asked.f.dot(other.f) - own.g * asked.f.dot(other.g))
}

/// A joint whose angle has a zero to be chosen.
macro_rules! zero_can_be_chosen {
    ($($joint:ident),*) => {$(
        impl $joint {
            /// The same joint with the zero of its measured angle where the direction f_i of body i
            /// lies along f_j of body j; of both only what is across the axis counts. An f that
            /// `h_i` has is replaced, so that the last zero counts. Global directions as drawn:
            /// `m.local_direction(body, f)`.
            ///
            /// A direction along the axis is refused where the joint is added.
            #[must_use]
            pub fn zero(mut self, f_i: impl Into<Vec3>, f_j: impl Into<Vec3>) -> Self {
                self.h_i = zeroed(self.h_i, self.h_j, f_i.into(), f_j.into());
                self
            }
        }
    )*};
}

zero_can_be_chosen!(revolute, cylindrical, planar);
