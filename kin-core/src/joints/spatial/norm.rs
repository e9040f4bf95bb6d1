//! Constraints of spatial bodies.

use kin_macros::constraint;

/// The norm of a body's Euler parameters: pᵀ p − 1 = 0.      \[–\]
///
/// Every spatial body gets this row by itself when its mechanism is built.
#[constraint(lanes)]
pub fn euler_norm(b: Spatial) -> f64 {
    b.p.norm_squared() - 1.0
}
