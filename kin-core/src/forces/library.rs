//! The library of loads: springs, dampers, struts, written with the compiler as joints are.
//!
//! Those of planar bodies and coordinates are here, those of spatial bodies in [`spatial`]. A load
//! acts on both of its bodies, and on the ground where one of them is the ground.

use crate::model::coordinates::{IntoCoordinate, IntoPlanarBody};
use crate::model::law::Law;
use crate::model::loads::Load;
use crate::numbers::algebra::Vec2;
use kin_macros::{constraint, force, potential};

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

/// How far P_i is along a direction of body j: h_j · (Aⱼᵀ(r_Pi − r_j) − ū_j)/|h_j|, a length to act
/// along. \[m\]
///
/// `u_i`, `u_j`: the points; `h_j`: the direction in body j, such as the axis of a cylinder.
///
/// Signs: a force along it pushes P_i along h_j, and j the other way.
#[constraint]
#[require(h_j.norm() > 0.0, "the direction needs a length above zero")]
pub fn slide(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2) -> f64 {
    h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm()
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
/// `u_i`, `u_j`: the points; `stiffness`: k, `free`: l0, its length without force. Shabana,
/// *Computational Dynamics*, section 5.2.
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

/// An elastic bushing: V = ½ (k_x d_x² + k_y d_y² + k_θ φ²), d the way from P_j to P_i as body j
/// sees it, φ = θ_i − θ_j − θ0.   \[J\]
///
/// `u_i`, `u_j`: the points; `stiffness`: (k_x, k_y), `torsion`: k_θ, `free`: θ0.
///
/// Signs: it pulls P_i back to P_j and turns i back.
#[potential]
pub fn bushing(
    i: Planar,
    j: Planar,
    u_i: Vec2,
    u_j: Vec2,
    stiffness: Vec2,
    torsion: f64,
    free: f64,
) -> f64 {
    let d = j.local(i.point(u_i)) - u_j;
    let turn = i.theta - j.theta - free;
    0.5 * (stiffness.x * d.x * d.x + stiffness.y * d.y * d.y + torsion * turn * turn)
}

/// A spring and a damper along x: f = −k (x − x0) − c ẋ.      \[N, N m\]
///
/// `x`: any length or angle; `stiffness`: k, `free`: x0, `damping`: c.
///
/// Signs: beyond x0 it pulls back.
#[force]
pub fn spring_damper(x: Coord, rate: Rate, stiffness: f64, free: f64, damping: f64) -> f64 {
    -stiffness * (x - free) - damping * rate
}

/// A damper along x: f = −c ẋ.      \[N, N m\]
///
/// `x`: any length or angle; `damping`: c.
///
/// Signs: against ẋ.
#[force]
pub fn viscous(_x: Coord, rate: Rate, damping: f64) -> f64 {
    -damping * rate
}

/// A force by x, such as a measured characteristic: f = F(x).      \[N, N m\]
///
/// `x`: any length or angle; `law`: F, a law of x.
///
/// Signs: positive pushes the way x grows.
#[force]
pub fn force_by(x: Coord, law: Law) -> f64 {
    law.at(x)
}

/// A force by time along x: f = F(t).      \[N, N m\]
///
/// `x`: any length or angle; `law`: F, a law of t.
///
/// Signs: positive pushes the way x grows.
#[force]
pub fn force_in_time(_x: Coord, t: Time, law: Law) -> f64 {
    law.at(t)
}

/// Pressure in a cylinder along the length of its chamber: f = p(x) A.      \[N\]
///
/// `x`: the length of the chamber; `table`: p by that length, such as `Law::spline` of an indicator
/// diagram \[Pa\]; `area`: A of the piston \[m²\].
///
/// Signs: pressure above that outside makes the chamber longer.
#[force]
#[require(area > 0.0, "the area of a piston is above zero")]
pub fn pressure(x: Coord, table: Law, area: f64) -> f64 {
    table.at(x) * area
}

/// The gas in a closed chamber along a length x: f = F (a/(a + x − x0))ⁿ.      \[N\]
///
/// `push`: F, its force at x0 = `there`; `column`: a, the length of the column of gas there;
/// `exponent`: n of the gas, 1 slow, 1.4 fast.
///
/// Signs: F above zero makes x longer.
#[force]
#[require(column > 0.0, "the column of gas has a length above zero")]
pub fn gas(x: Coord, push: f64, there: f64, column: f64, exponent: f64) -> f64 {
    push * (column / (column + x - there)).powf(exponent)
}

/// A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart
/// positive.   \[N s/m\]
pub fn damper(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    u_i: impl Into<Vec2>,
    u_j: impl Into<Vec2>,
    damping: f64,
) -> Load {
    viscous(length(i, j, u_i.into(), u_j.into()), damping)
}

/// A damper between two bodies that turn: the torque −c (θ̇_i − θ̇_j) on body i.   \[N m s\]
pub fn torsion_damper(i: impl IntoPlanarBody, j: impl IntoPlanarBody, damping: f64) -> Load {
    viscous(turn(i, j), damping)
}

/// A bushing with damping: the energy of [`bushing`](fn@bushing), and −c_x ḋ_x, −c_y ḋ_y, −c_θ φ̇
/// along the same way and turn.   \[N, N m\]
///
/// `u`: P_i and P_j; `stiffness`, `damping`: along x and y of body j and about z; `free`: θ0.
pub fn damped_bushing(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    u: [Vec2; 2],
    stiffness: [f64; 3],
    damping: [f64; 3],
    free: f64,
) -> Load {
    let i = i.into_planar_body();
    let j = j.into_planar_body();
    let [u_i, u_j] = u;
    let along = |h: Vec2| slide(i, j, u_i, u_j, h);
    let [k_x, k_y, k_turn] = stiffness;
    viscous(along(Vec2::new(1.0, 0.0)), damping[0])
        .and(viscous(along(Vec2::new(0.0, 1.0)), damping[1]))
        .and(viscous(turn(i, j), damping[2]))
        .and(bushing(i, j, u_i, u_j, Vec2::new(k_x, k_y), k_turn, free))
}

/// A force or torque along a coordinate, by a law of time.   \[N, N m\]
pub fn force_along(q: impl IntoCoordinate, force: Law) -> Load {
    force_in_time(along(q), force)
}

/// A strut or cylinder between two points whose force is a law of its length, such as a table of
/// pressures times the area of its piston: positive pushes the points apart.   \[N\]
///
/// ```
/// use kin::law::Ends;
/// use kin::{Law, loads};
/// # use kin::prelude::*;
/// # fn main() -> kin::Result<()> {
/// # let mut m = Mechanism::new("engine");
/// # let piston = m.planar("piston", pose(0.3, 0.0, 0.0))?;
/// // by the length of the chamber
/// let pressure = Law::spline(&[(0.10, 2.0e6), (0.15, 1.1e6), (0.20, 0.7e6)], Ends::Natural);
/// let area = 0.004;
/// let (on_piston, on_ground) = (vec2(0.0, 0.0), vec2(0.5, 0.0));
/// m.load("gas", loads::strut(piston, m.ground(), on_piston, on_ground, pressure * area))?;
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
    force_by(length(i, j, u_i.into(), u_j.into()), force)
}

/// A gas spring between two points: it pushes them apart with F (a/(a − (l0 − l)))ⁿ, F being its
/// force at the length l0, a the length of its column of gas there, n the exponent of the gas (1
/// slow, 1.4 fast).   \[N, m\]
pub fn gas_spring(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    [u_i, u_j]: [Vec2; 2],
    force: f64,
    [length_there, column]: [f64; 2],
    exponent: f64,
) -> Load {
    gas(length(i, j, u_i, u_j), force, length_there, column, exponent)
}
