//! The description of mechanisms: coordinates, constraints and their states, laws, equations as
//! data, errors.

pub mod blame;
pub(crate) mod body;
pub mod constraint;
pub mod coordinates;
pub(crate) mod describer;
pub mod dimension;
pub mod dual_route;
pub mod error;
pub(crate) mod formula;
pub(crate) mod growth;
pub(crate) mod jammed;
pub mod law;
pub(crate) mod layout;
pub(crate) mod loads;
pub mod mechanism;
pub(crate) mod mismatch;
pub mod motion;
pub(crate) mod named_value;
pub(crate) mod no_derivative;
pub(crate) mod not_unique;
pub mod state;
pub mod terms;
pub(crate) mod units;
pub mod verdict;
pub(crate) mod words;
