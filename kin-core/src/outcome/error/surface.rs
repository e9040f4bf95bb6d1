//! Adapts messages to the interface of the user: advice names a Rust function, a Python keyword or
//! a command-line flag.

use std::sync::atomic::{AtomicU8, Ordering};

/// The interface whose names messages use.
///
/// A Rust program uses [`Surface::Rust`]. The Python package and the command call
/// [`Surface::choose`] once when they start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Surface {
    /// Names of the Rust crate, such as `SolverOptions::new().allowed_misfit(1e-8)`.
    #[default]
    Rust,
    /// Names of the Python package, such as `allowed_misfit=1e-8`.
    Python,
    /// Flags of the command, such as `--allowed-misfit 1e-8`.
    Command,
}

static CHOSEN: AtomicU8 = AtomicU8::new(Surface::Rust as u8);

impl Surface {
    /// Selects this interface for all messages of the process.
    pub fn choose(self) {
        CHOSEN.store(self as u8, Ordering::Relaxed);
    }

    /// Returns the interface of this process.
    pub fn chosen() -> Surface {
        match CHOSEN.load(Ordering::Relaxed) {
            1 => Surface::Python,
            2 => Surface::Command,
            _ => Surface::Rust,
        }
    }

    /// An angle in radians, of so many degrees, as a user writes it.
    pub(crate) fn angle(self, degrees: f64) -> String {
        let sign = if degrees < 0.0 { "-" } else { "" };
        match (self, degrees.abs()) {
            (Surface::Rust, 360.0) => format!("`{sign}TAU`"),
            (Surface::Rust, 180.0) => format!("`{sign}PI`"),
            (Surface::Rust, _) => format!("`deg({degrees:?})`"),
            (Surface::Python, 360.0) => format!("`{sign}kin.tau`"),
            (Surface::Python, 180.0) => format!("`{sign}kin.pi`"),
            (Surface::Python, _) => format!("`kin.deg({degrees})`"),
            (Surface::Command, _) => format!("{} ({degrees}°)", degrees.to_radians()),
        }
    }

    /// A law with one number, as a program writes it; a file has no such form.
    pub(crate) fn law(self, kind: &str, number: &str) -> Option<String> {
        match self {
            Surface::Rust => Some(format!("`Law::{kind}({number})`")),
            Surface::Python => Some(format!("`Law.{kind}({number})`")),
            Surface::Command => None,
        }
    }

    /// A number as a program writes it.
    pub(crate) fn number(self, x: f64) -> String {
        match self {
            Surface::Rust => format!("{x:?}"),
            Surface::Python | Surface::Command => x.to_string(),
        }
    }

    /// How a point or direction of a body is found from a global one: the name of the call, and the
    /// body as a variable is likely to be called.
    pub(crate) fn in_body(self, call: &str, body: &str, argument: &str) -> String {
        let points = if call == "local" { "points" } else { "axes" };
        match self {
            Surface::Rust | Surface::Python => {
                let variable: String =
                    body.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
                format!(
                    "Constraints need {points} in the frame of `{body}`. Convert global {points} by `m.{call}({variable}, {argument})`"
                )
            }
            Surface::Command => format!("Constraints need {points} in the frame of `{body}`"),
        }
    }

    /// How a closure error is allowed.
    pub(crate) fn allowed_misfit(self, share: f64) -> String {
        match self {
            Surface::Rust => format!("`SolverOptions::new().allowed_misfit({share:e})`"),
            Surface::Python => format!("`run(times, allowed_misfit={share:e})`"),
            Surface::Command => format!("`--allowed-misfit {share:e}`"),
        }
    }

    /// How a user writes an angle in degrees.
    pub(crate) fn radians(self, degrees: f64) -> String {
        match self {
            Surface::Rust => format!("`deg({degrees:.1})` converts degrees"),
            Surface::Python => format!("`kin.deg({degrees:.1})` converts degrees"),
            Surface::Command => {
                format!("{degrees:.1} degrees are {:.4} rad", degrees.to_radians())
            }
        }
    }

    /// How a user computes a point or direction in the frame of a body, in brackets; the command
    /// has no call for it.
    pub(crate) fn local(self, call: &str, body: &str, what: &str) -> String {
        let variable: String =
            body.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        match self {
            Surface::Rust | Surface::Python => {
                format!(" (`m.{call}({variable}, {what})` computes the local {what})")
            }
            Surface::Command => String::new(),
        }
    }

    /// How a user holds turns on which nothing depends.
    pub(crate) fn hold_idle(self) -> &'static str {
        match self {
            Surface::Rust | Surface::Python => "by `m.hold_idle_turns()`",
            Surface::Command => "by one more constraint",
        }
    }

    /// How a user gets a unique number for a force that redundant constraints share.
    pub(crate) fn shared_force(self) -> &'static str {
        match self {
            Surface::Rust => {
                "Request a unique sum by `forces.sum([…])`, or choose a rule of `LoadSharing`"
            }
            Surface::Python => {
                "Request a unique sum by `forces.sum([…])`, or choose a rule by `sharing=`"
            }
            Surface::Command => "Choose the forces with the smallest norm by `--least-norm`",
        }
    }

    /// How a user names the units of a mechanism, in their order.
    pub(crate) fn units(self) -> &'static str {
        match self {
            Surface::Rust => "`m.units(length, time).mass(mass)`",
            Surface::Python => "`m.units(length, time, mass)`",
            Surface::Command => "`units` in the file",
        }
    }

    /// How a user adds one load.
    pub(crate) fn load(self) -> &'static str {
        match self {
            Surface::Rust | Surface::Python => "Add the energy by `m.load(…)`",
            Surface::Command => "Write the energy under `loads` in the file",
        }
    }

    /// How a user makes a clearance.
    pub(crate) fn clearance(self) -> &'static str {
        match self {
            Surface::Rust | Surface::Python => "`m.clearance(…)`",
            Surface::Command => "`clearance` in the file",
        }
    }

    /// How a user adds a coordinate.
    pub(crate) fn coordinate(self) -> &'static str {
        match self {
            Surface::Rust | Surface::Python => {
                "Add a coordinate for the measure (`m.length(…)`, `m.angle(…)`)"
            }
            Surface::Command => "Add a coordinate for the measure to the file",
        }
    }

    /// How a user gives bodies mass and lets loads act.
    pub(crate) fn loads(self) -> &'static str {
        match self {
            Surface::Rust | Surface::Python => "by `m.mass(…)` and `m.load(…)`",
            Surface::Command => "under `masses` and `loads` in the file",
        }
    }

    /// How a user gives a dimension a tolerance.
    pub(crate) fn tolerance(self) -> &'static str {
        match self {
            Surface::Rust => "`m.dimension(…)?.tolerance(…)`",
            Surface::Python => "`m.dimension(…, tolerance=…)`",
            Surface::Command => "`tolerance` in the file",
        }
    }

    /// Says where the motion before a failure is.
    pub(crate) fn motion_before(self, until: &str) -> String {
        match self {
            Surface::Rust => {
                format!("The motion up to t = {until} is in this error: `error.motion()`.")
            }
            Surface::Python => {
                format!("The motion up to t = {until} is in this error: `error.motion`.")
            }
            Surface::Command => format!("The files hold the motion up to t = {until}."),
        }
    }

    /// Returns the words before the limit of a run's memory, and those after the cure.
    pub(crate) fn memory(self) -> (&'static str, &'static str) {
        match self {
            Surface::Rust => ("`SolverOptions::memory` allows", ", or allow more"),
            Surface::Python => ("the option `memory` allows", ", or allow more"),
            Surface::Command => ("a run may use", ""),
        }
    }

    /// Says how a single run can use less memory.
    pub(crate) fn fewer_times(self) -> &'static str {
        match self {
            Surface::Rust => "Run in parts by `Solver::run_in_parts`, give fewer times",
            Surface::Python | Surface::Command => "Give fewer times",
        }
    }

    /// Says how to continue without proof that the run stays on its branch. The command has no such
    /// way.
    pub(crate) fn unchecked(self) -> &'static str {
        match self {
            Surface::Rust => "\n  To run without this check, choose `Follow::Unchecked`.",
            Surface::Python => "\n  To run without this check, give `follow=\"unchecked\"`.",
            Surface::Command => {
                "\n  Give times that are closer together, or end the run before this time."
            }
        }
    }

    /// The ground, as the argument of a joint.
    pub(crate) fn ground(self) -> &'static str {
        match self {
            Surface::Rust => "`Ground`",
            Surface::Python => "`m.ground`",
            Surface::Command => "`{\"planar\": null}` or `{\"spatial\": null}`",
        }
    }

    /// Says that a run ends because it needs more small steps than it may take.
    pub(crate) fn too_many_steps(self) -> &'static str {
        match self {
            Surface::Rust => {
                "the step to the next time needs more substeps than a run may take. Give closer times or a larger `SolverOptions::effort`"
            }
            Surface::Python => {
                "the step to the next time needs more substeps than a run may take. Give closer times or a larger `effort`"
            }
            Surface::Command => {
                "the step to the next time needs more substeps than a run may take. Give closer times or a larger `--effort`"
            }
        }
    }

    /// Says how to let Kin choose the engine.
    pub(crate) fn any_engine(self) -> &'static str {
        match self {
            Surface::Rust => "leave `SolverOptions::engine` at `Engine::Auto`",
            Surface::Python => "leave the option `engine` at `\"auto\"`",
            Surface::Command => "leave `--engine` at `auto`",
        }
    }

    /// Says how to let Kin choose the engine of forces.
    pub(crate) fn any_engine_of_forces(self) -> &'static str {
        match self {
            Surface::Rust => "compute the forces with `Engine::Auto`",
            Surface::Python => "leave `engine` at `\"auto\"`",
            Surface::Command => "leave `--engine` at `auto`",
        }
    }

    /// Says how to write a law with known bounds. The text precedes another cure.
    pub(crate) fn readable_law(self) -> &'static str {
        match self {
            Surface::Rust => {
                "write the law with `#[law]` and without loops or calls that Kin cannot read, or "
            }
            Surface::Python => "write the law with `@kin.law`, or ",
            Surface::Command => "",
        }
    }

    /// Says how to write a force whose formula Kin knows.
    pub(crate) fn readable_force(self) -> &'static str {
        match self {
            Surface::Rust => "a function with `#[force]`",
            Surface::Python => "a function with `@kin.force`",
            Surface::Command => "text in the file",
        }
    }

    /// Says how to cure a constraint whose part of the jerk is unknown.
    pub(crate) fn no_jerk(self) -> &'static str {
        match self {
            Surface::Rust => {
                "implement `Constraint::jerk_rhs`, or run without `SolverOptions::jerk`"
            }
            Surface::Python => "run without `jerk=True`",
            Surface::Command => "run without `--jerk`",
        }
    }

    /// Shows how to state the direction in which a run leaves a dead centre.
    pub(crate) fn start(self, coordinate: &str) -> String {
        match self {
            Surface::Rust => format!("`solver.start(Start::towards(\"{coordinate}\", 1))`"),
            Surface::Python => format!("`start={{\"{coordinate}\": 1}}`"),
            Surface::Command => format!("`--start {coordinate}=+1`"),
        }
    }

    /// Shows times of a run as an example.
    pub(crate) fn many_times(self) -> &'static str {
        match self {
            Surface::Rust => "`linspace(0.0, 1.0, 101)`",
            Surface::Python => "`np.linspace(0.0, 1.0, 101)`",
            Surface::Command => "`0:1:101`",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_surface_has_its_words() {
        let words = [Surface::Rust, Surface::Python, Surface::Command]
            .map(|surface| surface.allowed_misfit(3e-8));
        assert_eq!(
            words,
            [
                "`SolverOptions::new().allowed_misfit(3e-8)`",
                "`run(times, allowed_misfit=3e-8)`",
                "`--allowed-misfit 3e-8`"
            ]
        );
    }

    #[test]
    fn an_angle_is_written_as_each_surface_writes_it() {
        let all = |degrees: f64| {
            [Surface::Rust, Surface::Python, Surface::Command].map(|surface| surface.angle(degrees))
        };
        assert_eq!(all(360.0), ["`TAU`", "`kin.tau`", "6.283185307179586 (360°)"]);
        assert_eq!(all(-180.0), ["`-PI`", "`-kin.pi`", "-3.141592653589793 (-180°)"]);
        assert_eq!(all(45.0), ["`deg(45.0)`", "`kin.deg(45)`", "0.7853981633974483 (45°)"]);
    }

    /// Nothing that is said to a user of the wheel or of the command names a path of Rust.
    #[test]
    fn only_programs_are_told_paths_of_rust() {
        for surface in [Surface::Rust, Surface::Python, Surface::Command] {
            let (limit, more) = surface.memory();
            let all = [
                surface.allowed_misfit(1e-8),
                surface.motion_before("1 s"),
                limit.to_string(),
                more.to_string(),
                surface.fewer_times().to_string(),
                surface.unchecked().to_string(),
                surface.radians(90.0),
                surface.local("local", "rod", "point"),
                surface.hold_idle().to_string(),
                surface.shared_force().to_string(),
                surface.units().to_string(),
                surface.load().to_string(),
                surface.loads().to_string(),
                surface.clearance().to_string(),
                surface.coordinate().to_string(),
                surface.tolerance().to_string(),
                surface.any_engine().to_string(),
                surface.any_engine_of_forces().to_string(),
                surface.readable_law().to_string(),
                surface.readable_force().to_string(),
                surface.no_jerk().to_string(),
                surface.many_times().to_string(),
            ];
            let of_rust =
                |text: &&String| ["::", "#[", ")?."].iter().any(|mark| text.contains(mark));
            let told = all.iter().filter(of_rust).count();
            assert!(
                if surface == Surface::Rust { told >= 8 } else { told == 0 },
                "{surface:?}: {all:?}"
            );
        }
    }
}
