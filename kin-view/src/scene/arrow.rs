//! Stores the forces and torques of a motion for arrows.

use kin::forces::{BodyWrench, Forces, Reaction};
use kin::loads::HasTorque;
use kin::results::Units;
use kin::{Vec2, Vec3};

use super::{Body, Kind, Scene};

/// Kinds of sources of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Acting {
    Joint,
    Drive,
    Load,
}

/// A force or a torque on a body over time.
#[derive(Clone)]
pub(crate) struct Arrow {
    /// The name, such as `A on crank`.
    pub name: String,
    pub acting: Acting,
    pub body: Body,
    pub is_torque: bool,
    pub unit: String,
    /// The points at which the force acts, one for each time. \[m\]
    pub points: Vec<Vec3>,
    /// The components of the force or torque, a vector for each time. \[N or N m\]
    pub vectors: Vec<Vec3>,
}

/// Forces below this share of the largest one at all times are none.   \[-\]
const NOTHING: f64 = 1e-9;

impl Scene {
    /// Shows the forces of the drawn motion as arrows.
    ///
    /// Each constraint and each load has an arrow for its force and an arrow for its torque on its
    /// first body, at its point on this body. The force and torque on the other body are the
    /// opposite. The scene omits forces that are not unique because equations are redundant.
    /// Pictures of a pose and pages show the arrows, with a scale. On a page the arrows move, and
    /// the reader can switch them off.
    pub fn forces(mut self, forces: &Forces<'_>) -> Scene {
        let drives = forces.drives();
        for name in forces.constraints() {
            let acting = if drives.contains(&name) { Acting::Drive } else { Acting::Joint };
            if let Ok(reaction) = forces.reaction(name) {
                self.act(name, acting, &reaction, forces);
            }
        }
        for name in forces.loads() {
            if let Ok(load) = forces.load(name) {
                self.act(name, Acting::Load, &load, forces);
            }
        }
        let [force, torque] = [false, true].map(|is_torque| self.largest(is_torque));
        let lever = torque.max(force * self.reach());
        let is_some =
            |arrow: &Arrow| size(arrow) > NOTHING * if arrow.is_torque { lever } else { force };
        self.arrows.retain(is_some);
        self
    }

    /// How far apart forces act.   \[m\]
    fn reach(&self) -> f64 {
        let points = || self.arrows.iter().flat_map(|arrow| &arrow.points);
        let first = points().next().copied().unwrap_or(Vec3::zeros());
        points().map(|p| (*p - first).norm()).filter(|far| far.is_finite()).fold(0.0, f64::max)
    }

    /// The arrows of one source, on the first body that it acts on.
    fn act(&mut self, name: &str, acting: Acting, reaction: &Reaction<'_>, forces: &Forces<'_>) {
        let units = forces.motion().unit_words();
        for look in &self.looks {
            let source =
                Source { name: format!("{name} on {}", look.name), acting, body: look.body, units };
            let elsewhere = self.is_held_elsewhere(name, look.body);
            let found = match look.body.0 {
                Kind::Planar(body) => reaction.on(body).map(|acted| {
                    let acted = if elsewhere { acted.at(Vec2::zeros()) } else { acted };
                    source.arrows(&acted, flat, across)
                }),
                Kind::Spatial(body) => reaction.on(body).map(|acted| {
                    let acted = if elsewhere { acted.at(Vec3::zeros()) } else { acted };
                    source.arrows(&acted, same, same)
                }),
            };
            if let Ok(arrows) = found {
                self.arrows.extend(arrows);
                return;
            }
        }
    }

    /// True if a joint has points, but none in this body: of a guide on the ground the force is
    /// shown where the body is.
    fn is_held_elsewhere(&self, name: &str, body: Body) -> bool {
        let Some(joint) = self.joints.iter().find(|joint| joint.name == name) else { return false };
        !joint.points.is_empty() && !joint.points.iter().any(|(k, _)| joint.bodies[*k] == body)
    }

    /// The largest force or torque of all at all times.
    fn largest(&self, is_torque: bool) -> f64 {
        self.arrows
            .iter()
            .filter(|arrow| arrow.is_torque == is_torque)
            .map(size)
            .fold(0.0, f64::max)
    }
}

fn size(arrow: &Arrow) -> f64 {
    arrow.vectors.iter().map(|vector| vector.norm()).fold(0.0, f64::max)
}

/// Where arrows come from.
struct Source<'a> {
    name: String,
    acting: Acting,
    body: Body,
    units: &'a Units,
}

impl Source<'_> {
    fn arrows<V: HasTorque>(
        &self,
        acted: &BodyWrench<'_, V>,
        vector: fn(V) -> Vec3,
        torque: fn(V::Torque) -> Vec3,
    ) -> Vec<Arrow> {
        let points: Vec<Vec3> = acted.points().into_iter().map(vector).collect();
        let arrow = |is_torque: bool, unit: String, vectors: Vec<Vec3>| Arrow {
            name: self.name.clone(),
            acting: self.acting,
            body: self.body,
            is_torque,
            unit,
            points: points.clone(),
            vectors,
        };
        let forces = acted.force().map(|all| all.into_iter().map(vector).collect());
        let torques = acted.torque().map(|all| all.into_iter().map(torque).collect());
        let forces = forces.map(|all| arrow(false, self.units.force(), all));
        forces.into_iter().chain(torques.map(|all| arrow(true, self.units.torque(), all))).collect()
    }
}

fn flat(v: Vec2) -> Vec3 {
    Vec3::new(v.x, v.y, 0.0)
}

fn across(torque: f64) -> Vec3 {
    Vec3::new(0.0, 0.0, torque)
}

fn same(v: Vec3) -> Vec3 {
    v
}
