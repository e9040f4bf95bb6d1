//! Sets the numbers of masses and loads by their names, and checks them.

use super::{Acting, Along, ForceAlong, Friction, Line, Loads, OnBody, Solid};
use crate::dimensions::{Beside, Holder};
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::outcome::error::{Error, Result};

impl Loads {
    /// Returns the name and the constraint of a mass or load.
    pub(crate) fn held(&self, by: Holder) -> Option<(&str, &dyn Constraint)> {
        match by {
            Holder::Constraint(_) => None,
            Holder::Point(k) => {
                self.points.get(k).map(|(name, point, _)| (name.as_str(), point.as_ref()))
            }
            Holder::Load { load, part } | Holder::Force { load, part } => {
                let (name, load) = self.loads.get(load)?;
                let is_force = matches!(by, Holder::Force { .. });
                Some((name, load.part(part)?.constraint(is_force)?))
            }
        }
    }

    /// Returns the constraint of a mass or load, mutable.
    pub(crate) fn held_mut(&mut self, by: Holder) -> Option<&mut Box<dyn Constraint>> {
        match by {
            Holder::Constraint(_) => None,
            Holder::Point(k) => self.points.get_mut(k).map(|(_, point, _)| point),
            Holder::Load { load, part } => match self.loads.get_mut(load)?.1.part_mut(part)? {
                Acting::Potential(scalar) | Acting::Along(Along(Line::Row(scalar)), _) => {
                    Some(scalar)
                }
                _ => None,
            },
            Holder::Force { load, part } => match self.loads.get_mut(load)?.1.part_mut(part)? {
                Acting::Along(_, ForceAlong::Written(force)) => Some(force),
                _ => None,
            },
        }
    }

    /// Sets a number by its name. Returns false if there is no number with this name.
    pub(crate) fn put(&mut self, of: &Beside, name: &str, value: f64) -> bool {
        match of {
            Beside::Solid(item) => {
                let own = self.solids.iter_mut().find(|(known, _)| known == item);
                own.is_some_and(|(_, solid)| solid.put(name, value))
            }
            Beside::PointMass(k) => {
                name == "mass" && self.points.get_mut(*k).map(|(.., mass)| *mass = value).is_some()
            }
            Beside::Gravity => put_component(&mut self.gravity, "g", name, value),
            Beside::OnBody { load, part } => {
                match self.loads.get_mut(*load).and_then(|(_, load)| load.part_mut(*part)) {
                    Some(Acting::OnBody(on)) => on.put(name, value),
                    _ => false,
                }
            }
            Beside::Friction(joint) => {
                let own = self.frictions.iter_mut().find(|(known, _)| known == joint);
                own.is_some_and(|(_, friction)| friction.put(name, value))
            }
        }
    }
}

impl Solid {
    fn put(&mut self, name: &str, value: f64) -> bool {
        let j = &mut self.inertia;
        let places = match name {
            "mass" => [&mut self.mass].into_iter().collect::<Vec<&mut f64>>(),
            "centre.x" => vec![&mut self.centre.x],
            "centre.y" => vec![&mut self.centre.y],
            "centre.z" => vec![&mut self.centre.z],
            // In a plane the name `inertia` means the moment about z.
            "inertia" => vec![&mut j.m11, &mut j.m22, &mut j.m33],
            "inertia.m11" => vec![&mut j.m11],
            "inertia.m12" => vec![&mut j.m12],
            "inertia.m13" => vec![&mut j.m13],
            "inertia.m21" => vec![&mut j.m21],
            "inertia.m22" => vec![&mut j.m22],
            "inertia.m23" => vec![&mut j.m23],
            "inertia.m31" => vec![&mut j.m31],
            "inertia.m32" => vec![&mut j.m32],
            "inertia.m33" => vec![&mut j.m33],
            _ => return false,
        };
        places.into_iter().for_each(|place| *place = value);
        true
    }

    /// Returns an error for a mass or an inertia that no body can have.
    pub(crate) fn sensible(&self, body: &str, planar: bool) -> Result<()> {
        self.refusal(planar).map_or(Ok(()), |reason| Err(senseless(body, "mass", &reason)))
    }
}

impl OnBody {
    fn put(&mut self, name: &str, value: f64) -> bool {
        let Some((of, own)) = name.split_once('.') else { return false };
        if of == "point" {
            return put_component(&mut self.point, "point", name, value);
        }
        let Some((component, own)) = own.split_once('.') else { return false };
        let laws: &mut [Law; 3] = match of {
            "force" => &mut self.force,
            "torque" => &mut self.torque,
            _ => return false,
        };
        let law =
            COMPONENTS.iter().position(|known| *known == component).and_then(|k| laws.get_mut(k));
        law.is_some_and(|law| law.set_parameter(own, value))
    }

    /// Returns an error for a point that is not finite, or for invalid laws.
    pub(crate) fn sensible(&self, load: &str) -> Result<()> {
        if let Some(bad) = self.point.iter().find(|x| !x.is_finite()) {
            return Err(senseless(
                load,
                "load",
                &format!("a coordinate of the point of the load is {bad}. Give finite numbers"),
            ));
        }
        match self.force.iter().chain(&self.torque).find_map(|law| law.refusal()) {
            Some(reason) => Err(senseless(load, "load", &reason)),
            None => Ok(()),
        }
    }
}

impl Friction {
    /// Returns the names of the numbers, in their order.
    pub(crate) fn names(&self) -> [&'static str; 4] {
        let [a, b] = self.shape.names();
        ["coefficient", "rate", a, b]
    }

    fn put(&mut self, name: &str, value: f64) -> bool {
        let Some(k) = self.names().iter().position(|known| *known == name) else { return false };
        let [a, b] = self.shape.numbers_mut();
        *[&mut self.coefficient, &mut self.rate, a, b][k] = value;
        true
    }
}

const COMPONENTS: [&str; 3] = ["x", "y", "z"];

/// Sets component `name` of the vector with the name `of`.
fn put_component(vector: &mut [f64; 3], of: &str, name: &str, value: f64) -> bool {
    let own = name.strip_prefix(of).and_then(|rest| rest.strip_prefix('.'));
    let place = own.and_then(|own| COMPONENTS.iter().position(|known| *known == own));
    place.map(|k| vector[k] = value).is_some()
}

/// Returns an error for a mass that is not positive.
pub(crate) fn sensible_point_mass(name: &str, mass: f64) -> Result<()> {
    match mass.is_finite() && mass > 0.0 {
        true => Ok(()),
        false => Err(senseless(
            name,
            "point with mass",
            &format!("the mass is {mass}. Give a value above zero"),
        )),
    }
}

/// Returns an error for a component that is not finite.
pub(crate) fn sensible_gravity(gravity: &[f64; 3]) -> Result<()> {
    match gravity.iter().find(|g| !g.is_finite()) {
        Some(bad) => Err(senseless(
            "gravity",
            "acceleration",
            &format!("a component is {bad}. Give finite numbers"),
        )),
        None => Ok(()),
    }
}

/// Builds the error for invalid numbers.
pub(crate) fn senseless(name: &str, kind: &str, reason: &str) -> Error {
    let constraint = name.to_string();
    let kind = kind.to_string();
    Error::InvalidParameters { constraint, kind, reason: reason.to_string() }
}
