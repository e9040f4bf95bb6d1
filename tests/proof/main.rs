//! Proofs by interval bounds: what holds is proved, what does not is not, and no verdict depends on units.

mod breaking;
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
