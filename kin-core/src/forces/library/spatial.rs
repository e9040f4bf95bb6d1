//! Loads of spatial bodies.

use crate::model::coordinates::IntoSpatialBody;
use crate::model::law::Law;
use crate::model::loads::Load;
use crate::numbers::algebra::Vec3;
use kin_macros::{constraint, potential};

/// The distance of two points, |r_Pi − r_Pj|: a length to act along.      \[m\]
///
/// `u_i`, `u_j`: the points. Where they meet it has no slope.
///
/// Signs: none; a force along it pushes the points apart.
#[constraint]
pub fn length(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// A spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)².      \[J\]
///
/// `u_i`, `u_j`: the points; `stiffness`: k, `free`: l0, its length without force. Shabana, *Computational
/// Dynamics*, section 5.2.
///
/// Signs: longer than l0 it pulls the points together.
#[potential]
pub fn spring(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, stiffness: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * stiffness * stretch * stretch
}

/// A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart positive.   \[N s/m\]
pub fn damper(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    damping: f64,
) -> Load {
    Load::along(length(i, j, u_i.into(), u_j.into()), move |_, rate, _| -damping * rate)
}

/// A strut or cylinder between two points whose force is a law of its length: positive pushes the points
/// apart.   \[N\]
pub fn strut(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    force: Law,
) -> Load {
    Load::along(length(i, j, u_i.into(), u_j.into()), move |x, _, _| force.at(x))
}
