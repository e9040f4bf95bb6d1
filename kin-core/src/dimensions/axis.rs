//! Defines the trait of the axes that a constructor of a constraint accepts.

use super::{Bindings, Dimension, IntoNumber};
use crate::numbers::algebra::{Axis, Components, Vec3};

/// A value that gives an axis: a [`crate::Vec3`] along the axis, an [`Axis`], any `Into<Axis>`, or
/// one of these types with [`Dimension`]s as components.
#[diagnostic::on_unimplemented(
    message = "expected an axis, but found `{Self}`",
    label = "not an axis",
    note = "give a vector along the axis, `vec3(0.0, 0.0, 1.0)`, or `Axis::new(h, f)` with a second vector f across the axis"
)]
pub trait IntoAxis {
    /// Returns the axis.
    ///
    /// If the directions of the axis depend on dimensions, the method records them under `name`.
    fn into_axis(self, name: &str, to: &mut Bindings) -> Axis;
}

#[diagnostic::do_not_recommend]
impl<T: Into<Axis>> IntoAxis for T {
    fn into_axis(self, _: &str, _: &mut Bindings) -> Axis {
        self.into()
    }
}

#[diagnostic::do_not_recommend]
impl IntoAxis for Axis<Dimension> {
    fn into_axis(self, name: &str, to: &mut Bindings) -> Axis {
        to.axis(name, &[self.h, self.f].map(Vec3::to_array).concat())
    }
}

/// Directions that contain dimensions.
macro_rules! directions {
    ($($direction:ty)*) => {$(
        #[diagnostic::do_not_recommend]
        impl IntoAxis for $direction {
            fn into_axis(self, name: &str, to: &mut Bindings) -> Axis {
                to.axis(name, &self.components().map(IntoNumber::into_number))
            }
        }
    )*};
}

directions! {
    Vec3<Dimension> [Dimension; 3] (Dimension, Dimension, Dimension)
    (Dimension, f64, f64) (f64, Dimension, f64) (f64, f64, Dimension)
    (f64, Dimension, Dimension) (Dimension, f64, Dimension) (Dimension, Dimension, f64)
}
