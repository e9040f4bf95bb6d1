//! Defines poses of bodies, and helpers for the numbers of a model.

use super::place::facing;
use crate::dimensions::{Dimension, IntoNumber};
use crate::numbers::algebra::{
    Axis, Components, EulerParameters, Mat3, Mix, Mixed, Scalar, Vec2, Vec3,
};

/// The position and angle of a planar body: (R_x, R_y, θ). \[m, m, rad\]
///
/// Each component is a number or a [`crate::Dimension`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose<X = f64, Y = f64, A = f64> {
    /// R_x   \[m\]
    pub x: X,
    /// R_y   \[m\]
    pub y: Y,
    /// θ, counter-clockwise from the global x-axis.   \[rad\]
    pub theta: A,
}

/// Creates the pose (R_x, R_y, θ) of a planar body. \[m, m, rad\]
pub fn pose<X: IntoNumber, Y: IntoNumber, A: IntoNumber>(x: X, y: Y, theta: A) -> Pose<X, Y, A> {
    Pose { x, y, theta }
}

impl<S: Scalar> Pose<S, S, S> {
    /// Returns a frame in the middle between two global points, with its x-axis from `a` to `b`.
    pub(crate) fn between(a: Vec2<S>, b: Vec2<S>) -> Self {
        Pose { x: (a.x + b.x) * 0.5, y: (a.y + b.y) * 0.5, theta: (b.y - a.y).atan2(b.x - a.x) }
    }
}

/// The position and Euler parameters of a spatial body: (R, e0, e1, e2, e3), scalar first. \[m, –\]
///
/// Each number is an `f64` or a [`crate::Dimension`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialPose<R = f64, P = f64> {
    /// R   \[m\]
    pub r: Vec3<R>,
    /// The Euler parameters p, of any length except zero; a mechanism normalises p.
    pub p: EulerParameters<P>,
}

impl SpatialPose {
    /// Creates the pose with the position R and the Euler parameters p. \[m, –\]
    pub fn new<R: Scalar, P: Scalar>(
        r: impl Components<3, Scalar = R>,
        p: EulerParameters<P>,
    ) -> SpatialPose<R, P> {
        SpatialPose { r: Vec3::from(r.components()), p }
    }

    /// Creates the pose with the position R and the axes of the global frame: p = (1, 0, 0, 0).
    /// \[m\]
    pub fn at<R: Scalar>(r: impl Components<3, Scalar = R>) -> SpatialPose<R> {
        SpatialPose::new(r, EulerParameters::new(1.0, 0.0, 0.0, 0.0))
    }

    /// Creates the pose with the position R and a rotation by `angle` φ about the direction `axis`:
    /// p = (cos φ/2, n sin φ/2). \[m, rad\]
    ///
    /// A zero axis means no rotation.
    pub fn turned<R: Scalar, P: Scalar + Mix<A>, A: Scalar>(
        r: impl Components<3, Scalar = R>,
        axis: impl Components<3, Scalar = A>,
        angle: P,
    ) -> SpatialPose<R, Mixed<P, A>> {
        let axis = axis.components();
        let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.value().abs()));
        if largest == 0.0 {
            return SpatialPose::new(
                r,
                EulerParameters::new(1.0, 0.0, 0.0, 0.0).map(<Mixed<P, A> as From<f64>>::from),
            );
        }
        let [x, y, z] = axis.map(|x| x / largest);
        let (sin, cos) = (angle * 0.5).sin_cos();
        let share = sin / (x * x + y * y + z * z).sqrt();
        let [e1, e2, e3] = [x, y, z].map(|x| share * <Mixed<P, A> as From<A>>::from(x));
        SpatialPose::new(r, EulerParameters { e0: cos.into(), e1, e2, e3 })
    }

    /// Creates the pose at R with the x-axis of the body along h of an axis and its y-axis along f.
    /// \[m, –\]
    ///
    /// With `SpatialPose::facing(r, vec3(1.0, 1.0, 0.0))` Kin chooses f. With
    /// `SpatialPose::facing(r, Axis::new(h, f))` you set both directions. If a direction contains a
    /// [`Dimension`], the result is a [`Facing`], which a mechanism accepts as a pose.
    pub fn facing<R: IntoNumber, D: Direction>(
        r: impl Components<3, Scalar = R>,
        x: D,
    ) -> D::Pose<R> {
        x.pose(Vec3::from(r.components()))
    }
}

/// A value that gives one or two directions that a spatial body faces.
#[diagnostic::on_unimplemented(
    message = "expected an axis, but found `{Self}`",
    label = "not an axis",
    note = "give a direction such as `vec3(1.0, 0.0, 0.0)`, or `Axis::new(h, f)` with a second direction f across h"
)]
pub trait Direction {
    /// The type of the pose of a body that faces the direction.
    type Pose<R: IntoNumber>;

    #[doc(hidden)]
    fn pose<R: IntoNumber>(self, r: Vec3<R>) -> Self::Pose<R>;
}

#[diagnostic::do_not_recommend]
impl<A: Into<Axis>> Direction for A {
    type Pose<R: IntoNumber> = SpatialPose<R>;

    fn pose<R: IntoNumber>(self, r: Vec3<R>) -> SpatialPose<R> {
        let Axis { h, f, g } = self.into();
        SpatialPose::new(r, EulerParameters::from_rotation(Mat3::from_columns([h, f, g])))
    }
}

/// The pose of a spatial body that faces directions with dimensions ([`SpatialPose::facing`]).
///
/// If a dimension changes, Kin rotates the body accordingly.
#[derive(Clone, Debug, PartialEq)]
pub struct Facing {
    /// The components of R, then of one or two directions.
    numbers: Vec<Dimension>,
}

impl Facing {
    fn of(r: [Dimension; 3], directions: &[Dimension]) -> Facing {
        Facing { numbers: [&r, directions].concat() }
    }
}

#[diagnostic::do_not_recommend]
impl Direction for Axis<Dimension> {
    type Pose<R: IntoNumber> = Facing;

    fn pose<R: IntoNumber>(self, r: Vec3<R>) -> Facing {
        let directions = [self.h, self.f].map(Vec3::to_array).concat();
        Facing::of(r.to_array().map(IntoNumber::into_number), &directions)
    }
}

/// Directions that contain dimensions.
macro_rules! directions {
    ($($direction:ty)*) => {$(
        #[diagnostic::do_not_recommend]
        impl Direction for $direction {
            type Pose<R: IntoNumber> = Facing;

            fn pose<R: IntoNumber>(self, r: Vec3<R>) -> Facing {
                let direction = self.components().map(IntoNumber::into_number);
                Facing::of(r.to_array().map(IntoNumber::into_number), &direction)
            }
        }
    )*};
}

directions! {
    Vec3<Dimension> [Dimension; 3] (Dimension, Dimension, Dimension)
    (Dimension, f64, f64) (f64, Dimension, f64) (f64, f64, Dimension)
    (f64, Dimension, Dimension) (Dimension, f64, Dimension) (Dimension, Dimension, f64)
}

/// A value that gives the pose of a spatial body: a [`SpatialPose`] or a [`Facing`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a pose of a spatial body",
    label = "write `SpatialPose::at(r)`, `SpatialPose::turned(r, axis, angle)` or `SpatialPose::facing(r, x)`"
)]
pub trait IntoSpatialPose {
    #[doc(hidden)]
    fn drawn(self) -> Drawn;
}

/// A pose in the form that a mechanism stores.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The coordinates; plain numbers if the body faces a direction.
    pub(crate) coordinates: [Dimension; 7],
    /// The numbers from which Kin computes the pose; empty if the coordinates are given directly.
    pub(crate) facing: Vec<Dimension>,
}

impl<R: IntoNumber, P: IntoNumber> IntoSpatialPose for SpatialPose<R, P> {
    fn drawn(self) -> Drawn {
        Drawn { coordinates: self.coordinates(), facing: Vec::new() }
    }
}

impl IntoSpatialPose for Facing {
    fn drawn(self) -> Drawn {
        let pose = facing(self.numbers.iter().map(|x| x.value()));
        Drawn { coordinates: pose.coordinates().map(|x| x.value().into()), facing: self.numbers }
    }
}

impl<R: IntoNumber, P: IntoNumber> SpatialPose<R, P> {
    /// Returns (R, p/|p|) as coordinates; they are not finite if p = 0.
    pub(crate) fn coordinates(self) -> [Dimension; 7] {
        let p = [self.p.e0, self.p.e1, self.p.e2, self.p.e3];
        let largest = p.iter().fold(0.0_f64, |m, e| m.max(e.value().abs()));
        let p = p.map(|e| e / largest);
        let norm = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]).sqrt();
        let [x, y, z] = [self.r.x, self.r.y, self.r.z];
        let [e0, e1, e2, e3] = p.map(|e| e / norm);
        let r = [x, y, z].map(R::into_number);
        let p = [e0, e1, e2, e3].map(P::into_number);
        [r[0], r[1], r[2], p[0], p[1], p[2], p[3]]
    }
}

/// Converts degrees to radians: x π/180.
pub fn deg(x: f64) -> f64 {
    x.to_radians()
}

/// Returns `n` evenly spaced numbers from `a` to `b`, with both ends exact.
///
/// For n = 1 the result is `[a]`, and for n = 0 the result is empty.
pub fn linspace(a: f64, b: f64, n: usize) -> Vec<f64> {
    let last = n.saturating_sub(1);
    (0..n)
        .map(|k| if k == last && k > 0 { b } else { a + (b - a) * (k as f64 / last.max(1) as f64) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linspace_has_both_ends() {
        assert_eq!(linspace(0.0, 1.0, 5), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(linspace(0.1, 24.0, 241)[240], 24.0);
        assert_eq!(linspace(2.0, 3.0, 1), [2.0]);
        assert!(linspace(0.0, 1.0, 0).is_empty());
    }

    #[test]
    fn euler_parameters_are_normalised() {
        let q = SpatialPose::new(
            Vec3::new(1.0, 2.0, 3.0),
            EulerParameters::new(1e200, 0.0, 1e200, 0.0),
        )
        .coordinates()
        .map(Dimension::value);
        assert!((q[3] - 0.5_f64.sqrt()).abs() < 1e-15 && (q[5] - 0.5_f64.sqrt()).abs() < 1e-15);
        let turned =
            SpatialPose::turned(Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0), deg(90.0));
        assert!(
            (turned.p.e0 - 0.5_f64.sqrt()).abs() < 1e-15
                && (turned.p.e3 - 0.5_f64.sqrt()).abs() < 1e-15
        );
    }

    #[test]
    fn link_lies_between_its_points() {
        let pose = Pose::between(Vec2::new(1.0, 1.0), Vec2::new(1.0, 3.0));
        assert_eq!((pose.x, pose.y, pose.theta), (1.0, 2.0, std::f64::consts::FRAC_PI_2));
    }
}
