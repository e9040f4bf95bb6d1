//! How emitted kernels compute.

use std::sync::atomic::{Ordering, compiler_fence};

/// a b + c: rounded once, in one instruction, where the target has one; without, a fused product
/// would be a call that takes a hundred.
#[inline(always)]
pub fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// Writes a number; what is written before stays before. No instruction more; else the compiler
/// gathers the outputs of a kernel at its end, keeping each in memory until then, and joins them to
/// vectors that it has to shuffle together.
#[inline(always)]
pub fn put(to: &mut f64, value: f64) {
    *to = value;
    compiler_fence(Ordering::SeqCst);
}

/// The first of `n` rows that holds, else `n`.
#[inline(always)]
pub fn first(n: usize, holds: impl Fn(usize) -> bool) -> usize {
    let mut row = 0;
    while row < n && !holds(row) {
        row += 1;
    }
    row
}
