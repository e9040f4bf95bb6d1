//! Builds the sentences of error messages that depend on what Kin knows.

use crate::model::error::Error;
use crate::model::error::surface::Surface;
use crate::model::motion::Motion;
use crate::model::units::Units;
use crate::model::verdict::Diagnosis;
use crate::model::words::{at, bytes, count, list, row, time};

/// Says where the last position was, and what to try.
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

/// Returns the message for a position that does not exist: the reason from the diagnosis if it
/// found one, otherwise the message of the solver.
pub(super) fn unmet(diagnosis: &Option<Box<Diagnosis>>, solver: impl Fn() -> String) -> String {
    let found = diagnosis.as_ref().filter(|diagnosis| !diagnosis.gaps.is_empty());
    found.map_or_else(solver, |diagnosis| {
        format!("the mechanism \"{}\" cannot be put together.", diagnosis.mechanism)
    })
}

/// Lists the faults, one per line. The text is empty if nothing is wrong or no diagnosis exists.
fn details(diagnosis: &Option<Box<Diagnosis>>) -> String {
    diagnosis.as_ref().map(|diagnosis| diagnosis.details().to_string()).unwrap_or_default()
}

/// Returns the complete diagnosis if it found a fault, otherwise the message of the solver.
pub(super) fn diagnosed(diagnosis: &Option<Box<Diagnosis>>, solver: impl Fn() -> String) -> String {
    let found = diagnosis.as_ref().filter(|diagnosis| !diagnosis.can_be_driven());
    found.map_or_else(solver, |diagnosis| diagnosis.to_string())
}

/// Returns the message for a singular C_q: the coordinates that can move, and the equations that
/// depend on one another.
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

/// Says why Kin does not replace a guess that is a singular assembly by another assembly.
pub(super) fn drawn(drawn: bool) -> &'static str {
    if drawn {
        "\n  The drawn position is singular: it meets every equation, so Kin does not leave it for another \
         assembly. To begin in another one, draw the mechanism there, or prefer it by a coordinate or measure."
    } else {
        ""
    }
}

/// Returns the message for a position beyond a toggle: why the mechanism cannot reach it, and what
/// can move at the toggle.
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

/// Returns the message for a run that may have left its branch.
pub(super) fn cannot_follow(at: &str, reason: &str, motion: &Option<Box<Motion>>) -> String {
    format!(
        "t = {at}: beyond this time the run cannot be shown to stay on its branch ({reason}).\n  A law or \
         constraint with a kink, or a position that is singular in more than one way{}.{}",
        Surface::chosen().unchecked(),
        computed_before(motion)
    )
}

/// Returns the message for a position on the wrong branch.
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

/// Returns the message for a law that jumps at an argument in a derivative of the given order.
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

/// Says that the motion before the failure is available.
pub(super) fn computed_before(motion: &Option<Box<Motion>>) -> String {
    motion.as_deref().map(motion_before).unwrap_or_default()
}

impl Error {
    /// Returns the message without its last line, which says where the motion before the failure
    /// is. A page that shows this motion uses it.
    pub fn reason(&self) -> String {
        let text = self.to_string();
        let line = self.motion().map(motion_before).unwrap_or_default();
        text.strip_suffix(&line).unwrap_or(&text).to_string()
    }
}

/// Returns the line about the motion before the failure, or an empty text if the motion has no
/// times.
pub(super) fn motion_before(motion: &Motion) -> String {
    let Some(last) = motion.times().last() else { return String::new() };
    let until = at(*last, motion.unit_words());
    format!("\n  {}", Surface::chosen().motion_before(&until))
}

/// Returns the message for a sweep or a run that was stopped. A run carries its motion.
pub(super) fn stopped([done, all]: [usize; 2], motion: &Option<Box<Motion>>) -> String {
    let (what, parts) = if motion.is_some() { ("run", "times") } else { ("sweep", "cases") };
    format!("the {what} was stopped after {done} of {all} {parts}")
}

/// Lists the known names, the most similar name first.
pub(super) fn known(known: &[String]) -> String {
    if known.is_empty() { String::new() } else { format!("; there are {}", list(known)) }
}

/// Says how far Newton's method came.
pub(super) fn worst(iterations: usize, constraint: &str, of: &str, residual: f64) -> String {
    format!(
        "no convergence in {}; worst is `{constraint}`{}: |C| = {residual:.1e}.",
        count(iterations, "iteration"),
        row(of)
    )
}

/// Returns the message for motions that need too much memory, with the ways to need less.
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

/// Returns the message for a handle of another mechanism.
pub(super) fn foreign([place, argument, mechanism]: [&str; 3]) -> String {
    format!(
        "`{place}`: `{argument}` is not of the mechanism \"{mechanism}\"; use what its own methods gave out"
    )
}

/// Returns the message for one thing in two arguments.
pub(super) fn repeated([constraint, first, second, name]: [&str; 4]) -> String {
    format!(
        "`{constraint}`: `{first}` and `{second}` are both `{name}`; a constraint needs different bodies and coordinates"
    )
}
