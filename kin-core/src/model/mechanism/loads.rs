//! Adds masses, gravity and loads to a mechanism.

use super::{Mechanism, Refused, admission};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::dimensions::{
    Beside, Bindings, Dimension, Holder, Hung, IntoGravity, IntoNumber, IntoParameter, IntoVector,
    Name,
};
use crate::model::body::Body;
use crate::model::constraint::Constraint;
use crate::model::loads::{
    Acting, Along, ForceAlong, HasMass, Holding, HungInLoad, IntoLoad, Line, Load, OnBody, Solid,
    senseless, sensible_gravity, sensible_point_mass,
};
use crate::model::mechanism::IntoConstraint;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::{Error, Result};

impl Mechanism {
    /// Sets the mass of a body, its centre of mass in the body frame, and its inertia about the
    /// centre of mass. \[kg, m, kg m²\]
    ///
    /// The inertia is one moment in the plane, and a tensor in the axes of the body in space. Each
    /// number may be a [`Dimension`]. A second call for the same body replaces the mass of the
    /// first call.
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
    /// Errors: the body is the ground or belongs to another mechanism; the mass is not positive; a
    /// number is not finite; no body can have the inertia. An impossible inertia is not symmetric,
    /// has a negative moment, or has a principal moment above the sum of the two others.
    pub fn mass<B: HasMass>(
        &mut self,
        body: B,
        mass: impl IntoNumber,
        centre: impl IntoVector<B::Vector>,
        inertia: impl IntoParameter<B::Inertia>,
    ) -> Result<()> {
        let mut hung = Bindings::default();
        let mass = hung.number("mass", mass);
        let centre = Vec3::from(hung.vector("centre", centre.numbers()));
        let inertia = inertia.into_parameter(&Name::Own("inertia"), &mut hung);
        self.weigh(body, B::solid(mass, centre, inertia), hung.take())
    }

    /// Sets the mass of a body from shapes and a density: `m.solid(crank, Solid::bar(0.1, 0.02,
    /// 0.01, Solid::STEEL))`. A planar body ignores z.
    ///
    /// Errors: those of [`Mechanism::mass`].
    pub fn solid<B: Body>(&mut self, body: B, solid: Solid) -> Result<()> {
        self.weigh(body, solid, Vec::new())
    }

    /// Sets the mass of a body, where numbers with these names depend on dimensions.
    pub(crate) fn weigh<B: Body>(
        &mut self,
        body: B,
        solid: Solid,
        bound: Vec<(String, Dimension)>,
    ) -> Result<()> {
        let target = body.target();
        let item = match self.placed(&target, "mass")? {
            Place::Own { item, .. } => item,
            Place::Ground(_) => {
                return Err(senseless(
                    "ground",
                    "mass",
                    "the ground does not move, so a mass of the ground has no effect. Give the mass to a body that can move",
                ));
            }
        };
        let name = self.layout.items[item].name.clone();
        solid.sensible(&name, matches!(target, Target::Planar(_)))?;
        self.hang_beside(&name, Beside::Solid(item), bound)?;
        self.loads.solids.retain(|(known, _)| *known != item);
        self.loads.solids.push((item, solid));
        Ok(())
    }

    /// Adds a mass at a point that belongs to no body, for a mechanism in scalar coordinates.
    /// \[kg\]
    ///
    /// The point is a constraint of two or three rows whose value is the position r(q, t). The
    /// parameters of the point and the mass may be [`Dimension`]s.
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
    /// Errors: those of [`Mechanism::add`]; the mass is not positive; the point does not have two
    /// or three rows.
    pub fn point_mass(
        &mut self,
        name: &str,
        point: impl IntoConstraint,
        mass: impl IntoNumber,
    ) -> Result<()> {
        let mut point = point.into_constraint();
        let bound = point.take_bindings().take();
        self.point_mass_bound(name, (point, bound), mass.into_number())
    }

    /// Adds a mass at a point, where parameters of the point depend on dimensions.
    pub(crate) fn point_mass_bound(
        &mut self,
        name: &str,
        (point, bound): (Box<dyn Constraint>, Vec<(String, Dimension)>),
        mass: Dimension,
    ) -> Result<()> {
        self.admit_load(name, point.as_ref())?;
        let rows = point.facts().rows.len();
        if !(2..=3).contains(&rows) {
            let reason =
                format!("a point has two or three rows, but this constraint has {rows} rows");
            return Err(senseless(name, "point with mass", &reason));
        }
        sensible_point_mass(name, mass.value())?;
        let number = self.loads.points.len();
        let hung = self.hung_parameters(name, Holder::Point(number), bound, point.as_ref())?;
        self.hang_beside(name, Beside::PointMass(number), vec![("mass".to_string(), mass)])?;
        self.hung.extend(hung);
        self.loads.points.push((name.to_string(), point, mass.value()));
        Ok(())
    }

    /// Sets the acceleration of gravity, such as `vec2(0.0, -9.81)`; without this call it is zero.
    /// \[m/s²\]
    ///
    /// The components may be [`Dimension`]s. [`Mechanism::build`] returns an error if a component
    /// is not finite.
    pub fn gravity(&mut self, g: impl IntoGravity) {
        let numbers = g.numbers();
        if self.pull(numbers).is_err() {
            self.refuse(Refused::Gravity(numbers));
        }
    }

    /// Returns an error for numbers that are not finite, and for dimensions of another mechanism.
    pub(super) fn pull(&mut self, numbers: [Dimension; 3]) -> Result<()> {
        let mut hung = Bindings::default();
        let gravity = hung.vector("g", numbers);
        sensible_gravity(&gravity)?;
        self.hang_beside("gravity", Beside::Gravity, hung.take())?;
        self.loads.gravity = gravity;
        Ok(())
    }

    /// Adds a load under a name: an energy, a force along a length or an angle, or a force or
    /// torque on a body.
    ///
    /// An energy is a [`crate::loads::Potential`]. [`crate::Load`] creates forces, and
    /// [`crate::loads`] contains the library of loads. The numbers of a load may be [`Dimension`]s.
    /// A closure keeps the values that it captured, so its numbers do not follow dimensions.
    ///
    /// Errors: those of [`Mechanism::add`]; the load acts on the ground alone; a law is invalid. If
    /// no joint has the measure of a load, [`Mechanism::build`] returns the error, because the
    /// program may add the joint later.
    pub fn load(&mut self, name: &str, load: impl IntoLoad) -> Result<()> {
        let mut load = load.into_load();
        let bound = load.take_bindings();
        self.load_bound(name, load, bound)
    }

    /// Adds a load, where these numbers depend on dimensions.
    pub(crate) fn load_bound(
        &mut self,
        name: &str,
        load: Load,
        bound: Vec<HungInLoad>,
    ) -> Result<()> {
        let mut all: Vec<&Acting> = Vec::new();
        load.parts(&mut |part| all.push(part));
        if all.is_empty() || name.trim().is_empty() {
            return Err(Error::EmptyName { what: "load" });
        }
        for part in &all {
            if let Acting::Along(_, ForceAlong::Written(force)) = part {
                admission::finite_parameters(name, force.as_ref())?;
                admission::sensible_parameters(name, force.as_ref())?;
            }
            match part {
                Acting::Along(Along(Line::Named(_)), _) => {}
                Acting::Potential(scalar) | Acting::Along(Along(Line::Row(scalar)), _) => {
                    self.admit_load(name, scalar.as_ref())?;
                    let rows = scalar.facts().rows.len();
                    if rows != 1 {
                        let reason = format!(
                            "a load acts along one number, but this constraint has {rows} rows"
                        );
                        return Err(senseless(name, scalar.facts().kind, &reason));
                    }
                }
                Acting::OnBody(on) => self.admit_on_body(name, on)?,
                Acting::Sum(_) => {}
            }
        }
        self.fresh(name)?;
        let hung = self.hung_in_load(name, &all, bound)?;
        self.hung.extend(hung);
        self.loads.loads.push((name.to_string(), load));
        Ok(())
    }

    /// Returns the numbers of the new load that depend on dimensions, with their places.
    fn hung_in_load(
        &self,
        name: &str,
        parts: &[&Acting],
        bound: Vec<HungInLoad>,
    ) -> Result<Vec<Hung>> {
        let load = self.loads.loads.len();
        let mut hung = Vec::new();
        for (part, acting) in parts.iter().enumerate() {
            for holding in [Holding::Scalar, Holding::Force, Holding::OnBody] {
                let own = bound.iter().filter(|own| (own.0, own.1) == (part, holding));
                let own: Vec<(String, Dimension)> =
                    own.map(|(_, _, name, number)| (name.clone(), *number)).collect();
                let is_force = holding == Holding::Force;
                let holder = match is_force {
                    true => Holder::Force { load, part },
                    false => Holder::Load { load, part },
                };
                hung.extend(match acting.constraint(is_force) {
                    Some(constraint) => self.hung_parameters(name, holder, own, constraint)?,
                    None => self.hung_beside(name, &Beside::OnBody { load, part }, own)?,
                });
            }
        }
        Ok(hung)
    }

    fn admit_on_body(&self, name: &str, on: &OnBody) -> Result<()> {
        if let Place::Ground(_) = self.placed(&on.target, name)? {
            return Err(senseless(
                name,
                "load",
                "the load is on the ground, which does not move. Give the load a body that can move",
            ));
        }
        on.sensible(name)
    }

    /// Checks the constraint of a load or of a point with mass.
    fn admit_load(&self, name: &str, scalar: &dyn Constraint) -> Result<()> {
        if name.trim().is_empty() {
            return Err(Error::EmptyName { what: "load" });
        }
        self.fresh(name)?;
        admission::admit(&self.name, &self.layout, name, scalar)
    }

    fn fresh(&self, name: &str) -> Result<()> {
        let known = self.loads.loads.iter().map(|(known, _)| known);
        match known
            .chain(self.loads.points.iter().map(|(known, ..)| known))
            .any(|known| known == name)
        {
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
