//! Positions of a mechanism with freedom left: the surface C(q) = 0, and the way on it towards
//! wishes, such as a point at a target.

mod descent;
mod goal;
mod levels;
mod manifold;

pub(crate) use descent::{Bound, Descent};
pub(crate) use goal::{Goal, Wanted};
pub(crate) use manifold::{Basis, Manifold};
