//! Computes exact derivatives of a motion by parameters, without finite differences.
//!
//! Let J = C_q and P = C_p along the motion, both functions of time. Differentiation of C(q(t, p),
//! t, p) = 0 gives
//!
//! ```text
//! J q_p = −P        J q̇_p = −Ṗ − J̇ q_p        J q̈_p = −P̈ − 2 J̇ q̇_p − J̈ q_p
//! ```
//!
//! * `equation.rs` and `along.rs` evaluate the derivatives of each equation with second-order
//!   numbers along time. The results are J, J̇, J̈ and P, Ṗ, P̈ for all parameters.
//! * `sensitivities.rs` and `solver.rs` solve forward for every parameter with the factors of J.
//! * `adjoint.rs` solves with the transposed factors for every parameter at once. Optimisers use
//!   the adjoint solution (`objective.rs`).
//! * `agreement.rs` checks the redundant equations of a mechanism.
//! * `variation/` records all derivatives as one tape, for motions of many times.
//! * `partials.rs` and `measured.rs` differentiate measures.
//! * `toggle.rs` differentiates the time of a toggle.
//! * `tolerance/` computes from tolerances of dimensions how far a measure, an extreme or a stroke
//!   (`feature.rs`) can deviate.

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

pub use crate::dimensions::Distribution;
/// The crate of optimisers, in the version whose traits objectives implement.
#[cfg(feature = "argmin")]
pub use argmin;
pub use feature::Feature;
pub use measured::{ExtremeSensitivity, MeasureSensitivity};
pub use objective::Objective;
pub use sensitivities::{Sensitivities, Sensitivity};
pub use tolerance::{
    Contribution, Off, Proved, Samples, Sampling, Searched, SecondOrder, Tolerance,
};
