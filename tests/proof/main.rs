//! Proofs by interval bounds: what holds is proved, what does not is not, and no verdict depends on
//! units.

// Tables of cases hold functions, and arguments next to a pole as they are written.
#![allow(clippy::type_complexity, clippy::approx_constant)]

mod breaking;
#[path = "../data/engines.rs"]
mod engines;
#[path = "../data/hermite.rs"]
mod hermite;
#[path = "../following/models.rs"]
mod models;
#[path = "../data/own.rs"]
mod own;
mod promises;
mod random;
mod refused;
mod singular;
mod whole_turns;
mod wide;
