//! How far a mechanism is examined.

use crate::model::error::Result;
use crate::solve::assembly::SearchOptions;
use crate::solve::assembly::options::{Clock, at_least_one};
use crate::system::scaled::Model;

/// How far a mechanism is examined. All fields have defaults: `DiagnosisOptions { poses: 10,
/// ..DiagnosisOptions::default() }`.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagnosisOptions {
    /// How a pose is looked for.
    pub search: SearchOptions,
    /// Constraints that are let go at most, where not all can be met; default 6.
    pub let_go: usize,
    /// Nearby poses at most at which the rank is taken, where it is less than it could be;
    /// default 3.
    pub poses: usize,
}

impl Default for DiagnosisOptions {
    fn default() -> Self {
        DiagnosisOptions { search: SearchOptions::default(), let_go: 6, poses: 3 }
    }
}

impl DiagnosisOptions {
    /// The defaults, a pose looked for as a run looks for it.
    pub(super) fn searching(search: &SearchOptions) -> Self {
        DiagnosisOptions { search: search.clone(), ..DiagnosisOptions::default() }
    }

    /// An error unless there is something to do.
    pub(crate) fn check(&self) -> Result<()> {
        self.search.check()?;
        at_least_one(self.poses, "nearby poses")
    }
}

/// A search for a pose, and for what stands in its way: what stays the same all through it.
pub(super) struct Search<'a> {
    pub model: Model<'a>,
    pub t: f64,
    pub options: &'a DiagnosisOptions,
    pub clock: Clock,
}

impl Search<'_> {
    /// True if nothing else is to be tried: the time is over, or the work spent.
    pub(super) fn is_up(&self) -> bool {
        self.clock.is_up() || self.model.is_spent()
    }
}
