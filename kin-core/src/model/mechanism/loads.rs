//! Masses of bodies, gravity, and what acts on a mechanism.

use super::{Mechanism, Refused, admission};
use crate::model::body::{Body, Vector};
use crate::model::constraint::Constraint;
use crate::model::coordinates::Target;
use crate::model::error::{Error, Result};
use crate::model::layout::Place;
use crate::model::loads::{Acting, ForceAlong, IntoLoad, Massive, OnBody, Solid};
use crate::model::mechanism::IntoConstraint;

/// Why a load with a dimension in it is refused.
const HANGS: &str =
    "numbers of loads and of points with mass do not follow dimensions: give the `value()` of it";

impl Mechanism {
    /// The mass of a body, its centre of mass in the body's frame and its inertia about that centre: in the
    /// plane one moment, in space a tensor in the body's axes. Given again it takes the place of what was
    /// given before.   \[kg, m, kg m²\]
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("pendulum, driven");
    /// let arm = m.link("arm", 0.5)?;
    /// m.mass(arm, 1.2, vec2(0.1, 0.0), 0.03)?;
    /// m.gravity(vec2(0.0, -9.81));
    /// m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    /// m.add("motor", drive_angle(arm, Law::ramp(2.0)))?;
    /// let system = m.build()?;
    /// let motion = system.run(linspace(0.0, 3.0, 301))?;
    /// let forces = system.forces(&motion)?;
    /// println!("{}", forces.drive("motor")?.peak()); // 4.1202 N m at 0 s
    /// assert!((forces.drive("motor")?.peak().value - 1.2 * 9.81 * 0.35).abs() < 1e-12);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: the ground or a body of another mechanism; a mass that is not above zero, numbers that are not
    /// finite, an inertia that no body can have (not symmetric, a moment below zero, a principal moment above
    /// the sum of the two others).
    pub fn mass<B: Massive>(
        &mut self,
        body: B,
        mass: f64,
        centre: impl Into<B::Vector>,
        inertia: impl Into<B::Inertia>,
    ) -> Result<()> {
        self.solid(body, B::solid(mass, centre.into(), inertia.into()))
    }

    /// The same by a shape and a density: `m.solid(crank, Solid::bar(0.1, 0.02, 0.01, Solid::STEEL))`. In a
    /// plane z does not count.
    ///
    /// Errors: those of [`Mechanism::mass`].
    pub fn solid<B: Body>(&mut self, body: B, solid: Solid) -> Result<()> {
        let target = body.target();
        let item = match self.placed(&target, "mass")? {
            Place::Own { item, .. } => item,
            Place::Ground(_) => {
                return Err(refused("ground", "mass", "the ground does not move: its mass does nothing"));
            }
        };
        if let Some(reason) = solid.refusal(matches!(target, Target::Planar(_))) {
            return Err(refused(&self.layout.items[item].name, "mass", &reason));
        }
        self.loads.solids.retain(|(known, _)| *known != item);
        self.loads.solids.push((item, solid));
        Ok(())
    }

    /// A mass at a point that is not one of a body: of a mechanism in bare coordinates. The point is a
    /// constraint of two or three rows whose value is where it is, r(q, t).   \[kg\]
    ///
    /// ```
    /// # use kin::prelude::*;
    /// /// The tip of a pendulum.      [m]
    /// #[constraint]
    /// fn tip(theta: Coord, l: f64) -> (f64, f64) {
    ///     let x = l * theta.cos();
    ///     let y = l * theta.sin();
    ///     (x, y)
    /// }
    ///
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("pendulum");
    /// let theta = m.angle("theta", 0.0)?;
    /// m.point_mass("bob", tip(theta, 0.4), 2.0)?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: those of [`Mechanism::add`]; a mass that is not above zero, a point with more or fewer rows.
    pub fn point_mass(&mut self, name: &str, point: impl IntoConstraint, mass: f64) -> Result<()> {
        let point = point.into_constraint();
        self.admit_load(name, point.as_ref())?;
        let rows = point.facts().rows.len();
        if !(2..=3).contains(&rows) {
            return Err(refused(
                name,
                "point with mass",
                &format!("a point has two or three rows, this has {rows}"),
            ));
        }
        if !(mass.is_finite() && mass > 0.0) {
            return Err(refused(
                name,
                "point with mass",
                &format!("the mass is {mass}; give one above zero"),
            ));
        }
        self.loads.points.push((name.to_string(), point, mass));
        Ok(())
    }

    /// The acceleration of gravity, such as `vec2(0.0, -9.81)`; zero without it. Numbers that are not finite
    /// are told by [`Mechanism::build`].   \[m/s²\]
    pub fn gravity<V: Vector>(&mut self, g: V) {
        let mut gravity = [0.0; 3];
        gravity.iter_mut().zip(0..V::NAMES.len()).for_each(|(to, k)| *to = g.component(k));
        match gravity.iter().find(|g| !g.is_finite()) {
            Some(bad) => self.refuse(Refused::Gravity(*bad)),
            None => self.loads.gravity = gravity,
        }
    }

    /// Something that acts, under a name: an energy ([`crate::Potential`]), a force along a length or an
    /// angle ([`crate::Load::along`]), a force or torque on a body; [`crate::loads`] has the library.
    ///
    /// Errors: those of [`Mechanism::add`]; a load on the ground alone; laws that make no sense.
    pub fn load(&mut self, name: &str, load: impl IntoLoad) -> Result<()> {
        let load = load.into_load();
        let mut all: Vec<Acting> = Vec::new();
        load.parts(&mut |part| all.push(part.clone()));
        if all.is_empty() || name.trim().is_empty() {
            return Err(Error::EmptyName { what: "load" });
        }
        for part in &all {
            if let Acting::Along(_, ForceAlong::Written(force)) = part {
                self.admit_force(name, force.as_ref())?;
            }
            match part {
                Acting::Potential(scalar) | Acting::Along(scalar, _) => {
                    self.admit_load(name, scalar.as_ref())?;
                    let rows = scalar.facts().rows.len();
                    if rows != 1 {
                        let reason = format!("a load acts along one number, this has {rows} rows");
                        return Err(refused(name, scalar.facts().kind, &reason));
                    }
                }
                Acting::OnBody(on) => self.admit_on_body(name, on)?,
                Acting::Sum(_) => {}
            }
        }
        self.fresh(name)?;
        self.loads.loads.push((name.to_string(), load));
        Ok(())
    }

    /// The numbers of a force along x.
    fn admit_force(&self, name: &str, force: &dyn Constraint) -> Result<()> {
        if !force.clone_boxed().take_bindings().take().is_empty() {
            return Err(refused(name, force.facts().kind, HANGS));
        }
        admission::finite_parameters(name, force)?;
        admission::sensible_parameters(name, force)
    }

    fn admit_on_body(&self, name: &str, on: &OnBody) -> Result<()> {
        if let Place::Ground(_) = self.placed(&on.target, name)? {
            return Err(refused(name, "load", "it is on the ground, which does not move: give it a body"));
        }
        if let Some(bad) = on.point.iter().find(|x| !x.is_finite()) {
            return Err(refused(name, "load", &format!("a coordinate of its point is {bad}")));
        }
        let mut hangs = false;
        on.force.iter().chain(&on.torque).for_each(|law| law.each_hung(&mut |_, _| hangs = true));
        if hangs {
            return Err(refused(name, "load", HANGS));
        }
        match on.force.iter().chain(&on.torque).find_map(|law| law.refusal()) {
            Some(reason) => Err(refused(name, "load", &reason)),
            None => Ok(()),
        }
    }

    /// A scalar or a point that carries something.
    fn admit_load(&self, name: &str, scalar: &dyn Constraint) -> Result<()> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "load" });
        }
        self.fresh(name)?;
        if !scalar.clone_boxed().take_bindings().take().is_empty() {
            return Err(refused(name, scalar.facts().kind, HANGS));
        }
        admission::admit(&self.name, &self.layout, name, scalar)
    }

    fn fresh(&self, name: &str) -> Result<()> {
        let known = self.loads.loads.iter().map(|(known, _)| known);
        match known.chain(self.loads.points.iter().map(|(known, ..)| known)).any(|known| known == name) {
            true => Err(Error::DuplicateName { what: "loads", name: name.to_string() }),
            false => Ok(()),
        }
    }

    fn placed(&self, target: &Target, place: &str) -> Result<Place> {
        self.layout.place(target).ok_or_else(|| Error::ForeignBody {
            mechanism: self.name.clone(),
            place: place.to_string(),
            argument: "body".to_string(),
        })
    }
}

fn refused(name: &str, kind: &str, reason: &str) -> Error {
    let (constraint, kind) = (name.to_string(), kind.to_string());
    Error::InvalidParameters { constraint, kind, reason: reason.to_string() }
}

/// The error for a component of gravity that is not finite.
pub(super) fn gravity(value: f64) -> Result<()> {
    Err(refused("gravity", "acceleration", &format!("a component is {value}; give finite numbers")))
}
