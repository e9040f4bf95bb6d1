//! Defines 3 × 3 matrices.

use std::iter::Sum;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

use nalgebra::Matrix3;

use super::componentwise::{componentwise, mixed};
use super::matrix::matrix;
use super::{Components, Scalar, Vec3};
use crate::numbers::real::{Dual, Real, assign, by_ref};

/// A 3 × 3 matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3<T = f64> {
    /// The entry in row 1, column 1.
    pub m11: T,
    /// The entry in row 1, column 2.
    pub m12: T,
    /// The entry in row 1, column 3.
    pub m13: T,
    /// The entry in row 2, column 1.
    pub m21: T,
    /// The entry in row 2, column 2.
    pub m22: T,
    /// The entry in row 2, column 3.
    pub m23: T,
    /// The entry in row 3, column 1.
    pub m31: T,
    /// The entry in row 3, column 2.
    pub m32: T,
    /// The entry in row 3, column 3.
    pub m33: T,
}

matrix!(Mat3, Vec3, 3 {
    (m11 = 0, 0; m12 = 0, 1; m13 = 0, 2),
    (m21 = 1, 0; m22 = 1, 1; m23 = 1, 2),
    (m31 = 2, 0; m32 = 2, 1; m33 = 2, 2)
});

mixed!(Mul::mul, Mat3, Vec3 => Vec3, |a, v| Vec3 {
    x: a.m11 * v.x + a.m12 * v.y + a.m13 * v.z,
    y: a.m21 * v.x + a.m22 * v.y + a.m23 * v.z,
    z: a.m31 * v.x + a.m32 * v.y + a.m33 * v.z,
});

mixed!(Mul::mul, Mat3, Mat3 => Mat3, |a, b| Mat3::from_columns([a * b.column(0), a * b.column(1), a * b.column(2)]));

impl Mat3 {
    /// Returns ã, the skew matrix of a vector: ã b = a × b.
    #[inline]
    pub fn skew<V: Components<3>>(a: V) -> Mat3<V::Scalar> {
        let [x, y, z] = a.components();
        let zero = V::Scalar::default();
        Mat3::new(zero, -z, y, z, zero, -x, -y, x, zero)
    }
}

impl<T: Scalar> Mat3<T> {
    /// Returns the transpose Aᵀ.
    #[inline]
    pub fn transpose(self) -> Self {
        Mat3::new(
            self.m11, self.m21, self.m31, self.m12, self.m22, self.m32, self.m13, self.m23,
            self.m33,
        )
    }

    /// Returns the determinant det A.
    #[inline]
    pub fn determinant(self) -> T {
        self.row(0).dot(self.row(1).cross(self.row(2)))
    }

    /// Returns the trace tr A.
    #[inline]
    pub fn trace(self) -> T {
        self.m11 + self.m22 + self.m33
    }
}

impl From<Matrix3<f64>> for Mat3 {
    fn from(a: Matrix3<f64>) -> Self {
        Mat3::from(<[[f64; 3]; 3]>::from(a)).transpose()
    }
}

impl From<Mat3> for Matrix3<f64> {
    fn from(a: Mat3) -> Self {
        a.transpose().to_array().into()
    }
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual64;
    use nalgebra::Vector3;

    use super::*;
    use crate::numbers::algebra::vec3;

    const A: Mat3 = Mat3::new(1.0, 2.0, 3.0, -4.0, 5.0, 0.5, 0.1, -0.2, 7.0);
    const B: Mat3 = Mat3::new(0.5, -1.0, 7.0, 2.0, 0.0, 1.0, -3.0, 0.3, 0.8);
    const V: Vec3 = Vec3::new(0.3, -0.7, 1.9);

    #[test]
    fn nalgebra_agrees() {
        let a = Matrix3::from(A);
        let b = Matrix3::from(B);
        let v = Vector3::from(V);
        assert_eq!((a[(0, 2)], Mat3::from(a)), (3.0, A));
        assert_eq!(A * V, (a * v).into());
        assert!((Matrix3::from(A * B) - a * b).norm() < 1e-14);
        assert_eq!(2.0 * A - B / 2.0, (a * 2.0 - b / 2.0).into());
        assert_eq!((A.transpose(), A.trace()), (a.transpose().into(), a.trace()));
        assert!((A.determinant() - a.determinant()).abs() < 1e-13);
        assert_eq!(Mat3::skew(V), v.cross_matrix().into());
        assert_eq!((A.row(1), A.column(1)), (vec3(-4.0, 5.0, 0.5), vec3(2.0, 5.0, -0.2)));
        assert_eq!(Mat3::identity() * A + Mat3::zeros(), A);
        let mut c = A;
        c[(2, 0)] = 9.0;
        assert_eq!((c.m31, A[(1, 2)]), (9.0, 0.5));
    }

    #[test]
    fn rows_columns_and_arrays_round_trip() {
        assert_eq!(Mat3::from_rows([A.row(0), A.row(1), A.row(2)]), A);
        assert_eq!(Mat3::from_columns([A.column(0), A.column(1), A.column(2)]), A);
        assert_eq!(Mat3::from(<[[f64; 3]; 3]>::from(A)), A);
    }

    #[test]
    fn skew_is_the_cross_product_and_kinds_mix() {
        let moving = V.map(|x| Real(Dual64::new(x, x * x)));
        let rate = |v: Vec3<Real<Dual64>>| v.map(|x| x.0.eps);
        assert_eq!(rate(Mat3::skew(moving) * V), rate(moving.cross(V)));
        assert_eq!(rate(Mat3::skew(V) * moving), rate(V.cross(moving)));
        assert_eq!(rate(A * moving), A * rate(moving));
        assert!((rate((A * Mat3::skew(moving)) * V) - rate(A * moving.cross(V))).norm() < 1e-14);
        assert!((rate((Mat3::skew(moving) * A) * V) - rate(moving.cross(A * V))).norm() < 1e-14);
        assert_eq!(Mat3::skew(V.map(Real::<Dual64>::from)), Mat3::skew(&V).into());
    }
}
