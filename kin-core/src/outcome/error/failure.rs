//! Describes failures of a run: the kind, the time, the motion so far and the diagnosis.

use std::fmt;

use super::surface::Surface;
use super::{Error, text};
use crate::coordinates::units::Units;
use crate::outcome::culprit::Culprit;
use crate::outcome::motion::Motion;
use crate::outcome::verdict::Diagnosis;
use crate::outcome::words;

/// A failure of a run or of a single position, with all data that Kin has about it.
///
/// `Debug` prints the same text as `Display`.
///
/// ```
/// use kin::Error;
/// use kin::error::FailureKind;
/// use kin::prelude::*;
///
/// #[constraint]
/// fn circle(x: Coord, y: Coord) -> f64 {
///     x * x + y * y - 1.0
/// }
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("circle");
/// let x = m.length("x", 0.9)?;
/// let y = m.length("y", 0.4)?;
/// m.add("on the circle", circle(x, y))?;
/// m.add("drive", drive(y, Law::linear(0.4, 1.0)))?;
/// let Err(Error::Run(failure)) = m.build()?.run([0.0, 0.4, 0.8]) else { panic!("a toggle") };
/// assert!(matches!(failure.kind, FailureKind::Toggle { .. }));
/// assert!((failure.t - 0.6).abs() < 1e-9);
/// assert_eq!(failure.motion.as_ref().map(Motion::len), Some(2));
/// # Ok(())
/// # }
/// ```
#[non_exhaustive]
pub struct RunFailure {
    /// The time of the failure. \[s\]
    ///
    /// For a toggle the time t* of the toggle, for a discontinuous law the first time after the
    /// jump, and for [`FailureKind::CannotFollow`] the last time at which the branch is known.
    pub t: f64,
    /// Names of the units of length and time.
    pub units: Units,
    /// The kind of the failure, with its data.
    pub kind: FailureKind,
    /// The motion computed before the failure. After a toggle, the last
    /// [`Motion::singular_positions`] of this motion is the toggle.
    pub motion: Option<Motion>,
    /// The diagnosis of the mechanism at the time that it could not reach, with names and the
    /// smallest distance that the parts can reach.
    pub diagnosis: Option<Diagnosis>,
}

/// The kinds of failures of a run.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum FailureKind {
    /// Nothing can drive the mechanism in any pose: equations are missing or contradict each other.
    CannotBeDriven,
    /// Newton's method did not reach C(q, t) = 0.
    NoConvergence {
        /// Newton steps taken.
        iterations: usize,
        /// The constraint with the largest residual.
        constraint: String,
        /// The row of that constraint; empty for a constraint of one row.
        row: String,
        /// |C| of that row, in the row's unit.
        residual: f64,
        /// The last time at which the position was found.   \[s\]
        last: Option<f64>,
    },
    /// C_q has no inverse at a position: the position is a toggle or a change point, or the
    /// constraints of the mechanism are wrong.
    SingularAt {
        /// Number of coordinates.
        n: usize,
        /// Numerical rank of C_q in units of order 1. It is n if C_q is singular only within
        /// rounding.
        rank: usize,
        /// The smallest pivot of the elimination, relative to its row.
        pivot: f64,
        /// Bodies and coordinates that can move while all drivers are at rest.
        movable: Vec<String>,
        /// Equations that depend on one another.
        dependent: Vec<String>,
        /// An equation with a large residual at the end of the search; `None` at a position.
        unmet: Option<String>,
        /// True if this pose is the guess, and the guess satisfies every equation.
        drawn: bool,
    },
    /// A toggle: the mechanism cannot be driven beyond it; what it moves has an infinite rate
    /// there.
    Toggle {
        /// The requested time. \[s\]
        asked: f64,
        /// Bodies and coordinates that can move at t* while all drivers are at rest.
        movable: Vec<String>,
        /// Equations that depend on one another at t*.
        dependent: Vec<String>,
    },
    /// A step may have left its branch, and Kin cannot make the step shorter.
    CannotFollow {
        /// The reason.
        reason: UnfollowedReason,
    },
    /// A position satisfies the equations but is on the wrong branch: an axis, for example, has
    /// turned by 180°.
    WrongBranch {
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The condition that is not satisfied.
        reason: String,
    },
    /// A discontinuous law drives the motion.
    LawJumps {
        /// The constraint.
        constraint: String,
        /// The name of the law in the constraint.
        law: String,
        /// The argument of the law at the jump.
        at: f64,
        /// The derivative that jumps: 0 the value, 1 the slope.
        order: usize,
    },
    /// A constraint returned a value or derivative that is infinite or not a number.
    NotFinite {
        /// The constraint.
        constraint: String,
        /// The name of the row; empty for a constraint of one row.
        row: String,
        /// The quantity: `C`, `C_q`, `C_t` or `Q_d`; `q'` or `q''` if only the solution overflows.
        quantity: &'static str,
        /// The subexpression that caused it, as the user wrote it, and the values of its operands.
        culprit: Culprit,
    },
}

/// The reasons why Kin cannot confirm that a run stays on its branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum UnfollowedReason {
    /// The step to the next time needs more smaller steps than a run may take.
    TooManySteps,
    /// A body turns too far in one time step.
    TurnsTooFar,
    /// The next position differs from the predicted position.
    PredictionMissed,
    /// A loop of the mechanism has turned over.
    TurnedOver,
    /// A driver may move further within a time step than from its beginning to its end.
    HiddenDrive,
    /// Between two times of a motion an extreme or a crossing would need too many more times.
    TooManyTimes,
}

impl fmt::Display for UnfollowedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            UnfollowedReason::TooManySteps => Surface::chosen().too_many_steps(),
            UnfollowedReason::TurnsTooFar => "a body turns too far in one time step",
            UnfollowedReason::PredictionMissed => {
                "the next position differs from the predicted position"
            }
            UnfollowedReason::TurnedOver => "a loop of the mechanism has turned over",
            UnfollowedReason::HiddenDrive => {
                "a driver may move further within a time step than from its beginning to its end"
            }
            UnfollowedReason::TooManyTimes => {
                "between two times of the motion Kin would need more than 100 000 additional times. Give times that are closer together"
            }
        })
    }
}

impl RunFailure {
    /// Returns the time that the mechanism could not reach, if a diagnosis can say why.
    pub(crate) fn unreached(&self) -> Option<f64> {
        match self.kind {
            FailureKind::SingularAt { .. } | FailureKind::NoConvergence { .. } => Some(self.t),
            FailureKind::Toggle { asked, .. } => Some(asked),
            _ => None,
        }
    }
}

impl FailureKind {
    /// Builds the error of this kind at a time. A run adds its motion and a diagnosis.
    pub(crate) fn at(self, t: f64, units: &Units) -> Error {
        let units = units.clone();
        let failure = RunFailure { t, units, kind: self, motion: None, diagnosis: None };
        Error::Run(Box::new(failure))
    }
}

impl fmt::Display for RunFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RunFailure { t, units, kind, motion, diagnosis } = self;
        let at = words::at(*t, units);
        let diagnosis = diagnosis.as_ref();
        match kind {
            FailureKind::CannotBeDriven => f.write_str(&text::report(diagnosis))?,
            FailureKind::NoConvergence { iterations, constraint, row, residual, last } => {
                let worst = || text::worst(*iterations, constraint, row, *residual);
                f.write_str(&text::unmet(&at, diagnosis, worst))?;
                f.write_str(&text::no_convergence(*last, units, diagnosis))?;
                // Without an earlier position there is no motion before.
                if last.is_none() {
                    return Ok(());
                }
            }
            FailureKind::SingularAt { n, rank, movable, dependent, unmet, drawn, .. } => {
                let singular =
                    || text::singular(&at, [*rank, *n], [movable, dependent], unmet.as_deref());
                f.write_str(&text::diagnosed(diagnosis, singular))?;
                f.write_str(text::drawn(*drawn))?;
            }
            FailureKind::Toggle { movable, .. } => {
                let why = text::toggle(movable, diagnosis);
                write!(f, "no position exists beyond the toggle at t = {at}.{why}")?;
            }
            FailureKind::CannotFollow { reason } => {
                f.write_str(&text::cannot_follow(&at, *reason))?
            }
            FailureKind::WrongBranch { constraint, kind, reason } => {
                f.write_str(&text::wrong_branch(&at, [constraint, kind, reason]))?
            }
            FailureKind::LawJumps { constraint, law, at: x, order } => {
                f.write_str(&text::law_jumps(&at, [constraint, law], (*x, *order)))?
            }
            FailureKind::NotFinite { constraint, row, quantity, culprit } => {
                let row = words::row(row);
                write!(f, "{quantity} of `{constraint}`{row} is not finite at t = {at}{culprit}")?;
            }
        }
        f.write_str(&text::computed_before(motion.as_ref()))
    }
}

impl fmt::Debug for RunFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for RunFailure {}
