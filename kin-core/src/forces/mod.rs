//! Computes forces in driven mechanisms, the reactions of joints and the efforts of drivers, from
//! C_q.
//!
//! The acceleration q̈ is known, so Kin computes the multipliers λ of the constraints by one
//! transposed solve for each time,
//!
//! ```text
//! C_qᵀ λ = Q_e + Q_v − M q̈
//! ```
//!
//! (A. A. Shabana, *Computational Dynamics*, 3rd ed., section 6.7: kinematically driven systems).
//! Q_e are the generalised forces of weight and loads, and M q̈ − Q_v are the inertial forces. The
//! balance of each body (`body.rs`) gives the inertial forces with ω̄ = 2 Ḡ ṗ, so that no force
//! acts along p.
//!
//! A constraint applies the generalised force −C_qᵀ λ to the coordinates of its bodies. In the
//! plane the force on a body is −C_Rᵀ λ and the torque is −C_θᵀ λ. In space the torque is −½ Ḡ C_pᵀ
//! λ in the axes of the body (`wrench.rs`).

mod acted;
mod acting;
mod balance;
mod body;
mod calls;
mod effort;
mod friction;
mod given;
mod growth;
mod inverse;
pub(crate) mod library;
mod multipliers;
mod reaction;
mod sharing;
mod sum;
mod table;
mod wrench;

pub use crate::model::loads::LoadSharing;
pub use crate::outcome::growth::Growth;
pub use acted::BodyWrench;
pub use balance::{Balance, Energy};
pub use calls::Forces;
pub use effort::{Drive, Peak};
pub use reaction::Reaction;
