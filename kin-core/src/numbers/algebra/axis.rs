//! Defines the axis of a spatial body, with two directions perpendicular to the axis.

use super::{Components, Mix, Mixed, Scalar, Vec3};

/// A direction h in a spatial body, with two perpendicular unit vectors f and g = h × f, all in the
/// frame of the body. \[–\]
///
/// An angle about h is zero at f and positive by the right-hand rule. The constructor computes f
/// and g once. If a joint computed f and g from the pose, the equations of the joint would lose
/// rank at some poses. If you pass a `Vec3` as an axis, Kin chooses f (x for z, y for x, z for y);
/// [`Axis::new`] sets f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<T = f64> {
    /// The unit vector along the axis.
    pub h: Vec3<T>,
    /// The unit vector perpendicular to the axis at the angle 0.
    pub f: Vec3<T>,
    /// The unit vector h × f, at the angle 90°.
    pub g: Vec3<T>,
}

impl Axis {
    /// Creates the axis along `h`, with the part of `f` perpendicular to `h` as its reference
    /// direction.
    ///
    /// If `h` is zero, or `f` is along `h`, the vectors are NaN, and a mechanism returns an error
    /// that names the axis.
    pub fn new<S: Scalar + Mix<T>, T: Scalar>(
        h: impl Components<3, Scalar = S>,
        f: impl Components<3, Scalar = T>,
    ) -> Axis<Mixed<S, T>> {
        let h: [Mixed<S, T>; 3] = h.components().map(|x| <Mixed<S, T> as From<S>>::from(x));
        let f: [Mixed<S, T>; 3] = f.components().map(|x| <Mixed<S, T> as From<T>>::from(x));
        Axis::of(h.into(), f.into())
    }

    /// Creates the axis along `h`, with an f that Kin chooses.
    ///
    /// f is the direction perpendicular to h that is nearest to an axis of the body frame: the axis
    /// after the one with the largest component of h.
    pub fn along(h: impl Into<Vec3>) -> Self {
        Axis::of_direction(h.into())
    }

    /// Returns the name of number `part` of the nine numbers of an axis: `NAME.h.x`, …, `NAME.g.z`.
    pub(crate) fn name_of(name: &str, part: usize) -> String {
        let pick = |of: [&'static str; 3], k: usize| of.get(k).copied().unwrap_or_default();
        format!("{name}.{}.{}", pick(["h", "f", "g"], part / 3), pick(["x", "y", "z"], part % 3))
    }

    /// Returns true if the vectors are finite: the given directions were neither zero nor parallel.
    pub(crate) fn is_sound(&self) -> bool {
        [self.h, self.f].iter().all(|v| v.to_array().iter().all(|x| x.is_finite()))
    }
}

impl<T: Scalar> Vec3<T> {
    /// Returns the axis along a constant direction, like [`Axis::along`] for any numbers.
    ///
    /// Measures of joints use this method if only the direction is known.
    pub fn axis(self) -> Axis<T> {
        Axis::along(self.plain()).map(|v| v.map(Into::into))
    }

    /// Returns the axis along this vector with its reference direction as close as possible to `f`.
    ///
    /// If `f` is along the axis, Kin chooses the reference direction.
    pub fn axis_near(self, f: Vec3<T>) -> Axis<T> {
        let chosen = Axis::new(self.plain(), f.plain());
        let axis = if chosen.is_sound() { chosen } else { Axis::along(self.plain()) };
        axis.map(|v| v.map(Into::into))
    }

    /// Returns the components as plain numbers.
    fn plain(self) -> Vec3 {
        Vec3::new(self.x.value(), self.y.value(), self.z.value())
    }
}

impl<T: Scalar> Axis<T> {
    /// Computes [`Axis::along`] for any numbers. Their values select f.
    fn of_direction(h: Vec3<T>) -> Self {
        let h = unit(h);
        let [x, y, z] = h.to_array().map(|x| x.value().abs());
        let after_the_largest = match (x > y, y > z, z >= x) {
            (true, _, false) => Vec3::y(),
            (false, true, _) => Vec3::z(),
            _ => Vec3::x(),
        };
        Axis::of(h, after_the_largest.map(T::from))
    }

    /// Returns the axis from three components of h, or from three of h and three of f.
    pub(crate) fn given(components: &[T]) -> Self {
        let vector =
            |from: usize| components.get(from..).and_then(|rest| rest.first_chunk::<3>()).copied();
        match (vector(0), vector(3)) {
            (Some(h), Some(f)) => Axis::of(h.into(), f.into()),
            (Some(h), None) => Axis::of_direction(h.into()),
            (None, _) => Axis::of_direction([T::from(f64::NAN); 3].into()),
        }
    }

    /// Computes [`Axis::new`] for numbers of one kind.
    pub(crate) fn of(h: Vec3<T>, f: Vec3<T>) -> Self {
        let h = unit(h);
        let f = unit(f);
        let f = across(h, f);
        Axis { h, f, g: h.cross(f) }
    }

    /// Returns the nine numbers in the order of their names.
    pub(crate) fn numbers(self) -> [T; 9] {
        let Axis { h, f, g } = self;
        [h.x, h.y, h.z, f.x, f.y, f.z, g.x, g.y, g.z]
    }

    /// Applies a function to each of the three vectors.
    pub(crate) fn map<S>(self, number: impl Fn(Vec3<T>) -> Vec3<S>) -> Axis<S> {
        Axis { h: number(self.h), f: number(self.f), g: number(self.g) }
    }
}

impl<V: Into<Vec3>> From<V> for Axis {
    fn from(h: V) -> Self {
        Axis::along(h)
    }
}

/// Returns v/|v| without overflow or underflow, or NaN if v is zero.
fn unit<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    let largest = v.to_array().iter().fold(0.0_f64, |m, x| m.max(x.value().abs()));
    let v = v / T::from(largest);
    v / v.norm()
}

/// Returns the part of a unit vector `f` across the unit vector `h`, normalised, or NaN if there is
/// none.
fn across<T: Scalar>(h: Vec3<T>, f: Vec3<T>) -> Vec3<T> {
    let part = f - h * h.dot(f);
    if part.norm().value() > 1e-9 { unit(part) } else { part / T::from(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::algebra::vec3;

    fn orthonormal(axis: Axis) -> bool {
        let Axis { h, f, g } = axis;
        let right_handed = h.cross(f).dot(g);
        [
            h.norm() - 1.0,
            f.norm() - 1.0,
            g.norm() - 1.0,
            h.dot(f),
            h.dot(g),
            f.dot(g),
            right_handed - 1.0,
        ]
        .iter()
        .all(|x| x.abs() < 1e-15)
    }

    #[test]
    fn vectors_are_orthonormal_and_right_handed() {
        for h in [
            vec3(0.0, 0.0, 1.0),
            vec3(1e-200, 2e-200, 0.0),
            vec3(1.0, 1.0, 1.0),
            vec3(-3e150, 1e150, 2e150),
            vec3(1.0, -1.0, 0.0),
        ] {
            assert!(orthonormal(Axis::along(h)), "{h:?}: {:?}", Axis::along(h));
        }
        assert!(orthonormal(Axis::new(vec3(0.0, 0.0, 2.0), vec3(1.0, 1.0, 5.0))));
    }

    #[test]
    fn the_frames_axes_follow_one_another() {
        assert_eq!(Axis::along(Vec3::z()).f, Vec3::x());
        assert_eq!(Axis::along(Vec3::x()).f, Vec3::y());
        assert_eq!(Axis::along(Vec3::y()).f, Vec3::z());
    }

    #[test]
    fn unsound_directions_are_told() {
        let zero = vec3(0.0, 0.0, 0.0);
        assert!(
            !Axis::along(zero).is_sound() && !Axis::new(Vec3::z(), vec3(0.0, 0.0, -2.0)).is_sound()
        );
        assert!(
            !Axis::along(vec3(f64::NAN, 0.0, 1.0)).is_sound()
                && !Axis::new(Vec3::z(), zero).is_sound()
        );
        assert!(Axis::along(vec3(0.0, 1.0, 0.0)).is_sound());
    }
}
