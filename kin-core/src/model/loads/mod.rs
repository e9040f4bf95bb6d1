//! Describes masses, gravity and loads. The module `forces/` computes forces from them.

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

/// The masses and loads of a mechanism.
#[derive(Clone, Default)]
pub(crate) struct Loads {
    /// Masses of bodies, each with the index of its item in the layout.
    pub solids: Vec<(usize, Solid)>,
    /// Masses at points: the name, the point as the rows of a constraint, and the mass.
    pub points: Vec<(String, Box<dyn Constraint>, f64)>,
    /// Acceleration of gravity; in a plane the third component is zero.
    pub gravity: [f64; 3],
    pub loads: Vec<(String, Load)>,
    /// Friction, with the name of its joint.
    pub frictions: Vec<(String, Friction)>,
}

impl Loads {
    /// Returns true if there is no mass and no load.
    pub(crate) fn is_empty(&self) -> bool {
        self.solids.is_empty() && self.points.is_empty() && self.loads.is_empty()
    }
}
