//! Places bodies by points, and finds local positions in bodies at their drawn poses.
//!
//! These functions help because users often forget that the frame of a link is in its middle.

use super::{Mechanism, Pose, SpatialPose};
use crate::coordinates::layout::Place;
use crate::coordinates::{Link, SpatialLink};
use crate::dimensions::{Bound, IntoNumber};
use crate::model::body::Body;
use crate::numbers::algebra::{Axis, Components, Mix, Mixed, Scalar, Vec2, Vec3};
use crate::outcome::error::{Error, Result};

/// A named point and direction of a body, both in the frame of the body.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("crank");
/// let crank = m.link_between("crank", (0.0, 0.0), (3.0, 4.0))?;
/// let pin = m.marker("pin", crank, (3.0, 4.0), (1.0, 0.0))?; // where it is drawn
/// assert!((pin.u - crank.end()).norm() < 1e-15 && (pin.h - vec2(0.6, -0.8)).norm() < 1e-15);
/// m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("motor", drive_angle(pin.body, Law::linear((4.0_f64 / 3.0).atan(), 1.0)))?;
/// let mut motion = m.build()?.run([0.0, 1.0])?;
/// assert!((motion.marker(&pin)?.speed().values()[0] - 5.0).abs() < 1e-12);
/// motion.add_marker(&pin)?; // columns `pin.x`, `pin.y`, …
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Marker<B: Body> {
    /// The name of the marker, for files and figures.
    pub name: String,
    /// The body to which the marker belongs.
    pub body: B,
    /// The position in the frame of the body. \[m\]
    pub u: B::Vector,
    /// The direction in the frame of the body, a vector of any length. \[–\]
    pub h: B::Vector,
}

impl<B: Body> Marker<B> {
    /// Creates a marker from a local position and a local direction.
    ///
    /// [`Mechanism::marker`] accepts a global position and direction.
    pub fn new(name: &str, body: B, u: impl Into<B::Vector>, h: impl Into<B::Vector>) -> Self {
        Marker { name: name.to_string(), body, u: u.into(), h: h.into() }
    }
}

/// Returns a frame in the middle between two global points, with its x-axis from the first to the
/// second. `components` are the six components of the points.
pub(crate) fn between(components: impl Iterator<Item = f64>) -> SpatialPose {
    let mut all = [f64::NAN; 6];
    all.iter_mut().zip(components).for_each(|(to, x)| *to = x);
    let a = Vec3::new(all[0], all[1], all[2]);
    let b = Vec3::new(all[3], all[4], all[5]);
    SpatialPose::facing((a + b) * 0.5, b - a)
}

/// Returns a frame at a global point that faces one or two directions. `components` are the
/// components of the point, then of the directions.
pub(crate) fn facing(components: impl Iterator<Item = f64>) -> SpatialPose {
    let all: Vec<f64> = components.collect();
    let (r, directions) = all.split_at(all.len().min(3));
    let r = r.first_chunk::<3>().copied().unwrap_or([f64::NAN; 3]);
    SpatialPose::facing(r, Axis::given(directions))
}

impl Mechanism {
    /// Returns the local position ū of a global point in a body at its drawn pose. \[m\]
    ///
    /// The drawn pose is the guess from the declaration, or a later guess that replaced it.
    ///
    /// Errors: the body belongs to another mechanism.
    pub fn local<B: Body>(&self, body: B, point: impl Into<B::Vector>) -> Result<B::Vector> {
        self.drawn(body).map(|q| B::local(point.into(), q))
    }

    /// Returns the local direction h̄ of a global direction in a body at its drawn pose.
    ///
    /// Errors: the body belongs to another mechanism.
    pub fn local_direction<B: Body>(&self, body: B, h: impl Into<B::Vector>) -> Result<B::Vector> {
        self.drawn(body).map(|q| B::local_direction(h.into(), q))
    }

    /// Creates a marker of a body from a global point and a global direction, for the body at its
    /// drawn pose. \[m, –\]
    ///
    /// Errors: the body belongs to another mechanism, the name is empty.
    pub fn marker<B: Body + Copy>(
        &self,
        name: &str,
        body: B,
        point: impl Into<B::Vector>,
        h: impl Into<B::Vector>,
    ) -> Result<Marker<B>> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "marker" });
        }
        Ok(Marker::new(name, body, self.local(body, point)?, self.local_direction(body, h)?))
    }

    /// Adds a planar body between two pins at the global points `a` and `b`. \[m\]
    ///
    /// The length of the body is the distance of the points. The frame of the body is in the
    /// middle, with the x-axis from `a` to `b`. If a component is a [`crate::Dimension`], length
    /// and guess depend on the dimension.
    ///
    /// Errors: the points coincide or are not finite, the name is empty or taken, a dimension
    /// belongs to another mechanism.
    pub fn link_between<S: Scalar + Mix<T>, T: Scalar>(
        &mut self,
        name: &str,
        a: impl Components<2, Scalar = S>,
        b: impl Components<2, Scalar = T>,
    ) -> Result<Link<Mixed<S, T>>>
    where
        Mixed<S, T>: IntoNumber,
    {
        let a: [Mixed<S, T>; 2] = a.components().map(|x| <Mixed<S, T> as From<S>>::from(x));
        let b: [Mixed<S, T>; 2] = b.components().map(|x| <Mixed<S, T> as From<T>>::from(x));
        let a = Vec2::from(a);
        let b = Vec2::from(b);
        self.link_at(name, (b.x - a.x).hypot(b.y - a.y), Pose::between(a, b))
    }

    /// Adds a spatial body between two joints at the global points `a` and `b`. \[m\]
    ///
    /// The length of the body is the distance of the points. The frame of the body is in the
    /// middle, with the x-axis from `a` to `b`. If a component is a [`crate::Dimension`], length
    /// and guess depend on the dimension.
    ///
    /// Errors: the points coincide or are not finite, the name is empty or taken, a dimension
    /// belongs to another mechanism.
    pub fn spatial_link_between<S: Scalar + Mix<T>, T: Scalar>(
        &mut self,
        name: &str,
        a: impl Components<3, Scalar = S>,
        b: impl Components<3, Scalar = T>,
    ) -> Result<SpatialLink<Mixed<S, T>>>
    where
        Mixed<S, T>: IntoNumber,
    {
        let a: [Mixed<S, T>; 3] = a.components().map(|x| <Mixed<S, T> as From<S>>::from(x));
        let b: [Mixed<S, T>; 3] = b.components().map(|x| <Mixed<S, T> as From<T>>::from(x));
        let length = (Vec3::from(b) - Vec3::from(a)).norm();
        let number = self.check_length(name, length.into_number())?;
        let points = [a, b].map(|point| point.map(IntoNumber::into_number));
        points.as_flattened().iter().try_for_each(|x| self.check_origin(name, *x))?;
        let body = self.spatial(name, between(points.as_flattened().iter().map(|x| x.value())))?;
        self.note_length(name, body.index, number)?;
        if let Some(index) = body.index {
            let first = self.layout.items[index].first;
            self.hang_pose(name, points.as_flattened(), |part| Bound::Between { first, part })?;
        }
        Ok(SpatialLink { body, length })
    }

    /// Returns the coordinates of a body as it is drawn; the ground has none.
    fn drawn<B: Body>(&self, body: B) -> Result<&[f64]> {
        let target = body.target();
        match self.layout.place(&target) {
            Some(Place::Own { first, .. }) => {
                Ok(self.initial.get(first..first + target.columns()).unwrap_or_default())
            }
            Some(Place::Ground(_)) => Ok(&[]),
            None => {
                let mechanism = self.name.clone();
                let place = "marker".to_string();
                let argument = "body".to_string();
                Err(Error::ForeignBody { mechanism, place, argument })
            }
        }
    }
}
