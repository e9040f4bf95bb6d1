//! An axis of a spatial body, with the directions across it.

use super::{Components, Mix, Mixed, Scalar, Vec3};

/// A direction in a spatial body with two others across it: unit vectors h, f and g = h × f, all
/// local to the body.   \[–\]
///
/// f is where angles about h are measured from, by the right-hand rule. They are worked out once,
/// when the axis is made: a joint whose kept components depended on the pose would lose rank at
/// some of them. Any `Vec3` is an axis with an f of Kin's choice (x for z, y for x, z for y);
/// [`Axis::new`] chooses f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<T = f64> {
    /// Along the axis.
    pub h: Vec3<T>,
    /// Across it: angles about h count from here.
    pub f: Vec3<T>,
    /// h × f: an angle of 90°.
    pub g: Vec3<T>,
}

impl Axis {
    /// The axis along `h`; `f` is made perpendicular to it. A direction that is zero, or an `f`
    /// along `h`, gives vectors that are not numbers, which a mechanism refuses by name.
    pub fn new<S: Scalar + Mix<T>, T: Scalar>(
        h: impl Components<3, Scalar = S>,
        f: impl Components<3, Scalar = T>,
    ) -> Axis<Mixed<S, T>> {
        let h: [Mixed<S, T>; 3] = h.components().map(|x| <Mixed<S, T> as From<S>>::from(x));
        let f: [Mixed<S, T>; 3] = f.components().map(|x| <Mixed<S, T> as From<T>>::from(x));
        Axis::of(h.into(), f.into())
    }

    /// The axis along `h`, with an f of Kin's choice: across h, nearest to the axis of the body's
    /// frame that follows h's largest component.
    pub fn along(h: impl Into<Vec3>) -> Self {
        Axis::of_direction(h.into())
    }

    /// The name of number `part` of the nine of an axis: `NAME.h.x`, …, `NAME.g.z`.
    pub(crate) fn name_of(name: &str, part: usize) -> String {
        let pick = |of: [&'static str; 3], k: usize| of.get(k).copied().unwrap_or_default();
        format!("{name}.{}.{}", pick(["h", "f", "g"], part / 3), pick(["x", "y", "z"], part % 3))
    }

    /// True if the vectors are numbers: the directions that made the axis were neither zero nor
    /// parallel.
    pub(crate) fn is_sound(&self) -> bool {
        [self.h, self.f].iter().all(|v| v.to_array().iter().all(|x| x.is_finite()))
    }
}

impl<T: Scalar> Vec3<T> {
    /// The axis along a direction that does not move: [`Axis::along`] for any numbers, for measures
    /// of joints that hold the direction alone.
    pub fn axis(self) -> Axis<T> {
        Axis::along(self.plain()).map(|v| v.map(Into::into))
    }

    /// The same with f as near to another direction as may be, the part of it across the axis;
    /// where there is none, f is of Kin's choice.
    pub fn axis_near(self, f: Vec3<T>) -> Axis<T> {
        let chosen = Axis::new(self.plain(), f.plain());
        let axis = if chosen.is_sound() { chosen } else { Axis::along(self.plain()) };
        axis.map(|v| v.map(Into::into))
    }

    /// Its components as plain numbers.
    fn plain(self) -> Vec3 {
        Vec3::new(self.x.value(), self.y.value(), self.z.value())
    }
}

impl<T: Scalar> Axis<T> {
    /// [`Axis::along`] of any numbers; f is chosen by their values.
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

    /// The axis by three components of h, or by three of h and three of f.
    pub(crate) fn given(components: &[T]) -> Self {
        let vector =
            |from: usize| components.get(from..).and_then(|rest| rest.first_chunk::<3>()).copied();
        match (vector(0), vector(3)) {
            (Some(h), Some(f)) => Axis::of(h.into(), f.into()),
            (Some(h), None) => Axis::of_direction(h.into()),
            (None, _) => Axis::of_direction([T::from(f64::NAN); 3].into()),
        }
    }

    /// [`Axis::new`] of numbers of one kind.
    pub(crate) fn of(h: Vec3<T>, f: Vec3<T>) -> Self {
        let h = unit(h);
        let f = unit(f);
        let f = across(h, f);
        Axis { h, f, g: h.cross(f) }
    }

    /// Its nine numbers in the order of their names.
    pub(crate) fn numbers(self) -> [T; 9] {
        let Axis { h, f, g } = self;
        [h.x, h.y, h.z, f.x, f.y, f.z, g.x, g.y, g.z]
    }

    /// An axis of other numbers.
    pub(crate) fn map<S>(self, number: impl Fn(Vec3<T>) -> Vec3<S>) -> Axis<S> {
        Axis { h: number(self.h), f: number(self.f), g: number(self.g) }
    }
}

impl<V: Into<Vec3>> From<V> for Axis {
    fn from(h: V) -> Self {
        Axis::along(h)
    }
}

/// v/|v|, whatever its size; not a number if it is zero.
fn unit<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    let largest = v.to_array().iter().fold(0.0_f64, |m, x| m.max(x.value().abs()));
    let v = v / T::from(largest);
    v / v.norm()
}

/// The part of a unit vector `f` across the unit vector `h`, of length one; not a number if there
/// is none.
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
