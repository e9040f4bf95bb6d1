//! Marks the ends of the user's expressions in a body that runs on dual numbers.

use crate::numbers::real::{self, Dual};

/// Returns the value of expression number `expression`. If the numbers trace a failure, the
/// function records that the expression has ended.
#[inline(always)]
pub fn ended<D: Dual, T>(expression: usize, value: T) -> T {
    if D::TRACED {
        real::ended(expression);
    }
    value
}
