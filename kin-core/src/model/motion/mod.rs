//! A motion as data: what a run has found, time by time. `solve/motion/` derives from it what
//! people ask for.

mod crossed;
mod event;
mod series;
mod singular;
mod warning;

use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Serialize};

use crate::model::layout::Layout;
use crate::model::units::Units;
pub use crossed::CrossedBreak;
pub use event::{Event, EventKind};
pub use series::Series;
pub use singular::{Branch, SingularKind, SingularPosition};
pub use warning::{Warning, WarningKind};

/// q, q̇ and q̈ at each time (q⃛ too where it was asked for), all finite, and a report of how they
/// were found.
#[derive(Clone)]
pub struct Motion {
    pub(crate) name: String,
    pub(crate) layout: Arc<Layout>,
    pub(crate) equations: Arc<[String]>,
    pub(crate) times: Vec<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) qdd: Vec<f64>,
    /// Empty unless the jerk was asked for.
    pub(crate) qddd: Vec<f64>,
    pub(crate) iterations: Vec<usize>,
    pub(crate) residuals: Vec<f64>,
    /// The largest residual of all times, and its row.
    pub(crate) worst: Option<(f64, usize)>,
    pub(crate) outputs: Vec<Series>,
    pub(crate) breaks: Vec<CrossedBreak>,
    pub(crate) events: Vec<Event>,
    pub(crate) singular: Vec<SingularPosition>,
    /// The guess that the first position was found from; empty if the motion does not begin a run.
    pub(crate) guess: Vec<f64>,
    /// Warnings about the mechanism and the first position, from the run that begins here.
    pub(crate) begun: Vec<Warning>,
    /// True if a driver has turned by more than a turn between t = 0 and the first time, as its law
    /// says, or may have: angles that are far from their guesses are no slip then.
    pub(crate) turned_before: bool,
    /// All warnings, once somebody has read them; whatever adds an event empties the list.
    pub(crate) warnings: OnceLock<Vec<Warning>>,
    /// By how much of their norms equations contradict one another, where that was allowed.   \[-\]
    pub(crate) misfit: f64,
    /// How many times a program has computed, and how often it has handed the rest of a block to
    /// plain steps.
    pub(crate) engine: EngineCounts,
    /// Why there is no program, where one was looked for.
    pub(crate) plain: Option<Arc<str>>,
}

/// How a run was computed; all zero where all of it was plain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EngineCounts {
    /// Times that a program has computed; the others are plain steps.
    pub compiled: usize,
    /// How often the rest of a block of times was handed back to plain steps.
    pub handed_back: usize,
}

impl Motion {
    /// How many times a program has computed ([`crate::Engine::Compiled`]), and how often it has
    /// handed the rest of a block to plain steps.
    pub fn engine(&self) -> EngineCounts {
        self.engine
    }

    /// Why all of it was computed by plain steps, where a program would have paid: what stands in
    /// the way, by the name of its constraint. `None` where a program was used or not looked for.
    pub fn why_not_compiled(&self) -> Option<&str> {
        self.plain.as_deref()
    }

    /// Its last time alone.
    pub(crate) fn last(&self) -> Motion {
        self.rows(self.len().saturating_sub(1))
    }

    /// The times of this motion and those of a later one; neither's events.
    pub(crate) fn followed_by(&self, later: &Motion) -> Motion {
        let mut whole = self.rows(0);
        whole.times.extend_from_slice(&later.times);
        let kinds = [
            (&mut whole.q, &later.q),
            (&mut whole.qd, &later.qd),
            (&mut whole.qdd, &later.qdd),
            (&mut whole.qddd, &later.qddd),
        ];
        kinds.into_iter().for_each(|(all, more)| all.extend_from_slice(more));
        whole.iterations.extend_from_slice(&later.iterations);
        whole.residuals.extend_from_slice(&later.residuals);
        whole
    }

    /// The times from number `first` on, without what happened there.
    fn rows(&self, first: usize) -> Motion {
        let of = |all: &[f64]| all.get(first * self.layout.len()..).unwrap_or_default().to_vec();
        Motion {
            name: self.name.clone(),
            layout: self.layout.clone(),
            equations: self.equations.clone(),
            times: self.times[first..].to_vec(),
            q: of(&self.q),
            qd: of(&self.qd),
            qdd: of(&self.qdd),
            qddd: of(&self.qddd),
            iterations: self.iterations[first..].to_vec(),
            residuals: self.residuals[first..].to_vec(),
            guess: Vec::new(),
            begun: Vec::new(),
            turned_before: false,
            warnings: OnceLock::new(),
            misfit: self.misfit,
            engine: self.engine,
            plain: self.plain.clone(),
            worst: self.worst,
            outputs: Vec::new(),
            breaks: Vec::new(),
            events: Vec::new(),
            singular: Vec::new(),
        }
    }

    /// Name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of times.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// True if there is no time at all.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The times.   \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// q at time k, in the order of [`Motion::names`]; empty beyond the last time.   \[m, rad\]
    pub fn q(&self, k: usize) -> &[f64] {
        self.row(&self.q, k)
    }

    /// q̇ at time k; empty beyond the last time.   \[m/s, rad/s\]
    pub fn qd(&self, k: usize) -> &[f64] {
        self.row(&self.qd, k)
    }

    /// q̈ at time k; empty beyond the last time.   \[m/s², rad/s²\]
    pub fn qdd(&self, k: usize) -> &[f64] {
        self.row(&self.qdd, k)
    }

    /// q⃛ at time k; empty beyond the last time, and where the run was not asked for the jerk
    /// ([`crate::SolverOptions::jerk`]).   \[m/s³, rad/s³\]
    pub fn qddd(&self, k: usize) -> &[f64] {
        self.row(&self.qddd, k)
    }

    /// q of all times without a gap: a row a time, a column a coordinate, as an array of NumPy or
    /// ndarray lies in memory.   \[m, rad\]
    pub fn q_rows(&self) -> &[f64] {
        &self.q
    }

    /// q̇ of all times, as [`Motion::q_rows`].   \[m/s, rad/s\]
    pub fn qd_rows(&self) -> &[f64] {
        &self.qd
    }

    /// q̈ of all times, as [`Motion::q_rows`].   \[m/s², rad/s²\]
    pub fn qdd_rows(&self) -> &[f64] {
        &self.qdd
    }

    /// q⃛ of all times, as [`Motion::q_rows`]; empty where the run was not asked for the
    /// jerk.   \[m/s³, rad/s³\]
    pub fn qddd_rows(&self) -> &[f64] {
        &self.qddd
    }

    /// True if the motion holds the jerk.
    pub fn has_jerk(&self) -> bool {
        self.qddd.len() == self.q.len() && !self.is_empty()
    }

    fn row<'a>(&self, all: &'a [f64], k: usize) -> &'a [f64] {
        let n = self.layout.len();
        let first = k.saturating_mul(n);
        all.get(first..first.saturating_add(n)).unwrap_or_default()
    }

    /// Names of the coordinates, such as `crank.theta`.
    pub fn names(&self) -> &[String] {
        &self.layout.names
    }

    /// Units of the coordinates: `m`, `rad` or `-`.
    pub fn units(&self) -> Vec<String> {
        self.layout.unit_words()
    }

    /// Names of the units of length and time.
    pub fn unit_words(&self) -> &Units {
        &self.layout.words
    }

    /// The times, and what units are called.
    pub(crate) fn clock(&self) -> (&[f64], &Units) {
        (&self.times, &self.layout.words)
    }

    /// Newton steps taken at each time.
    pub fn iterations(&self) -> &[usize] {
        &self.iterations
    }

    /// max |C_i| at each time, in the unit of its row.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// Name of the equation with the largest residual of all, such as `A.x`.
    pub fn worst(&self) -> Option<&str> {
        self.equations.get(self.worst?.1).map(String::as_str)
    }

    /// The derived quantities added so far.
    pub fn outputs(&self) -> &[Series] {
        &self.outputs
    }

    /// The breaks of laws that were crossed, where a derivative of the motion jumps, in the order
    /// of time: the first 100 000 of them, and of one law between two times the first ten thousand.
    pub fn breaks(&self) -> &[CrossedBreak] {
        &self.breaks
    }

    /// The singular positions that were met, change points and at last a toggle, in the order of
    /// time; they are among [`Motion::events`] too.
    pub fn singular_positions(&self) -> &[SingularPosition] {
        &self.singular
    }

    pub(crate) fn add_singular(&mut self, found: SingularPosition) {
        self.add_event(found.event());
        self.singular.push(found);
    }
}

impl std::fmt::Debug for Motion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Motion({}: {} times)", self.name, self.len())
    }
}
