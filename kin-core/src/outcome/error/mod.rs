//! Defines the errors of Kin.
//!
//! Each message names the time and the constraint, says what is wrong, and says what to do.

use std::path::PathBuf;

use crate::coordinates::units::Units;
use crate::outcome::motion::Motion;
use crate::outcome::words;
mod cannot_reach;
mod carried;
mod constructors;
mod failure;
mod other_motion;
pub(crate) mod surface;
mod text;

pub use cannot_reach::CannotReach;
pub use carried::Result;
pub use failure::{FailureKind, RunFailure, UnfollowedReason};
pub use other_motion::OtherMotion;

/// An error of Kin.
///
/// `Debug` prints the same text as `Display`, so an error that `main` returns is readable.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A run or a single position failed ([`RunFailure`]).
    #[error(transparent)]
    Run(#[from] Box<RunFailure>),

    /// A parameter of a constraint is infinite or not a number.
    #[error("`{constraint}` has {value} as its parameter `{parameter}`. Give a finite number")]
    ParameterNotFinite {
        /// The constraint.
        constraint: String,
        /// The parameter, such as `u_i.x`.
        parameter: String,
        /// Its value.
        value: f64,
    },

    /// Parameters contradict the constraint: a negative length, an axis without direction.
    #[error("`{constraint}` ({kind}): {reason}")]
    InvalidParameters {
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The condition that is not satisfied.
        reason: String,
    },

    /// The program gives a coordinate an initial or other value that is infinite or not a number.
    #[error("the value of {coordinate} for `{name}` is {value}. Give a finite number")]
    InitialNotFinite {
        /// The body or bare coordinate.
        name: String,
        /// Its coordinate.
        coordinate: String,
        /// The value given.
        value: f64,
    },

    /// The length of a link is not positive.
    #[error("the link `{link}` has the length {length}. Give a length above zero")]
    InvalidLength {
        /// The link.
        link: String,
        /// The length given.   \[m\]
        length: f64,
    },

    /// A body or coordinate belongs to another mechanism.
    #[error("{}", text::foreign([place, argument, mechanism]))]
    ForeignBody {
        /// The mechanism that received the body or coordinate.
        mechanism: String,
        /// The constraint or the operation.
        place: String,
        /// Name of the argument.
        argument: String,
    },

    /// A constraint contains the same body or coordinate twice.
    #[error("{}", text::repeated([constraint, first, second, name]))]
    RepeatedBody {
        /// The constraint.
        constraint: String,
        /// Name of the first argument.
        first: String,
        /// Name of the second argument.
        second: String,
        /// The body or coordinate.
        name: String,
    },

    /// An equation contains no coordinates, because all its bodies are the ground.
    #[error("`{constraint}`{} depends on no coordinate: {reason}", words::row(.row))]
    NoCoordinates {
        /// The constraint.
        constraint: String,
        /// The name of the row; empty for a constraint of one row.
        row: String,
        /// The arguments that are the ground.
        reason: String,
    },

    /// Interval bounds cannot prove anything about a motion.
    #[error("Kin cannot prove {what}: {reason}")]
    CannotBeProved {
        /// The mechanism of the motion, or the constraint.
        what: String,
        /// The reason.
        reason: String,
    },

    /// A part of a mechanism cannot be printed as a file of C.
    #[error("Kin cannot print {what} as C: {reason}")]
    CannotEmit {
        /// The constraint, measure or mechanism.
        what: String,
        /// The reason.
        reason: String,
    },

    /// A hand-written constraint contradicts itself, or does not implement what Kin needs.
    #[error("`{constraint}` ({kind}): {reason}")]
    InvalidConstraint {
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The mistake.
        reason: String,
    },

    /// Two things of a mechanism have the same name.
    #[error("{}", text::duplicate(.what, .name))]
    DuplicateName {
        /// "bodies or coordinates", "constraints", "outputs".
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A name is empty.
    #[error("a {what} has an empty name. Give the {what} a name")]
    EmptyName {
        /// The kind of thing that has no name, such as "body".
        what: &'static str,
    },
    /// The mechanism contains nothing with the requested name.
    #[error("there is no {what} `{name}`{}", text::known(.name, .known))]
    UnknownName {
        /// The kind of thing that Kin looked for.
        what: &'static str,
        /// The name given.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// The times of a run are not valid.
    #[error("times: {reason}")]
    InvalidTimes {
        /// The mistake.
        reason: String,
    },

    /// A solver option is out of its range.
    #[error("options: {reason}")]
    InvalidOptions {
        /// The mistake.
        reason: String,
    },

    /// Motions need more memory than [`crate::SolverOptions::memory`] allows, so Kin has not
    /// started the computation.
    #[error("{}", text::needs_memory([*.motions, *.times, *.coordinates], [*.needed, *.allowed as f64]))]
    NeedsMemory {
        /// The number of motions that exist at the same time: one for each thread of a sweep.
        motions: usize,
        /// The number of times of each motion.
        times: usize,
        /// The number of coordinates at each time.
        coordinates: usize,
        /// The memory that the motions take.   \[B\]
        needed: f64,
        /// The allowed memory. \[B\]
        allowed: usize,
    },

    /// A case of a sweep contains a number that is infinite or not a number.
    #[error("case {case}: `{name}` is {value}. Give a finite number")]
    CaseNotFinite {
        /// The case, counted from 0.
        case: usize,
        /// The parameter or coordinate.
        name: String,
        /// Its value.
        value: f64,
    },

    /// A stop condition ended a sweep or a run ([`crate::solver::Sweep::stop_when`],
    /// [`crate::Solver::stop_when`]).
    #[error("{}{}", text::stopped([*.done, *.all], .motion.is_some()), text::computed_before(.motion.as_deref()))]
    Stopped {
        /// The number of computed cases or times.
        done: usize,
        /// The number of all cases or times.
        all: usize,
        /// The motion that a run had computed; `None` for a sweep.
        motion: Option<Box<Motion>>,
    },
    /// A list has the wrong length.
    #[error("{what} has {found} values, but Kin needs {expected}")]
    WrongLength {
        /// The list.
        what: String,
        /// The required length.
        expected: usize,
        /// The given length.
        found: usize,
    },
    /// An output contains a value that is infinite or not a number.
    #[error("the output `{output}` is {value} at t = {}. Give an output that is finite at each time", words::at(*.t, .units))]
    OutputNotFinite {
        /// The output.
        output: String,
        /// Time.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The value.
        value: f64,
    },

    /// Two ways to compute a derivative disagree ([`crate::ask::check::compare`]).
    #[error(transparent)]
    Mismatch(#[from] Box<crate::outcome::mismatch::Mismatch>),
    /// Kin cannot differentiate by a parameter: the parameter does not exist, or its derivative is
    /// unknown ([`crate::System::sensitivities`]).
    #[error(transparent)]
    NoDerivative(#[from] Box<crate::outcome::no_derivative::NoDerivative>),
    /// A force is not unique, because redundant constraints share the force
    /// ([`crate::forces::Forces`]).
    #[error(transparent)]
    NotUnique(#[from] Box<crate::outcome::not_unique::NotUnique>),
    /// The motion belongs to another system, or to this system before a change.
    #[error(transparent)]
    OtherMotion(#[from] Box<other_motion::OtherMotion>),
    /// Friction jams the mechanism ([`crate::Mechanism::friction`]).
    #[error(transparent)]
    Jammed(#[from] Box<crate::outcome::jammed::Jammed>),
    /// Forces have no bound at a singular position ([`crate::forces::Forces`]).
    #[error(transparent)]
    Unbounded(#[from] Box<crate::outcome::growth::Unbounded>),
    /// A dimension is invalid ([`crate::Mechanism::dimension`]).
    #[error(transparent)]
    Dimension(#[from] Box<crate::outcome::DimensionError>),
    /// A follower cannot reach the driver values that a call gave it
    /// ([`crate::solver::Follower::to`]).
    #[error(transparent)]
    CannotReach(#[from] Box<cannot_reach::CannotReach>),
    /// Kin cannot write a part of a mechanism as data, or data contain a mistake.
    #[error("{place}: {reason}")]
    Data {
        /// The place of the mistake: a file, a mechanism, a constraint by name.
        place: String,
        /// The mistake.
        reason: String,
    },

    /// Kin cannot read the table of a law: the file is unreadable, or its content is not such a
    /// table.
    #[error("{}: {reason}", .path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// The mistake.
        reason: String,
    },
    /// Kin cannot write a file.
    #[error("cannot write {}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The reason that the operating system reports.
        source: std::io::Error,
    },
}
