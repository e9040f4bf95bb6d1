//! Couplings of turns and slides. The turn of a spatial body is known from its pose up to full turns only: what couples it takes it back by the
//! turn it should have and holds what is left at zero, so that any number of turns is counted and nothing jumps.

use crate::algebra::{Axis, Vec3};
use kin_macros::constraint;

/// A coordinate of its own for the turn of body i in body j: the turn of f_i from f_j about h_j, taken back by φ, is zero.      \[rad\]
///
/// Removes 1 freedom, and brings one of its own, the coordinate `phi`, which counts any number of turns. `h_i`, `h_j`: the common axis in either body,
/// held parallel by another joint; f_i and f_j are where the angle counts from. With it turns can be driven, and coupled by `coupling`.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
pub fn relative_angle(i: Spatial, j: Spatial, phi: Coord, h_i: Axis, h_j: Axis) -> f64 {
    let f = i.direction(h_i.f);
    let (x, y) = (f.dot(j.direction(h_j.f)), f.dot(j.direction(h_j.g)));
    (y * phi.cos() - x * phi.sin()).atan2(x * phi.cos() + y * phi.sin())
}

/// Pair of gears on a frame: z_i φ_i + z_j φ_j − z_i φ0 = 0, up to whole teeth, φ the turns of the wheels in the frame.      \[rad\]
///
/// Removes 1 freedom. `i`, `j`: the wheels, each with its axis `h_i`, `h_j` and the same axis in the frame, `a_i`, `a_j`, held parallel by other joints;
/// f is where a turn counts from. `teeth_i`, `teeth_j`: z, whole numbers, one below zero for a ring with inner teeth; `phase`: φ0, the turn of i when
/// that of j is zero. With axes that point out of the frame alike (from the apex of bevel gears) the wheels turn against each other. A wheel looks the
/// same after a whole turn, so the equation has no jump; which teeth mesh is decided by the first position. For wheels without teeth see
/// [`relative_angle`](fn@relative_angle).
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
    let (f_i, f_j) = (i.direction(h_i.f), j.direction(h_j.f));
    let turn_i = f_i.dot(frame.direction(a_i.g)).atan2(f_i.dot(frame.direction(a_i.f)));
    let turn_j = f_j.dot(frame.direction(a_j.g)).atan2(f_j.dot(frame.direction(a_j.f)));
    let mesh = teeth_i * (turn_i - phase) + teeth_j * turn_j;
    mesh.sin().atan2(mesh.cos())
}

/// Rack and pinion: the turn of the pinion in the rack about h_j, taken back by φ0 − f_j · (r_Pi − r_Pj)/r, is zero.      \[rad\]
///
/// Removes 1 freedom. `i`: the pinion, centre `u_i`, axis `h_i`, pitch radius `radius`: r; `j`: the rack, a point `u_j` of its pitch line and `h_j`, the
/// direction of the pinion's axis with f_j along the rack (`Axis::new(h, f)`); the axes are held parallel by other joints. With the pinion on
/// the side of g_j = h_j × f_j it turns clockwise about h_j as it goes along f_j; a negative radius is for the other side. `phase`: φ0, the turn of f_i
/// from f_j where the centre stands over `u_j`.
#[constraint]
#[require(radius != 0.0, "a pinion needs a radius")]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "its axes are opposite: h_i · h_j < 0")]
pub fn rack_and_pinion(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Axis, radius: f64, phase: f64) -> f64 {
    let (along, f) = (j.direction(h_j.f), i.direction(h_i.f));
    let (sin, cos) = (phase - along.dot(i.point(u_i) - j.point(u_j)) / radius).sin_cos();
    let (x, y) = (f.dot(along), f.dot(j.direction(h_j.g)));
    (y * cos - x * sin).atan2(x * cos + y * sin)
}
