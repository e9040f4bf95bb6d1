//! Constraints of spatial bodies.

use kin_macros::constraint;

/// The norm of a body's Euler parameters: pᵀ p − 1 = 0.      \[–\]
///
/// Removes 1 freedom that is none. Every spatial body gets this row by itself when its mechanism is built. Lecture, "Euler Parameters".
///
/// Signs: p and −p are one pose.
#[constraint(lanes)]
pub fn euler_norm(b: Spatial) -> f64 {
    b.p.norm_squared() - 1.0
}
