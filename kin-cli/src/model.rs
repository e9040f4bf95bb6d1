//! From a mechanism file to a system, and to its motion.

use std::io::Read;

use kin::Mechanism;
use kin::data::MechanismData;
use kin::results::{SingularKind, SingularPosition};
use kin::solver::Start;
use kin::{Error, Follow, Motion, SolverOptions, System};

use crate::arguments::{self, Engine, Model};
use crate::fault::Fault;
use crate::points::Setting;

/// Longer files are no mechanisms.
const LONGEST: u64 = 1 << 28;

/// The text of a file, or of the standard input for `-`.
pub fn text(file: &str) -> Result<String, Fault> {
    let fail =
        |why: &dyn std::fmt::Display| Fault::File(format!("cannot read {}: {why}", named(file)));
    let from: Box<dyn Read> = match file {
        "-" => Box::new(std::io::stdin()),
        _ => Box::new(std::fs::File::open(file).map_err(|error| fail(&error))?),
    };
    let mut text = String::new();
    from.take(LONGEST + 1).read_to_string(&mut text).map_err(|error| fail(&error))?;
    if text.len() as u64 > LONGEST {
        return Err(fail(&format!("it has more than {LONGEST} bytes")));
    }
    Ok(text)
}

/// The file in words.
pub fn named(file: &str) -> &str {
    if file == "-" { "standard input" } else { file }
}

/// The mechanism in a file, equations as text in it too.
pub fn mechanism(file: &str) -> Result<Mechanism, Fault> {
    let data = MechanismData::read(&text(file)?).map_err(|error| match error {
        Error::Data { reason, .. } => {
            Fault::File(format!("{} cannot be read as a mechanism: {reason}", named(file)))
        }
        other => other.into(),
    })?;
    Mechanism::from_data(&data, &kin_text::registry()).map_err(|error| match error {
        Error::Data { place, reason } => Fault::File(format!("{}: {place}: {reason}", named(file))),
        other => other.into(),
    })
}

/// The system of a file, with what is set in it. Errors: a name that is set twice.
pub fn system(model: &Model) -> Result<System, Fault> {
    let all = &model.settings;
    let again = |k: &usize| all[..*k].iter().any(|before| before.name == all[*k].name);
    if let Some(k) = (0..all.len()).find(again) {
        let name = &all[k].name;
        return Err(Fault::Usage(format!("`--set` names `{name}` twice. Remove one of the two")));
    }
    let mut system = mechanism(&model.file)?.build()?;
    model.settings.iter().try_for_each(|setting| set(&mut system, setting)).map_err(not_set)?;
    Ok(system)
}

/// The fault of a value that no dimension, parameter or coordinate can have.
fn not_set(error: Error) -> Fault {
    match error {
        Error::Dimension(_) | Error::InvalidLength { .. } => Fault::Usage(error.to_string()),
        other => Fault::asked(other),
    }
}

/// Sets a parameter or the guess of a coordinate.
///
/// Errors: a name that neither has; a value that makes no sense.
pub fn set(system: &mut System, Setting { name, value }: &Setting) -> kin::Result<()> {
    match system.coordinate_names().iter().position(|known| known == name) {
        Some(column) => {
            let mut q = system.initial().to_vec();
            q[column] = *value;
            system.set_initial(&q)
        }
        None => system.set(name, *value),
    }
}

/// The options that are asked for.
pub fn options(asked: &arguments::Motion, jerk: bool) -> SolverOptions {
    SolverOptions::new()
        .allowed_misfit(asked.misfit.share)
        .jerk(jerk)
        .engine(match asked.engine {
            Engine::Auto => kin::Engine::Auto,
            Engine::StepByStep => kin::Engine::StepByStep,
            Engine::Compiled => kin::Engine::Compiled,
        })
        .follow(match &asked.other_branch_at[..] {
            [] => Follow::default(),
            numbers => Follow::OtherBranchAt(numbers.to_vec()),
        })
        .effort(asked.effort)
}

/// Errors: a change point to turn at that a whole motion does not pass.
fn turned(motion: &Motion, turning: &[usize]) -> Result<(), Fault> {
    let is_one = |at: &&SingularPosition| at.kind == SingularKind::Bifurcation;
    let passed = motion.singular_positions().iter().filter(is_one).count();
    let Some(number) = turning.iter().find(|number| **number >= passed) else { return Ok(()) };
    let there = match passed {
        0 => "the motion passes no change point".to_string(),
        1 => "the motion passes one change point, number 0".to_string(),
        _ => format!("the motion passes {passed} change points, numbers 0 to {}", passed - 1),
    };
    Err(Fault::Usage(format!("`--other-branch-at {number}`: {there}")))
}

/// The motion; where the run ends early the part before, with the fault.
///
/// Errors: the fault of a motion that has no part; a change point to turn at that it does not pass.
pub fn motion(
    system: &System,
    asked: &arguments::Motion,
    jerk: bool,
) -> Result<(Motion, Option<Fault>), Fault> {
    let mut solver = system.solver().options(options(asked, jerk));
    if let Some(Setting { name, value }) = &asked.start {
        solver = solver.start(Start::towards(name, *value));
    }
    match solver.run(&asked.times.0) {
        Ok(motion) => turned(&motion, &asked.other_branch_at).map(|()| (motion, None)),
        Err(error) => match error.motion().filter(|motion| !motion.is_empty()).cloned() {
            Some(before) => Ok((before, Some(Fault::Early(Box::new(error))))),
            None => Err(error.into()),
        },
    }
}
