//! Constraints of spatial bodies.

use kin_macros::constraint;

use crate::numbers::algebra::{EulerParameters, Vec3};

/// The norm of a body's Euler parameters: pᵀ p − 1 = 0.      \[–\]
///
/// Removes 1 freedom that is none. Every spatial body gets this row by itself when its mechanism is
/// built. Lecture, "Euler Parameters".
///
/// Signs: p and −p are one pose.
#[constraint]
pub fn euler_norm(b: Spatial) -> f64 {
    b.p.norm_squared() - 1.0
}

/// The turn of a body about its own axis h, counted from the pose p₀ = `turn`, is held at zero:
/// (p₀* p)·(0, h) = 0.   \[–\]
///
/// Whatever else the body does, it does not turn about h: the twist of its rotation from p₀
/// vanishes. Removes 1 freedom, that of a rod between two balls which nothing depends on
/// ([`crate::Mechanism::hold_idle_turns`]); depends on it only where h has been turned by 180°.
///
/// P. Dobrowolski, *Swing-twist decomposition in Clifford algebra*, 2015.
#[constraint]
#[require(h.norm() > 0.0, "the axis needs a length above zero")]
pub fn held_turn(b: Spatial, turn: EulerParameters, h: Vec3) -> f64 {
    turn.conjugate().product(b.p).vector().dot(h.normalize())
}
