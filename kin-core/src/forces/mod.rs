//! Forces in driven mechanisms: reactions of joints and efforts of drivers, computed from C_q.
//!
//! q̈ is known, so the multipliers of the constraints follow from one transposed solve for each
//! time,
//!
//! ```text
//! C_qᵀ λ = Q_e + Q_v − M q̈
//! ```
//!
//! (A. A. Shabana, *Computational Dynamics*, 3rd ed., section 6.7: kinematically driven systems).
//! Q_e are the generalised forces of weight and loads, and M q̈ − Q_v are the inertial forces. The
//! balance of each body (`body.rs`) gives them with ω̄ = 2 Ḡ ṗ, so that nothing acts along p.
//!
//! A constraint puts the generalised force −C_qᵀ λ on the coordinates of its bodies. This is a
//! force −C_Rᵀ λ and a torque −C_θᵀ λ; in space the torque is −½ Ḡ C_pᵀ λ in the axes of the body
//! (`wrench.rs`).

mod acted;
mod acting;
mod balance;
mod body;
mod calls;
mod effort;
mod friction;
mod growth;
mod inverse;
pub(crate) mod library;
mod multipliers;
mod reaction;
mod sharing;
mod sum;
mod table;
mod wrench;

pub use crate::model::growth::Growth;
pub use crate::model::loads::LoadSharing;
pub use acted::BodyWrench;
pub use balance::{Balance, Energy};
pub use calls::Forces;
pub use effort::{Drive, Peak};
pub use reaction::Reaction;
