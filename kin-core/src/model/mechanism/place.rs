//! Bodies placed by points, and points found in bodies as they are drawn: frames at mid-link are
//! where people slip.

use super::{Mechanism, Pose, SpatialPose};
use crate::model::body::Body;
use crate::model::coordinates::{Link, SpatialLink};
use crate::model::dimension::{Bound, IntoNumber};
use crate::model::error::{Error, Result};
use crate::model::layout::Place;
use crate::numbers::algebra::{Axis, Components, Mix, Mixed, Scalar, Vec2, Vec3};

/// A named point of a body and a direction there, both in the body's frame.
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
    /// Its name, for files and figures.
    pub name: String,
    /// The body.
    pub body: B,
    /// Local position.   \[m\]
    pub u: B::Vector,
    /// Local direction, of any length.   \[–\]
    pub h: B::Vector,
}

impl<B: Body> Marker<B> {
    /// A marker by local position and direction; [`Mechanism::marker`] takes global ones.
    pub fn new(name: &str, body: B, u: impl Into<B::Vector>, h: impl Into<B::Vector>) -> Self {
        Marker { name: name.to_string(), body, u: u.into(), h: h.into() }
    }
}

/// Frame at the middle between two global points in space, x-axis from the first to the second, by
/// their six components.
pub(crate) fn between(components: impl Iterator<Item = f64>) -> SpatialPose {
    let mut all = [f64::NAN; 6];
    all.iter_mut().zip(components).for_each(|(to, x)| *to = x);
    let a = Vec3::new(all[0], all[1], all[2]);
    let b = Vec3::new(all[3], all[4], all[5]);
    SpatialPose::facing((a + b) * 0.5, b - a)
}

/// Frame at a global point in space, facing the direction or the two directions that follow its
/// three components.
pub(crate) fn facing(components: impl Iterator<Item = f64>) -> SpatialPose {
    let all: Vec<f64> = components.collect();
    let (r, directions) = all.split_at(all.len().min(3));
    let r = r.first_chunk::<3>().copied().unwrap_or([f64::NAN; 3]);
    SpatialPose::facing(r, Axis::given(directions))
}

impl Mechanism {
    /// ū, where a global point is in a body as it is drawn: at the pose it was declared with or
    /// given since.   \[m\]
    ///
    /// Errors: a body of another mechanism.
    pub fn local<B: Body>(&self, body: B, point: impl Into<B::Vector>) -> Result<B::Vector> {
        self.drawn(body).map(|q| B::local(point.into(), q))
    }

    /// h̄, a global direction as a body sees it where it is drawn.
    ///
    /// Errors: a body of another mechanism.
    pub fn local_direction<B: Body>(&self, body: B, h: impl Into<B::Vector>) -> Result<B::Vector> {
        self.drawn(body).map(|q| B::local_direction(h.into(), q))
    }

    /// A marker at a global point, with a global direction, of a body as it is drawn.   \[m, –\]
    ///
    /// Errors: a body of another mechanism, name empty.
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

    /// A planar body between two pins at the global points `a` and `b`: their distance is its
    /// length, frame at the middle, x-axis from `a` to `b`. With a [`crate::Dimension`] in them
    /// length and guess hang on it.   \[m\]
    ///
    /// Errors: points that coincide or are not finite, name empty or taken, a dimension of another
    /// mechanism.
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

    /// A spatial body between two joints at the global points `a` and `b`: their distance is its
    /// length, frame at the middle, x-axis from `a` to `b`. With a [`crate::Dimension`] in them
    /// length and guess hang on it.   \[m\]
    ///
    /// Errors: points that coincide or are not finite, name empty or taken, a dimension of another
    /// mechanism.
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

    /// The coordinates of a body as it is drawn; none of the ground's.
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
