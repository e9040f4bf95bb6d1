//! Defines bodies and points that are planar or spatial.

use kin::extend::Target;
use kin::{Ground, Link, PlanarBody, SpatialBody, SpatialLink, Vec2, Vec3};

/// A body of a mechanism, planar or spatial, or the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Body(pub(crate) Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Planar(PlanarBody),
    Spatial(SpatialBody),
}

impl Body {
    /// The body of an argument, if it is one.
    pub(crate) fn of(target: &Target) -> Option<Body> {
        match target {
            Target::Planar(body) => Some(Body(Kind::Planar(*body))),
            Target::Spatial(body) => Some(Body(Kind::Spatial(*body))),
            Target::Coord(..) => None,
        }
    }

    pub(crate) fn is_ground(self) -> bool {
        match self.0 {
            Kind::Planar(body) => body == PlanarBody::from(Ground),
            Kind::Spatial(body) => body == SpatialBody::from(Ground),
        }
    }
}

impl From<PlanarBody> for Body {
    fn from(body: PlanarBody) -> Self {
        Body(Kind::Planar(body))
    }
}

impl<L> From<Link<L>> for Body {
    fn from(link: Link<L>) -> Self {
        Body(Kind::Planar(link.into()))
    }
}

impl From<SpatialBody> for Body {
    fn from(body: SpatialBody) -> Self {
        Body(Kind::Spatial(body))
    }
}

impl<L> From<SpatialLink<L>> for Body {
    fn from(link: SpatialLink<L>) -> Self {
        Body(Kind::Spatial(link.into()))
    }
}

impl From<Ground> for Body {
    fn from(ground: Ground) -> Self {
        Body(Kind::Planar(ground.into()))
    }
}

/// A point of the plane (z = 0) or of space.   \[m\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point(pub(crate) Vec3);

impl From<Vec2> for Point {
    fn from(p: Vec2) -> Self {
        Point(Vec3::new(p.x, p.y, 0.0))
    }
}

impl From<Vec3> for Point {
    fn from(p: Vec3) -> Self {
        Point(p)
    }
}
