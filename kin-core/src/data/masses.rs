//! Masses and gravity as data.

use serde::{Deserialize, Serialize};

use crate::model::coordinates::Target;
use crate::model::error::{Error, Result};
use crate::model::loads::Solid;
use crate::model::mechanism::Mechanism;
use crate::numbers::algebra::{Mat3, Vec3};

/// The mass of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MassData {
    /// Name of the body.
    pub body: String,
    /// Its mass.
    pub mass: f64,
    /// Its centre of mass in its frame; z is 0 in a plane.
    pub centre: [f64; 3],
    /// Its inertia about the centre in its axes, by rows; in a plane the last number counts.
    pub inertia: [[f64; 3]; 3],
}

impl Mechanism {
    /// Masses and gravity as data.
    pub(super) fn mass_data(&self) -> (Vec<MassData>, Option<[f64; 3]>) {
        let data = |(item, solid): &(usize, Solid)| MassData {
            body: self.layout.items[*item].name.clone(),
            mass: solid.mass,
            centre: solid.centre.to_array(),
            inertia: solid.inertia.to_array(),
        };
        let gravity = Some(self.loads.gravity).filter(|gravity| *gravity != [0.0; 3]);
        (self.loads.solids.iter().map(data).collect(), gravity)
    }

    /// Takes masses and gravity from data. Errors: a name that no body has, those of [`Mechanism::mass`].
    pub(super) fn take_masses(&mut self, masses: &[MassData], gravity: Option<[f64; 3]>) -> Result<()> {
        for MassData { body, mass, centre, inertia } in masses {
            let solid = Solid { mass: *mass, centre: Vec3::from(*centre), inertia: Mat3::from(*inertia) };
            let bodies = self.layout.bodies();
            let target = bodies.iter().find(|(known, _)| known == body).map(|(_, target)| *target);
            match target {
                Some(Target::Planar(found)) => self.solid(found, solid)?,
                Some(Target::Spatial(found)) => self.solid(found, solid)?,
                _ => {
                    return Err(Error::UnknownName {
                        what: "body",
                        name: body.clone(),
                        known: bodies.iter().map(|(known, _)| known.to_string()).collect(),
                    });
                }
            }
        }
        if let Some(gravity) = gravity {
            self.gravity(Vec3::from(gravity));
        }
        Ok(())
    }
}
