//! Where the user's expressions end, in a body that runs on dual numbers.

use crate::numbers::real::{self, Dual};

/// The value of expression number `expression`: numbers that look for a fault are told that it lies
/// behind them.
#[inline(always)]
pub fn ended<D: Dual, T>(expression: usize, value: T) -> T {
    if D::TRACED {
        real::ended(expression);
    }
    value
}
