//! Describes mechanisms: constraints and the states that they read, loads, equations as data.

pub mod blame;
pub(crate) mod body;
pub mod constraint;
pub(crate) mod describer;
pub mod dual_route;
pub(crate) mod formula;
pub(crate) mod loads;
pub mod mechanism;
pub mod state;
pub mod terms;
