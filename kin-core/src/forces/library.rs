//! Defines the library of loads: springs, dampers and struts, as compiled functions like the
//! joints.
//!
//! This module contains the loads of planar bodies and coordinates. The module [`spatial`] contains
//! the loads of spatial bodies. A load acts on both of its bodies. If one body is the ground, the
//! load also acts on the ground.

use crate::coordinates::{IntoCoordinate, IntoPlanarBody};
use crate::law::Law;
use crate::model::loads::Load;
use crate::numbers::algebra::Vec2;
use kin_macros::{constraint, force, potential};

pub mod spatial;

/// Returns the distance of two points, |r_Pi − r_Pj|, as a length along which a load can act. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. If the points
/// coincide, the distance has no derivative.
///
/// Signs: a positive force along the distance pushes the points apart.
#[constraint]
pub fn length(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// Returns the angle of body i relative to body j, θ_i − θ_j, as an angle along which a load can
/// act. \[rad\]
///
/// Signs: a positive torque along the angle turns i counter-clockwise and j clockwise.
#[constraint]
pub fn turn(i: Planar, j: Planar) -> f64 {
    i.theta - j.theta
}

/// Returns the displacement of P_i along a direction of body j, h_j · (Aⱼᵀ(r_Pi − r_j) −
/// ū_j)/|h_j|, as a length along which a load can act. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `h_j` is the
/// direction in body j, such as the axis of a cylinder.
///
/// Signs: a positive force along the displacement pushes P_i along h_j and body j in the opposite
/// direction.
#[constraint]
#[require(h_j.norm() > 0.0, "the direction must not be zero")]
pub fn slide(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2) -> f64 {
    h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm()
}

/// Returns the coordinate q itself as a length or angle along which a load can act. \[unit of q\]
///
/// Signs: a positive force or torque increases q.
#[constraint]
pub fn along(q: Coord) -> f64 {
    q
}

/// Acts as a spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². \[J\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `stiffness` is
/// k \[N/m\]. `free` is l0, the length without force \[m\]. Shabana, *Computational Dynamics*,
/// section 5.2.
///
/// Signs: a spring longer than l0 pulls the points together.
#[potential]
pub fn spring(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, stiffness: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * stiffness * stretch * stretch
}

/// Acts as a torsion spring between two bodies: V = ½ k (θ_i − θ_j − θ0)². \[J\]
///
/// `stiffness` is k \[N m/rad\]. `free` is θ0, the angle of i relative to j without torque \[rad\].
///
/// Signs: the spring turns body i back towards the angle θ0.
#[potential]
pub fn torsion_spring(i: Planar, j: Planar, stiffness: f64, free: f64) -> f64 {
    let turn = i.theta - j.theta - free;
    0.5 * stiffness * turn * turn
}

/// Acts as a spring along a coordinate: V = ½ k (q − q0)². \[J\]
///
/// `stiffness` is k \[N/m or N m/rad\]. `free` is q0, the coordinate without force \[unit of q\].
///
/// Signs: the spring pulls the coordinate back towards q0.
#[potential]
pub fn coordinate_spring(q: Coord, stiffness: f64, free: f64) -> f64 {
    0.5 * stiffness * (q - free) * (q - free)
}

/// Acts as an elastic bushing: V = ½ (k_x d_x² + k_y d_y² + k_θ φ²) with φ = θ_i − θ_j − θ0, where
/// d is the vector from P_j to P_i in the frame of j. \[J\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `stiffness` is
/// (k_x, k_y) \[N/m\]. `torsion` is k_θ \[N m/rad\]. `free` is θ0, the angle without torque
/// \[rad\].
///
/// Signs: the bushing pulls P_i back to P_j and turns i back to θ0.
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

/// Acts as a spring and a damper along x: f = −k (x − x0) − c ẋ. \[N, N m\]
///
/// `x` is any length or angle. `stiffness` is k \[N/m or N m/rad\]. `free` is x0, the length or
/// angle without force. `damping` is c \[N s/m or N m s\].
///
/// Signs: the spring pulls x back towards x0, and the damper acts against ẋ.
#[force]
pub fn spring_damper(x: Coord, rate: Rate, stiffness: f64, free: f64, damping: f64) -> f64 {
    -stiffness * (x - free) - damping * rate
}

/// Acts as a damper along x: f = −c ẋ. \[N, N m\]
///
/// `x` is any length or angle. `damping` is c \[N s/m or N m s\].
///
/// Signs: the force acts against ẋ.
#[force]
pub fn viscous(_x: Coord, rate: Rate, damping: f64) -> f64 {
    -damping * rate
}

/// Applies a force that depends on x, such as a measured characteristic: f = F(x). \[N, N m\]
///
/// `x` is any length or angle. `law` is F, a law of x.
///
/// Signs: a positive force increases x.
#[force]
pub fn force_by(x: Coord, law: Law) -> f64 {
    law.at(x)
}

/// Applies a force along x that depends on time: f = F(t). \[N, N m\]
///
/// `x` is any length or angle. `law` is F, a law of t.
///
/// Signs: a positive force increases x.
#[force]
pub fn force_in_time(_x: Coord, t: Time, law: Law) -> f64 {
    law.at(t)
}

/// Applies the pressure in a cylinder along the length of its chamber: f = p(x) A. \[N\]
///
/// `x` is the length of the chamber \[m\]. `table` is p as a law of the length of the chamber, such
/// as `Law::spline` of an indicator diagram \[Pa\]. `area` is the area A of the piston \[m²\].
///
/// Signs: a positive p pushes the chamber to a greater length; p is the pressure above the outside
/// pressure.
#[force]
#[require(area > 0.0, "the area of the piston must be above zero")]
pub fn pressure(x: Coord, table: Law, area: f64) -> f64 {
    table.at(x) * area
}

/// Acts as the gas in a closed chamber along a length x: f = F (a/(a + x − x0))ⁿ. \[N\]
///
/// `push` is F, the force at x0 \[N\]. `there` is x0 \[m\]. `column` is a, the length of the column
/// of gas at x0 \[m\]. `exponent` is n of the gas: 1 for slow, 1.4 for fast changes.
///
/// Signs: a positive F increases x.
#[force]
#[require(column > 0.0, "the length of the column of gas must be above zero")]
pub fn gas(x: Coord, push: f64, there: f64, column: f64, exponent: f64) -> f64 {
    push * (column / (column + x - there)).powf(exponent)
}

/// Acts as a damper between two points: f = −c d|r_Pi − r_Pj|/dt along the line, where a positive
/// force pushes the points apart. \[N\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `damping` is c
/// \[N s/m\].
pub fn damper(
    i: impl IntoPlanarBody,
    j: impl IntoPlanarBody,
    u_i: impl Into<Vec2>,
    u_j: impl Into<Vec2>,
    damping: f64,
) -> Load {
    viscous(length(i, j, u_i.into(), u_j.into()), damping)
}

/// Acts as a damper between two bodies that rotate: the torque on body i is −c (θ̇_i − θ̇_j). \[N
/// m\]
///
/// `damping` is c \[N m s\].
pub fn torsion_damper(i: impl IntoPlanarBody, j: impl IntoPlanarBody, damping: f64) -> Load {
    viscous(turn(i, j), damping)
}

/// Acts as a bushing with damping: the energy of [`bushing`](fn@bushing) and the forces −c_x ḋ_x,
/// −c_y ḋ_y, −c_θ φ̇. \[N, N m\]
///
/// `u` contains the local positions of P_i and P_j \[m\]. `stiffness` and `damping` contain the
/// values along x and y of body j, and about z. `free` is θ0, the angle without torque \[rad\].
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

/// Applies a force or torque along a coordinate by a law of time. \[N, N m\]
///
/// `q` is the coordinate and `force` is the law of time. A positive force increases q.
pub fn force_along(q: impl IntoCoordinate, force: Law) -> Load {
    force_in_time(along(q), force)
}

/// Acts as a strut or cylinder between two points, with a force that is a law of its length. \[N\]
///
/// A positive force pushes the points apart. The law can be a table of pressures times the area of
/// the piston. `u_i` and `u_j` are the local positions of the points in body i and body j \[m\].
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

/// Acts as a gas spring between two points, which pushes the points apart with the force F (a/(a −
/// (l0 − l)))ⁿ. \[N\]
///
/// The distance of the points is l \[m\], and F is the force at the length l0 \[N\]. The column of
/// gas has the length a at l0 \[m\]. The exponent n of the gas is 1 for slow and 1.4 for fast
/// changes.
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
