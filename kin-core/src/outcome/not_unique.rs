//! Forces that equilibrium does not determine.

use crate::outcome::error::surface::Surface;
use crate::outcome::words;

/// A force is not unique: redundant constraints share it according to their stiffness and play, so
/// Kin returns no number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{constraint}`: {what} is not unique. The constraints {} carry this force together, and their parts depend on play and stiffness, which Kin does not know. {}, or remove a redundant equation from one of these constraints",
    words::list(.shared), Surface::chosen().shared_force()
)]
#[non_exhaustive]
pub struct NotUnique {
    /// The constraint, or the sum of several constraints.
    pub constraint: String,
    /// The component, such as `F_z on `door``.
    pub what: String,
    /// The constraints that share the force.
    pub shared: Vec<String>,
}
