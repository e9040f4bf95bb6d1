//! Couplings of turns and slides. The turn of a spatial body is known from its pose up to full
//! turns only: what couples it takes it back by the turn it should have and holds what is left at
//! zero, so that any number of turns is counted and nothing jumps.

use std::f64::consts::TAU;

use crate::numbers::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// A separate coordinate for the turn of body i in body j: the turn of f_i from f_j about h_j,
/// taken back by φ, is zero.   \[rad\]
///
/// Removes 1 freedom and adds one, the coordinate `phi`, which counts any number of turns. `h_i`,
/// `h_j`: the common axis in either body, held parallel by another joint; f_i and f_j are where the
/// angle counts from. With it turns can be driven, and coupled by `coupling`. Haug, section 9.4.
///
/// Signs: φ is the turn of i in j, right-handed about h_j, zero where f_i lies along f_j.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
pub fn relative_angle(i: Spatial, j: Spatial, phi: Coord, h_i: Axis, h_j: Axis) -> f64 {
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    (y * phi.cos() - x * phi.sin()).atan2(x * phi.cos() + y * phi.sin())
}

/// Pair of gears on a frame: z_i φ_i + z_j φ_j − z_i φ0 = 0, up to whole teeth, φ the turns of the
/// wheels in the frame.   \[rad\]
///
/// Removes 1 freedom. `i`, `j`: the wheels, each with its axis `h_i`, `h_j` and the same axis in
/// the frame, `a_i`, `a_j`, held parallel by other joints; f is where a turn counts from.
/// `teeth_i`, `teeth_j`: z, whole numbers, one below zero for a ring with inner teeth; `phase`: φ0,
/// the turn of i when that of j is zero. A wheel looks the same after a whole turn, so the equation
/// has no jump; which teeth mesh is decided by the first position. By radii:
/// [`gear_by_radii`](fn@gear_by_radii). Norton, *Design of Machinery*, ch. 9.
///
/// Signs: turns are right-handed about a_i and a_j. With axes that point out of the frame alike
/// (from the apex of bevel gears) the wheels turn against each other.
#[constraint]
#[require(
    teeth_i != 0.0 && teeth_j != 0.0 && teeth_i.fract() == 0.0 && teeth_j.fract() == 0.0,
    "numbers of teeth are whole numbers, and not zero"
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

/// Rack and pinion: the turn of the pinion in the rack about h_j, taken back by φ0 − f_j · (r_Pi −
/// r_Pj)/r, is zero.   \[rad\]
///
/// Removes 1 freedom. `i`: the pinion, centre `u_i`, axis `h_i`, pitch radius `radius`: r; `j`: the
/// rack, a point `u_j` of its pitch line and `h_j`, the direction of the pinion's axis with f_j
/// along the rack (`Axis::new(h, f)`); the axes are held parallel by other joints. `phase`: φ0, the
/// turn of f_i from f_j where the centre stands over `u_j`. Haug, section 3.4, in space.
///
/// Signs: the pinion is on the side of g_j = h_j × f_j (a negative radius: on the other) and turns
/// clockwise about h_j as it goes along f_j.
#[constraint]
#[require(radius != 0.0, "a pinion needs a radius")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
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

/// Pair of gears on a frame by their radii: the turns of the wheels in the frame, taken back by
/// φ0 + s/r_i and by −s/r_j, are zero.   \[rad, rad\]
///
/// Removes 2 freedoms and adds one, the length `s` that has rolled through the mesh: 1 in all. `i`,
/// `j`: the wheels, each with its axis `h_i`, `h_j` and the same axis in the frame, `a_i`, `a_j`,
/// held parallel by other joints; f is where a turn counts from. `r_i`, `r_j`: pitch radii (of
/// bevel gears at the same distance from the apex, of friction wheels of any ratio), one below zero
/// for a ring with inner teeth; `phase`: φ0, the turn of i when that of j is zero. `s` counts any
/// number of turns, and can be driven. Norton, *Design of Machinery*, ch. 9.
///
/// Signs: turns are right-handed about a_i and a_j; `s` grows with the turn of i. With axes that
/// point out of the frame alike (from the apex of bevel gears) the wheels turn against each other.
#[constraint]
#[require(r_i != 0.0 && r_j != 0.0, "a wheel needs a pitch radius")]
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

/// Thread: the turn of f_i from f_j about h_j, taken back by 2π h_j · (r_Pi − r_Pj)/lead, is
/// zero.   \[rad\]
///
/// Removes 1 freedom: the one row that makes a [`screw`](fn@super::screw) of a cylindrical joint,
/// or of a slide and a shaft that other joints hold. `u_i`, `u_j`: points on the axis; `h_i`,
/// `h_j`: the axis in either body, held parallel by another joint, with f_i over f_j where the
/// points meet; `lead`: way of i along h_j per turn about h_j. Any number of turns is counted.
/// Haug, section 9.4. Angle and slide are measures of the joint that holds the axes.
///
/// Signs: the turn is that of i in j, right-handed about h_j, the way is that of i along h_j in j;
/// `lead` is above zero for a right-hand thread.
#[constraint]
#[require(lead != 0.0, "a thread needs a lead")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
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
