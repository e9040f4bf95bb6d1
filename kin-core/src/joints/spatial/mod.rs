//! Defines the joints between spatial bodies, and their drivers.
//!
//! All joints consist of four equations, the [`primitives`]: two points coincide, two directions
//! are perpendicular (dot-1), a direction is perpendicular to the line between two points (dot-2),
//! and two points keep a distance. The number of rows of a joint equals the number of freedoms that
//! the joint removes. The rows have full rank at every regular pose, because the two directions
//! across an axis are fixed in a body ([`Axis`](crate::Axis)) and never depend on the pose. The
//! vector part of relative Euler parameters holds an orientation, without a second solution. Two
//! dot-1 rows that hold axes parallel have a second solution, rotated by 180°. A position with the
//! second solution is an error.

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

/// Gives the equations of all joints their usual names (Haug, *Computer Aided Kinematics and
/// Dynamics*, section 9.4).
pub mod primitives {
    pub use super::{
        distance, perpendicular as dot_1, point_in_plane as dot_2, spherical as at_point,
    };
}
