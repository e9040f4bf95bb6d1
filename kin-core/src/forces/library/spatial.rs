//! Defines the loads of spatial bodies.

use crate::coordinates::IntoSpatialBody;
use crate::law::Law;
use crate::model::loads::{IntoLoad, Load};
use crate::numbers::algebra::{Axis, EulerParameters, Vec3};
use kin_macros::{constraint, potential};

use super::{force_by, viscous};

/// Returns the distance of two points, |r_Pi − r_Pj|, as a length along which a load can act. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. If the points
/// coincide, the distance has no derivative.
///
/// Signs: a positive force along the distance pushes the points apart.
#[constraint]
pub fn length(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// Acts as a spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². \[J\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `stiffness` is
/// k \[N/m\]. `free` is l0, the length without force \[m\]. Shabana, *Computational Dynamics*,
/// section 5.2.
///
/// Signs: a spring longer than l0 pulls the points together.
#[potential]
pub fn spring(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, stiffness: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * stiffness * stretch * stretch
}

/// Returns the displacement of P_i along a direction of body j, h_j · (r_Pi − r_Pj), as a length
/// along which a load can act. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `h_j` is the
/// direction in body j, such as the axis of a cylinder.
///
/// Signs: a positive force along the displacement pushes P_i along h_j and body j in the opposite
/// direction.
#[constraint]
pub fn slide(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis) -> f64 {
    j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j))
}

/// Returns the angle of body i relative to body j about an axis, from f_j to f_i, as an angle along
/// which a load can act. \[rad\]
///
/// `h_i` and `h_j` are the common axis in body i and body j. A joint must keep both axes parallel.
/// The angle is between −π and π. For a spring that turns further, use a separate coordinate
/// (`spatial::relative_angle`).
///
/// Signs: a positive torque along the angle turns i right-handed about h_j, and j in the opposite
/// direction.
#[constraint]
pub fn turn(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis) -> f64 {
    let f = i.direction(h_i.f);
    f.dot(j.direction(h_j.g)).atan2(f.dot(j.direction(h_j.f)))
}

/// Acts as a torsion spring about an axis: V = ½ k (φ − φ0)², where φ is the angle of i relative to
/// j. \[J\]
///
/// `h_i` and `h_j` are the common axis in body i and body j. `stiffness` is k \[N m/rad\]. `free`
/// is φ0 \[rad\]. Kin uses the value of φ − φ0 between −π and π.
///
/// Signs: the spring turns body i back towards the angle φ0.
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

/// Acts as an elastic bushing: V = ½ Σ k d² + 2 Σ κ e², where d is the vector from P_j to P_i in
/// the frame of j and e the rotation of i. \[J\]
///
/// The vector e is the vector part of the Euler parameters of i relative to j; for small rotations
/// 2 e is the rotation vector. `u_i` and `u_j` are the local positions of the points in body i and
/// body j \[m\]. `p_j` are the Euler parameters of i relative to j without torque. `stiffness` is k
/// along the axes of j \[N/m\]. `torsion` is κ about the axes of j \[N m/rad\].
///
/// Signs: the bushing pulls P_i back to P_j and turns i back to the orientation `p_j`.
#[potential]
#[require(p_j.norm() > 0.0, "at least one Euler parameter must differ from zero")]
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

/// Returns a component of a small rotation of body i in body j, 2 e · h_j, as an angle along which
/// a load can act. \[rad\]
///
/// The vector e is the vector part of the Euler parameters of i relative to j. `p_j` are the Euler
/// parameters of i relative to j where the angle is zero. `h_j` is the direction in body j.
///
/// Signs: a positive torque along the angle turns i right-handed about h_j, and j in the opposite
/// direction.
#[constraint]
pub fn small_turn(i: Spatial, j: Spatial, p_j: EulerParameters, h_j: Axis) -> f64 {
    2.0 * j.p.conjugate().product(i.p).product(p_j.normalize().conjugate()).vector().dot(h_j.h)
}

/// Acts as a bushing with damping: the energy of [`bushing`](fn@bushing), and dampers along its
/// displacements and rotations. \[N, N m\]
///
/// `u` contains the local positions of P_i and P_j \[m\]. `p_j` are the Euler parameters of i
/// relative to j without torque. `stiffness` and `damping` contain the values along the axes of
/// body j, then about these axes.
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

/// Acts as a damper between two points: f = −c d|r_Pi − r_Pj|/dt along the line, where a positive
/// force pushes the points apart. \[N\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `damping` is c
/// \[N s/m\].
pub fn damper(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    damping: f64,
) -> Load {
    viscous(length(i, j, u_i.into(), u_j.into()), damping)
}

/// Acts as a strut or cylinder between two points, with a force that is a law of its length. \[N\]
///
/// A positive force pushes the points apart. `u_i` and `u_j` are the local positions of the points
/// in body i and body j \[m\].
pub fn strut(
    i: impl IntoSpatialBody,
    j: impl IntoSpatialBody,
    u_i: impl Into<Vec3>,
    u_j: impl Into<Vec3>,
    force: Law,
) -> Load {
    force_by(length(i, j, u_i.into(), u_j.into()), force)
}
