//! Joints between spatial bodies, and their drivers.
//!
//! Four equations, the [`primitives`], make all joints: two points coincide, two directions are
//! perpendicular (dot-1), a direction is perpendicular to the line between two points (dot-2), and
//! two points keep a distance. A joint has exactly as many rows as it removes freedoms. The rows
//! have full rank at every regular pose, because the two directions across an axis are fixed in a
//! body ([`Axis`](crate::Axis)) and never depend on the pose. The vector part of relative Euler
//! parameters holds an orientation; it has no second solution. Two dot-1 rows that hold axes
//! parallel have a second solution, rotated by 180°. A position with that solution is an error.

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

/// The equations that make all joints, under their names in the field (Haug, *Computer Aided
/// Kinematics and Dynamics*, section 9.4).
pub mod primitives {
    pub use super::{
        distance, perpendicular as dot_1, point_in_plane as dot_2, spherical as at_point,
    };
}
