//! Defines Euler parameters.

use std::iter::Sum;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

use super::componentwise::{componentwise, mixed};
use super::vector::{sum, vector};
use super::{Components, Mat3, Mix, Mixed, Scalar, Vec3};
use crate::numbers::real::{Dual, Real, assign, by_ref};

/// Euler parameters p = (e0, e) = (cos φ/2, u sin φ/2) of a rotation by φ about the unit vector u,
/// with |p| = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerParameters<T = f64> {
    /// The scalar cos φ/2.
    pub e0: T,
    /// u_x sin φ/2.
    pub e1: T,
    /// u_y sin φ/2.
    pub e2: T,
    /// u_z sin φ/2.
    pub e3: T,
}

vector!(EulerParameters, 4 { e0 = 0, e1 = 1, e2 = 2, e3 = 3 }, (T, T, T, T), (f64, f64, f64, f64));

mixed!(Mul::mul, EulerParameters, EulerParameters => EulerParameters, |p, q| p.product(q));

impl<T: Scalar> Default for EulerParameters<T> {
    /// Returns no rotation, (1, 0, 0, 0).
    fn default() -> Self {
        EulerParameters::identity().map(T::from)
    }
}

impl EulerParameters {
    /// Returns the identity (1, 0, 0, 0), which does not rotate, in `f64`, which mixes with
    /// `Real<D>`.
    #[inline]
    pub const fn identity() -> Self {
        EulerParameters { e0: 1.0, e1: 0.0, e2: 0.0, e3: 0.0 }
    }
}

impl EulerParameters {
    /// Returns the Euler parameters p of a rotation matrix A, with e0 ≥ 0.
    ///
    /// This function is the inverse of [`EulerParameters::rotation`].
    ///
    /// For a matrix that is not a rotation the result is meaningless.
    pub fn from_rotation(a: Mat3) -> Self {
        let matrix = nalgebra::Matrix3::from(a);
        let turn = nalgebra::UnitQuaternion::from_rotation_matrix(
            &nalgebra::Rotation3::from_matrix_unchecked(matrix),
        )
        .into_inner();
        let sign = if turn.w < 0.0 { -1.0 } else { 1.0 };
        EulerParameters {
            e0: sign * turn.w,
            e1: sign * turn.i,
            e2: sign * turn.j,
            e3: sign * turn.k,
        }
    }
}

impl<T: Scalar> EulerParameters<T> {
    /// Returns the rotation by `angle` \[rad\] about `axis`, which may have any length except zero.
    pub fn from_axis_angle(axis: impl Into<Vec3<T>>, angle: T) -> Self {
        let (sin, cos) = (angle * 0.5).sin_cos();
        let e = axis.into().normalize() * sin;
        EulerParameters { e0: cos, e1: e.x, e2: e.y, e3: e.z }
    }

    /// Returns the vector part e = (e1, e2, e3).
    #[inline]
    pub fn vector(self) -> Vec3<T> {
        Vec3 { x: self.e1, y: self.e2, z: self.e3 }
    }

    /// Returns (e0, −e), the inverse rotation.
    #[inline]
    pub fn conjugate(self) -> Self {
        EulerParameters { e0: self.e0, e1: -self.e1, e2: -self.e2, e3: -self.e3 }
    }

    /// Returns the rotation matrix A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ from the body frame to the
    /// global frame.
    ///
    /// Other algebraic forms of A have different values if |p| ≠ 1.
    pub fn rotation(self) -> Mat3<T> {
        let e0 = self.e0;
        let e = self.vector();
        let double = e + e;
        let scalar = e0 + e0;
        let diagonal = scalar * e0 - 1.0;
        let xy = double.x * e.y;
        let xz = double.x * e.z;
        let yz = double.y * e.z;
        let turn = e * scalar;
        Mat3 {
            m11: diagonal + double.x * e.x,
            m12: xy - turn.z,
            m13: xz + turn.y,
            m21: xy + turn.z,
            m22: diagonal + double.y * e.y,
            m23: yz - turn.x,
            m31: xz - turn.y,
            m32: yz + turn.x,
            m33: diagonal + double.z * e.z,
        }
    }

    /// Returns the quaternion product p q, also written `p * q`: the rotation q, followed by the
    /// rotation p.
    ///
    /// A(p q) = A(p) A(q) if |p| = |q| = 1.
    #[inline]
    pub fn product<V: Components<4>>(self, q: V) -> EulerParameters<Mixed<T, V::Scalar>>
    where
        T: Mix<V::Scalar>,
    {
        let p = self;
        let [q0, q1, q2, q3] = q.components();
        EulerParameters {
            e0: p.e0 * q0 - p.e1 * q1 - p.e2 * q2 - p.e3 * q3,
            e1: p.e0 * q1 + p.e1 * q0 + p.e2 * q3 - p.e3 * q2,
            e2: p.e0 * q2 - p.e1 * q3 + p.e2 * q0 + p.e3 * q1,
            e3: p.e0 * q3 + p.e1 * q2 - p.e2 * q1 + p.e3 * q0,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual64;
    use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};

    use super::*;
    use crate::numbers::algebra::vec3;

    const P: EulerParameters = EulerParameters::new(0.5, -0.1, 0.7, 0.3);
    const Q: EulerParameters = EulerParameters::new(-0.2, 0.4, 0.9, -0.6);

    fn quaternion(p: EulerParameters) -> Quaternion<f64> {
        Quaternion::new(p.e0, p.e1, p.e2, p.e3)
    }

    #[test]
    fn nalgebra_agrees() {
        let pq = quaternion(P) * quaternion(Q);
        assert!((quaternion(P * Q) - pq).norm() < 1e-15);
        assert_eq!(P.product(&Q), P * Q);
        let a = UnitQuaternion::from_quaternion(quaternion(P)).to_rotation_matrix();
        assert!((nalgebra::Matrix3::from(P.normalize().rotation()) - a.matrix()).norm() < 1e-15);
        let turn = UnitQuaternion::from_axis_angle(
            &Unit::new_normalize(Vector3::new(1.0, 2.0, -2.0)),
            0.8,
        );
        assert!(
            (quaternion(EulerParameters::from_axis_angle(vec3(1.0, 2.0, -2.0), 0.8)) - *turn)
                .norm()
                < 1e-15
        );
    }

    #[test]
    fn rotation_has_kins_form_off_the_unit_sphere() {
        let e = P.vector();
        let outer = Mat3::from_columns([e * e.x, e * e.y, e * e.z]);
        let a =
            (2.0 * P.e0 * P.e0 - 1.0) * Mat3::identity() + 2.0 * outer + 2.0 * P.e0 * Mat3::skew(e);
        for i in 0..3 {
            assert!((a.row(i) - P.rotation().row(i)).norm() < 1e-15);
        }
        assert_eq!(EulerParameters::<f64>::default().rotation(), Mat3::identity());
    }

    #[test]
    fn products_turn_one_after_the_other() {
        let p = P.normalize();
        let q = Q.normalize();
        let v = vec3(0.2, -1.0, 3.0);
        assert!(((p * q).rotation() * v - p.rotation() * (q.rotation() * v)).norm() < 1e-14);
        assert!(((p * p.conjugate()) - EulerParameters::identity()).norm() < 1e-15);
        assert!(
            (P.norm() - 0.84f64.sqrt()).abs() < 1e-15
                && (P.dot(P) - P.norm_squared()).abs() < 1e-15
        );
        assert_eq!((P[0], P[3], P.to_array()), (0.5, 0.3, [0.5, -0.1, 0.7, 0.3]));
    }

    #[test]
    fn moving_parameters_mix_with_constant_ones() {
        let moving = EulerParameters::from_axis_angle(Vec3::z(), Real(Dual64::new(0.3, 1.0)));
        let v = moving.rotation() * vec3(1.0, 0.0, 0.0);
        assert!(
            (v.x.0.eps + 0.3f64.sin()).abs() < 1e-15 && (v.y.0.eps - 0.3f64.cos()).abs() < 1e-15
        );
        assert_eq!((moving * P).dot(Q).0.eps, (moving * P.map(Real::from)).dot(Q).0.eps);
        assert_eq!(moving.norm().0.eps, 0.0);
    }
}
