//! Multiplication and addition in one.

/// a b + c: rounded once, in one instruction, where the target has one; without, a fused product would be a call that takes a hundred.
#[inline(always)]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}
