//! Checks the times of a run.

use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};

/// Checks that the times are finite and strictly increasing or strictly decreasing.
pub(crate) fn check(times: &[f64]) -> Result<()> {
    let fail = |reason: String| Err(Error::InvalidTimes { reason });
    if times.is_empty() {
        return fail(format!(
            "the list is empty. Give at least one time, or many such as {}",
            Surface::chosen().many_times()
        ));
    }
    // Usually the times increase; then those between finite ends are finite. All pairs are compared
    // without an early exit, so that the compiler can vectorise the loop.
    if times.windows(2).fold(true, |rise, pair| rise & (pair[0] < pair[1]))
        && (times[times.len() - 1] - times[0]).is_finite()
    {
        return Ok(());
    }
    if let Some((k, t)) = times.iter().enumerate().find(|(_, t)| !t.is_finite()) {
        return fail(format!("the time with number {k} is {t}. Give finite times"));
    }
    let first = times[0];
    let last = times[times.len() - 1];
    if !(last - first).is_finite() {
        return fail(format!(
            "the span from {first:e} to {last:e} is above the largest number, {:e}. Give times that are closer together",
            f64::MAX
        ));
    }
    let backwards = times.len() > 1 && times[1] < times[0];
    match times.windows(2).position(|pair| pair[0] == pair[1] || (pair[1] < pair[0]) != backwards) {
        Some(k) => fail(format!(
            "the time {} is followed by {}. Give times that only increase, or only decrease",
            times[k],
            times[k + 1]
        )),
        None => Ok(()),
    }
}

/// Checks times that come one by one.
#[derive(Default)]
pub(crate) struct Order {
    /// The last two times.
    last: [Option<f64>; 2],
}

impl Order {
    /// Checks one more time.
    pub(crate) fn check(&mut self, t: f64) -> Result<()> {
        let all: Vec<f64> = self.last.into_iter().flatten().chain([t]).collect();
        self.last = [self.last[1], Some(t)];
        check(&all)
    }

    /// Returns an error if there was no time.
    pub(crate) fn some(&self) -> Result<()> {
        if self.last[1].is_some() { Ok(()) } else { check(&[]) }
    }
}
