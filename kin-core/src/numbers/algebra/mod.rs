//! Defines small vectors and matrices over `f64` or [`Real<D>`](crate::numbers::real::Real), with
//! the method names of nalgebra.
//!
//! Operands are values or references. `f64` mixes with `Real<D>` in all operations, such as a
//! constant vector times a vector of `Real<D>`, or a literal on either side. `From` and `Into`
//! convert to nalgebra and back.

mod axis;
mod componentwise;
mod euler;
mod mat2;
mod mat3;
mod matrix;
mod scalar;
mod vec2;
mod vec3;
mod vector;

pub use axis::Axis;
pub use euler::EulerParameters;
pub use mat2::Mat2;
pub use mat3::Mat3;
pub(crate) use scalar::sealed;
pub use scalar::{Mix, Mixed, Scalar};
pub use vec2::{Vec2, vec2};
pub use vec3::{Vec3, vec3};

/// A value with N components of one type: a vector of Kin by value or by reference, a vector of
/// nalgebra, an array, or a tuple.
///
/// Joints and the methods of vectors accept such values.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a vector of {N} components",
    label = "expected {N} components",
    note = "write `vec2(x, y)` or `(x, y)` in the plane, and `vec3(x, y, z)` or `(x, y, z)` in space; write numbers with a decimal point, such as `1.0`"
)]
pub trait Components<const N: usize> {
    /// The number type of the components.
    type Scalar: Scalar;

    /// Returns the components in order.
    fn components(self) -> [Self::Scalar; N];
}

impl<T: Scalar, const N: usize> Components<N> for [T; N] {
    type Scalar = T;

    #[inline]
    fn components(self) -> [T; N] {
        self
    }
}
