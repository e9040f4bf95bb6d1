//! Bodies with points that results can follow.

use crate::coordinates::{Link, PlanarBody, SpatialBody, SpatialLink, Target};
use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{Scalar, Vec2, Vec3};
use crate::numbers::real::{Dual3_64, Real};

/// A vector of the plane or of space.
pub trait Vector: Copy {
    /// The names of the components.
    const NAMES: &'static [&'static str];
    /// Returns component k.
    fn component(&self, k: usize) -> f64;
}

impl Vector for Vec2 {
    const NAMES: &'static [&'static str] = &["x", "y"];

    fn component(&self, k: usize) -> f64 {
        if k == 0 { self.x } else { self.y }
    }
}

impl Vector for Vec3 {
    const NAMES: &'static [&'static str] = &["x", "y", "z"];

    fn component(&self, k: usize) -> f64 {
        [self.x, self.y, self.z].get(k).copied().unwrap_or(0.0)
    }
}

/// The coordinates of a body and their derivatives at one time. The lists of the ground are empty.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct Course<'a> {
    /// q
    pub q: &'a [f64],
    /// q̇
    pub qd: &'a [f64],
    /// q̈
    pub qdd: &'a [f64],
    /// q⃛; empty if the caller does not need the jerk.
    pub qddd: &'a [f64],
}

/// A body with points that results can follow.
pub trait Body {
    /// `Vec2` or `Vec3`.
    type Vector: Vector;

    /// Returns the place of the handle in a mechanism.
    #[doc(hidden)]
    fn target(self) -> Target;

    /// Returns the position, velocity, acceleration and jerk of the local point u from the
    /// coordinates of the body and their derivatives.
    ///
    /// If `course` has no q⃛, the returned jerk is meaningless.
    #[doc(hidden)]
    fn point(u: Self::Vector, course: Course<'_>) -> [Self::Vector; 4];

    /// Returns the local position ū of a global point, for the body at coordinates q (empty for the
    /// ground).
    #[doc(hidden)]
    fn local(point: Self::Vector, q: &[f64]) -> Self::Vector;

    /// Returns the local direction h̄ of a global direction, for the body at coordinates q (empty
    /// for the ground).
    #[doc(hidden)]
    fn local_direction(h: Self::Vector, q: &[f64]) -> Self::Vector;
}

impl Body for PlanarBody {
    type Vector = Vec2;

    fn target(self) -> Target {
        Target::Planar(self)
    }

    /// r = R + A ū, v = Ṙ + θ̇ A_θ ū, a = R̈ + θ̈ A_θ ū − θ̇² A ū (lecture, "Velocity" and
    /// "Acceleration"), and from there ȧ = R⃛ + (θ⃛ − θ̇³) A_θ ū − 3 θ̇ θ̈ A ū
    fn point(u: Vec2, Course { q, qd, qdd, qddd }: Course<'_>) -> [Vec2; 4] {
        let (&[x, y, theta], &[vx, vy, w], &[ax, ay, alpha]) = (q, qd, qdd) else {
            return still(u);
        };
        let [jx, jy, zeta] = qddd.first_chunk().copied().unwrap_or_default();
        let au = PlanarState::new([x, y, theta]).direction(u);
        // A_θ ū is A ū rotated by 90°.
        let turned = Vec2::new(-au.y, au.x);
        let across = zeta - w * w * w;
        let along = 3.0 * w * alpha;
        [
            Vec2::new(x + au.x, y + au.y),
            Vec2::new(vx + w * turned.x, vy + w * turned.y),
            Vec2::new(ax + alpha * turned.x - w * w * au.x, ay + alpha * turned.y - w * w * au.y),
            Vec2::new(jx + across * turned.x - along * au.x, jy + across * turned.y - along * au.y),
        ]
    }

    fn local(point: Vec2, q: &[f64]) -> Vec2 {
        q.first_chunk().map_or(point, |q| PlanarState::new(*q).local(point))
    }

    fn local_direction(h: Vec2, q: &[f64]) -> Vec2 {
        q.first_chunk().map_or(h, |q| PlanarState::new(*q).a().transpose() * h)
    }
}

/// A link delegates to its body.
macro_rules! as_its_body {
    ([$of:ident] $link:ty, $vector:ident, $body:ident) => {
        impl<$of: Scalar> Body for $link {
            type Vector = $vector;

            fn target(self) -> Target {
                self.body().target()
            }

            fn point(u: $vector, course: Course<'_>) -> [$vector; 4] {
                $body::point(u, course)
            }

            fn local(point: $vector, q: &[f64]) -> $vector {
                $body::local(point, q)
            }

            fn local_direction(h: $vector, q: &[f64]) -> $vector {
                $body::local_direction(h, q)
            }
        }
    };
}

as_its_body!([L] Link<L>, Vec2, PlanarBody);
as_its_body!([L] SpatialLink<L>, Vec3, SpatialBody);

impl Body for SpatialBody {
    type Vector = Vec3;

    fn target(self) -> Target {
        Target::Spatial(self)
    }

    /// Computes r = R + A(p) ū and its derivatives along p(t) with third-order dual numbers.
    fn point(u: Vec3, course: Course<'_>) -> [Vec3; 4] {
        let Some(jets) = jets(course) else { return still(u) };
        let r = SpatialState::new(jets).point(u);
        let order =
            |part: fn(&Dual3_64) -> f64| Vec3::new(part(&r.x.0), part(&r.y.0), part(&r.z.0));
        [order(|x| x.re), order(|x| x.v1), order(|x| x.v2), order(|x| x.v3)]
    }

    fn local(point: Vec3, q: &[f64]) -> Vec3 {
        q.first_chunk().map_or(point, |q| SpatialState::new(*q).local(point))
    }

    fn local_direction(h: Vec3, q: &[f64]) -> Vec3 {
        q.first_chunk().map_or(h, |q| SpatialState::new(*q).a().transpose() * h)
    }
}

/// A point of the ground is at rest.
fn still<V: Default>(u: V) -> [V; 4] {
    [u, V::default(), V::default(), V::default()]
}

/// Returns the coordinates of a body as dual numbers along the motion; q⃛ counts as zero if it is
/// missing. Returns `None` unless q, q̇ and q̈ have N numbers each.
fn jets<const N: usize>(course: Course<'_>) -> Option<[Real<Dual3_64>; N]> {
    let qddd = course.qddd.first_chunk().unwrap_or(&[0.0; N]);
    let q = course.q.first_chunk::<N>()?;
    let qd = course.qd.first_chunk::<N>()?;
    let qdd = course.qdd.first_chunk::<N>()?;
    Some(std::array::from_fn(|k| Real(Dual3_64::new(q[k], qd[k], qdd[k], qddd[k]))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planar_formulas_are_the_derivatives_along_the_motion() {
        let course = Course {
            q: &[0.3, -1.2, 2.1],
            qd: &[0.7, 0.2, -3.0],
            qdd: &[1.5, -0.4, 11.0],
            qddd: &[-6.0, 2.5, 70.0],
        };
        let u = Vec2::new(0.4, -0.9);
        let exact = PlanarState::new(jets(course).unwrap()).point(u);
        for (order, found) in PlanarBody::point(u, course).into_iter().enumerate() {
            for (found, exact) in [(found.x, exact.x.0), (found.y, exact.y.0)] {
                let exact = [exact.re, exact.v1, exact.v2, exact.v3][order];
                assert!((found - exact).abs() < 1e-13 * (1.0 + exact.abs()), "{found} {exact}");
            }
        }
    }

    #[test]
    fn spatial_point_turns_like_the_planar_one_about_z() {
        let theta = 0.7_f64;
        let w = 1.3;
        let alpha = -2.0;
        let (s, c) = (0.5 * theta).sin_cos();
        // p = (cos θ/2, 0, 0, sin θ/2)
        let p = [c, 0.0, 0.0, s];
        let pd = [-0.5 * w * s, 0.0, 0.0, 0.5 * w * c];
        let pdd =
            [-0.5 * alpha * s - 0.25 * w * w * c, 0.0, 0.0, 0.5 * alpha * c - 0.25 * w * w * s];
        let join = |r: [f64; 3], p: [f64; 4]| [r[0], r[1], r[2], p[0], p[1], p[2], p[3]];
        let orders =
            [join([0.3, -1.2, 5.0], p), join([0.7, 0.2, 0.0], pd), join([1.5, -0.4, 0.0], pdd)];
        let [q, qd, qdd] = &orders;
        let spatial =
            SpatialBody::point(Vec3::new(0.4, -0.9, 0.2), Course { q, qd, qdd, qddd: &[] });
        let planar = PlanarBody::point(
            Vec2::new(0.4, -0.9),
            Course {
                q: &[0.3, -1.2, theta],
                qd: &[0.7, 0.2, w],
                qdd: &[1.5, -0.4, alpha],
                qddd: &[],
            },
        );
        let spatial = &spatial[..3];
        let planar = &planar[..3];
        for (spatial, planar) in spatial.iter().zip(planar) {
            assert!((spatial.x - planar.x).abs() < 1e-14 && (spatial.y - planar.y).abs() < 1e-14);
        }
        assert!((spatial[0].z - 5.2).abs() + spatial[1].z.abs() + spatial[2].z.abs() < 1e-14);
    }
}
