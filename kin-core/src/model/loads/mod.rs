//! Masses of bodies, gravity, and what else acts on a mechanism: described here, computed in
//! `forces/`.

mod along;
mod check;
mod friction;
mod load;
mod numbers;
mod sharing;
mod solid;
mod torque;

pub use along::{Along, IntoAlong};
pub(crate) use along::{ForceAlong, Line};
pub use friction::Friction;
pub(crate) use friction::{Seat, Shape};
pub(crate) use load::{Acting, Holding, HungInLoad, OnBody};
pub use load::{IntoLoad, Load, Potential};
pub(crate) use numbers::{senseless, sensible_gravity, sensible_point_mass};
pub use sharing::LoadSharing;
pub use solid::{HasMass, Solid};
pub use torque::{ByLaws, HasTorque};

use crate::model::constraint::Constraint;

/// Everything that has mass, and everything that acts.
#[derive(Clone, Default)]
pub(crate) struct Loads {
    /// Bodies by the number of their item in the layout.
    pub solids: Vec<(usize, Solid)>,
    /// Points with mass, each with its name: the point as rows of a constraint.
    pub points: Vec<(String, Box<dyn Constraint>, f64)>,
    /// Acceleration of gravity; the third component is zero in a plane.
    pub gravity: [f64; 3],
    pub loads: Vec<(String, Load)>,
    /// Friction by the names of joints.
    pub frictions: Vec<(String, Friction)>,
}

impl Loads {
    /// True if nothing has mass and nothing acts.
    pub(crate) fn is_empty(&self) -> bool {
        self.solids.is_empty() && self.points.is_empty() && self.loads.is_empty()
    }
}
