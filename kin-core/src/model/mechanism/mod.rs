//! Describes a mechanism: bodies, scalar coordinates and named constraints.
//!
//! [`Mechanism::build`] creates a [`crate::System`] from the description.

pub(crate) mod admission;
mod dimensions;
mod friction;
mod limit;
mod loads;
pub(crate) mod place;
mod pose;
mod preference;
mod units;

pub(crate) use limit::Limit;
pub use place::Marker;
pub(crate) use pose::Drawn;
pub use pose::{Direction, Facing, IntoSpatialPose, Pose, SpatialPose, deg, linspace, pose};
pub use preference::Preferred;
use preference::Wish;
pub use units::UnitWords;

use std::collections::HashSet;
use std::sync::Arc;

use crate::coordinates::layout::{Kind, Layout, Place};
use crate::coordinates::units::Units;
use crate::coordinates::{
    Coordinate, Ground, Link, MechanismId, PlanarBody, SpatialBody, Target, Trig,
};
use crate::dimensions::{Bound, Dimension, Holder, Hung, IntoNumber, Shared};
use crate::model::constraint::Constraint;
use crate::model::loads::Loads;
use crate::outcome::error::{Error, Result};
use crate::outcome::words::GROUND;

/// The bodies, scalar coordinates and constraints of a machine.
///
/// You may use any consistent units. Headers show metre, radian and second by default.
///
/// ```
/// use kin::prelude::*;
/// use kin::{Mechanism, deg, linspace};
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("four-bar");
/// let ground = m.ground();
/// let crank = m.link("crank", 1.0)?;
/// let coupler = m.link("coupler", 3.5)?;
/// let rocker = m.link("rocker", 3.0)?;
/// m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
/// m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
/// m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
/// m.prefer(rocker, deg(100.0));
///
/// let motion = m.build()?.run(linspace(0.0, 1.0, 1001))?;
/// let p = motion.point(coupler, vec2(0.0, 0.5))?;
/// assert!(p.speed().max() > 6.0);
/// # Ok(())
/// # }
/// ```
///
/// A clone is a variant of the mechanism. The handles of bodies and coordinates of the original are
/// valid in the clone too.
#[derive(Clone)]
pub struct Mechanism {
    pub(crate) name: String,
    pub(crate) layout: Layout,
    /// The guess of q, one value for each coordinate.
    pub(crate) initial: Vec<f64>,
    /// Preferred values as (coordinate, value).
    pub(crate) preferred: Vec<(usize, f64)>,
    /// Preferred measures as (name, value).
    pub(crate) asked: Vec<(String, f64)>,
    pub(crate) constraints: Vec<(String, Box<dyn Constraint>)>,
    names: HashSet<String>,
    /// The first call without a result that failed; build returns its error. `None` if all calls
    /// succeeded.
    refused: Option<Refused>,
    /// Two flags: the user has declared the units of length and time, and the unit of mass.
    pub(crate) declared: [bool; 2],
    /// Permitted ranges of measures.
    pub(crate) limits: Vec<Limit>,
    /// Masses, gravity and loads.
    pub(crate) loads: Loads,
    /// Named dimensions, shared with copies; `None` if there are none.
    pub(crate) dimensions: Option<Arc<Shared>>,
    /// The numbers that depend on dimensions.
    pub(crate) hung: Vec<Hung>,
}

/// The index of a constraint of a mechanism, in the order in which the program added the
/// constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ConstraintId(usize);

/// A call without a result that failed. Build repeats it and returns its error.
#[derive(Clone)]
pub(crate) enum Refused {
    /// Words for units, and the words declared before.
    Units {
        before: Option<Units>,
        units: Units,
    },
    Preference(Wish),
    Gravity([Dimension; 3]),
}

/// A value that [`Mechanism::add`] accepts: a constraint, or a `Box<dyn Constraint>`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a constraint",
    label = "give the constraint that `revolute(…)` or a function with `#[constraint]` returns",
    note = "write `#[constraint]` above a function to make it a constraint, and call the function with bodies and parameters"
)]
pub trait IntoConstraint {
    /// Returns the constraint.
    #[doc(hidden)]
    fn into_constraint(self) -> Box<dyn Constraint>;
}

impl<T: Constraint + 'static> IntoConstraint for T {
    fn into_constraint(self) -> Box<dyn Constraint> {
        Box::new(self)
    }
}

impl IntoConstraint for Box<dyn Constraint> {
    fn into_constraint(self) -> Box<dyn Constraint> {
        self
    }
}

impl Mechanism {
    /// Creates an empty mechanism.
    pub fn new(name: &str) -> Self {
        Mechanism {
            name: name.to_string(),
            layout: Layout::new(MechanismId::fresh()),
            initial: Vec::new(),
            preferred: Vec::new(),
            asked: Vec::new(),
            constraints: Vec::new(),
            names: HashSet::new(),
            refused: None,
            declared: [false; 2],
            limits: Vec::new(),
            loads: Loads::default(),
            dimensions: None,
            hung: Vec::new(),
        }
    }

    /// Returns the name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Keeps the first call that failed.
    fn refuse(&mut self, refused: Refused) {
        self.refused = self.refused.take().or(Some(refused));
    }

    /// Returns the ground: the global frame, as a planar and a spatial body without coordinates.
    pub fn ground(&self) -> Ground {
        Ground
    }

    /// Adds a planar body between two pins at the distance `length`, with its frame in the middle.
    /// \[m\]
    ///
    /// The assembly finds the pose of the body. If the length is a [`Dimension`], the pins
    /// `start()` and `end()` depend on the dimension.
    ///
    /// Errors: the length is not positive, the name is empty or taken, a dimension belongs to
    /// another mechanism.
    pub fn link<L: IntoNumber>(&mut self, name: &str, length: L) -> Result<Link<L>> {
        self.link_at(name, length, pose(0.0, 0.0, 0.0))
    }

    fn link_at<L: IntoNumber, S: IntoNumber>(
        &mut self,
        name: &str,
        length: L,
        pose: Pose<S, S, S>,
    ) -> Result<Link<L>> {
        let number = self.check_length(name, length.into_number())?;
        let body = self.planar(name, pose)?;
        self.note_length(name, body.index, number)?;
        Ok(Link { body, length })
    }

    /// Returns the length of a link, if it is valid.
    fn check_length(&self, name: &str, length: Dimension) -> Result<Dimension> {
        self.check_origin(name, length)?;
        let value = length.value();
        match value.is_finite() && value > 0.0 {
            true => Ok(length),
            false => Err(Error::InvalidLength { link: name.to_string(), length: value }),
        }
    }

    /// Records the length between the pins of a body.
    pub(crate) fn note_length(
        &mut self,
        name: &str,
        body: Option<usize>,
        length: Dimension,
    ) -> Result<()> {
        let (Some(index), length) = (body, self.check_length(name, length)?) else { return Ok(()) };
        let length = self.hang(name, Bound::Length(self.layout.links.len()), length)?;
        self.layout.links.push((index, length));
        Ok(())
    }

    /// Adds a planar body with the coordinates (R_x, R_y, θ) and a guess of the coordinates. \[m,
    /// m, rad\]
    ///
    /// Errors: the guess is not finite, the name is empty or taken.
    pub fn planar<X: IntoNumber, Y: IntoNumber, A: IntoNumber>(
        &mut self,
        name: &str,
        pose: Pose<X, Y, A>,
    ) -> Result<PlanarBody> {
        let guess = [pose.x.into_number(), pose.y.into_number(), pose.theta.into_number()];
        let index = self.declare_hung(name, Kind::Planar, &guess)?;
        Ok(PlanarBody { mechanism: self.layout.mechanism, index: Some(index) })
    }

    /// Adds a spatial body with the coordinates (R, e0, e1, e2, e3) and a guess of the coordinates.
    /// \[m, –\]
    ///
    /// Kin normalises the Euler parameters p. [`Mechanism::build`] adds the equation |p|² = 1 under
    /// the name `NAME.p`.
    ///
    /// Errors: the guess is not finite or p = 0, the name is empty or taken.
    pub fn spatial(&mut self, name: &str, pose: impl IntoSpatialPose) -> Result<SpatialBody> {
        let Drawn { coordinates, facing } = pose.drawn();
        facing.iter().try_for_each(|number| self.check_origin(name, *number))?;
        let index = self.declare_hung(name, Kind::Spatial, &coordinates)?;
        let first = self.layout.items[index].first;
        self.hang_pose(name, &facing, |part| Bound::Facing { first, part })?;
        Ok(SpatialBody { mechanism: self.layout.mechanism, index: Some(index) })
    }

    /// Adds a scalar coordinate that is an angle, with a guess of its value. \[rad\]
    ///
    /// Errors: the guess is not finite, the name is empty or taken.
    pub fn angle(&mut self, name: &str, guess: impl IntoNumber) -> Result<Coordinate> {
        let index = self.declare_hung(name, Kind::Angle, &[guess.into_number()])?;
        Ok(Coordinate::Own { mechanism: self.layout.mechanism, index })
    }

    /// Adds a scalar coordinate that is a length, with a guess of its value. \[m\]
    ///
    /// Errors: the guess is not finite, the name is empty or taken.
    pub fn length(&mut self, name: &str, guess: impl IntoNumber) -> Result<Coordinate> {
        let index = self.declare_hung(name, Kind::Length, &[guess.into_number()])?;
        Ok(Coordinate::Own { mechanism: self.layout.mechanism, index })
    }

    pub(crate) fn declare(&mut self, name: &str, kind: Kind, guess: &[f64]) -> Result<usize> {
        for ((suffix, _), &value) in kind.coordinates().iter().zip(guess) {
            if !value.is_finite() {
                return Err(Error::InitialNotFinite {
                    name: name.to_string(),
                    coordinate: format!("{name}{suffix}"),
                    value,
                });
            }
        }
        if name == GROUND && matches!(kind, Kind::Planar | Kind::Spatial) {
            return Err(Error::DuplicateName { what: "bodies", name: name.to_string() });
        }
        let index = self.layout.declare(name, kind)?;
        self.initial.extend_from_slice(guess);
        Ok(index)
    }

    /// Adds a constraint under a name.
    ///
    /// Errors, each of which contains the name of the constraint:
    ///
    /// * The name is empty or taken.
    /// * A parameter is not finite or invalid: a negative length, a zero axis, a table that does
    ///   not increase.
    /// * A body belongs to another mechanism, or the constraint contains a body or coordinate
    ///   twice.
    /// * An equation contains no coordinates, because its bodies are the ground.
    pub fn add(&mut self, name: &str, constraint: impl IntoConstraint) -> Result<ConstraintId> {
        let mut constraint = constraint.into_constraint();
        let bound = constraint.take_bindings().take();
        self.add_bound(name, constraint, bound)
    }

    /// Adds a constraint, where these parameters are expressions of dimensions.
    pub(crate) fn add_bound(
        &mut self,
        name: &str,
        constraint: Box<dyn Constraint>,
        bound: Vec<(String, Dimension)>,
    ) -> Result<ConstraintId> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "constraint" });
        }
        if self.names.contains(name) {
            return Err(Error::DuplicateName { what: "constraints", name: name.to_string() });
        }
        admission::holds(name, constraint.as_ref())?;
        admission::admit(&self.name, &self.layout, name, constraint.as_ref())?;
        let holder = Holder::Constraint(self.constraints.len());
        let hung = self.hung_parameters(name, holder, bound, constraint.as_ref())?;
        self.hung.extend(hung);
        self.names.insert(name.to_string());
        self.constraints.push((name.to_string(), constraint));
        Ok(ConstraintId(self.constraints.len() - 1))
    }

    /// Sets the guess of one coordinate. \[m or rad\]
    ///
    /// Errors: the guess is not finite, the coordinate belongs to another mechanism.
    pub fn guess(&mut self, coordinate: Coordinate, value: impl IntoNumber) -> Result<()> {
        self.set_all("guess", Target::Coord(coordinate, Trig::Unused), &[value.into_number()])
    }

    /// Sets the guess of the pose of a planar body. \[m, m, rad\]
    ///
    /// Errors: the guess is not finite, the body belongs to another mechanism.
    pub fn set_pose<X: IntoNumber, Y: IntoNumber, A: IntoNumber>(
        &mut self,
        body: impl Into<PlanarBody>,
        pose: Pose<X, Y, A>,
    ) -> Result<()> {
        let guess = [pose.x.into_number(), pose.y.into_number(), pose.theta.into_number()];
        self.set_all("set_pose", Target::Planar(body.into()), &guess)
    }

    /// Sets the guess of the pose of a spatial body. \[m, –\]
    ///
    /// Errors: the guess is not finite or p = 0, the body belongs to another mechanism.
    pub fn set_spatial_pose(
        &mut self,
        body: impl Into<SpatialBody>,
        pose: impl IntoSpatialPose,
    ) -> Result<()> {
        let target = Target::Spatial(body.into());
        let Drawn { coordinates, facing } = pose.drawn();
        facing.iter().try_for_each(|number| self.check_origin("set_spatial_pose", *number))?;
        self.set_all("set_spatial_pose", target, &coordinates)?;
        let Some(Place::Own { first, .. }) = self.layout.place(&target) else { return Ok(()) };
        self.hang_pose("set_spatial_pose", &facing, |part| Bound::Facing { first, part })
    }

    /// Sets the guesses of all coordinates, in the order of their declaration. \[m, rad\]
    ///
    /// Errors: the list has the wrong length, a guess is not finite.
    pub fn set_initial(&mut self, q: &[f64]) -> Result<()> {
        if q.len() != self.initial.len() {
            return Err(Error::WrongLength {
                what: "initial guess".to_string(),
                expected: self.initial.len(),
                found: q.len(),
            });
        }
        if let Some(k) = q.iter().position(|x| !x.is_finite()) {
            return Err(Error::initial_not_finite(&self.layout, k, q[k]));
        }
        self.initial.copy_from_slice(q);
        self.free_guesses(0..q.len());
        Ok(())
    }

    /// Writes a guess. For the ground there is nothing to write.
    fn set_all(&mut self, place: &str, target: Target, numbers: &[Dimension]) -> Result<()> {
        let foreign = || Error::ForeignBody {
            mechanism: self.name.clone(),
            place: place.to_string(),
            argument: "body".to_string(),
        };
        let Place::Own { first, .. } = self.layout.place(&target).ok_or_else(foreign)? else {
            return Ok(());
        };
        if let Some(k) = numbers.iter().position(|number| !number.value().is_finite()) {
            return Err(Error::initial_not_finite(&self.layout, first + k, numbers[k].value()));
        }
        numbers.iter().try_for_each(|number| self.check_origin(place, *number))?;
        self.free_guesses(first..first + numbers.len());
        for (column, number) in (first..).zip(numbers) {
            self.initial[column] = self.hang(place, Bound::Guess(column), *number)?;
        }
        Ok(())
    }

    /// Returns the mechanism, or the error of a call that has no result. Errors: units that
    /// contradict each other, a mistake in a preference.
    pub(crate) fn settled(mut self) -> Result<Self> {
        match self.refused.take() {
            Some(Refused::Units { before, units }) => units::refusal(before.as_ref(), &units)?,
            Some(Refused::Preference(wish)) => self.note(wish)?,
            Some(Refused::Gravity(numbers)) => self.pull(numbers)?,
            None => {}
        }
        self.check_units()?;
        Ok(self)
    }
}
