//! How far poses are looked for.

use std::time::{Duration, Instant};

use crate::model::error::{Error, Result};

/// How a pose is looked for from a guess that may be poor. All fields have defaults:
/// `SearchOptions { starts: 50, ..SearchOptions::default() }`.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchOptions {
    /// Starts that are tried until one leads to a pose: the guess, then others around it, ever
    /// further from it; default 16.
    pub starts: usize,
    /// Steps of damped least squares (Levenberg–Marquardt) from one start at most; default 200.
    pub steps: usize,
    /// The same seed gives the same starts; default 0.
    pub seed: u64,
    /// Time after which no other start is begun. With a limit the result can depend on the machine;
    /// default none.
    pub time_limit: Option<Duration>,
}

impl Default for SearchOptions {
    fn default() -> Self {
        SearchOptions { starts: 16, steps: 200, seed: 0, time_limit: None }
    }
}

impl SearchOptions {
    /// An error unless there is something to do.
    pub(crate) fn check(&self) -> Result<()> {
        at_least_one(self.starts, "starts")?;
        at_least_one(self.steps, "steps")
    }

    pub(crate) fn clock(&self) -> Clock {
        Clock::new(self.time_limit)
    }
}

/// An error for a limit of zero.
pub(crate) fn at_least_one(limit: usize, what: &str) -> Result<()> {
    if limit > 0 {
        return Ok(());
    }
    Err(Error::InvalidOptions { reason: format!("no {what} are allowed; allow one at least") })
}

/// A limit of time that has begun.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock(Option<(Instant, Duration)>);

impl Clock {
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Clock(limit.map(|limit| (Instant::now(), limit)))
    }

    /// True if the time is over.
    pub(crate) fn is_up(&self) -> bool {
        self.0.is_some_and(|(begun, limit)| begun.elapsed() >= limit)
    }
}
