//! The library of loads: springs, dampers, struts, written with the compiler as joints are.
//!
//! Those of planar bodies and coordinates are here, those of spatial bodies in [`spatial`]. A load acts on
//! both of its bodies, and on the ground where one of them is the ground.

use crate::model::coordinates::{IntoCoordinate, IntoPlanarBody};
use crate::model::law::Law;
use crate::model::loads::Load;
use crate::numbers::algebra::Vec2;
use kin_macros::{constraint, potential};

pub mod spatial;

/// The distance of two points, |r_Pi − r_Pj|: a length to act along.      \[m\]
///
/// `u_i`, `u_j`: the points. Where they meet it has no slope.
///
/// Signs: none; a force along it pushes the points apart.
#[constraint]
pub fn length(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// The turn of body i in body j, θ_i − θ_j: an angle to act along.      \[rad\]
///
/// Signs: a torque along it turns i counter-clockwise, and j the other way.
#[constraint]
pub fn turn(i: Planar, j: Planar) -> f64 {
    i.theta - j.theta
}

/// The coordinate itself, to act along.      \[unit of q\]
///
/// Signs: those of the coordinate.
#[constraint]
pub fn along(q: Coord) -> f64 {
    q
}

/// A spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)².      \[J\]
///
/// `u_i`, `u_j`: the points; `stiffness`: k, `free`: l0, its length without force. Shabana, *Computational
/// Dynamics*, section 5.2.
///
/// Signs: longer than l0 it pulls the points together.
#[potential]
pub fn spring(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, stiffness: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * stiffness * stretch * stretch
}

/// A torsion spring between two bodies: V = ½ k (θ_i − θ_j − θ0)².      \[J\]
///
/// `stiffness`: k, `free`: θ0, the turn of i in j without torque.
///
/// Signs: turned beyond θ0, body i is turned back.
#[potential]
pub fn torsion_spring(i: Planar, j: Planar, stiffness: f64, free: f64) -> f64 {
    let turn = i.theta - j.theta - free;
    0.5 * stiffness * turn * turn
}

/// A spring along a coordinate: V = ½ k (q − q0)².      \[J\]
///
/// `stiffness`: k, `free`: q0.
///
/// Signs: beyond q0 it pulls back.
#[potential]
pub fn coordinate_spring(q: Coord, stiffness: f64, free: f64) -> f64 {
    0.5 * stiffness * (q - free) * (q - free)
}

/// An elastic bushing: V = ½ (k_x d_x² + k_y d_y² + k_θ φ²), d the way from P_j to P_i as body j sees it, φ =
/// θ_i − θ_j − θ0.      \[J\]
///
/// `u_i`, `u_j`: the points; `stiffness`: (k_x, k_y), `torsion`: k_θ, `free`: θ0.
///
/// Signs: it pulls P_i back to P_j and turns i back.
#[potential]
pub fn bushing(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, stiffness: Vec2, torsion: f64, free: f64) -> f64 {
    let d = j.local(i.point(u_i)) - u_j;
    let turn = i.theta - j.theta - free;
    0.5 * (stiffness.x * d.x * d.x + stiffness.y * d.y * d.y + torsion * turn * turn)
}

/// A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart positive.   \[N s/m\]
pub fn damper(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    u_i: impl Into<Vec2>,
    u_j: impl Into<Vec2>,
    damping: f64,
) -> Load {
    Load::along(length(i, j, u_i.into(), u_j.into()), move |_, rate, _| -damping * rate)
}

/// A damper between two bodies that turn: the torque −c (θ̇_i − θ̇_j) on body i.   \[N m s\]
pub fn torsion_damper(i: impl IntoPlanarBody, j: impl IntoPlanarBody, damping: f64) -> Load {
    Load::along(turn(i, j), move |_, rate, _| -damping * rate)
}

/// A force or torque along a coordinate, by a law of time.   \[N, N m\]
pub fn force_along(q: impl IntoCoordinate, force: Law) -> Load {
    Load::along(along(q), move |_, _, t| force.at(t))
}

/// A strut or cylinder between two points whose force is a law of its length, such as a table of pressures
/// times the area of its piston: positive pushes the points apart.   \[N\]
///
/// ```
/// use kin::{Ends, Law, loads};
/// # use kin::prelude::*;
/// # fn main() -> kin::Result<()> {
/// # let mut m = Mechanism::new("engine");
/// # let piston = m.planar("piston", pose(0.3, 0.0, 0.0))?;
/// // by the length of the chamber
/// let pressure = Law::spline(&[(0.10, 2.0e6), (0.15, 1.1e6), (0.20, 0.7e6)], Ends::Natural);
/// let area = 0.004;
/// m.load("gas", loads::strut(piston, m.ground(), vec2(0.0, 0.0), vec2(0.5, 0.0), pressure * area))?;
/// # Ok(())
/// # }
/// ```
pub fn strut(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    u_i: impl Into<Vec2>,
    u_j: impl Into<Vec2>,
    force: Law,
) -> Load {
    Load::along(length(i, j, u_i.into(), u_j.into()), move |x, _, _| force.at(x))
}

/// A gas spring between two points: it pushes them apart with F (a/(a − (l0 − l)))ⁿ, F being its force at the
/// length l0, a the length of its column of gas there, n the exponent of the gas (1 slow, 1.4 fast).   \[N,
/// m\]
pub fn gas_spring(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    [u_i, u_j]: [Vec2; 2],
    force: f64,
    [length_there, column]: [f64; 2],
    exponent: f64,
) -> Load {
    let push = move |l: f64| force * (column / (column - (length_there - l))).powf(exponent);
    Load::along(length(i, j, u_i, u_j), move |l, _, _| push(l))
}
