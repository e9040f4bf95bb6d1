//! Defines constraints of single spatial bodies.

use kin_macros::constraint;

use crate::numbers::algebra::{EulerParameters, Vec3};

/// Keeps the norm of a body's Euler parameters at one: pᵀ p − 1 = 0. \[–\]
///
/// The row removes one coordinate, but no freedom of motion.
/// [`Mechanism::build`](crate::Mechanism::build) adds this constraint for every spatial body.
/// Source: lecture notes, "Euler Parameters".
///
/// Signs: p and −p describe the same pose.
#[constraint]
pub fn euler_norm(b: Spatial) -> f64 {
    b.p.norm_squared() - 1.0
}

/// Holds a body's rotation about its local axis h at zero, counted from the pose p₀ = `turn`: (p₀*
/// p)·(0, h) = 0. \[–\]
///
/// The body may move in any other way. The row sets the twist about h of the rotation from p₀ to
/// zero. The row removes the idle rotation of a rod between two ball joints, which moves no other
/// body ([`crate::Mechanism::hold_idle_turns`]). The row is singular only where h has rotated by
/// 180°.
///
/// Source: P. Dobrowolski, *Swing-twist decomposition in Clifford algebra*, 2015.
#[constraint]
#[require(h.norm() > 0.0, "the axis must not be zero")]
pub fn held_turn(b: Spatial, turn: EulerParameters, h: Vec3) -> f64 {
    turn.conjugate().product(b.p).vector().dot(h.normalize())
}
