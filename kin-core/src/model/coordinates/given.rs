//! Defines the traits of the bodies, coordinates and axes that a constructor of a constraint
//! accepts.
//!
//! Constructors use these traits instead of `Into`, so that rustc prints a helpful message for a
//! wrong argument.

use super::{Coordinate, PlanarBody, SpatialBody};
use crate::model::dimension::{Bindings, Dimension, IntoNumber};
use crate::numbers::algebra::{Axis, Components, Vec3};

/// A value that names a planar body: a [`PlanarBody`], a [`crate::Link`], the ground, or any
/// `Into<PlanarBody>`.
#[diagnostic::on_unimplemented(
    message = "expected a planar body, but found `{Self}`",
    label = "not a planar body",
    note = "give the value that `m.planar(…)`, `m.link(…)` or `m.ground()` returned, without `&`, and not the name of the body",
    note = "the joints and drivers of spatial bodies are in `spatial`, such as `spatial::revolute`"
)]
pub trait IntoPlanarBody {
    /// Returns the handle of the body.
    fn into_planar_body(self) -> PlanarBody;
}

#[diagnostic::do_not_recommend]
impl<T: Into<PlanarBody>> IntoPlanarBody for T {
    fn into_planar_body(self) -> PlanarBody {
        self.into()
    }
}

/// A value that names a spatial body: a [`SpatialBody`], a [`crate::SpatialLink`], the ground, or
/// any `Into<SpatialBody>`.
#[diagnostic::on_unimplemented(
    message = "expected a spatial body, but found `{Self}`",
    label = "not a spatial body",
    note = "give the value that `m.spatial(…)`, `m.spatial_link(…)` or `m.ground()` returned, without `&`, and not the name of the body",
    note = "the joints and drivers of planar bodies have no `spatial::`, such as `revolute`"
)]
pub trait IntoSpatialBody {
    /// Returns the handle of the body.
    fn into_spatial_body(self) -> SpatialBody;
}

#[diagnostic::do_not_recommend]
impl<T: Into<SpatialBody>> IntoSpatialBody for T {
    fn into_spatial_body(self) -> SpatialBody {
        self.into()
    }
}

/// A value that names a scalar coordinate: a [`Coordinate`] or any `Into<Coordinate>`.
#[diagnostic::on_unimplemented(
    message = "expected a coordinate, but found `{Self}`",
    label = "not a coordinate",
    note = "give the value that `m.angle(…)` or `m.length(…)` returned, or a coordinate of a body: `body.x()`, `body.y()`, `body.theta()`"
)]
pub trait IntoCoordinate {
    /// Returns the handle of the coordinate.
    fn into_coordinate(self) -> Coordinate;
}

#[diagnostic::do_not_recommend]
impl<T: Into<Coordinate>> IntoCoordinate for T {
    fn into_coordinate(self) -> Coordinate {
        self.into()
    }
}

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
