//! Computes the balance of one body: inertial forces, weight, kinetic energy.

use crate::model::loads::Solid;
use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{EulerParameters, Scalar, Vec2, Vec3};
use crate::numbers::real::{Dual64, Real};

/// Makes a dual number from a value and its derivative.
fn moving(value: f64, rate: f64) -> Real<Dual64> {
    Real(Dual64::new(value, rate))
}

/// The coordinates of a body at one time, and their derivatives.
#[derive(Clone, Copy)]
pub(super) struct Moved<'a, const N: usize> {
    pub q: &'a [f64; N],
    pub qd: &'a [f64; N],
    pub qdd: &'a [f64; N],
}

/// The generalised forces, energies and powers of one body.
pub(super) struct Body<const N: usize> {
    /// M q̈ − Q_v, by coordinates of the body.
    pub inertial: [f64; N],
    /// Q of the weight, by coordinates of the body.
    pub weight: [f64; N],
    /// T, and dT/dt from differentiating T. \[J, W\]
    pub kinetic: [f64; 2],
    /// The potential energy of the weight, −m g · r_c. \[J\]
    pub potential: f64,
}

/// Computes a planar body: m a_c acts at the centre, J θ̈ about it.
pub(super) fn planar(solid: &Solid, gravity: [f64; 3], moved: Moved<'_, 3>) -> Body<3> {
    let Moved { q, qd, qdd } = moved;
    let c = Vec2::new(solid.centre.x, solid.centre.y);
    let m = solid.mass;
    let j = solid.inertia.m33;
    let state = PlanarState::new(*q);
    let [vx, vy, w] = *qd;
    let [ax, ay, alpha] = *qdd;
    let arm = state.direction(c);
    let a = Vec2::new(ax - alpha * arm.y - w * w * arm.x, ay + alpha * arm.x - w * w * arm.y);
    let generalised = |f: Vec2, torque: f64| [f.x, f.y, torque + arm.x * f.y - arm.y * f.x];
    let g = Vec2::new(gravity[0], gravity[1]);
    let dual: [Real<Dual64>; 3] = std::array::from_fn(|k| moving(q[k], qd[k]));
    let turn = PlanarState::new(dual).direction(c);
    let [vx, vy] = [moving(vx, ax), moving(vy, ay)];
    let w = moving(w, alpha);
    let v = Vec2::new(vx - w * turn.y, vy + w * turn.x);
    let kinetic = v.dot(v) * (0.5 * m) + w * w * (0.5 * j);
    let centre = state.point(c);
    Body {
        inertial: generalised(a * m, j * alpha),
        weight: generalised(g * m, 0.0),
        kinetic: [kinetic.0.re, kinetic.0.eps],
        potential: -m * g.dot(centre),
    }
}

/// Computes a spatial body: m a_c acts at the centre, J ω̄̇ + ω̄ × J ω̄ about it, in the axes of
/// the body.
pub(super) fn spatial(solid: &Solid, gravity: [f64; 3], moved: Moved<'_, 7>) -> Body<7> {
    let Moved { q, qd, qdd } = moved;
    let c = solid.centre;
    let m = solid.mass;
    let j = solid.inertia;
    let state = SpatialState::new(*q);
    let g = Vec3::from(gravity);
    let [rate, second] = [qd, qdd].map(|x| EulerParameters::new(x[3], x[4], x[5], x[6]));
    let w = omega(state.p, rate);
    let alpha = omega(state.p, second);
    let arm = alpha.cross(c) + w.cross(w.cross(c));
    let a = Vec3::new(qdd[0], qdd[1], qdd[2]) + state.a * arm;
    let torque = j * alpha + w.cross(j * w);
    let at_origin =
        |f: Vec3, torque: Vec3| generalised(state.p, f, torque + c.cross(state.a.transpose() * f));
    let dual = SpatialState::new(std::array::from_fn(|k| moving(q[k], qd[k])));
    let dual_rate = EulerParameters::new(
        moving(qd[3], qdd[3]),
        moving(qd[4], qdd[4]),
        moving(qd[5], qdd[5]),
        moving(qd[6], qdd[6]),
    );
    let dual_w = omega(dual.p, dual_rate);
    let v = Vec3::new(moving(qd[0], qdd[0]), moving(qd[1], qdd[1]), moving(qd[2], qdd[2]))
        + dual.a * dual_w.cross(c);
    let kinetic = v.dot(v) * (0.5 * m) + dual_w.dot(j * dual_w) * 0.5;
    Body {
        inertial: at_origin(a * m, torque),
        weight: at_origin(g * m, Vec3::zeros()),
        kinetic: [kinetic.0.re, kinetic.0.eps],
        potential: -m * g.dot(state.point(c)),
    }
}

/// Returns ω̄ = 2 Ḡ ṗ, the angular velocity in the axes of the body: twice the vector part of p* ṗ.
/// For p̈ it returns ω̄̇, because Ḡ̇ ṗ is zero.
pub(super) fn omega<T: Scalar>(p: EulerParameters<T>, rate: EulerParameters<T>) -> Vec3<T> {
    let e0 = p.e0;
    let e = p.vector();
    let f0 = rate.e0;
    let f = rate.vector();
    let cross =
        Vec3 { x: e.y * f.z - e.z * f.y, y: e.z * f.x - e.x * f.z, z: e.x * f.y - e.y * f.x };
    let part = |e: T, f: T, cross: T| {
        let half = e0 * f - f0 * e - cross;
        half + half
    };
    Vec3 { x: part(e.x, f.x, cross.x), y: part(e.y, f.y, cross.y), z: part(e.z, f.z, cross.z) }
}

/// Returns Q of a global force at the origin of a spatial body and a torque in its axes: (F, 2 Ḡᵀ
/// T̄).
pub(super) fn generalised(p: EulerParameters, f: Vec3, torque: Vec3) -> [f64; 7] {
    // ½ ∂ω̄/∂ṗ T̄ = p (0, T̄), twice.
    let turned = p.product(EulerParameters::new(0.0, torque.x, torque.y, torque.z));
    [f.x, f.y, f.z, 2.0 * turned.e0, 2.0 * turned.e1, 2.0 * turned.e2, 2.0 * turned.e3]
}

/// Returns T̄ of generalised forces along p: ½ Ḡ Q_p, without the part along p.
pub(super) fn torque(p: EulerParameters, by_p: EulerParameters) -> Vec3 {
    p.conjugate().product(by_p).vector() * (0.5 / p.norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::algebra::{Mat3, vec3};

    const P: EulerParameters = EulerParameters::new(0.5, -0.1, 0.7, 0.3);

    #[test]
    fn the_power_of_a_torque_is_that_of_its_generalised_force() {
        let p = P.normalize();
        let rate = EulerParameters::new(0.3, -2.0, 0.4, 1.1);
        let t = vec3(0.2, -1.4, 3.0);
        let q = generalised(p, Vec3::zeros(), t);
        let power = q[3] * rate.e0 + q[4] * rate.e1 + q[5] * rate.e2 + q[6] * rate.e3;
        assert!((power - t.dot(omega(p, rate))).abs() < 1e-14);
        let by_p = EulerParameters::new(q[3], q[4], q[5], q[6]);
        assert!((torque(p, by_p) - t).norm() < 1e-14);
        assert!(torque(p, by_p + p * 7.0).norm() - t.norm() < 1e-13);
    }

    #[test]
    fn omega_is_the_rate_of_the_rotation_matrix() {
        let p = P.normalize();
        let rate = EulerParameters::new(0.3, -2.0, 0.4, 1.1);
        let rate = rate - p * p.dot(rate);
        let dual = EulerParameters::new(
            moving(p.e0, rate.e0),
            moving(p.e1, rate.e1),
            moving(p.e2, rate.e2),
            moving(p.e3, rate.e3),
        );
        let turning = p.rotation().transpose() * dual.rotation().map(|x| x.0.eps);
        let skew = Mat3::skew(omega(p, rate));
        for k in 0..3 {
            assert!((turning.row(k) - skew.row(k)).norm() < 1e-14);
        }
    }
}
