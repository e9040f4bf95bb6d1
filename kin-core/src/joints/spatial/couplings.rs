//! Defines couplings of rotations and displacements.
//!
//! The pose of a spatial body determines its angle only up to full revolutions. A coupling
//! therefore rotates the body back by the angle that the body should have and holds the remaining
//! angle at zero. So a coupling counts full revolutions and never jumps.

use std::f64::consts::TAU;

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// Introduces a coordinate φ for the angle of body i relative to body j: φ_ij − φ = 0, where φ_ij
/// is the angle from f_j to f_i about h_j. \[rad\]
///
/// Removes 1 freedom and adds one coordinate, the angle `phi`, which counts full revolutions. `h_i`
/// and `h_j` are the common axis in body i and body j. Another joint must keep both axes parallel.
/// f_i and f_j are the reference directions of the angle. Use the coordinate to drive a rotation,
/// or to couple the rotation by `coupling`. Source: Haug, section 9.4.
///
/// Signs: φ is the rotation of i relative to j, right-handed about h_j. The angle is zero where f_i
/// is along f_j.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
pub fn relative_angle(i: Spatial, j: Spatial, phi: Coord, h_i: Axis, h_j: Axis) -> f64 {
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    (y * phi.cos() - x * phi.sin()).atan2(x * phi.cos() + y * phi.sin())
}

/// Meshes two gears on a frame by their numbers of teeth: z_i φ_i + z_j φ_j − z_i φ0 = 0, up to
/// whole teeth. \[rad\]
///
/// Removes 1 freedom. φ_i and φ_j are the angles of the wheels relative to the frame. `i` and `j`
/// are the wheels. `h_i` and `h_j` are their axes; `a_i` and `a_j` are the same axes in the frame.
/// Other joints must keep the axes parallel. The direction f of an axis is the reference direction
/// of its angle. `teeth_i` and `teeth_j` are z_i and z_j, whole numbers; for a ring with internal
/// teeth the number is negative. `phase` is φ0, the angle of i when the angle of j is zero \[rad\].
/// The equation has no jump after a full revolution, because a wheel then looks the same. The first
/// position decides which teeth mesh. To use radii instead, use
/// [`gear_by_radii`](fn@gear_by_radii). Source: Norton, *Design of Machinery*, ch. 9.
///
/// Signs: angles are right-handed about a_i and a_j. If both axes point out of the frame (or from
/// the apex of bevel gears), the wheels turn in opposite directions.
#[constraint]
#[require(
    teeth_i != 0.0 && teeth_j != 0.0 && teeth_i.fract() == 0.0 && teeth_j.fract() == 0.0,
    "the numbers of teeth must be whole numbers other than zero"
)]
pub fn gear(
    i: Spatial,
    j: Spatial,
    frame: Spatial,
    h_i: Axis,
    h_j: Axis,
    a_i: Axis,
    a_j: Axis,
    teeth_i: f64,
    teeth_j: f64,
    phase: f64,
) -> f64 {
    let f_i = i.direction(h_i.f);
    let f_j = j.direction(h_j.f);
    let turn_i = f_i.dot(frame.direction(a_i.g)).atan2(f_i.dot(frame.direction(a_i.f)));
    let turn_j = f_j.dot(frame.direction(a_j.g)).atan2(f_j.dot(frame.direction(a_j.f)));
    let mesh = teeth_i * (turn_i - phase) + teeth_j * turn_j;
    mesh.sin().atan2(mesh.cos())
}

/// Meshes a pinion with a rack: φ − φ0 + f_j · (r_Pi − r_Pj)/r = 0, where φ is the angle of the
/// pinion relative to the rack about h_j. \[rad\]
///
/// Removes 1 freedom. `i` is the pinion, `u_i` its centre \[m\], `h_i` its axis and `radius` its
/// pitch radius r \[m\]. `j` is the rack and `u_j` a point of its pitch line \[m\]. `h_j` is the
/// direction of the pinion's axis in the rack, with f_j along the rack (`Axis::new(h, f)`). Other
/// joints must keep the axes parallel. `phase` is φ0, the angle from f_j to f_i where the centre is
/// over `u_j` \[rad\]. Source: Haug, section 3.4, in space.
///
/// Signs: the pinion is on the side of g_j = h_j × f_j; with a negative radius it is on the other
/// side. When the pinion moves along f_j, it turns clockwise about h_j.
#[constraint]
#[require(radius != 0.0, "the radius of the pinion must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
pub fn rack_and_pinion(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
    radius: f64,
    phase: f64,
) -> f64 {
    let along = j.direction(h_j.f);
    let f = i.direction(h_i.f);
    let (sin, cos) = (phase - along.dot(i.point(u_i) - j.point(u_j)) / radius).sin_cos();
    let x = f.dot(along);
    let y = f.dot(j.direction(h_j.g));
    (y * cos - x * sin).atan2(x * cos + y * sin)
}

/// Meshes two gears on a frame by their radii: φ_i − φ0 − s/r_i = 0 and φ_j + s/r_j = 0, where φ is
/// the angle of a wheel relative to the frame. \[rad, rad\]
///
/// Removes 2 freedoms and adds one coordinate, the length `s` that has rolled through the mesh
/// \[m\], so the joint removes 1 freedom in total. `i` and `j` are the wheels. `h_i` and `h_j` are
/// their axes; `a_i` and `a_j` are the same axes in the frame. Other joints must keep the axes
/// parallel. The direction f of an axis is the reference direction of its angle. `r_i` and `r_j`
/// are the pitch radii \[m\]; for a ring with internal teeth the radius is negative. Measure the
/// radii of bevel gears at the same distance from the apex. Friction wheels may have any ratio.
/// `phase` is φ0, the angle of i when the angle of j is zero \[rad\]. `s` counts full revolutions,
/// and you can drive `s`. Source: Norton, *Design of Machinery*, ch. 9.
///
/// Signs: angles are right-handed about a_i and a_j; `s` grows with the angle of i. If both axes
/// point out of the frame (or from the apex of bevel gears), the wheels turn in opposite
/// directions.
#[constraint]
#[require(r_i != 0.0 && r_j != 0.0, "the pitch radii of the wheels must not be zero")]
pub fn gear_by_radii(
    i: Spatial,
    j: Spatial,
    frame: Spatial,
    s: Coord,
    h_i: Axis,
    h_j: Axis,
    a_i: Axis,
    a_j: Axis,
    r_i: f64,
    r_j: f64,
    phase: f64,
) -> [f64; 2] {
    let f_i = i.direction(h_i.f);
    let f_j = j.direction(h_j.f);
    let x_i = f_i.dot(frame.direction(a_i.f));
    let y_i = f_i.dot(frame.direction(a_i.g));
    let x_j = f_j.dot(frame.direction(a_j.f));
    let y_j = f_j.dot(frame.direction(a_j.g));
    let (sin_i, cos_i) = (phase + s / r_i).sin_cos();
    let (sin_j, cos_j) = (-s / r_j).sin_cos();
    [
        (y_i * cos_i - x_i * sin_i).atan2(x_i * cos_i + y_i * sin_i),
        (y_j * cos_j - x_j * sin_j).atan2(x_j * cos_j + y_j * sin_j),
    ]
}

/// Couples the rotation of body i in body j to its displacement, as a thread does: φ − 2π h_j ·
/// (r_Pi − r_Pj)/lead = 0, where φ is the angle from f_j to f_i about h_j. \[rad\]
///
/// Removes 1 freedom. The row turns a cylindrical joint into a [`screw`](fn@super::screw). The row
/// also couples a slide to a shaft that other joints hold. `u_i` and `u_j` are points of the axis
/// in body i and body j \[m\]. `h_i` and `h_j` are the axis in body i and body j, with f_i along
/// f_j where the points coincide. Another joint must keep both axes parallel. `lead` is the
/// displacement of i along h_j for one revolution about h_j \[m\]. The thread counts full
/// revolutions. Source: Haug, section 9.4. The joint that holds the axes measures the angle and the
/// slide.
///
/// Signs: φ is the rotation of i relative to j, right-handed about h_j. The displacement is the
/// displacement of i along h_j in j. `lead` is positive for a right-hand thread.
#[constraint]
#[require(lead != 0.0, "the lead of the thread must not be zero")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
pub fn thread(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Axis,
    h_j: Axis,
    lead: f64,
) -> f64 {
    let (sin, cos) = (TAU / lead * j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j))).sin_cos();
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    (y * cos - x * sin).atan2(x * cos + y * sin)
}
