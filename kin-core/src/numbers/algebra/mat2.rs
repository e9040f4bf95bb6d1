//! Defines 2 × 2 matrices.

use std::iter::Sum;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

use nalgebra::Matrix2;

use super::componentwise::{componentwise, mixed};
use super::matrix::matrix;
use super::{Components, Scalar, Vec2};
use crate::numbers::real::{Dual, Real, assign, by_ref};

/// A 2 × 2 matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat2<T = f64> {
    /// The entry in row 1, column 1.
    pub m11: T,
    /// The entry in row 1, column 2.
    pub m12: T,
    /// The entry in row 2, column 1.
    pub m21: T,
    /// The entry in row 2, column 2.
    pub m22: T,
}

matrix!(Mat2, Vec2, 2 { (m11 = 0, 0; m12 = 0, 1), (m21 = 1, 0; m22 = 1, 1) });

mixed!(Mul::mul, Mat2, Vec2 => Vec2, |a, v| Vec2 { x: a.m11 * v.x + a.m12 * v.y, y: a.m21 * v.x + a.m22 * v.y });

mixed!(Mul::mul, Mat2, Mat2 => Mat2, |a, b| Mat2 {
    m11: a.m11 * b.m11 + a.m12 * b.m21,
    m12: a.m11 * b.m12 + a.m12 * b.m22,
    m21: a.m21 * b.m11 + a.m22 * b.m21,
    m22: a.m21 * b.m12 + a.m22 * b.m22,
});

impl<T: Scalar> Mat2<T> {
    /// Returns the rotation matrix \[cos φ, −sin φ; sin φ, cos φ\] of a counter-clockwise rotation
    /// by φ. \[rad\]
    #[inline]
    pub fn rotation(angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        Mat2 { m11: cos, m12: -sin, m21: sin, m22: cos }
    }

    /// Returns the transpose Aᵀ.
    #[inline]
    pub fn transpose(self) -> Self {
        Mat2 { m12: self.m21, m21: self.m12, ..self }
    }

    /// Returns the determinant det A.
    #[inline]
    pub fn determinant(self) -> T {
        self.m11 * self.m22 - self.m21 * self.m12
    }

    /// Returns the trace tr A.
    #[inline]
    pub fn trace(self) -> T {
        self.m11 + self.m22
    }
}

impl From<Matrix2<f64>> for Mat2 {
    fn from(a: Matrix2<f64>) -> Self {
        Mat2 { m11: a.m11, m12: a.m12, m21: a.m21, m22: a.m22 }
    }
}

impl From<Mat2> for Matrix2<f64> {
    fn from(a: Mat2) -> Self {
        Matrix2::new(a.m11, a.m12, a.m21, a.m22)
    }
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual64;
    use nalgebra::{Rotation2, Vector2};

    use super::*;
    use crate::numbers::algebra::vec2;

    const A: Mat2 = Mat2::new(1.0, 2.0, 3.0, -4.0);
    const B: Mat2 = Mat2::new(0.5, -1.0, 7.0, 2.0);
    const V: Vec2 = Vec2::new(0.3, -0.7);

    #[test]
    fn nalgebra_agrees() {
        let a = Matrix2::from(A);
        let b = Matrix2::from(B);
        let v = Vector2::from(V);
        assert_eq!((A * V, A * B), ((a * v).into(), (a * b).into()));
        assert_eq!(2.0 * A - B / 2.0, (a * 2.0 - b / 2.0).into());
        assert_eq!(
            (A.transpose(), A.determinant(), A.trace()),
            (a.transpose().into(), a.determinant(), a.trace())
        );
        assert_eq!((A.row(1), A.column(1)), (vec2(3.0, -4.0), vec2(2.0, -4.0)));
        assert_eq!((A[(0, 1)], A[(1, 0)]), (a[(0, 1)], a[(1, 0)]));
        assert_eq!(Mat2::rotation(0.4), (*Rotation2::new(0.4).matrix()).into());
        assert_eq!(Mat2::identity() * A, A);
    }

    #[test]
    fn rows_columns_and_arrays_round_trip() {
        assert_eq!(Mat2::from_rows([A.row(0), A.row(1)]), A);
        assert_eq!(Mat2::from_columns([[1.0, 3.0], [2.0, -4.0]]), A);
        assert_eq!(Mat2::from(<[[f64; 2]; 2]>::from(A)), A);
    }

    #[test]
    #[allow(clippy::op_ref)]
    fn a_turning_matrix_and_a_constant_vector_mix() {
        let turning = Mat2::rotation(Real(Dual64::new(0.4, 1.0)));
        let rate = |v: Vec2<Real<Dual64>>| v.map(|x| x.0.eps);
        let expected = Mat2::rotation(0.4) * V.perp();
        for v in [
            turning * V,
            &turning * &V,
            turning * V.map(Real::from),
            (turning * B) * V - turning * (B * V) + turning * V,
        ] {
            assert!((rate(v) - expected).norm() < 1e-15);
        }
        assert_eq!(rate(A * (turning * V)), A * rate(turning * V));
        assert_eq!(
            (A * turning)[(0, 0)].0.eps,
            A.m11 * turning.m11.0.eps + A.m12 * turning.m21.0.eps
        );
    }

    #[test]
    #[should_panic(expected = "entry (0, 2) of Mat2")]
    fn an_entry_beyond_the_last_panics() {
        let _ = A[(0, 2)];
    }
}
