//! The sentences of error messages that depend on what is known.

use crate::model::error::Error;
use crate::model::error::surface::Surface;
use crate::model::motion::Motion;
use crate::model::units::Units;
use crate::model::verdict::Diagnosis;
use crate::model::words::{at, bytes, count, list, row, time};

/// Where the last position was found, and what to try.
pub(super) fn no_convergence(
    last: Option<f64>,
    units: &Units,
    diagnosis: &Option<Box<Diagnosis>>,
    motion: &Option<Box<Motion>>,
) -> String {
    let found = details(diagnosis);
    match last {
        Some(t) if found.is_empty() => {
            format!(
                "\n  Nearest solved t = {}. Try a smaller time step, or the loop cannot close beyond it.{}",
                at(t, units),
                computed_before(motion)
            )
        }
        Some(t) => {
            format!("\n  Nearest solved t = {}.{found}{}", at(t, units), computed_before(motion))
        }
        None if found.is_empty() => {
            "\n  Try a better initial guess, or a preferred assembly; or the loop cannot close."
                .to_string()
        }
        None => found,
    }
}

/// Message of a position that does not exist, where the diagnosis has found why; else that of the
/// solver.
pub(super) fn unmet(diagnosis: &Option<Box<Diagnosis>>, solver: impl Fn() -> String) -> String {
    let found = diagnosis.as_ref().filter(|diagnosis| !diagnosis.gaps.is_empty());
    found.map_or_else(solver, |diagnosis| {
        format!("the mechanism \"{}\" cannot be put together.", diagnosis.mechanism)
    })
}

/// The faults, one a line; empty where nothing is wrong, or no diagnosis was made.
fn details(diagnosis: &Option<Box<Diagnosis>>) -> String {
    diagnosis.as_ref().map(|diagnosis| diagnosis.details().to_string()).unwrap_or_default()
}

/// The whole diagnosis where it has found what is wrong, else what the solver has to say.
pub(super) fn diagnosed(diagnosis: &Option<Box<Diagnosis>>, solver: impl Fn() -> String) -> String {
    let found = diagnosis.as_ref().filter(|diagnosis| !diagnosis.can_be_driven());
    found.map_or_else(solver, |diagnosis| diagnosis.to_string())
}

/// Message of a singular C_q: the coordinates that can move, and the equations that depend on one
/// another.
pub(super) fn singular(
    at: &str,
    [rank, n]: [usize; 2],
    pivot: f64,
    [movable, dependent]: [&[String]; 2],
    unmet: &Option<Box<str>>,
) -> String {
    let rank = if rank < n {
        format!("has rank {rank}")
    } else {
        "is singular but for rounding".to_string()
    };
    let mut text =
        format!("t = {at}: C_q ({n} x {n}) {rank}; smallest relative pivot {pivot:.1e}.");
    if !movable.is_empty() {
        text += &format!("\n  free to move though the drivers stand still: {}.", list(movable));
    }
    if !dependent.is_empty() {
        text += &format!("\n  dependent equations: {}.", list(dependent));
    }
    text += &match unmet {
        None => "\n  A toggle or change point (start or step elsewhere), or one constraint repeats the others (remove it).".to_string(),
        Some(name) => {
            format!("\n  `{name}` cannot be met there: the dependent equations contradict one another (remove one), or the guess is poor.")
        }
    };
    text
}

/// Why a guess that is an assembly, but a singular one, is not left for another assembly.
pub(super) fn drawn(drawn: bool) -> &'static str {
    if drawn {
        "\n  The drawn position is singular: it meets every equation, so Kin does not leave it for another \
         assembly. To begin in another one, draw the mechanism there, or prefer it by a coordinate or measure."
    } else {
        ""
    }
}

/// The message of a position beyond a toggle: why it cannot be reached, and what can move at the
/// toggle.
pub(super) fn toggle(
    movable: &[String],
    dependent: &[String],
    diagnosis: &Option<Box<Diagnosis>>,
) -> String {
    let all = format!(
        "There {} can move although what drives stands still, and {} depend on one another.",
        list(movable),
        list(dependent)
    );
    format!("{}\n  {all}", details(diagnosis))
}

/// Message of a run that may have left its branch.
pub(super) fn cannot_follow(at: &str, reason: &str, motion: &Option<Box<Motion>>) -> String {
    format!(
        "t = {at}: beyond this time the run cannot be shown to stay on its branch ({reason}).\n  A law or \
         constraint with a kink, or a position that is singular in more than one way{}.{}",
        Surface::chosen().unchecked(),
        computed_before(motion)
    )
}

/// Message of a position that closes, but not as it is meant.
pub(super) fn wrong_branch(
    at: &str,
    [constraint, kind, reason]: [&str; 3],
    motion: &Option<Box<Motion>>,
) -> String {
    format!(
        "t = {at}: `{constraint}` ({kind}) closes the wrong way: {reason}.\n  Give a better guess of the poses, \
         or turn one of the directions round.{}",
        computed_before(motion)
    )
}

/// Message of a law that jumps, at an argument, in a derivative of that order.
pub(super) fn law_jumps(
    at: &str,
    [constraint, law]: [&str; 2],
    (x, order): (f64, usize),
    motion: &Option<Box<Motion>>,
) -> String {
    let what = if order == 0 { "value changes" } else { "slope changes" };
    format!(
        "t = {at}: the law `{law}` of `{constraint}` jumps at {}: its {what} there, which no body can follow.\n  \
         Let its parts meet, or stop before it.{}",
        time(x),
        computed_before(motion)
    )
}

/// Says that the motion before the failure is not lost.
pub(super) fn computed_before(motion: &Option<Box<Motion>>) -> String {
    motion.as_deref().map(motion_before).unwrap_or_default()
}

impl Error {
    /// The message without its last line, which says where the motion before the failure is: for a
    /// page that shows that motion.
    pub fn reason(&self) -> String {
        let text = self.to_string();
        let line = self.motion().map(motion_before).unwrap_or_default();
        text.strip_suffix(&line).unwrap_or(&text).to_string()
    }
}

/// The line about the motion before the failure; empty where it has no times.
pub(super) fn motion_before(motion: &Motion) -> String {
    let Some(last) = motion.times().last() else { return String::new() };
    let until = at(*last, motion.unit_words());
    format!("\n  {}", Surface::chosen().motion_before(&until))
}

/// A sweep, or a run, which carries a motion.
pub(super) fn stopped([done, all]: [usize; 2], motion: &Option<Box<Motion>>) -> String {
    let (what, parts) = if motion.is_some() { ("run", "times") } else { ("sweep", "cases") };
    format!("the {what} was stopped after {done} of {all} {parts}")
}

/// The names there are, nearest guess first.
pub(super) fn known(known: &[String]) -> String {
    if known.is_empty() { String::new() } else { format!("; there are {}", list(known)) }
}

/// How far Newton's method has come.
pub(super) fn worst(iterations: usize, constraint: &str, of: &str, residual: f64) -> String {
    format!(
        "no convergence in {}; worst is `{constraint}`{}: |C| = {residual:.1e}.",
        count(iterations, "iteration"),
        row(of)
    )
}

/// The message of motions that need more memory than they may have, and how to need less.
pub(super) fn needs_memory([motions, times, coordinates]: [usize; 3], sizes: [f64; 2]) -> String {
    let surface = Surface::chosen();
    let (all, cure) = if motions > 1 {
        (
            format!("{motions} motions at once of "),
            "Run the sweep on fewer threads, ask for fewer times",
        )
    } else {
        (String::new(), surface.fewer_times())
    };
    let [needed, allowed] = sizes.map(bytes);
    let times = count(times, "time");
    let coordinates = count(coordinates, "coordinate");
    let (limit, more) = surface.memory();
    format!("{all}{times} of {coordinates} need {needed}; {limit} {allowed}.\n  {cure}{more}.")
}

/// A handle of another mechanism.
pub(super) fn foreign([place, argument, mechanism]: [&str; 3]) -> String {
    format!(
        "`{place}`: `{argument}` is not of the mechanism \"{mechanism}\"; use what its own methods gave out"
    )
}

/// One thing by two arguments.
pub(super) fn repeated([constraint, first, second, name]: [&str; 4]) -> String {
    format!(
        "`{constraint}`: `{first}` and `{second}` are both `{name}`; a constraint needs different bodies and coordinates"
    )
}
