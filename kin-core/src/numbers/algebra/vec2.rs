//! Defines vectors in the plane.

use std::iter::Sum;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign,
};

use nalgebra::Vector2;

use super::componentwise::{componentwise, mixed};
use super::vector::{sum, vector};
use super::{Components, Mix, Mixed, Scalar};
use crate::numbers::real::{Dual, Real, assign, by_ref};

/// A vector or a point in the plane. The unit is the unit of the components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec2<T = f64> {
    /// The component along the x-axis.
    pub x: T,
    /// The component along the y-axis.
    pub y: T,
}

/// Creates the vector (x, y) from `f64` and `Real<D>` in any mixture: `vec2(x, 0.0)`.
///
/// In a `const` write `Vec2::new`.
#[inline]
pub fn vec2<A: Mix<B>, B>(x: A, y: B) -> Vec2<Mixed<A, B>> {
    Vec2 { x: x.into(), y: y.into() }
}

vector!(Vec2, 2 { x = 0, y = 1 }, (T, T), (f64, f64));

impl Vec2 {
    /// Returns the unit vector (1, 0) in `f64`, which mixes with `Real<D>`.
    #[inline]
    pub const fn x() -> Self {
        Vec2 { x: 1.0, y: 0.0 }
    }

    /// Returns the unit vector (0, 1) in `f64`, which mixes with `Real<D>`.
    #[inline]
    pub const fn y() -> Self {
        Vec2 { x: 0.0, y: 1.0 }
    }
}

impl<T: Scalar> Vec2<T> {
    /// Returns (−y, x): the vector rotated by 90° counter-clockwise.
    #[inline]
    pub fn perp(self) -> Self {
        Vec2 { x: -self.y, y: self.x }
    }

    /// Returns a × b = aₓ b_y − a_y bₓ, the z-component of the cross product.
    ///
    /// The result is positive if b is counter-clockwise of a.
    #[inline]
    pub fn cross<V: Components<2>>(self, other: V) -> Mixed<T, V::Scalar>
    where
        T: Mix<V::Scalar>,
    {
        let [x, y] = other.components();
        self.x * y - self.y * x
    }
}

impl From<Vector2<f64>> for Vec2 {
    fn from(a: Vector2<f64>) -> Self {
        Vec2 { x: a.x, y: a.y }
    }
}

impl From<Vec2> for Vector2<f64> {
    fn from(a: Vec2) -> Self {
        Vector2::new(a.x, a.y)
    }
}

impl Components<2> for Vector2<f64> {
    type Scalar = f64;

    fn components(self) -> [f64; 2] {
        self.into()
    }
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::Dual64;

    use super::*;

    const A: Vec2 = Vec2::new(1.5, -2.0);
    const B: Vec2 = Vec2::new(0.3, 4.0);

    fn moving() -> Vec2<Real<Dual64>> {
        Vec2::new(Real(Dual64::new(3.0, 1.0)), Real(Dual64::new(4.0, -2.0)))
    }

    fn rates(v: Vec2<Real<Dual64>>) -> [f64; 2] {
        [v.x.0.eps, v.y.0.eps]
    }

    #[test]
    fn nalgebra_agrees() {
        let a = Vector2::from(A);
        let b = Vector2::from(B);
        assert_eq!(Vec2::from(a + b * 2.0), A + 2.0 * B);
        assert_eq!(A.dot(B), a.dot(&b));
        assert_eq!(A.cross(B), a.perp(&b));
        assert_eq!(A.norm(), a.norm());
        assert_eq!(A.norm_squared(), a.norm_squared());
        assert_eq!(A.normalize(), a.normalize().into());
        assert_eq!(A.component_mul(B), a.component_mul(&b).into());
        assert_eq!(A.component_div(B), a.component_div(&b).into());
        assert_eq!(A.lerp(B, 0.25), a.lerp(&b, 0.25).into());
        assert_eq!(
            (A.dot(b), A.dot(&B), A.dot([0.3, 4.0]), A.dot((0.3, 4.0))),
            (A.dot(B), A.dot(B), A.dot(B), A.dot(B))
        );
    }

    #[test]
    fn perp_is_a_quarter_turn_counter_clockwise() {
        assert_eq!(Vec2::x().perp(), Vec2::y());
        assert_eq!((A.perp().dot(A), A.cross(A.perp())), (0.0, A.norm_squared()));
    }

    #[test]
    #[allow(clippy::op_ref)]
    fn references_and_literals_on_either_side() {
        let mut c = A;
        c += &B;
        c -= B;
        c *= 2.0;
        c /= 2.0;
        for d in [
            &A * 1.0,
            A * &1.0,
            1.0 * &A,
            &1.0 * A,
            &A / 1.0,
            -(-&A),
            &A + &B - &B,
            &A - B + B,
            [A].into_iter().sum(),
            c,
        ] {
            assert!((d - A).norm() < 1e-15);
        }
        assert_eq!((vec2(0.0, 1.0) + vec2(3.0, 3.0)).norm(), 5.0);
        assert_eq!(vec2(1.0, 0.0).dot(vec2(0.0, 1.0)).sqrt(), 0.0);
        assert_eq!(
            (c[0], c[1], <[f64; 2]>::from(c), Vec2::from((1.5, -2.0))),
            (1.5, -2.0, [1.5, -2.0], A)
        );
        c[1] = 7.0;
        assert_eq!(c.to_array(), [1.5, 7.0]);
    }

    #[test]
    #[allow(clippy::op_ref)]
    fn constant_and_moving_vectors_mix() {
        let v = moving();
        for w in [v + A, A + v, &v + A, v - -A, A - -v, v + Vec2::<Real<Dual64>>::from(A)] {
            assert_eq!((w.map(Real::value), rates(w)), (vec2(4.5, 2.0), [1.0, -2.0]));
        }
        for w in [v * 2.0, 2.0 * v, v / 0.5, v * Real::from(2.0), Real::from(2.0) * v] {
            assert_eq!((w.map(Real::value), rates(w)), (vec2(6.0, 8.0), [2.0, -4.0]));
        }
        for (a, b) in [(v.x * A, A * v.x), (A * v.x, Real::from(1.0) * (v.x * A))] {
            assert_eq!((a, rates(a)), (b, [1.5, -2.0]));
        }
        for product in
            [v.dot(A), A.dot(v), A.dot(&v), v.cross(-A.perp()), -A.perp().cross(v) * -1.0]
        {
            assert_eq!(product.0.eps.abs(), 5.5);
        }
        let half = A.lerp(v, 0.5);
        assert_eq!((half.map(Real::value), rates(half)), (vec2(2.25, 1.0), [0.5, -1.0]));
        assert_eq!(rates(v.lerp(v, v.x)), [1.0, -2.0]);
        let mut w = v;
        w += A;
        w -= &A;
        w *= 2.0;
        w /= v.x;
        assert_eq!(w.x.0.eps, 0.0);
    }

    #[test]
    fn vec2_mixes_a_moving_number_with_a_literal() {
        let x = moving().x;
        assert_eq!(rates(vec2(x, 0.0)), [1.0, 0.0]);
        assert_eq!(rates(vec2(0.0, x) + vec2(1.0, 0.0)), [0.0, 1.0]);
    }

    #[test]
    fn norm_of_a_constant_zero_vector_is_constant() {
        assert!(Vec2::<Real<Dual64>>::default().norm().is_constant());
        assert_eq!(moving().norm().0.eps, -1.0);
    }

    #[test]
    #[should_panic(expected = "component 2 of Vec2 with 2")]
    fn a_component_beyond_the_last_panics() {
        let _ = A[2];
    }
}
