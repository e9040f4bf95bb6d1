//! Defines the options of the search for a pose.

use std::time::{Duration, Instant};

use crate::outcome::error::{Error, Result};

/// Options of the search for a pose from a guess that may be poor.
///
/// All fields have defaults: `SearchOptions { starts: 50, ..SearchOptions::default() }`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SearchOptions {
    /// The largest number of starts (default 16). The first start is the guess; the other starts
    /// are around the guess, at growing distances.
    pub starts: usize,
    /// The largest number of damped least-squares steps (Levenberg–Marquardt) from one start
    /// (default 200).
    pub steps: usize,
    /// The seed of the random starts (default 0). The same seed gives the same starts.
    pub seed: u64,
    /// The time after which no new start begins; `None` (default) for no limit. With a time limit
    /// the result can depend on the speed of the machine.
    pub time_limit: Option<Duration>,
    /// The largest number of constraints that a diagnosis releases if the constraints cannot all be
    /// satisfied (default 6).
    pub released: usize,
    /// The largest number of nearby poses at which a diagnosis computes the rank, if the rank is
    /// not full (default 3).
    pub poses: usize,
}

impl Default for SearchOptions {
    fn default() -> Self {
        SearchOptions { starts: 16, steps: 200, seed: 0, time_limit: None, released: 6, poses: 3 }
    }
}

impl SearchOptions {
    /// Returns the default options.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Sets [`SearchOptions::starts`].
        starts: usize,
        /// Sets [`SearchOptions::steps`].
        steps: usize,
        /// Sets [`SearchOptions::seed`].
        seed: u64,
        /// Sets [`SearchOptions::time_limit`].
        time_limit: Option<Duration>,
        /// Sets [`SearchOptions::released`].
        released: usize,
        /// Sets [`SearchOptions::poses`].
        poses: usize,
    }

    /// An error unless there is something to do.
    pub(crate) fn check(&self) -> Result<()> {
        at_least_one(self.starts, "starts")?;
        at_least_one(self.steps, "steps")?;
        at_least_one(self.poses, "nearby poses")
    }

    pub(crate) fn clock(&self) -> Clock {
        Clock::new(self.time_limit)
    }
}

/// Options of the search for all assemblies ([`crate::System::assemblies`]).
///
/// ```
/// let options = kin::solver::AssemblyOptions::new().seed(7);
/// assert_eq!(options.seed, 7);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct AssemblyOptions {
    /// The largest number of starts for a group of up to seven equations that must be solved
    /// together, such as a platform on six rods (default 20 000). For a group of k > 7 equations
    /// the limit is (7/k)² times this number, but at least a fifth of it.
    pub starts: usize,
    /// The number of consecutive starts without a new solution after which the search may end
    /// (default 60). The search needs ten more such starts for each known solution.
    pub patience: usize,
    /// The largest number of Newton steps from one start (default 60).
    pub steps: usize,
    /// The seed of the random starts (default 0). The same seed gives the same assemblies.
    pub seed: u64,
    /// The time after which no new start begins; `None` (default) for no limit. With a time limit
    /// the result can depend on the speed of the machine.
    pub time_limit: Option<Duration>,
}

impl Default for AssemblyOptions {
    fn default() -> Self {
        AssemblyOptions { starts: 20_000, patience: 60, steps: 60, seed: 0, time_limit: None }
    }
}

impl AssemblyOptions {
    /// Returns the default options.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Sets [`AssemblyOptions::starts`].
        starts: usize,
        /// Sets [`AssemblyOptions::patience`].
        patience: usize,
        /// Sets [`AssemblyOptions::steps`].
        steps: usize,
        /// Sets [`AssemblyOptions::seed`].
        seed: u64,
        /// Sets [`AssemblyOptions::time_limit`].
        time_limit: Option<Duration>,
    }
}

/// An error for a limit of zero.
pub(crate) fn at_least_one(limit: usize, what: &str) -> Result<()> {
    if limit > 0 {
        return Ok(());
    }
    Err(Error::InvalidOptions { reason: format!("the number of {what} is 0. Give at least 1") })
}

/// A time limit that has begun.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock(Option<(Instant, Duration)>);

impl Clock {
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Clock(limit.map(|limit| (Instant::now(), limit)))
    }

    /// Returns true if the time is over.
    pub(crate) fn is_up(&self) -> bool {
        self.0.is_some_and(|(begun, limit)| begun.elapsed() >= limit)
    }
}
