//! Joints between spatial bodies, and their drivers.
//!
//! All are made of four equations, the [`primitives`]: points coincide, two directions are
//! perpendicular (dot-1), a direction is perpendicular to the line between two points (dot-2), two
//! points keep a distance. Each joint has exactly as many rows as it removes freedoms, of full rank
//! at every regular pose: where an equation needs two directions across an axis, they are fixed in
//! a body ([`Axis`](crate::Axis)), never chosen by the pose. Orientations are held by the vector
//! part of relative Euler parameters, which has no second solution; axes held parallel by two dot-1
//! rows have one, turned by 180°, and tell it as an error once a position is found.

mod couplings;
mod directions;
mod links;
mod lower_pairs;
mod moving;
mod norm;
mod points;

pub use super::drivers::spatial::*;
pub use couplings::*;
pub use directions::*;
pub use links::*;
pub use lower_pairs::*;
pub use moving::*;
pub use norm::*;
pub use points::*;

/// The equations that all joints are made of, by their names in the field (Haug, *Computer Aided
/// Kinematics and Dynamics*, section 9.4).
pub mod primitives {
    pub use super::{
        distance, perpendicular as dot_1, point_in_plane as dot_2, spherical as at_point,
    };
}
