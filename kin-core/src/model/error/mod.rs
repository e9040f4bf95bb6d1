//! Errors, in the words of the field: where (time, constraint by name), the fault, and the cure to
//! try.

use std::path::PathBuf;

use crate::model::{blame::Culprit, motion::Motion, units::Units, verdict::Diagnosis, words};
mod carried;
mod other_motion;
pub(crate) mod surface;
mod text;

pub use carried::Result;
pub use other_motion::OtherMotion;

/// Everything that can go wrong. `Debug` prints what `Display` does: errors of `main` read well.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A mechanism that cannot be driven, whatever its pose: equations are missing or
    /// contradictory.
    #[error("{diagnosis}{}", text::computed_before(.motion))]
    CannotBeDriven {
        /// The diagnosis, by name.
        diagnosis: Box<Diagnosis>,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// Newton's method did not reach C(q, t) = 0.
    #[error("t = {}: {}{}", words::at(*.t, .units), text::unmet(.diagnosis, || text::worst(*.iterations, .constraint, .row, *.residual)),
        text::no_convergence(*.last, .units, .diagnosis, .motion))]
    NoConvergence {
        /// Time.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// Newton steps taken.
        iterations: usize,
        /// The constraint that is furthest from being met.
        constraint: String,
        /// Its row; empty for a constraint of one row.
        row: String,
        /// |C| of that row, in the row's unit.
        residual: f64,
        /// The last time at which the position was found.   \[s\]
        last: Option<f64>,
        /// The diagnosis at this time, by name, and how near the parts can come.
        diagnosis: Option<Box<Diagnosis>>,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// C_q has no inverse at a position: a toggle, a change point, a mechanism wrongly constrained.
    #[error("{}{}{}", text::diagnosed(.diagnosis, || text::singular(&words::at(*.t, .units), [*.rank, *.n], *.pivot,
        [.movable, .dependent], .unmet)), text::drawn(*.drawn), text::computed_before(.motion))]
    SingularAt {
        /// Time.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// Number of coordinates.
        n: usize,
        /// Numerical rank of C_q in units of order 1; n where it is singular but for rounding.
        rank: usize,
        /// The smallest pivot of the elimination relative to its row.
        pivot: f64,
        /// Bodies and coordinates that can move although everything that drives stands still.
        movable: Vec<String>,
        /// Equations that depend on one another.
        dependent: Box<[String]>,
        /// An equation that is far from being met where the search ended; `None` at a position.
        unmet: Option<Box<str>>,
        /// True if this is the pose that was given as the guess, which meets every equation.
        drawn: bool,
        /// The diagnosis at this time, by name.
        diagnosis: Option<Box<Diagnosis>>,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// A toggle: the mechanism cannot be driven beyond it; what it moves has an infinite rate
    /// there.
    #[error("t = {}: a toggle: beyond this time there is no position.{}{}", words::at(*.t, .units),
        text::toggle(.movable, .dependent, .diagnosis), text::computed_before(.motion))]
    Toggle {
        /// The time t* of the toggle.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The time that was asked for.   \[s\]
        asked: f64,
        /// Bodies and coordinates that can move at t* although everything that drives stands still.
        movable: Vec<String>,
        /// Equations that depend on one another at t*.
        dependent: Vec<String>,
        /// The diagnosis at the time that was asked for, by name, and how near the parts can come.
        diagnosis: Option<Box<Diagnosis>>,
        /// The motion computed before; its last [`Motion::singular_positions`] is the toggle.
        motion: Option<Box<Motion>>,
    },
    /// A step that may have left its branch, and cannot be made any shorter.
    #[error("{}", text::cannot_follow(&words::at(*.t, .units), reason, .motion))]
    CannotFollow {
        /// The last time at which the branch is known.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The objection.
        reason: &'static str,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// A position that closes, but not as it is meant: the equations hold for an axis turned by
    /// 180° too.
    #[error("{}", text::wrong_branch(&words::at(*.t, .units), [constraint, kind, reason], .motion))]
    WrongBranch {
        /// Time.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The condition that does not hold.
        reason: String,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// A law that jumps where it drives the motion.
    #[error("{}", text::law_jumps(&words::at(*.t, .units), [constraint, law], (*.at, *.order), .motion))]
    LawJumps {
        /// The first time beyond the jump.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The constraint.
        constraint: String,
        /// The law, by its name in the constraint.
        law: String,
        /// Where in the law.
        at: f64,
        /// 0: the value jumps; 1: the slope.
        order: usize,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },
    /// A constraint gave a value or derivative that is infinite or not a number.
    #[error("t = {}: {quantity} of `{constraint}`{} is not finite{culprit}{}", words::at(*.t, .units), words::row(.row), text::computed_before(.motion))]
    NotFinite {
        /// Time.   \[s\]
        t: f64,
        /// Names of the units of length and time.
        units: Units,
        /// The constraint.
        constraint: String,
        /// Its row; empty for a constraint of one row.
        row: String,
        /// `C`, `C_q`, `C_t`, `Q_d`, or `q'`, `q''` where only the solution overflows.
        quantity: &'static str,
        /// The sub-expression that made it so, as the user wrote it, and the values that went into
        /// it.
        culprit: Box<Culprit>,
        /// The motion computed before.
        motion: Option<Box<Motion>>,
    },

    /// A parameter of a constraint is infinite or not a number.
    #[error("`{constraint}`: the parameter `{parameter}` is {value}; give a finite number")]
    ParameterNotFinite {
        /// The constraint.
        constraint: String,
        /// The parameter, such as `u_i.x`.
        parameter: String,
        /// Its value.
        value: f64,
    },

    /// Parameters that make no sense: a length below zero, an axis without direction.
    #[error("`{constraint}` ({kind}): {reason}")]
    InvalidParameters {
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The condition that does not hold.
        reason: String,
    },

    /// An initial or other value given for a coordinate is infinite or not a number.
    #[error("`{name}`: the value given for {coordinate} is {value}; give a finite number")]
    InitialNotFinite {
        /// The body or bare coordinate.
        name: String,
        /// Its coordinate.
        coordinate: String,
        /// The value given.
        value: f64,
    },

    /// A link must have a length above zero.
    #[error("the link `{link}` has the length {length}; give one above zero")]
    InvalidLength {
        /// The link.
        link: String,
        /// The length given.   \[m\]
        length: f64,
    },

    /// A body or coordinate of another mechanism.
    #[error("{}", text::foreign([place, argument, mechanism]))]
    ForeignBody {
        /// The mechanism that was asked.
        mechanism: String,
        /// The constraint, or the operation.
        place: String,
        /// Name of the argument.
        argument: String,
    },

    /// The same body or coordinate twice in one constraint.
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

    /// An equation left without coordinates, because all its bodies are the ground.
    #[error("`{constraint}`{} has no coordinate left: {reason}", words::row(.row))]
    NoCoordinates {
        /// The constraint.
        constraint: String,
        /// Its row; empty for a constraint of one row.
        row: String,
        /// Why: which arguments are the ground.
        reason: String,
    },

    /// A motion that interval bounds cannot say anything about.
    #[error("{what} cannot be proved: {reason}")]
    CannotBeProved {
        /// The motion of which mechanism, or with which constraint.
        what: String,
        /// Why.
        reason: String,
    },

    /// A hand-written constraint that contradicts itself, or does not know what is asked of it.
    #[error("`{constraint}` ({kind}): {reason}")]
    InvalidConstraint {
        /// The constraint.
        constraint: String,
        /// Its kind.
        kind: String,
        /// The fault.
        reason: String,
    },

    /// A name given twice.
    #[error("there are two {what} named `{name}`; choose another name for one")]
    DuplicateName {
        /// "bodies or coordinates", "constraints", "outputs".
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A name that is empty.
    #[error("a {what} needs a name")]
    EmptyName {
        /// The kind of thing that has no name, such as "body".
        what: &'static str,
    },
    /// A name that nothing has.
    #[error("there is no {what} `{name}`{}", text::known(.known))]
    UnknownName {
        /// The kind of thing that was looked for.
        what: &'static str,
        /// The name given.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// Times that no sweep can follow.
    #[error("times: {reason}")]
    InvalidTimes {
        /// The fault.
        reason: String,
    },

    /// A solver option out of its range.
    #[error("options: {reason}")]
    InvalidOptions {
        /// The fault.
        reason: String,
    },

    /// Motions that take more memory than [`crate::SolverOptions::memory`] allows; nothing has been
    /// computed.
    #[error("{}", text::needs_memory([*.motions, *.times, *.coordinates], [*.needed, *.allowed as f64]))]
    NeedsMemory {
        /// How many motions there are at once: one for each thread of a sweep.
        motions: usize,
        /// Times of each.
        times: usize,
        /// Coordinates at each time.
        coordinates: usize,
        /// The memory that the motions take.   \[B\]
        needed: f64,
        /// The memory that is allowed.   \[B\]
        allowed: usize,
    },

    /// A case of a sweep with a number that is infinite or not a number.
    #[error("case {case}: `{name}` is {value}; give a finite number")]
    CaseNotFinite {
        /// The case, counted from 0.
        case: usize,
        /// The parameter or coordinate.
        name: String,
        /// Its value.
        value: f64,
    },

    /// A sweep or run that was told to stop ([`crate::solver::Sweep::stop_when`],
    /// [`crate::Solver::stop_when`]).
    #[error("{}{}", text::stopped([*.done, *.all], .motion), text::computed_before(.motion))]
    Stopped {
        /// Cases or times that were done.
        done: usize,
        /// Cases or times there are.
        all: usize,
        /// The motion that a run had computed before; `None` of a sweep.
        motion: Option<Box<Motion>>,
    },
    /// A list of the wrong length.
    #[error("{what}: {found} values given, {expected} needed")]
    WrongLength {
        /// The list.
        what: String,
        /// The length needed.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// An output with a value that is infinite or not a number.
    #[error("the output `{output}` is {value} at t = {}; give finite numbers", words::at(*.t, .units))]
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

    /// Routes to a derivative that do not agree ([`crate::ask::check::compare`]).
    #[error(transparent)]
    Mismatch(#[from] Box<crate::model::mismatch::Mismatch>),
    /// A derivative by a parameter that does not exist, or is not known
    /// ([`crate::System::sensitivities`]).
    #[error(transparent)]
    NoDerivative(#[from] Box<crate::model::no_derivative::NoDerivative>),
    /// A force that redundant constraints share ([`crate::forces::Forces`]).
    #[error(transparent)]
    NotUnique(#[from] Box<crate::model::not_unique::NotUnique>),
    /// A motion of another system, or of this one before something was set.
    #[error(transparent)]
    OtherMotion(#[from] Box<other_motion::OtherMotion>),
    /// A mechanism that friction holds fast ([`crate::Mechanism::friction`]).
    #[error(transparent)]
    Jammed(#[from] Box<crate::model::jammed::Jammed>),
    /// Forces at a singular position, where they have no bound ([`crate::forces::Forces`]).
    #[error(transparent)]
    Unbounded(#[from] Box<crate::model::growth::Unbounded>),
    /// A dimension that makes no sense ([`crate::Mechanism::dimension`]).
    #[error(transparent)]
    Dimension(#[from] Box<crate::model::dimension::DimensionError>),
    /// Something that cannot be written as data, or data that do not say what they should.
    #[error("{place}: {reason}")]
    Data {
        /// The place of the fault: a file, a mechanism, a constraint by name.
        place: String,
        /// The fault.
        reason: String,
    },

    /// A file with a table that cannot be read, or is no table of a law.
    #[error("{}: {reason}", .path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
}
