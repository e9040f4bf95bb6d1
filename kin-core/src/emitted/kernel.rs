//! The operations of emitted kernels.

use std::sync::atomic::{Ordering, compiler_fence};

/// Returns a b + c. It is rounded once if the target has an instruction for it; otherwise a fused
/// product would be a call that takes a hundred instructions.
#[inline(always)]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// Writes a number after all numbers written before it. The fence adds no instruction. Without it,
/// the compiler keeps the outputs of a kernel in memory until its end and then joins them to
/// vectors, which takes shuffles.
#[inline(always)]
pub fn put(to: &mut f64, value: f64) {
    *to = value;
    compiler_fence(Ordering::SeqCst);
}

/// Returns the first of `n` rows that satisfies `holds`, else `n`.
#[inline(always)]
pub fn first(n: usize, holds: impl Fn(usize) -> bool) -> usize {
    let mut row = 0;
    while row < n && !holds(row) {
        row += 1;
    }
    row
}
