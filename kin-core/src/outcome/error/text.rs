//! Builds the sentences of error messages that depend on what Kin knows.

use crate::coordinates::units::Units;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, UnfollowedReason};
use crate::outcome::motion::Motion;
use crate::outcome::similar;
use crate::outcome::verdict::Diagnosis;
use crate::outcome::words::{GROUND, at, bytes, count, list, row, time};

/// Says where the last position was, and what to try.
pub(super) fn no_convergence(
    last: Option<f64>,
    units: &Units,
    diagnosis: Option<&Diagnosis>,
) -> String {
    let found = details(diagnosis);
    let Some(t) = last else {
        return if found.is_empty() {
            "\n  Give a better initial guess or a preferred assembly, or check whether each loop of the mechanism can close."
                .to_string()
        } else {
            found
        };
    };
    let cure = if found.is_empty() {
        "\n  Use a smaller time step, or check whether each loop of the mechanism can close beyond this time."
    } else {
        ""
    };
    format!("\n  Kin found the last position at t = {}.{found}{cure}", at(t, units))
}

/// Message of a position that does not exist, where the diagnosis has found why; else that of the
/// solver.
pub(super) fn unmet(
    at: &str,
    diagnosis: Option<&Diagnosis>,
    solver: impl Fn() -> String,
) -> String {
    match diagnosis.filter(|diagnosis| !diagnosis.gaps.is_empty()) {
        Some(diagnosis) => {
            format!("the mechanism \"{}\" cannot be assembled at t = {at}.", diagnosis.mechanism)
        }
        None => format!("Kin found no position at t = {at}: {}", solver()),
    }
}

/// Lists the faults, one per line. The text is empty if nothing is wrong or no diagnosis exists.
fn details(diagnosis: Option<&Diagnosis>) -> String {
    diagnosis.map(|diagnosis| diagnosis.details().to_string()).unwrap_or_default()
}

/// Returns the complete diagnosis.
pub(super) fn report(diagnosis: Option<&Diagnosis>) -> String {
    diagnosis.map(Diagnosis::to_string).unwrap_or_default()
}

/// Returns the complete diagnosis if it found a fault, otherwise the message of the solver.
pub(super) fn diagnosed(diagnosis: Option<&Diagnosis>, solver: impl Fn() -> String) -> String {
    let found = diagnosis.filter(|diagnosis| !diagnosis.can_be_driven());
    found.map_or_else(solver, |diagnosis| diagnosis.to_string())
}

/// Returns the message for a singular C_q: the coordinates that can move, and the equations that
/// depend on one another.
pub(super) fn singular(
    at: &str,
    [rank, n]: [usize; 2],
    [movable, dependent]: [&[String]; 2],
    unmet: Option<&str>,
) -> String {
    let rank = if rank < n {
        format!("has rank {rank}")
    } else {
        "is singular within rounding error".to_string()
    };
    let mut text = format!("the pose at t = {at} is singular: C_q ({n} x {n}) {rank}.");
    if !movable.is_empty() {
        text += &format!("\n  {} can move while the drivers stand still.", list(movable));
    }
    if !dependent.is_empty() {
        text += &format!("\n  These equations depend on one another: {}.", list(dependent));
    }
    text += &match unmet {
        None => "\n  At a toggle or change point, begin at another pose or choose other times. If a constraint repeats other constraints, remove the redundant constraint.".to_string(),
        Some(name) => {
            format!("\n  `{name}` is not satisfied at this pose. Remove a dependent equation that contradicts the others, or give a better guess.")
        }
    };
    text
}

/// Says why Kin does not replace a guess that is a singular assembly by another assembly.
pub(super) fn drawn(drawn: bool) -> &'static str {
    if drawn {
        "\n  The initial guess is singular but satisfies every equation, so Kin keeps this assembly. \
         To begin in another assembly, declare the bodies near that assembly, or prefer the assembly by a coordinate or measure."
    } else {
        ""
    }
}

/// The message of a position beyond a toggle: why it cannot be reached, and what can move at the
/// toggle.
pub(super) fn toggle(movable: &[String], diagnosis: Option<&Diagnosis>) -> String {
    let found = details(diagnosis);
    let is_cured = diagnosis.is_some_and(|diagnosis| !diagnosis.changes.is_empty());
    let cure = found.rsplit_once("\n  ").filter(|_| is_cured);
    let (why, cure) =
        cure.unwrap_or((&found, "End the motion before the toggle, or drive another body."));
    let movable = list(movable);
    format!("{why}\n  At the toggle, {movable} can move while the drivers stand still.\n  {cure}")
}

/// Returns the message for a run that may have left its branch.
pub(super) fn cannot_follow(at: &str, reason: UnfollowedReason) -> String {
    format!(
        "Kin cannot confirm that the run stays on its branch beyond t = {at}: {reason}.\n  A law or \
         constraint may have a kink there, or the pose may be singular in more than one way.{}",
        Surface::chosen().unchecked()
    )
}

/// Returns the message for a position on the wrong branch.
pub(super) fn wrong_branch(at: &str, [constraint, kind, reason]: [&str; 3]) -> String {
    format!(
        "`{constraint}` ({kind}) is assembled the wrong way round at t = {at}: {reason}.\n  Give a better guess of the poses, \
         or reverse one of the directions."
    )
}

/// Returns the message for a law that jumps at an argument in a derivative of the given order.
pub(super) fn law_jumps(
    at: &str,
    [constraint, law]: [&str; 2],
    (x, order): (f64, usize),
) -> String {
    let what = if order == 0 { "value" } else { "slope" };
    format!(
        "the law `{law}` of `{constraint}` jumps at t = {at}: the {what} of the law changes suddenly at {}, and no body can follow.\n  \
         Join the parts of the law with equal value and slope, or end the run before this time.",
        time(x)
    )
}

/// Says that the motion before the failure is available.
pub(super) fn computed_before(motion: Option<&Motion>) -> String {
    motion.map(motion_before).unwrap_or_default()
}

impl Error {
    /// Returns the message without its last line, which says where the motion before the failure
    /// is.
    ///
    /// A page that shows the motion before the failure uses this text.
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
pub(super) fn stopped([done, all]: [usize; 2], is_run: bool) -> String {
    let (what, parts) = if is_run { ("run", "times") } else { ("sweep", "cases") };
    format!("your program stopped the {what} after {done} of {all} {parts}")
}

/// Returns the message for a name that is given twice. The ground has its name in every mechanism.
pub(super) fn duplicate(what: &str, name: &str) -> String {
    match name {
        GROUND => format!(
            "a body cannot have the name `{GROUND}`: every mechanism has the ground already. Use {} in joints, or choose \
             another name for a body that moves",
            Surface::chosen().ground()
        ),
        _ => format!("two {what} have the name `{name}`. Give the two {what} different names"),
    }
}

/// Lists the known names, the most similar name first.
pub(super) fn known(name: &str, known: &[String]) -> String {
    similar::cure(name, known)
}

/// Says how far Newton's method came.
pub(super) fn worst(iterations: usize, constraint: &str, of: &str, residual: f64) -> String {
    format!(
        "after {} the residual of `{constraint}`{} is still {residual:.1e} (in the unit of this equation).",
        count(iterations, "iteration"),
        row(of)
    )
}

/// Returns the message for motions that need too much memory, with the ways to need less.
pub(super) fn needs_memory([motions, times, coordinates]: [usize; 3], sizes: [f64; 2]) -> String {
    let surface = Surface::chosen();
    let (all, cure) = if motions > 1 {
        (
            format!("{motions} simultaneous motions of "),
            "Run the sweep on fewer threads, give fewer times",
        )
    } else {
        (String::new(), surface.fewer_times())
    };
    let [needed, allowed] = sizes.map(bytes);
    let times = count(times, "time");
    let coordinates = count(coordinates, "coordinate");
    let (limit, more) = surface.memory();
    format!("{all}{times} of {coordinates} need {needed}, but {limit} {allowed}.\n  {cure}{more}.")
}

/// Returns the message for a handle of another mechanism.
pub(super) fn foreign([place, argument, mechanism]: [&str; 3]) -> String {
    format!(
        "`{place}` cannot use `{argument}`, because `{argument}` does not belong to \"{mechanism}\". Use only bodies and coordinates of \"{mechanism}\""
    )
}

/// Returns the message for one thing in two arguments.
pub(super) fn repeated([constraint, first, second, name]: [&str; 4]) -> String {
    format!(
        "`{constraint}` has `{name}` twice, as `{first}` and as `{second}`. Give `{constraint}` two different bodies or coordinates"
    )
}
