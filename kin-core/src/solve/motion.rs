//! What a sweep gives: position, velocity and acceleration over time, with names and units, and what is derived from them.

mod csv;
mod distance;
mod event;
mod planar;
mod point;
mod quantity;
mod rotation;
mod series;
mod summary;

pub use event::{Event, EventKind};
pub use planar::Line;
pub use point::{Body, PointMotion, Vector};
pub use quantity::Quantity;
pub use rotation::RotationMotion;
pub use series::Series;
pub use summary::Displaced;

use std::sync::Arc;

use crate::model::coordinates::{Coordinate, PlanarBody, SpatialBody, Target};
use crate::model::error::{Error, Result};
use crate::model::layout::{Layout, Place};
use crate::model::units::Units;
use crate::solve::follow::SingularPosition;
use crate::solve::newton::{CrossedBreak, Newton, Outcome};
use crate::system::System;
pub(crate) use quantity::MARKS;

/// q, q̇ and q̈ at each time (q⃛ too where it was asked for), all finite, and a report of how they were found.
#[derive(Clone)]
pub struct Motion {
    pub(crate) name: String,
    pub(crate) layout: Arc<Layout>,
    pub(crate) equations: Arc<[String]>,
    pub(crate) times: Vec<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) qdd: Vec<f64>,
    /// Empty unless the jerk was asked for.
    pub(crate) qddd: Vec<f64>,
    pub(crate) iterations: Vec<usize>,
    pub(crate) residuals: Vec<f64>,
    /// The largest residual of all times, and its row.
    pub(crate) worst: Option<(f64, usize)>,
    pub(crate) outputs: Vec<Series>,
    pub(crate) breaks: Vec<CrossedBreak>,
    pub(crate) events: Vec<Event>,
    pub(crate) singular: Vec<SingularPosition>,
    /// The guess that the first position was found from.
    pub(crate) guess: Vec<f64>,
    /// Drivers of turns in space that begin beyond a turn, with the angle: bodies there do not show how often they have turned.   \[rad\]
    pub(crate) beyond_a_turn: Vec<(String, f64)>,
    /// By how much of their norms equations contradict one another, where that was allowed.   \[-\]
    pub(crate) misfit: f64,
}

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
            guess: system.initial().to_vec(),
            beyond_a_turn: Vec::new(),
            misfit: 0.0,
        }
    }

    pub(crate) fn push(&mut self, t: f64, newton: &Newton<'_>, outcome: Outcome) {
        let worst = if self.is_worse(outcome) { newton.worst().0 } else { 0 };
        self.append(t, [&newton.q, &newton.qd, &newton.qdd, &newton.qddd], outcome, worst);
    }

    fn is_worse(&self, outcome: Outcome) -> bool {
        self.worst.is_none_or(|(known, _)| outcome.residual > known)
    }

    /// q, q̇, q̈ and q⃛ (or nothing) at one more time; `worst` is the row with the largest |C_i|.
    #[inline(always)]
    pub(crate) fn append(&mut self, t: f64, [q, qd, qdd, qddd]: [&[f64]; 4], outcome: Outcome, worst: usize) {
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

    /// The same of several times at once: rows of q, of q̇ and of q̈, residuals and numbers of Newton steps; to be completed.
    pub(crate) fn push_all(&mut self, [q, qd, qdd, residuals]: [&[f64]; 4], steps: impl Iterator<Item = usize>) {
        let kinds = [(&mut self.q, q), (&mut self.qd, qd), (&mut self.qdd, qdd), (&mut self.residuals, residuals)];
        kinds.into_iter().for_each(|(all, more)| all.extend_from_slice(more));
        self.iterations.extend(steps);
    }

    /// The times of all that was pushed, the largest residual and its row.
    pub(crate) fn complete(&mut self, times: &[f64], worst: (f64, usize)) {
        self.times.extend_from_slice(times);
        self.worst = Some(worst);
    }

    /// Its last time alone.
    pub(crate) fn last(&self) -> Motion {
        self.rows(self.len().saturating_sub(1))
    }

    /// The times of this motion and those of a later one; neither's events.
    pub(crate) fn followed_by(&self, later: &Motion) -> Motion {
        let mut whole = self.rows(0);
        whole.times.extend_from_slice(&later.times);
        let kinds = [(&mut whole.q, &later.q), (&mut whole.qd, &later.qd), (&mut whole.qdd, &later.qdd), (&mut whole.qddd, &later.qddd)];
        kinds.into_iter().for_each(|(all, more)| all.extend_from_slice(more));
        whole.iterations.extend_from_slice(&later.iterations);
        whole.residuals.extend_from_slice(&later.residuals);
        whole
    }

    /// The times from number `first` on, without what happened there.
    fn rows(&self, first: usize) -> Motion {
        let of = |all: &[f64]| all.get(first * self.layout.len()..).unwrap_or_default().to_vec();
        Motion {
            name: self.name.clone(),
            layout: self.layout.clone(),
            equations: self.equations.clone(),
            times: self.times[first..].to_vec(),
            q: of(&self.q),
            qd: of(&self.qd),
            qdd: of(&self.qdd),
            qddd: of(&self.qddd),
            iterations: self.iterations[first..].to_vec(),
            residuals: self.residuals[first..].to_vec(),
            guess: self.guess.clone(),
            beyond_a_turn: self.beyond_a_turn.clone(),
            misfit: self.misfit,
            worst: self.worst,
            outputs: Vec::new(),
            breaks: Vec::new(),
            events: Vec::new(),
            singular: Vec::new(),
        }
    }

    /// Name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of times.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there is no time at all.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The times.   \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// q at time k, in the order of [`Motion::names`]; empty beyond the last time.   \[m, rad\]
    pub fn q(&self, k: usize) -> &[f64] {
        self.row(&self.q, k)
    }

    /// q̇ at time k; empty beyond the last time.   \[m/s, rad/s\]
    pub fn qd(&self, k: usize) -> &[f64] {
        self.row(&self.qd, k)
    }

    /// q̈ at time k; empty beyond the last time.   \[m/s², rad/s²\]
    pub fn qdd(&self, k: usize) -> &[f64] {
        self.row(&self.qdd, k)
    }

    /// q⃛ at time k; empty beyond the last time, and where the run was not asked for the jerk ([`crate::Options::jerk`]).   \[m/s³, rad/s³\]
    pub fn qddd(&self, k: usize) -> &[f64] {
        self.row(&self.qddd, k)
    }

    /// Whether it holds the jerk.
    pub fn has_jerk(&self) -> bool {
        self.qddd.len() == self.q.len() && !self.is_empty()
    }

    fn row<'a>(&self, all: &'a [f64], k: usize) -> &'a [f64] {
        let n = self.layout.len();
        let first = k.saturating_mul(n);
        all.get(first..first.saturating_add(n)).unwrap_or_default()
    }

    /// Names of the coordinates, such as `crank.theta`.
    pub fn names(&self) -> &[String] {
        &self.layout.names
    }

    /// Units of the coordinates: `m`, `rad` or `-`.
    pub fn units(&self) -> Vec<String> {
        self.layout.unit_words()
    }

    /// What the units of length and time are called.
    pub fn unit_words(&self) -> &Units {
        &self.layout.words
    }

    /// The times, and what units are called.
    pub(crate) fn clock(&self) -> (&[f64], &Units) {
        (&self.times, &self.layout.words)
    }

    /// Newton steps taken at each time.
    pub fn iterations(&self) -> &[usize] {
        &self.iterations
    }

    /// max |C_i| at each time, in the unit of its row.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// Name of the equation with the largest residual of all, such as `A.x`.
    pub fn worst(&self) -> Option<&str> {
        self.equations.get(self.worst?.1).map(String::as_str)
    }

    /// One coordinate over time, with its rates: a bare one, or a body's such as `crank.theta()`. Those of the ground stand still.
    ///
    /// Errors: a coordinate of another mechanism.
    pub fn coordinate(&self, coordinate: impl Into<Coordinate>) -> Result<Quantity> {
        match self.layout.coordinate(&coordinate.into()) {
            Some(Place::Own { first, .. }) => Ok(self.column(first)),
            Some(Place::Ground(value)) => {
                let still = if self.has_jerk() { self.len() } else { 0 };
                let orders = [vec![value; self.len()], vec![0.0; self.len()], vec![0.0; self.len()], vec![0.0; still]];
                Ok(Quantity::new("ground", "-", self.clock(), orders))
            }
            None => {
                let (mechanism, place, argument) = (self.name.to_string(), "coordinate".to_string(), "coordinate".to_string());
                Err(Error::ForeignBody { mechanism, place, argument })
            }
        }
    }

    /// The planar body of that name, for [`Motion::point`] and [`Motion::coordinate`].
    pub fn planar_named(&self, name: &str) -> Option<PlanarBody> {
        self.layout.bodies().into_iter().find_map(|(known, target)| match target {
            Target::Planar(body) if known == name => Some(body),
            _ => None,
        })
    }

    /// The spatial body of that name.
    pub fn spatial_named(&self, name: &str) -> Option<SpatialBody> {
        self.layout.bodies().into_iter().find_map(|(known, target)| match target {
            Target::Spatial(body) if known == name => Some(body),
            _ => None,
        })
    }

    /// The coordinate of that name, such as `crank.theta`, over time.
    ///
    /// Errors: no such coordinate.
    pub fn named(&self, name: &str) -> Result<Quantity> {
        match self.layout.names.iter().position(|known| known == name) {
            Some(column) => Ok(self.column(column)),
            None => Err(Error::UnknownName { what: "coordinate", name: name.to_string(), known: self.layout.names.clone() }),
        }
    }

    fn column(&self, column: usize) -> Quantity {
        let values = |all: &Vec<f64>| all.iter().skip(column).step_by(self.layout.len()).copied().collect();
        let orders = [&self.q, &self.qd, &self.qdd, &self.qddd].map(values);
        Quantity::new(&self.layout.names[column], &self.layout.unit(column, 0), self.clock(), orders)
    }

    /// Adds a derived quantity to the file: one value a time.
    ///
    /// Errors: wrong number of values, not finite, name empty or taken.
    pub fn add_output(&mut self, name: &str, unit: &str, values: Vec<f64>) -> Result<()> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "output" });
        }
        if self.outputs.iter().any(|known| known.name() == name) {
            return Err(Error::DuplicateName { what: "outputs", name: name.to_string() });
        }
        if values.len() != self.len() {
            return Err(Error::WrongLength { what: format!("output `{name}`"), expected: self.len(), found: values.len() });
        }
        if let Some((t, value)) = self.times.iter().zip(&values).find(|(_, value)| !value.is_finite()) {
            return Err(Error::OutputNotFinite { output: name.to_string(), t: *t, units: self.layout.words.clone(), value: *value });
        }
        self.outputs.push(Series::new(name, unit, (&self.times, &self.layout.words), values));
        Ok(())
    }

    /// Adds r, v and a of a point of a body to the file, as `NAME.x`, `NAME.y`, `NAME.x'`, ….
    ///
    /// Errors: a body of another mechanism, name empty or taken.
    pub fn add_point<B: Body>(&mut self, name: &str, body: B, local: impl Into<B::Vector>) -> Result<()> {
        for component in self.point(body, local)?.components() {
            self.add_output(&format!("{name}.{}", component.name()), component.unit(), component.values().to_vec())?;
        }
        Ok(())
    }

    /// The derived quantities added so far.
    pub fn outputs(&self) -> &[Series] {
        &self.outputs
    }

    /// The breaks of laws that were crossed, where a derivative of the motion jumps, in the order of time: the first 100 000 of them, and of one
    /// law between two times the first ten thousand.
    pub fn breaks(&self) -> &[CrossedBreak] {
        &self.breaks
    }

    /// The singular positions that were met, change points and at last a toggle, in the order of time; they are among
    /// [`Motion::events`] too.
    pub fn singular_positions(&self) -> &[SingularPosition] {
        &self.singular
    }

    pub(crate) fn add_singular(&mut self, found: SingularPosition) {
        self.add_event(found.event());
        self.singular.push(found);
    }
}

impl std::fmt::Debug for Motion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Motion({}: {} times)", self.name, self.len())
    }
}
