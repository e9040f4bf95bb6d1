//! Points of bodies over time: r, v and a.

use num_dual::Dual2_64;

use super::{Motion, Series};
use crate::algebra::{Vec2, Vec3};
use crate::coordinates::{Link, PlanarBody, SpatialBody, SpatialLink, Target};
use crate::error::{Error, Result};
use crate::layout::Place;
use crate::mechanism::Marker;
use crate::real::Real;
use crate::state::{PlanarState, SpatialState};

/// Position, velocity and acceleration of a point of a body, one of each a time.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMotion<V> {
    times: Vec<f64>,
    r: Vec<V>,
    v: Vec<V>,
    a: Vec<V>,
}

/// A vector of the plane or of space.
pub trait Vector: Copy {
    /// Names of its components.
    const NAMES: &'static [&'static str];
    /// Component k.
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

/// A body whose points can be followed.
pub trait Body {
    /// `Vec2` or `Vec3`.
    type Vector: Vector;

    /// What it is to a mechanism.
    #[doc(hidden)]
    fn target(self) -> Target;

    /// r, v, a of the local point u where the body's coordinates, rates and second rates are these (those of the ground: none).
    #[doc(hidden)]
    fn point(u: Self::Vector, q: &[f64], qd: &[f64], qdd: &[f64]) -> [Self::Vector; 3];

    /// ū of a global point where the body's coordinates are these (those of the ground: none).
    #[doc(hidden)]
    fn local(point: Self::Vector, q: &[f64]) -> Self::Vector;

    /// h̄ of a global direction where the body's coordinates are these (those of the ground: none).
    #[doc(hidden)]
    fn local_direction(h: Self::Vector, q: &[f64]) -> Self::Vector;
}

impl Body for PlanarBody {
    type Vector = Vec2;

    fn target(self) -> Target {
        Target::Planar(self)
    }

    /// r = R + A ū,  v = Ṙ + θ̇ A_θ ū,  a = R̈ + θ̈ A_θ ū − θ̇² A ū   (lecture, "Velocity" and "Acceleration")
    fn point(u: Vec2, q: &[f64], qd: &[f64], qdd: &[f64]) -> [Vec2; 3] {
        let (&[x, y, theta], &[vx, vy, w], &[ax, ay, alpha]) = (q, qd, qdd) else {
            return [u, Vec2::new(0.0, 0.0), Vec2::new(0.0, 0.0)];
        };
        let au = PlanarState::new([x, y, theta]).direction(u);
        // A_θ ū, the 90° turn of A ū
        let turned = Vec2::new(-au.y, au.x);
        [
            Vec2::new(x + au.x, y + au.y),
            Vec2::new(vx + w * turned.x, vy + w * turned.y),
            Vec2::new(ax + alpha * turned.x - w * w * au.x, ay + alpha * turned.y - w * w * au.y),
        ]
    }

    fn local(point: Vec2, q: &[f64]) -> Vec2 {
        q.first_chunk().map_or(point, |q| PlanarState::new(*q).local(point))
    }

    fn local_direction(h: Vec2, q: &[f64]) -> Vec2 {
        q.first_chunk().map_or(h, |q| PlanarState::new(*q).a().transpose() * h)
    }
}

/// A link is followed as its body.
macro_rules! as_its_body {
    ($link:ident, $vector:ident, $body:ident) => {
        impl Body for $link {
            type Vector = $vector;

            fn target(self) -> Target {
                self.body.target()
            }

            fn point(u: $vector, q: &[f64], qd: &[f64], qdd: &[f64]) -> [$vector; 3] {
                $body::point(u, q, qd, qdd)
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

as_its_body!(Link, Vec2, PlanarBody);
as_its_body!(SpatialLink, Vec3, SpatialBody);

impl Body for SpatialBody {
    type Vector = Vec3;

    fn target(self) -> Target {
        Target::Spatial(self)
    }

    /// r = R + A(p) ū and its first two derivatives along p(t), by second-order dual numbers.
    fn point(u: Vec3, q: &[f64], qd: &[f64], qdd: &[f64]) -> [Vec3; 3] {
        let jet = |k: usize| Some(Real(Dual2_64::new(*q.get(k)?, *qd.get(k)?, *qdd.get(k)?)));
        let jets: Vec<Real<Dual2_64>> = (0..7).filter_map(jet).collect();
        let Ok(jets) = <[Real<Dual2_64>; 7]>::try_from(jets) else {
            return [u, Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.0)];
        };
        let r = SpatialState::new(jets).point(u);
        [Vec3::new(r.x.0.re, r.y.0.re, r.z.0.re), Vec3::new(r.x.0.v1, r.y.0.v1, r.z.0.v1), Vec3::new(r.x.0.v2, r.y.0.v2, r.z.0.v2)]
    }

    fn local(point: Vec3, q: &[f64]) -> Vec3 {
        q.first_chunk().map_or(point, |q| SpatialState::new(*q).local(point))
    }

    fn local_direction(h: Vec3, q: &[f64]) -> Vec3 {
        q.first_chunk().map_or(h, |q| SpatialState::new(*q).a().transpose() * h)
    }
}

impl Motion {
    /// Position, velocity and acceleration over time of the point with local position `local` of a body or link; the ground as a body
    /// is welcome too.   \[m, m/s, m/s²\]
    ///
    /// A body of another mechanism has no history here: it gives an empty one, and [`Motion::try_point`] an error.
    pub fn point<B: Body>(&self, body: B, local: impl Into<B::Vector>) -> PointMotion<B::Vector> {
        self.try_point(body, local).unwrap_or_else(|_| PointMotion { times: Vec::new(), r: Vec::new(), v: Vec::new(), a: Vec::new() })
    }

    /// Position, velocity and acceleration of a marker over time.   \[m, m/s, m/s²\]
    ///
    /// A marker on a body of another mechanism has no history here: it gives an empty one.
    pub fn marker<B: Body + Copy>(&self, marker: &Marker<B>) -> PointMotion<B::Vector> {
        self.point(marker.body, marker.u)
    }

    /// Adds r, v and a of a marker to the file under its name.
    ///
    /// Errors: a body of another mechanism, name taken.
    pub fn add_marker<B: Body + Copy>(&mut self, marker: &Marker<B>) -> Result<()> {
        self.add_point(&marker.name, marker.body, marker.u)
    }

    /// As [`Motion::point`], with an error for a body of another mechanism.
    pub fn try_point<B: Body>(&self, body: B, local: impl Into<B::Vector>) -> Result<PointMotion<B::Vector>> {
        let (local, target) = (local.into(), body.target());
        let columns = match self.layout.place(&target) {
            Some(Place::Own { first, .. }) => first..first + target.columns(),
            Some(Place::Ground(_)) => 0..0,
            None => {
                let (mechanism, place, argument) = (self.name.to_string(), "point".to_string(), "body".to_string());
                return Err(Error::ForeignBody { mechanism, place, argument });
            }
        };
        let (mut r, mut v, mut a) = (Vec::with_capacity(self.len()), Vec::with_capacity(self.len()), Vec::with_capacity(self.len()));
        for k in 0..self.len() {
            let [q, qd, qdd] = [self.q(k), self.qd(k), self.qdd(k)].map(|row| row.get(columns.clone()).unwrap_or_default());
            let [rk, vk, ak] = B::point(local, q, qd, qdd);
            r.push(rk);
            v.push(vk);
            a.push(ak);
        }
        Ok(PointMotion { times: self.times().to_vec(), r, v, a })
    }
}

impl<V: Vector> PointMotion<V> {
    /// The times.   \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// r, global position.   \[m\]
    pub fn r(&self) -> &[V] {
        &self.r
    }

    /// v = ṙ, global components.   \[m/s\]
    pub fn v(&self) -> &[V] {
        &self.v
    }

    /// a = r̈, global components.   \[m/s²\]
    pub fn a(&self) -> &[V] {
        &self.a
    }

    /// |v| over time.   \[m/s\]
    pub fn speed(&self) -> Series {
        Series::new("speed", "m/s", &self.times, self.v.iter().map(size).collect())
    }

    /// |a| over time.   \[m/s²\]
    pub fn acceleration_magnitude(&self) -> Series {
        Series::new("acceleration", "m/s^2", &self.times, self.a.iter().map(size).collect())
    }

    /// Each component of r, v and a over time, named x, y, x', y', x'', ….
    pub fn components(&self) -> Vec<Series> {
        let quantities = [(&self.r, "", "m"), (&self.v, "'", "m/s"), (&self.a, "''", "m/s^2")];
        let component = |(all, mark, unit): (&Vec<V>, &'static str, &'static str), k: usize| {
            Series::new(format!("{}{mark}", V::NAMES[k]), unit, &self.times, all.iter().map(|x| x.component(k)).collect())
        };
        quantities.into_iter().flat_map(|quantity| (0..V::NAMES.len()).map(move |k| component(quantity, k))).collect()
    }
}

/// |x| without overflow.
fn size<V: Vector>(x: &V) -> f64 {
    (0..V::NAMES.len()).map(|k| x.component(k)).fold(0.0_f64, f64::hypot)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planar_formulas_are_the_derivatives_along_the_motion() {
        let (q, qd, qdd) = ([0.3, -1.2, 2.1], [0.7, 0.2, -3.0], [1.5, -0.4, 11.0]);
        let u = Vec2::new(0.4, -0.9);
        let [r, v, a] = PlanarBody::point(u, &q, &qd, &qdd);
        let jets: [Real<Dual2_64>; 3] = std::array::from_fn(|k| Real(Dual2_64::new(q[k], qd[k], qdd[k])));
        let exact = PlanarState::new(jets).point(u);
        for (found, exact) in [([r.x, v.x, a.x], exact.x.0), ([r.y, v.y, a.y], exact.y.0)] {
            for (found, exact) in found.into_iter().zip([exact.re, exact.v1, exact.v2]) {
                assert!((found - exact).abs() < 1e-14 * (1.0 + exact.abs()), "{found} {exact}");
            }
        }
    }

    #[test]
    fn spatial_point_turns_like_the_planar_one_about_z() {
        let (theta, w, alpha) = (0.7_f64, 1.3, -2.0);
        let (s, c) = (0.5 * theta).sin_cos();
        // p = (cos θ/2, 0, 0, sin θ/2)
        let p = [c, 0.0, 0.0, s];
        let pd = [-0.5 * w * s, 0.0, 0.0, 0.5 * w * c];
        let pdd = [-0.5 * alpha * s - 0.25 * w * w * c, 0.0, 0.0, 0.5 * alpha * c - 0.25 * w * w * s];
        let join = |r: [f64; 3], p: [f64; 4]| [r[0], r[1], r[2], p[0], p[1], p[2], p[3]];
        let spatial = SpatialBody::point(
            Vec3::new(0.4, -0.9, 0.2),
            &join([0.3, -1.2, 5.0], p),
            &join([0.7, 0.2, 0.0], pd),
            &join([1.5, -0.4, 0.0], pdd),
        );
        let planar = PlanarBody::point(Vec2::new(0.4, -0.9), &[0.3, -1.2, theta], &[0.7, 0.2, w], &[1.5, -0.4, alpha]);
        for (spatial, planar) in spatial.iter().zip(planar) {
            assert!((spatial.x - planar.x).abs() < 1e-14 && (spatial.y - planar.y).abs() < 1e-14);
        }
        assert!((spatial[0].z - 5.2).abs() + spatial[1].z.abs() + spatial[2].z.abs() < 1e-14);
    }
}
