//! Defines the traits of the bodies and coordinates that a constructor of a constraint accepts.
//!
//! Constructors use these traits instead of `Into`, so that rustc prints a helpful message for a
//! wrong argument.

use super::{Coordinate, PlanarBody, SpatialBody};

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
