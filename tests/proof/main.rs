//! Proofs by interval bounds: what holds is proved, what does not is not, and no verdict depends on units.

mod own;
mod whole_turns;
