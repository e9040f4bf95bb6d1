//! Stores a motion: the results of a run at each time.
//!
//! The module `solve/motion/` derives other results from a motion.

mod crossed;
mod event;
mod series;
mod singular;
pub(crate) mod warning;

use std::sync::{Arc, OnceLock};

use serde::{Deserialize, Serialize};

use crate::coordinates::layout::Layout;
use crate::coordinates::units::Units;
pub use crossed::{Break, CrossedBreak};
pub use event::{Event, EventKind};
pub use series::Series;
pub use singular::{Branch, SingularKind, SingularPosition};
pub use warning::{Warning, WarningKind};

/// The result of a run: q, q̇ and q̈ at each time, all finite, with a report of the computation.
///
/// The motion contains q⃛ if the run computed the jerk.
#[derive(Clone)]
pub struct Motion {
    pub(crate) name: String,
    pub(crate) layout: Arc<Layout>,
    pub(crate) equations: Arc<[String]>,
    pub(crate) times: Vec<f64>,
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) qdd: Vec<f64>,
    /// Empty unless the run computed the jerk.
    pub(crate) qddd: Vec<f64>,
    pub(crate) iterations: Vec<usize>,
    pub(crate) residuals: Vec<f64>,
    /// The largest residual of all times, and its row; `None` without a time.
    pub(crate) worst: Option<(f64, usize)>,
    pub(crate) outputs: Vec<Series>,
    pub(crate) breaks: Vec<CrossedBreak>,
    pub(crate) events: Vec<Event>,
    pub(crate) singular: Vec<SingularPosition>,
    /// The guess from which the run found the first position.
    pub(crate) guess: Vec<f64>,
    /// Warnings about the mechanism and the first position, from the run that begins here.
    pub(crate) begun: Vec<Warning>,
    /// True if a driver has turned by more than a turn between t = 0 and the first time, as its law
    /// says, or may have: angles that are far from their guesses are no slip then.
    pub(crate) turned_before: bool,
    /// All warnings, once somebody has read them; whatever adds an event empties the list.
    pub(crate) warnings: OnceLock<Vec<Warning>>,
    /// The contradiction of redundant equations as a share of their norms; 0 unless it is
    /// allowed.   \[-\]
    pub(crate) misfit: f64,
    /// How many times the compiled program has computed, and how often it has returned the rest of
    /// a block to the step-by-step solver.
    pub(crate) engine: EngineCounts,
    /// Why there is no compiled program, if the run looked for one.
    pub(crate) plain: Option<Arc<str>>,
}

/// Counts the times that the compiled program computed in a run.
///
/// All numbers are zero if the step-by-step solver computed everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EngineCounts {
    /// The number of times that the compiled program has computed; the step-by-step solver has
    /// computed the others.
    pub compiled: usize,
    /// The number of blocks whose remaining times the program returned to the step-by-step solver.
    pub handed_back: usize,
}

impl Motion {
    /// Returns the number of times that the compiled program has computed
    /// ([`crate::Engine::Compiled`]), and the number of blocks that it returned to the step-by-step
    /// solver.
    pub fn engine(&self) -> EngineCounts {
        self.engine
    }

    /// Returns the reason why the step-by-step solver computed everything although a compiled
    /// program would have been faster.
    ///
    /// The reason names the constraint. Returns `None` if the run used a program, or if the run did
    /// not try to compile a program.
    pub fn why_not_compiled(&self) -> Option<&str> {
        self.plain.as_deref()
    }

    /// Returns a motion with only the last time.
    pub(crate) fn last(&self) -> Motion {
        self.rows(self.len().saturating_sub(1))
    }

    /// Joins the times of this motion and of a later one, without the events of either.
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

    /// Returns the times from index `first` on, without their events.
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

    /// Returns the name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of times.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Returns true if the motion has no times.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Returns the times. \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns q at time k, in the order of [`Motion::names`]. \[m, rad\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn q(&self, k: usize) -> &[f64] {
        self.row(&self.q, k)
    }

    /// Returns q̇ at time k. \[m/s, rad/s\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn qd(&self, k: usize) -> &[f64] {
        self.row(&self.qd, k)
    }

    /// Returns q̈ at time k. \[m/s², rad/s²\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn qdd(&self, k: usize) -> &[f64] {
        self.row(&self.qdd, k)
    }

    /// Returns q⃛ at time k. \[m/s³, rad/s³\]
    ///
    /// The slice is empty if k is beyond the last time, or if the run did not compute the jerk
    /// ([`crate::SolverOptions::jerk`]).
    pub fn qddd(&self, k: usize) -> &[f64] {
        self.row(&self.qddd, k)
    }

    /// Returns q at all times as one contiguous slice: a row for each time, a column for each
    /// coordinate, like an array of NumPy or ndarray. \[m, rad\]
    pub fn q_rows(&self) -> &[f64] {
        &self.q
    }

    /// Returns q̇ of all times in the layout of [`Motion::q_rows`]. \[m/s, rad/s\]
    pub fn qd_rows(&self) -> &[f64] {
        &self.qd
    }

    /// Returns q̈ of all times in the layout of [`Motion::q_rows`]. \[m/s², rad/s²\]
    pub fn qdd_rows(&self) -> &[f64] {
        &self.qdd
    }

    /// Returns q⃛ of all times in the layout of [`Motion::q_rows`]. \[m/s³, rad/s³\]
    ///
    /// The slice is empty if the run did not compute the jerk.
    pub fn qddd_rows(&self) -> &[f64] {
        &self.qddd
    }

    /// Returns true if the motion contains the jerk.
    pub fn has_jerk(&self) -> bool {
        self.qddd.len() == self.q.len() && !self.is_empty()
    }

    fn row<'a>(&self, all: &'a [f64], k: usize) -> &'a [f64] {
        let n = self.layout.len();
        let first = k.saturating_mul(n);
        all.get(first..first.saturating_add(n)).unwrap_or_default()
    }

    /// Returns the names of the coordinates, such as `crank.theta`.
    pub fn names(&self) -> &[String] {
        &self.layout.names
    }

    /// Returns the units of the coordinates: `m`, `rad` or `-`.
    pub fn units(&self) -> Vec<String> {
        self.layout.unit_words()
    }

    /// Returns the names of the units of length and time.
    pub fn unit_words(&self) -> &Units {
        &self.layout.words
    }

    /// Returns the times and the names of the units.
    pub(crate) fn clock(&self) -> (&[f64], &Units) {
        (&self.times, &self.layout.words)
    }

    /// Returns the number of Newton steps at each time.
    pub fn iterations(&self) -> &[usize] {
        &self.iterations
    }

    /// Returns the largest residual max |C_i| at each time, in the unit of its row.
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// Returns the name of the equation with the largest residual of all times, such as `A.x`.
    pub fn worst(&self) -> Option<&str> {
        self.equations.get(self.worst?.1).map(String::as_str)
    }

    /// Returns the derived quantities that the program added to the motion.
    pub fn outputs(&self) -> &[Series] {
        &self.outputs
    }

    /// Returns the breaks of laws that the run crossed, in the order of time.
    ///
    /// At each break a derivative of the motion jumps.
    ///
    /// The list has at most 100 000 breaks in all, and at most 10 000 breaks of one law between two
    /// times.
    pub fn breaks(&self) -> &[CrossedBreak] {
        &self.breaks
    }

    /// Returns the singular positions of the run in the order of time: change points, and a toggle
    /// as the last one.
    ///
    /// [`Motion::events`] contains the singular positions too.
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
