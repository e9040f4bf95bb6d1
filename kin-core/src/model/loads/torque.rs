//! Defines the types of forces and torques, in the plane and in space, as constants or laws of
//! time.

use crate::dimensions::IntoNumber;
use crate::law::Law;
use crate::model::body::Vector;
use crate::numbers::algebra::{Vec2, Vec3};

/// A vector of the plane or of space, with the type of a torque: a number in the plane, a vector in
/// space.
pub trait HasTorque: Vector {
    /// A number in the plane, a vector in space.
    type Torque: Copy;

    #[doc(hidden)]
    fn vector(v: Vec3) -> Self;

    #[doc(hidden)]
    fn torque(v: Vec3) -> Self::Torque;

    #[doc(hidden)]
    fn lifted(self) -> Vec3;

    /// The names of the components of force and torque, with their indices among the six.
    #[doc(hidden)]
    const COMPONENTS: &'static [(&'static str, usize)];
}

impl HasTorque for Vec2 {
    type Torque = f64;

    fn vector(v: Vec3) -> Vec2 {
        Vec2::new(v.x, v.y)
    }

    fn torque(v: Vec3) -> f64 {
        v.z
    }

    fn lifted(self) -> Vec3 {
        Vec3::new(self.x, self.y, 0.0)
    }

    const COMPONENTS: &'static [(&'static str, usize)] = &[("F_x", 0), ("F_y", 1), ("T", 5)];
}

impl HasTorque for Vec3 {
    type Torque = Vec3;

    fn vector(v: Vec3) -> Vec3 {
        v
    }

    fn torque(v: Vec3) -> Vec3 {
        v
    }

    fn lifted(self) -> Vec3 {
        self
    }

    const COMPONENTS: &'static [(&'static str, usize)] =
        &[("F_x", 0), ("F_y", 1), ("F_z", 2), ("T_x", 3), ("T_y", 4), ("T_z", 5)];
}

/// A force or a torque that is constant or given by laws of time.
///
/// A force is a vector or one law for each component. A torque is a number or a law in the plane,
/// and a vector or three laws in space.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a force or torque",
    label = "give a vector of numbers or an array of laws: `vec2(0.0, -5.0)`, `[Law::constant(0.0), Law::sine(5.0, 2.0, 0.0)]`"
)]
pub trait ByLaws<T> {
    /// Returns three laws; in the plane the laws of the missing components are zero.
    #[doc(hidden)]
    fn laws(self) -> [Law; 3];
}

fn zero() -> Law {
    Law::constant(0.0)
}

impl<S: IntoNumber> ByLaws<Vec2> for Vec2<S> {
    fn laws(self) -> [Law; 3] {
        [Law::constant(self.x), Law::constant(self.y), zero()]
    }
}

impl ByLaws<Vec2> for [Law; 2] {
    fn laws(self) -> [Law; 3] {
        let [x, y] = self;
        [x, y, zero()]
    }
}

impl<S: IntoNumber> ByLaws<Vec3> for Vec3<S> {
    fn laws(self) -> [Law; 3] {
        [self.x, self.y, self.z].map(Law::constant)
    }
}

impl ByLaws<Vec3> for [Law; 3] {
    fn laws(self) -> [Law; 3] {
        self
    }
}

impl<S: IntoNumber> ByLaws<f64> for S {
    fn laws(self) -> [Law; 3] {
        [zero(), zero(), Law::constant(self)]
    }
}

impl ByLaws<f64> for Law {
    fn laws(self) -> [Law; 3] {
        [zero(), zero(), self]
    }
}
