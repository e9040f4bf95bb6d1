//! A mechanism whose drivers are released: positions by wishes, such as a point dragged to a
//! target.

mod wish;

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::ask::diagnosis::order;
use crate::ask::measure::Measure;
use crate::ask::still::Still;
use crate::linear::{Sparse, reduced};
use crate::model::body::Body;
use crate::model::mechanism::{Limit, Mechanism};
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;
use crate::solve::assembly::search;
use crate::solve::free::{Basis, Bound, Descent, Manifold};
use crate::solve::options::SolverOptions;
use crate::system::scaled::Measures;
use crate::system::{Solution, System, time};

pub use wish::{Granted, Reached, Wish};

/// The tangents of all freedoms take at most this many numbers.
const MOST_NUMBERS: usize = 1 << 22;

/// A mechanism whose drivers are released, at one position.
///
/// The equations of drivers, those with a law of time, do not count. All other equations hold, with
/// time at t0. [`Released::drag`] and [`Released::reach`] move the mechanism from where it stands
/// to wishes, within the limits of its measures ([`Mechanism::limit`]).
///
/// A wish moves along the straight line from its present value to its target, and the mechanism
/// follows in small steps, each of least change: the sum of (dq_j / s_j)² is as small as the wishes
/// permit, where s_j is 1 for an angle and a typical length for a length. So the mechanism neither
/// jumps nor changes its assembly. If the wishes leave no freedom, the way back leads to the same
/// position. If they leave some, a closed way may end elsewhere.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("arm");
/// let upper = m.link("upper", 0.5)?;
/// let lower = m.link("lower", 0.4)?;
/// m.add("shoulder", revolute(Ground, upper, vec2(0.0, 0.0), upper.start()))?;
/// m.add("elbow", revolute(upper, lower, upper.end(), lower.start()))?;
/// m.guess(upper.theta(), 0.4)?;
/// m.guess(lower.theta(), 1.2)?;
///
/// let mut arm = m.released(0.0)?;
/// assert_eq!(arm.freedoms(), ["upper.theta", "lower.theta"]);
/// let reached = arm.drag(lower, lower.end(), vec2(0.3, 0.6))?;
/// assert!(reached.wishes[0].is_met);
/// assert!(reached.freedoms.is_empty());
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Released {
    system: System,
    t0: f64,
    /// For each row false if it belongs to a driver.
    active: Arc<[bool]>,
    measures: Arc<Measures>,
    basis: Option<Basis>,
    q: Vec<f64>,
}

impl Mechanism {
    /// Releases the drivers of the mechanism at the assembled position at time t0. The mechanism
    /// may have fewer equations than coordinates.
    ///
    /// Errors: those of [`Mechanism::build`], except the one for too few equations; no position
    /// satisfies the equations
    /// ([`CannotBeDriven`](crate::error::FailureKind::CannotBeDriven), with the diagnosis).
    pub fn released(&self, t0: f64) -> Result<Released> {
        self.clone().system()?.released(t0)
    }
}

impl System {
    /// Releases the drivers of the mechanism at the assembled position at time t0.
    ///
    /// Errors: those of [`System::position`]; the freedoms are too many to be moved together.
    pub fn released(&self, t0: f64) -> Result<Released> {
        let t0 = time(t0)?;
        let q = if self.n_equations() < self.n_coordinates() {
            self.assembled(t0)?
        } else {
            let Solution { q, .. } = self.position(t0)?;
            q
        };
        let model = self.model();
        let active: Arc<[bool]> = (0..model.m()).map(|row| !model.drives(row)).collect();
        let measures = Arc::new(model.measure(&q, t0));
        let mut released = Released { system: self.clone(), t0, active, measures, basis: None, q };
        released.settle()?;
        Ok(released)
    }

    /// Returns a position near the guess that satisfies all equations of a mechanism with too few.
    fn assembled(&self, t0: f64) -> Result<Vec<f64>> {
        let options = SolverOptions::default();
        let model = self.model();
        match search::search(model, self.initial(), t0, &|_| true, &options.search) {
            Some(found) if found.met => Ok(found.place.q),
            _ => Err(Error::cannot_be_driven(self.diagnose(t0)?)),
        }
    }
}

impl Released {
    /// Moves the mechanism so that a point of a body comes to the target, or as near to it as the
    /// mechanism can follow. `local` is the point in the frame of the body. \[m\]
    ///
    /// Errors: those of [`Released::reach`].
    pub fn drag<B: Body>(
        &mut self,
        body: B,
        local: impl Into<B::Vector>,
        target: impl Into<B::Vector>,
    ) -> Result<Reached> {
        self.reach([Wish::point(body, local, target)])
    }

    /// Moves the mechanism towards wishes. A wish of an earlier priority counts before all later
    /// ones; wishes of one priority share what they miss by least squares.
    ///
    /// Errors: an unknown name, a body of another mechanism, a number that is not finite; the
    /// position is singular. The mechanism then has not moved.
    pub fn reach(&mut self, wishes: impl IntoIterator<Item = Wish>) -> Result<Reached> {
        let mut wishes: Vec<Wish> = wishes.into_iter().collect();
        wishes.sort_by_key(|wish| wish.priority);
        let limits = self.system.all_limits();
        let bounds = self.bounds(&limits)?;
        let mut levels: Vec<Vec<_>> = Vec::new();
        let mut priority = None;
        for wish in &wishes {
            if priority != Some(wish.priority) {
                levels.push(Vec::new());
                priority = Some(wish.priority);
            }
            let goal = wish.goal(&self.system, (self.t0, &self.q), &self.measures)?;
            levels.last_mut().into_iter().for_each(|level| level.push(goal.clone()));
        }
        let Released { system, t0, active, measures, basis, q } = self;
        let manifold = Manifold::new(system.model(), *t0, measures, active, basis.take());
        let mut descent = Descent { manifold, levels, bounds, q: q.clone() };
        let Some(free) = descent.go() else {
            return Err(self.system.singular(self.t0, &self.q, None));
        };
        let at_bounds = descent.at_bounds();
        let Descent { manifold, levels, q: reached, .. } = descent;
        *basis = manifold.into_basis();
        *q = reached;
        let goals = wishes.iter().zip(levels.iter().flatten());
        let granted = goals.map(|(wish, (goal, target))| wish.granted(system, goal, target));
        let wishes = granted.collect();
        let limits = at_bounds.into_iter().map(|k| limits[k].name.clone()).collect();
        Ok(Reached { wishes, limits, freedoms: self.names(&free) })
    }

    /// Returns the freedoms of the mechanism where it stands, by a coordinate for each: values of
    /// these coordinates determine the position nearby.
    pub fn freedoms(&mut self) -> Vec<String> {
        let tangents = self.with_manifold(|manifold, q| manifold.tangents(q));
        tangents.map(|tangents| self.names(&tangents)).unwrap_or_default()
    }

    /// Returns q in the order of [`System::coordinate_names`]. \[m, rad\]
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// Returns the system, with its drivers.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Returns the time t0, at which all laws of time stand. \[s\]
    pub fn t0(&self) -> f64 {
        self.t0
    }

    /// Takes the mechanism to the position near q that satisfies its equations.
    ///
    /// Errors: q has the wrong length or a value that is not finite; no position is near. The
    /// mechanism then stands where it was.
    pub fn set_position(&mut self, q: &[f64]) -> Result<()> {
        self.system.check(q, "position")?;
        let before = std::mem::replace(&mut self.q, q.to_vec());
        self.settle().inspect_err(|_| self.q = before)
    }

    /// Sets a parameter or dimension, as [`System::set`] does, and takes the mechanism to the
    /// nearest position with this value.
    ///
    /// Errors: those of [`System::set`]; no position is near. The value is then the old one, and
    /// the mechanism stands where it was.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        let before = self.clone();
        self.system.set(name, value)?;
        self.measures = Arc::new(self.system.model().measure(&self.q, self.t0));
        self.basis = None;
        let is_settled = self.settle();
        if is_settled.is_err() {
            *self = before;
        }
        is_settled
    }

    /// Returns a coordinate by its name, such as `rocker.theta`.
    pub fn coordinate(&self, name: &str) -> Option<f64> {
        self.still().coordinate(name)
    }

    /// Returns a measure: the angle or slide of a joint or a coordinate by name, or whatever else
    /// [`System::measure`] takes.
    ///
    /// Errors: an unknown name, with the known ones.
    pub fn measure(&self, what: impl Measure) -> Result<f64> {
        self.still().measure(what)
    }

    /// Returns all measures of joints, with names, units and values.
    ///
    /// Errors: a measure that is not finite here.
    pub fn measures(&self) -> Result<Vec<NamedValue>> {
        self.still().measures()
    }

    /// Returns the position as a motion of one time, 0, for points, pictures and tables. All
    /// velocities and accelerations are zero.
    pub fn motion(&self) -> Motion {
        self.still().motion()
    }

    fn still(&self) -> Still<'_> {
        Still { system: &self.system, q: &self.q }
    }

    fn with_manifold<R>(&mut self, f: impl FnOnce(&mut Manifold<'_>, &mut Vec<f64>) -> R) -> R {
        let Released { system, t0, active, measures, basis, q } = self;
        let mut manifold = Manifold::new(system.model(), *t0, measures, active, basis.take());
        let result = f(&mut manifold, q);
        *basis = manifold.into_basis();
        result
    }

    /// Takes the present place to C = 0.
    fn settle(&mut self) -> Result<()> {
        let mut q = self.q.clone();
        let is_found = self.with_manifold(|manifold, _| manifold.restore(&mut q, |_, _| Some(0.0)));
        if !is_found {
            return Err(self.system.singular(self.t0, &self.q, None));
        }
        self.q = q;
        let n = self.q.len();
        let freedoms = self.basis.as_ref().map_or(0, Basis::freedoms);
        if n.saturating_mul(freedoms) > MOST_NUMBERS {
            return Err(Error::InvalidOptions {
                reason: format!(
                    "\"{}\" has {freedoms} freedoms in {n} coordinates, which are too many to be moved \
                     together. Hold some of its bodies",
                    self.system.name()
                ),
            });
        }
        Ok(())
    }

    fn bounds(&self, limits: &[Limit]) -> Result<Vec<Bound>> {
        let at = (self.t0, &self.q[..]);
        let bound = |limit: &Limit| {
            let goal = wish::named(&self.system, at, &self.measures, &limit.name)?;
            Ok(Bound { goal, ends: limit.ends })
        };
        limits.iter().map(bound).collect()
    }

    /// Returns the coordinate of each direction, by which it is called.
    fn names(&self, directions: &DMatrix<f64>) -> Vec<String> {
        let model = self.system.model();
        let sparse =
            |k: usize| -> Sparse { directions.column(k).iter().copied().enumerate().collect() };
        let space = (0..directions.ncols()).map(sparse).collect();
        let found = reduced(space, model.n(), &order::of_columns(&model));
        found.into_iter().map(|(column, _)| model.layout.names[column].clone()).collect()
    }
}

impl std::fmt::Debug for Released {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Released").field("system", &self.system).field("q", &self.q).finish()
    }
}
