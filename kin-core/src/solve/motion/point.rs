//! Computes the position, velocity, acceleration and jerk of points of bodies over time.

use std::ops::Range;

use super::{MARKS, Motion, Quantity, Series};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::coordinates::units::Unit;
use crate::coordinates::units::Units;
use crate::model::body::{Body, Course, Vector};
use crate::model::mechanism::Marker;
use crate::outcome::error::{Error, Result};

/// The position, velocity and acceleration of a point of a body at each time, with its jerk if the
/// run computed it.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMotion<V> {
    times: Vec<f64>,
    units: Units,
    r: Vec<V>,
    v: Vec<V>,
    a: Vec<V>,
    /// Empty unless the run computed the jerk.
    jerk: Vec<V>,
}

impl Motion {
    /// Returns position, velocity and acceleration of a marker over time. \[m, m/s, m/s²\]
    ///
    /// Errors: the body of the marker belongs to another mechanism.
    pub fn marker<B: Body + Copy>(&self, marker: &Marker<B>) -> Result<PointMotion<B::Vector>> {
        self.point(marker.body, marker.u)
    }

    /// Adds the position, velocity and acceleration of a marker to the motion, as columns with the
    /// name of the marker.
    ///
    /// Errors: the body belongs to another mechanism, the name is taken.
    pub fn add_marker<B: Body + Copy>(&mut self, marker: &Marker<B>) -> Result<()> {
        self.add_point(&marker.name, marker.body, marker.u)
    }

    /// Returns position, velocity and acceleration over time of the point with local position
    /// `local` of a body or link. \[m, m/s, m/s²\]
    ///
    /// The body may be the ground.
    ///
    /// Errors: the body belongs to another mechanism.
    pub fn point<B: Body>(
        &self,
        body: B,
        local: impl Into<B::Vector>,
    ) -> Result<PointMotion<B::Vector>> {
        let local = local.into();
        let target = body.target();
        let columns = self.columns(&target, "point")?;
        let room = || Vec::with_capacity(self.len());
        let mut all = PointMotion {
            times: self.times().to_vec(),
            units: self.unit_words().clone(),
            r: room(),
            v: room(),
            a: room(),
            jerk: Vec::new(),
        };
        for k in 0..self.len() {
            let [q, qd, qdd, qddd] = self.orders(k, columns.clone());
            let [r, v, a, jerk] = B::point(local, Course { q, qd, qdd, qddd });
            all.r.push(r);
            all.v.push(v);
            all.a.push(a);
            if self.has_jerk() {
                all.jerk.push(jerk);
            }
        }
        Ok(all)
    }

    /// Returns the columns of a body, none for the ground. `place` names the caller in an error.
    pub(crate) fn columns(&self, target: &Target, place: &str) -> Result<Range<usize>> {
        match self.layout.place(target) {
            Some(Place::Own { first, .. }) => Ok(first..first + target.columns()),
            Some(Place::Ground(_)) => Ok(0..0),
            None => {
                let mechanism = self.name.to_string();
                let place = place.to_string();
                let argument = "body".to_string();
                Err(Error::ForeignBody { mechanism, place, argument })
            }
        }
    }

    /// Returns q, q̇, q̈ and q⃛ (or nothing) of these columns at time k.
    pub(crate) fn orders(&self, k: usize, columns: Range<usize>) -> [&[f64]; 4] {
        [self.q(k), self.qd(k), self.qdd(k), self.qddd(k)]
            .map(|row| row.get(columns.clone()).unwrap_or_default())
    }
}

impl<V: Vector> PointMotion<V> {
    /// Returns the times. \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the global position r at each time. \[m\]
    pub fn r(&self) -> &[V] {
        &self.r
    }

    /// Returns the velocity v = ṙ at each time, in global components. \[m/s\]
    pub fn v(&self) -> &[V] {
        &self.v
    }

    /// Returns the acceleration a = r̈ at each time, in global components. \[m/s²\]
    pub fn a(&self) -> &[V] {
        &self.a
    }

    /// Returns the jerk ȧ at each time, in global components. \[m/s³\]
    ///
    /// The slice is empty if the run did not compute the jerk ([`crate::SolverOptions::jerk`]).
    pub fn jerk(&self) -> &[V] {
        &self.jerk
    }

    /// Returns the unit of r (`order` 0) or of one of its derivatives.
    fn unit(&self, order: usize) -> String {
        self.units.text(Unit::Metre, order)
    }

    /// Returns the coordinate n · r of the point along a global direction n, with its derivatives.
    /// \[m\]
    ///
    /// You can pass a closure with this call to [`System::extremes`](crate::System::extremes).
    pub fn along(&self, n: impl Into<V>) -> Quantity {
        let n = n.into();
        let dot = |x: &V| (0..V::NAMES.len()).map(|k| n.component(k) * x.component(k)).sum();
        let orders =
            [&self.r, &self.v, &self.a, &self.jerk].map(|all| all.iter().map(dot).collect());
        Quantity::new("along", &self.unit(0), (&self.times, &self.units), orders)
    }

    /// Returns the speed |v| over time. \[m/s\]
    pub fn speed(&self) -> Series {
        Series::new(
            "speed",
            self.unit(1),
            (&self.times, &self.units),
            self.v.iter().map(size).collect(),
        )
    }

    /// Returns the magnitude |a| of the acceleration over time. \[m/s²\]
    pub fn acceleration_magnitude(&self) -> Series {
        Series::new(
            "acceleration",
            self.unit(2),
            (&self.times, &self.units),
            self.a.iter().map(size).collect(),
        )
    }

    /// Returns the magnitude |ȧ| of the jerk over time. \[m/s³\]
    ///
    /// The series is empty if the run did not compute the jerk.
    pub fn jerk_magnitude(&self) -> Series {
        let times = if self.jerk.is_empty() { &[] } else { &self.times[..] };
        Series::new(
            "jerk",
            self.unit(3),
            (times, &self.units),
            self.jerk.iter().map(size).collect(),
        )
    }

    /// Returns each component of r, v and a over time, with the names x, y, x', y', x'', ….
    ///
    /// The list contains the jerk too, if the run computed the jerk.
    pub fn components(&self) -> Vec<Series> {
        let orders = [&self.r, &self.v, &self.a, &self.jerk].into_iter().zip(MARKS).zip(0..);
        let component = |((all, mark), order): ((&Vec<V>, &'static str), usize), k: usize| {
            let values = all.iter().map(|x| x.component(k)).collect();
            Series::new(
                format!("{}{mark}", V::NAMES[k]),
                self.unit(order),
                (&self.times, &self.units),
                values,
            )
        };
        orders
            .filter(|((all, _), _)| !all.is_empty())
            .flat_map(|order| (0..V::NAMES.len()).map(move |k| component(order, k)))
            .collect()
    }
}

/// Returns |x| without overflow.
fn size<V: Vector>(x: &V) -> f64 {
    (0..V::NAMES.len()).map(|k| x.component(k)).fold(0.0_f64, f64::hypot)
}
