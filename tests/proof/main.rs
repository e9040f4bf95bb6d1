//! Proofs by interval bounds: what holds is proved, what does not is not, and no verdict depends on units.

#[path = "../following/models.rs"]
mod models;
mod own;
mod random;
mod refused;
mod singular;
mod whole_turns;
