//! The state of an unfinished search.

use crate::solve::assembly::SearchOptions;
use crate::solve::assembly::options::Clock;
use crate::system::scaled::Model;

/// A search for a pose, and for what stands in its way: what stays the same all through it.
pub(super) struct Search<'a> {
    pub model: Model<'a>,
    pub t: f64,
    pub options: &'a SearchOptions,
    pub clock: Clock,
}

impl Search<'_> {
    /// True if nothing else is to be tried: the time is over, or the work spent.
    pub(super) fn is_up(&self) -> bool {
        self.clock.is_up() || self.model.is_spent()
    }
}
