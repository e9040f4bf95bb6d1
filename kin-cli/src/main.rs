//! The command `kin`: mechanism files run, checked, diagnosed, proved, swept and drawn.
//!
//! Data go to the standard output or to files, words to the standard error. A file imports from
//! files further to the right only: `main` → `commands/` → `model` → `arguments` → `points` →
//! `times`, `say`, `output` → `fault`.
#![forbid(unsafe_code)]

mod arguments;
mod commands;
mod fault;
mod model;
mod output;
mod points;
mod say;
mod times;

use std::process::ExitCode;

use arguments::{Arguments, Command};
use clap::Parser;
use clap::error::ErrorKind;
use fault::Fault;
use say::{Format, Say};

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return ExitCode::from(not_understood(&error)),
    };
    kin::error::Surface::Command.choose();
    let say = Say::new(arguments.error_format);
    ExitCode::from(say.ended(done(&arguments.command, &say)))
}

fn done(command: &Command, say: &Say) -> Result<(), Fault> {
    match command {
        Command::Run(asked) => commands::run(asked, say),
        Command::Watch(asked) => commands::watch(asked, say),
        Command::Check(asked) => commands::check(asked, say),
        Command::Diagnose(asked) => commands::diagnose(asked, say),
        Command::Assemblies(asked) => commands::assemblies(asked, say),
        Command::Pose(asked) => commands::pose(asked, say),
        Command::Drag(asked) => commands::drag(asked, say),
        Command::Map(asked) => commands::map(asked, say),
        Command::Circuit(asked) => commands::circuit(asked, say),
        Command::Measure(asked) => commands::measure(asked, say),
        Command::Prove(asked) => commands::prove(asked, say),
        Command::Sensitivities(asked) => commands::sensitivities(asked, say),
        Command::Tolerance(asked) => commands::tolerance(asked, say),
        Command::Forces(asked) => commands::forces(asked, say),
        Command::Emit(asked) => commands::emit(asked),
        Command::Sweep(asked) => commands::sweep(asked, say),
        Command::Import(asked) => commands::import(asked, say),
        Command::Schema => commands::schema(),
        Command::Completions { shell } => commands::completions(*shell),
        Command::Manual { command } => commands::manual(command.as_deref()),
    }
}

/// Help and version, which are data, and mistakes in the arguments, which are words.
fn not_understood(error: &clap::Error) -> u8 {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        // Who closes the pipe has read enough of the help.
        let _ = error.print();
        return 0;
    }
    if Format::of_arguments(std::env::args()) == Format::Json {
        return Say::new(Format::Json).ended(Err(Fault::Usage(error.render().to_string())));
    }
    let _ = error.print();
    2
}
