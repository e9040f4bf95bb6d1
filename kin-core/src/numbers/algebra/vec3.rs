//! Defines vectors in space.

use std::iter::Sum;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

use nalgebra::Vector3;

use super::componentwise::{componentwise, mixed};
use super::vector::{sum, vector};
use super::{Components, Mix, Mixed, Scalar};
use crate::numbers::real::{Dual, Real, assign, by_ref};

/// A vector or a point in space. The unit is the unit of the components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<T = f64> {
    /// The component along the x-axis.
    pub x: T,
    /// The component along the y-axis.
    pub y: T,
    /// The component along the z-axis.
    pub z: T,
}

/// Creates the vector (x, y, z) from `f64` and `Real<D>` in any mixture: `vec3(x, 0.0, 1.0)`.
///
/// In a `const` write `Vec3::new`.
#[inline]
pub fn vec3<A, B, C>(x: A, y: B, z: C) -> Vec3<Mixed<Mixed<A, B>, C>>
where
    A: Mix<B>,
    Mixed<A, B>: Mix<C>,
{
    Vec3 { x: Mixed::<A, B>::from(x).into(), y: Mixed::<A, B>::from(y).into(), z: z.into() }
}

vector!(Vec3, 3 { x = 0, y = 1, z = 2 }, (T, T, T), (f64, f64, f64));

impl Vec3 {
    /// Returns the unit vector (1, 0, 0) in `f64`, which mixes with `Real<D>`.
    #[inline]
    pub const fn x() -> Self {
        Vec3 { x: 1.0, y: 0.0, z: 0.0 }
    }

    /// Returns the unit vector (0, 1, 0) in `f64`, which mixes with `Real<D>`.
    #[inline]
    pub const fn y() -> Self {
        Vec3 { x: 0.0, y: 1.0, z: 0.0 }
    }

    /// Returns the unit vector (0, 0, 1) in `f64`, which mixes with `Real<D>`.
    #[inline]
    pub const fn z() -> Self {
        Vec3 { x: 0.0, y: 0.0, z: 1.0 }
    }
}

impl<T: Scalar> Vec3<T> {
    /// Returns the cross product a × b.
    #[inline]
    pub fn cross<V: Components<3>>(self, other: V) -> Vec3<Mixed<T, V::Scalar>>
    where
        T: Mix<V::Scalar>,
    {
        let [x, y, z] = other.components();
        Vec3 { x: self.y * z - self.z * y, y: self.z * x - self.x * z, z: self.x * y - self.y * x }
    }
}

impl From<Vector3<f64>> for Vec3 {
    fn from(a: Vector3<f64>) -> Self {
        Vec3 { x: a.x, y: a.y, z: a.z }
    }
}

impl From<Vec3> for Vector3<f64> {
    fn from(a: Vec3) -> Self {
        Vector3::new(a.x, a.y, a.z)
    }
}

impl Components<3> for Vector3<f64> {
    type Scalar = f64;

    fn components(self) -> [f64; 3] {
        self.into()
    }
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual2_64;

    use super::*;

    const A: Vec3 = Vec3::new(1.5, -2.0, 0.7);
    const B: Vec3 = Vec3::new(0.3, 4.0, -1.1);

    #[test]
    fn nalgebra_agrees() {
        let a = Vector3::from(A);
        let b = Vector3::from(B);
        assert_eq!(Vec3::from(a - b / 2.0), A - B / 2.0);
        assert_eq!(A.dot(B), a.dot(&b));
        assert_eq!(A.cross(&B), a.cross(&b).into());
        assert_eq!(A.cross(b), a.cross(&b).into());
        assert_eq!(A.norm(), a.norm());
        assert_eq!(A.normalize(), a.normalize().into());
        assert_eq!(A.component_mul(B), a.component_mul(&b).into());
        assert_eq!(A.component_div(B), a.component_div(&b).into());
        assert_eq!(A.lerp(B, 0.25), a.lerp(&b, 0.25).into());
    }

    #[test]
    fn unit_vectors_are_right_handed() {
        assert_eq!(
            (Vec3::x().cross(Vec3::y()), Vec3::y().cross(Vec3::z())),
            (Vec3::z(), Vec3::x())
        );
        assert_eq!((A[0], A[1], A[2], A.to_array()), (1.5, -2.0, 0.7, [1.5, -2.0, 0.7]));
    }

    #[test]
    fn constant_and_moving_vectors_mix() {
        let x = Real(Dual2_64::new(2.0, 1.0, 0.0));
        let v = vec3(x, x * x, 1.0);
        let curvature = |v: Vec3<Real<Dual2_64>>| v.to_array().map(|x| x.0.v2);
        assert_eq!(curvature(A + 3.0 * v), [0.0, 6.0, 0.0]);
        assert_eq!(curvature(A.cross(v)), curvature(-v.cross(A)));
        assert_eq!((A.dot(v).0.v2, v.dot(A).0.v2, v.dot(v).0.v2), (-4.0, -4.0, 2.0 + 48.0));
        assert_eq!(curvature(vec3(0.0, x, x) + vec3(1.0, 0.0, x * x)), [0.0, 0.0, 2.0]);
        assert!(Vec3::<Real<Dual2_64>>::default().norm().is_constant());
    }
}
