//! Loads of spatial bodies.

use crate::model::coordinates::IntoSpatialBody;
use crate::model::law::Law;
use crate::model::loads::{IntoLoad, Load};
use crate::numbers::algebra::{Axis, EulerParameters, Vec3};
use kin_macros::{constraint, potential};

use super::{force_by, viscous};

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
/// `u_i`, `u_j`: the points; `stiffness`: k, `free`: l0, its length without force. Shabana,
/// *Computational Dynamics*, section 5.2.
///
/// Signs: longer than l0 it pulls the points together.
#[potential]
pub fn spring(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, stiffness: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * stiffness * stretch * stretch
}

/// How far P_i is along a direction of body j: h_j · (r_Pi − r_Pj), a length to act along.   \[m\]
///
/// `u_i`, `u_j`: the points; `h_j`: the direction in body j, such as the axis of a cylinder.
///
/// Signs: a force along it pushes P_i along h_j, and j the other way.
#[constraint]
pub fn slide(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis) -> f64 {
    j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j))
}

/// The turn of body i in body j about an axis, from f_j to f_i: an angle to act along.      \[rad\]
///
/// `h_i`, `h_j`: the common axis in either body, held parallel by a joint. Between −π and π: a
/// spring that is wound further belongs on a separate coordinate (`spatial::relative_angle`).
///
/// Signs: a torque along it turns i right-handed about h_j, and j the other way.
#[constraint]
pub fn turn(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis) -> f64 {
    let f = i.direction(h_i.f);
    f.dot(j.direction(h_j.g)).atan2(f.dot(j.direction(h_j.f)))
}

/// A torsion spring about an axis: V = ½ k (φ − φ0)², φ the turn of i in j.      \[J\]
///
/// `h_i`, `h_j`: the common axis in either body; `stiffness`: k, `free`: φ0. It is wound by π at
/// most to either side.
///
/// Signs: turned beyond φ0, body i is turned back.
#[potential]
pub fn torsion_spring(
    i: Spatial,
    j: Spatial,
    h_i: Axis,
    h_j: Axis,
    stiffness: f64,
    free: f64,
) -> f64 {
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    let (sin, cos) = free.sin_cos();
    let turn = (y * cos - x * sin).atan2(x * cos + y * sin);
    0.5 * stiffness * turn * turn
}

/// An elastic bushing: V = ½ Σ k d² + 2 Σ κ e², d the way from P_j to P_i as body j sees it, e the
/// vector part of the Euler parameters of i in j; for small turns 2 e is the turn.   \[J\]
///
/// `u_i`, `u_j`: the points; `p_j`: the Euler parameters of i in j without torque; `stiffness`: k
/// along the axes of j \[N/m\], `torsion`: κ about them \[N m/rad\].
///
/// Signs: it pulls P_i back to P_j and turns i back.
#[potential]
#[require(p_j.norm() > 0.0, "Euler parameters are not all zero")]
pub fn bushing(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    p_j: EulerParameters,
    stiffness: Vec3,
    torsion: Vec3,
) -> f64 {
    let d = j.local(i.point(u_i)) - u_j;
    let e = j.p.conjugate().product(i.p).product(p_j.normalize().conjugate()).vector();
    let pulled = stiffness.x * d.x * d.x + stiffness.y * d.y * d.y + stiffness.z * d.z * d.z;
    let turned = torsion.x * e.x * e.x + torsion.y * e.y * e.y + torsion.z * e.z * e.z;
    0.5 * pulled + 2.0 * turned
}

/// A component of the turn of body i in body j: 2 e · h_j, an angle to act along where it is
/// small.      \[rad\]
///
/// `p_j`: the Euler parameters of i in j where it is zero, `h_j`: the direction in body j.
///
/// Signs: a torque along it turns i right-handed about h_j, and j the other way.
#[constraint]
pub fn small_turn(i: Spatial, j: Spatial, p_j: EulerParameters, h_j: Axis) -> f64 {
    2.0 * j.p.conjugate().product(i.p).product(p_j.normalize().conjugate()).vector().dot(h_j.h)
}

/// A bushing with damping: the energy of [`bushing`](fn@bushing), and dampers along its way and its
/// turns. \[N, N m\]
///
/// `u`: P_i and P_j; `p_j`: the Euler parameters of i in j without torque; `stiffness`, `damping`:
/// along the axes of body j, then about them.
pub fn damped_bushing(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u: [Vec3; 2],
    p_j: EulerParameters,
    stiffness: [Vec3; 2],
    damping: [Vec3; 2],
) -> Load {
    let i = i.into_spatial_body();
    let j = j.into_spatial_body();
    let [u_i, u_j] = u;
    let elastic = bushing(i, j, u_i, u_j, p_j, stiffness[0], stiffness[1]);
    let axes = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
    let [along, about] = damping.map(Vec3::to_array);
    axes.into_iter().zip(along.into_iter().zip(about)).fold(
        elastic.into_load(),
        |load, (axis, (c, turned))| {
            load.and(viscous(slide(i, j, u_i, u_j, axis), c))
                .and(viscous(small_turn(i, j, p_j, axis), turned))
        },
    )
}

/// A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart
/// positive.   \[N s/m\]
pub fn damper(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    damping: f64,
) -> Load {
    viscous(length(i, j, u_i.into(), u_j.into()), damping)
}

/// A strut or cylinder between two points whose force is a law of its length: positive pushes the
/// points apart.   \[N\]
pub fn strut(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    force: Law,
) -> Load {
    force_by(length(i, j, u_i.into(), u_j.into()), force)
}
