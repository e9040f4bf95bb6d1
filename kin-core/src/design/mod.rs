//! Derivatives of a motion by parameters, exact and without differences.
//!
//! With J = C_q and P = C_p along the motion, both as functions of time, C(q(t, p), t, p) = 0 gives
//!
//! ```text
//! J q_p = −P        J q̇_p = −Ṗ − J̇ q_p        J q̈_p = −P̈ − 2 J̇ q̇_p − J̈ q_p
//! ```
//!
//! One walk over the derivatives of each equation with second-order numbers along time gives J, J̇,
//! J̈ and P, Ṗ, P̈ for all parameters (`equation.rs`, `along.rs`). The same factors of J then serve
//! every parameter forward (`sensitivities.rs`, `solver.rs`), and transposed every parameter at
//! once (`adjoint.rs`), which is what optimisers ask for (`objective.rs`). Superfluous equations of
//! a redundant mechanism have to agree (`agreement.rs`). Along a motion of many times all of it is
//! one tape, and the walk is for what is left (`variation/`). A measure reports what it reads
//! (`partials.rs`, `measured.rs`). The time of a toggle stands by itself (`toggle.rs`). With
//! tolerances of dimensions derivatives tell how far a measure, or an extreme or a stroke of it
//! (`feature.rs`), may be off (`tolerance/`).

mod adjoint;
mod agreement;
mod along;
mod asked;
mod equation;
mod feature;
mod measured;
mod objective;
mod partials;
mod sensitivities;
mod smooth;
mod solver;
mod toggle;
mod tolerance;
mod variation;

pub use crate::model::dimension::Distribution;
pub use feature::Feature;
pub use measured::{ExtremeSensitivity, MeasureSensitivity};
pub use objective::Objective;
pub use sensitivities::{Sensitivities, Sensitivity};
pub use tolerance::{
    Contribution, Off, Proved, Samples, Sampling, Searched, SecondOrder, Tolerance,
};
