//! Returns the results of a run: position, velocity and acceleration over time, with names and
//! units, and derived quantities.

pub(crate) mod csv;
mod distance;
mod given;
mod planar;
mod point;
mod quantity;
mod rotation;
mod summary;
mod warnings;

pub use crate::model::body::{Body, Vector};
pub use crate::outcome::motion::{
    EngineCounts, Event, EventKind, Motion, Series, Warning, WarningKind,
};
pub use planar::Line;
pub use point::PointMotion;
pub use quantity::{Quantity, QuantityValues};
pub use rotation::RotationMotion;
pub use summary::Displacement;

use std::sync::OnceLock;

use crate::coordinates::layout::Place;
use crate::coordinates::{Coordinate, PlanarBody, SpatialBody, Target};
use crate::outcome::error::{Error, Result};
use crate::solve::newton::{Newton, Outcome};
use crate::system::System;
pub(crate) use quantity::MARKS;

impl Motion {
    pub(crate) fn new(system: &System, times: usize) -> Self {
        let room = || Vec::with_capacity(times.saturating_mul(system.n_coordinates()));
        Motion {
            name: system.name().to_string(),
            layout: system.layout().clone(),
            equations: system.names_of_equations().clone(),
            times: Vec::with_capacity(times),
            q: room(),
            qd: room(),
            qdd: room(),
            qddd: Vec::new(),
            iterations: Vec::with_capacity(times),
            residuals: Vec::with_capacity(times),
            worst: None,
            outputs: Vec::new(),
            breaks: Vec::new(),
            events: Vec::new(),
            singular: Vec::new(),
            guess: Vec::new(),
            begun: Vec::new(),
            turned_before: false,
            warnings: OnceLock::new(),
            misfit: 0.0,
            engine: EngineCounts::default(),
            plain: None,
        }
    }

    pub(crate) fn push(&mut self, t: f64, newton: &Newton<'_>, outcome: Outcome) {
        let worst = if self.is_worse(outcome) { newton.worst().0 } else { 0 };
        self.append(t, [&newton.q, &newton.qd, &newton.qdd, &newton.qddd], outcome, worst);
    }

    pub(crate) fn is_worse(&self, outcome: Outcome) -> bool {
        self.worst.is_none_or(|(known, _)| outcome.residual > known)
    }

    /// Appends q, q̇, q̈ and q⃛ (or nothing) at one more time. `worst` is the row with the largest
    /// |C_i|.
    #[inline(always)]
    pub(crate) fn append(
        &mut self,
        t: f64,
        [q, qd, qdd, qddd]: [&[f64]; 4],
        outcome: Outcome,
        worst: usize,
    ) {
        if self.is_worse(outcome) {
            self.worst = Some((outcome.residual, worst));
        }
        self.times.push(t);
        self.q.extend_from_slice(q);
        self.qd.extend_from_slice(qd);
        self.qdd.extend_from_slice(qdd);
        if !qddd.is_empty() {
            self.qddd.extend_from_slice(qddd);
        }
        self.iterations.push(outcome.iterations);
        self.residuals.push(outcome.residual);
    }

    /// Removes the times from index `len` on. `worst` is the largest residual of the remaining
    /// times.
    pub(crate) fn cut(&mut self, len: usize, worst: Option<(f64, usize)>) {
        let numbers = len * self.layout.len();
        self.times.truncate(len);
        [&mut self.q, &mut self.qd, &mut self.qdd, &mut self.qddd]
            .into_iter()
            .for_each(|all| all.truncate(numbers));
        self.iterations.truncate(len);
        self.residuals.truncate(len);
        self.worst = worst;
    }

    /// Returns one coordinate over time with its derivatives: a scalar coordinate, or a coordinate
    /// of a body such as `crank.theta()`.
    ///
    /// Coordinates of the ground are constant.
    ///
    /// Errors: the coordinate belongs to another mechanism.
    pub fn coordinate(&self, coordinate: impl Into<Coordinate>) -> Result<Quantity> {
        match self.layout.coordinate(&coordinate.into()) {
            Some(Place::Own { first, .. }) => Ok(self.column(first)),
            Some(Place::Ground(value)) => {
                let still = if self.has_jerk() { self.len() } else { 0 };
                let orders = [
                    vec![value; self.len()],
                    vec![0.0; self.len()],
                    vec![0.0; self.len()],
                    vec![0.0; still],
                ];
                Ok(Quantity::new("ground", "-", self.clock(), orders))
            }
            None => {
                let mechanism = self.name.to_string();
                let place = "coordinate".to_string();
                let argument = "coordinate".to_string();
                Err(Error::ForeignBody { mechanism, place, argument })
            }
        }
    }

    /// Returns the planar body with this name, for [`Motion::point`] and [`Motion::coordinate`].
    pub fn planar_named(&self, name: &str) -> Option<PlanarBody> {
        self.layout.bodies().into_iter().find_map(|(known, target)| match target {
            Target::Planar(body) if known == name => Some(body),
            _ => None,
        })
    }

    /// Returns the spatial body with this name.
    pub fn spatial_named(&self, name: &str) -> Option<SpatialBody> {
        self.layout.bodies().into_iter().find_map(|(known, target)| match target {
            Target::Spatial(body) if known == name => Some(body),
            _ => None,
        })
    }

    /// Returns the coordinate with this name, such as `crank.theta`, over time.
    ///
    /// Errors: no coordinate has the name.
    pub fn named(&self, name: &str) -> Result<Quantity> {
        match self.layout.names.iter().position(|known| known == name) {
            Some(column) => Ok(self.column(column)),
            None => Err(Error::UnknownName {
                what: "coordinate",
                name: name.to_string(),
                known: self.layout.names.clone(),
            }),
        }
    }

    fn column(&self, column: usize) -> Quantity {
        let values =
            |all: &Vec<f64>| all.iter().skip(column).step_by(self.layout.len()).copied().collect();
        let orders = [&self.q, &self.qd, &self.qdd, &self.qddd].map(values);
        Quantity::new(
            &self.layout.names[column],
            &self.layout.unit(column, 0),
            self.clock(),
            orders,
        )
    }

    /// Adds a derived quantity to the motion and its files, with one value for each time.
    ///
    /// Errors: the number of values is wrong, a value is not finite, the name is empty or taken.
    pub fn add_output(&mut self, name: &str, unit: &str, values: Vec<f64>) -> Result<()> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "output" });
        }
        if self.outputs.iter().any(|known| known.name() == name) {
            return Err(Error::DuplicateName { what: "outputs", name: name.to_string() });
        }
        if values.len() != self.len() {
            return Err(Error::WrongLength {
                what: format!("output `{name}`"),
                expected: self.len(),
                found: values.len(),
            });
        }
        if let Some((t, value)) =
            self.times.iter().zip(&values).find(|(_, value)| !value.is_finite())
        {
            return Err(Error::OutputNotFinite {
                output: name.to_string(),
                t: *t,
                units: self.layout.words.clone(),
                value: *value,
            });
        }
        self.outputs.push(Series::new(name, unit, (&self.times, &self.layout.words), values));
        Ok(())
    }

    /// Adds the position, velocity and acceleration of a point of a body to the motion, as the
    /// columns `NAME.x`, `NAME.y`, `NAME.x'`, ….
    ///
    /// Errors: the body belongs to another mechanism, the name is empty or taken.
    pub fn add_point<B: Body>(
        &mut self,
        name: &str,
        body: B,
        local: impl Into<B::Vector>,
    ) -> Result<()> {
        for component in self.point(body, local)?.components() {
            self.add_output(
                &format!("{name}.{}", component.name()),
                component.unit(),
                component.values().to_vec(),
            )?;
        }
        Ok(())
    }
}
