//! Defines the drivers of spatial bodies.

use crate::law::Law;
use crate::numbers::algebra::{Axis, EulerParameters, Vec3, vec3};
use kin_macros::constraint;

/// Makes the angle of body i relative to body j follow a law of time: φ − f(t) = 0, where φ is the
/// angle from f_j to f_i about h_j. \[rad\]
///
/// `h_i` and `h_j` are the common axis in body i and body j. A joint must keep both axes parallel.
/// f_i and f_j are the reference directions of the angle. `law` is f \[rad\]. Kin rotates f_i back
/// by the law and holds the remaining angle at zero, so the law can count full revolutions. Source:
/// Haug, section 9.5.
///
/// Signs: the angle is the rotation of i relative to j, right-handed about h_j. The angle is zero
/// where f_i is along f_j.
#[constraint]
#[branch(i.direction(h_i.h).dot(j.direction(h_j.h)) > 0.0, "the axes point in opposite directions: h_i · h_j < 0")]
pub fn drive_turn(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis, law: Law, t: Time) -> f64 {
    let f = i.direction(h_i.f);
    let x = f.dot(j.direction(h_j.f));
    let y = f.dot(j.direction(h_j.g));
    let (sin, cos) = law.at(t).sin_cos();
    (y * cos - x * sin).atan2(x * cos + y * sin)
}

/// Makes a displacement along an axis of body j follow a law of time: h_j · (r_Pi − r_Pj) − f(t) =
/// 0. \[m\]
///
/// `u_i` is the local position of P_i in body i \[m\]. `u_j` is the point P_j of body j where the
/// displacement is zero \[m\]. `h_j` is the direction of the axis in body j. `law` is f \[m\]. Use
/// this driver for a cylinder or a linear motor. Source: Haug, section 9.5.
///
/// Signs: the displacement grows as P_i moves along h_j in j.
#[constraint]
pub fn drive_slide(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_j: Axis,
    law: Law,
    t: Time,
) -> f64 {
    j.direction(h_j.h).dot(i.point(u_i) - j.point(u_j)) - law.at(t)
}

/// Makes the distance of two points follow a law of time: |r_Pi − r_Pj| − f(t) = 0. \[m\]
///
/// `u_i` and `u_j` are the local positions of the points in body i and body j \[m\]. `law` is f
/// \[m\]. The law must remain positive, because the distance has no derivative where the points
/// coincide. Use this driver for a leg of a Stewart platform. Source: Haug, section 9.5.
///
/// Signs: the distance is always positive.
#[constraint]
pub fn drive_distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, law: Law, t: Time) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - law.at(t)
}

/// Makes a point of a body follow a path: r_P − (f1(t), f2(t), f3(t)) = 0. \[m\]
///
/// `u` is the local position of P \[m\]. `path_x`, `path_y` and `path_z` are f1, f2 and f3 \[m\].
/// Source: lecture notes, "Driving Constraints".
///
/// Signs: the laws give global coordinates.
#[constraint]
pub fn drive_point(body: Spatial, u: Vec3, path_x: Law, path_y: Law, path_z: Law, t: Time) -> Vec3 {
    body.point(u) - vec3(path_x.at(t), path_y.at(t), path_z.at(t))
}

/// Makes one coordinate of a point follow a law of time: n · r_P − f(t) = 0. \[m\]
///
/// `u` is the local position of P \[m\]. `n` is the global direction of the coordinate. `law` is f
/// \[m\]. Source: Haug, section 9.5.
///
/// Signs: the coordinate grows along `n`, from the global origin.
#[constraint]
pub fn drive_point_along(body: Spatial, u: Vec3, n: Axis, law: Law, t: Time) -> f64 {
    n.h.dot(body.point(u)) - law.at(t)
}

/// Makes body i rotate relative to body j about an axis by a law of time: vec(p(t)* p_j* p_i) = 0
/// with p(t) = (cos f/2, h_j sin f/2). \[–\]
///
/// The driver has three rows. The function vec gives the vector part of a product of Euler
/// parameters, and * is the conjugate. `h_j` is the axis in body j. `law` is f \[rad\]; the law can
/// count full revolutions. Source: Nikravesh, *Computer-Aided Analysis of Mechanical Systems*,
/// ch. 6.
///
/// Signs: the rotation of i relative to j is right-handed about h_j. At zero the axes of both
/// frames are parallel.
#[constraint]
pub fn drive_rotation(i: Spatial, j: Spatial, h_j: Axis, law: Law, t: Time) -> Vec3 {
    let (sin, cos) = (0.5 * law.at(t)).sin_cos();
    let back = EulerParameters::new(cos, -sin * h_j.h.x, -sin * h_j.h.y, -sin * h_j.h.z);
    back.product(j.p.conjugate().product(i.p)).vector()
}

/// Makes the orientation of body i in body j follow laws of yaw, pitch and roll: vec(p(t)* p_j*
/// p_i) = 0 with p = p_z(yaw) p_y(pitch) p_x(roll). \[–\]
///
/// The driver has three rows. The function vec gives the vector part of a product of Euler
/// parameters, and * is the conjugate. The body first rolls about the x-axis of body j, then
/// pitches about the y-axis of body j, then yaws about the z-axis of body j. The result equals yaw,
/// pitch and roll about the moving axes. `yaw`, `pitch` and `roll` are angles \[rad\] and can count
/// full revolutions. Source: Shabana, *Computational Dynamics*, section 7.2.
///
/// Signs: each rotation is right-handed about its axis. At zero the axes of both frames are
/// parallel.
#[constraint]
pub fn drive_orientation(i: Spatial, j: Spatial, yaw: Law, pitch: Law, roll: Law, t: Time) -> Vec3 {
    let (sz, cz) = (0.5 * yaw.at(t)).sin_cos();
    let (sy, cy) = (0.5 * pitch.at(t)).sin_cos();
    let (sx, cx) = (0.5 * roll.at(t)).sin_cos();
    let p_z = EulerParameters::new(cz, 0.0, 0.0, sz);
    let p_yx =
        EulerParameters::new(cy, 0.0, sy, 0.0).product(EulerParameters::new(cx, sx, 0.0, 0.0));
    p_z.product(p_yx).conjugate().product(j.p.conjugate().product(i.p)).vector()
}

/// Makes a frame of body i follow six laws in a frame of body j: r_Pi − r_Pj − A_j (x, y, z)(t) = 0
/// and vec(p(t)* p_j* p_i) = 0 with p = p_z(yaw) p_y(pitch) p_x(roll). \[m, –\]
///
/// The driver has six rows. A_j, p_i and p_j belong to the two frames. The function vec gives the
/// vector part of a product of Euler parameters, and * is the conjugate. `u_i`, `p_i` and `u_j`,
/// `p_j` are the origin \[m\] and the Euler parameters of the frame in body i and in body j.
/// `EulerParameters::identity()` selects the axes of the body itself. `x`, `y`, `z` are
/// displacements \[m\] and `yaw`, `pitch`, `roll` are angles \[rad\]. The frame in i first rolls
/// about x, then pitches about y, then yaws about z of the frame in j. For another order of
/// rotations choose other frames. The angles can count full revolutions. Source: Shabana,
/// *Computational Dynamics*, section 7.2.
///
/// Signs: x, y and z grow along the axes of the frame in j. Each rotation is right-handed about its
/// axis. At zero the axes of both frames are parallel.
#[constraint]
#[require(p_i.norm() > 0.0 && p_j.norm() > 0.0, "at least one Euler parameter must differ from zero")]
pub fn drive_motion(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    p_i: EulerParameters,
    p_j: EulerParameters,
    x: Law,
    y: Law,
    z: Law,
    yaw: Law,
    pitch: Law,
    roll: Law,
    t: Time,
) -> (Vec3, Vec3) {
    let frame_i = p_i.normalize();
    let frame_j = p_j.normalize();
    let place = frame_j.rotation() * vec3(x.at(t), y.at(t), z.at(t));
    let (sz, cz) = (0.5 * yaw.at(t)).sin_cos();
    let (sy, cy) = (0.5 * pitch.at(t)).sin_cos();
    let (sx, cx) = (0.5 * roll.at(t)).sin_cos();
    let p_z = EulerParameters::new(cz, 0.0, 0.0, sz);
    let p_yx =
        EulerParameters::new(cy, 0.0, sy, 0.0).product(EulerParameters::new(cx, sx, 0.0, 0.0));
    // The difference between the actual orientation of i in j and the prescribed one.
    let meant = frame_j.product(p_z.product(p_yx)).product(frame_i.conjugate());
    (
        i.point(u_i) - j.point(u_j + place),
        meant.conjugate().product(j.p.conjugate().product(i.p)).vector(),
    )
}
