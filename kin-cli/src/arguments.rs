//! The command line: what can be asked, as `clap` reads it.

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::points::{NamedPoint, Setting, Shard};
use crate::say::Format;
use crate::times::Times;

/// Mechanism files run, checked, diagnosed, proved, swept and drawn.
///
/// Data go to the standard output or to files, words to the standard error. `-` is the standard
/// input or output.
#[derive(Debug, Parser)]
#[command(name = "kin", version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// How notes and errors are written on the standard error
    #[arg(long, value_enum, default_value = "text", global = true)]
    pub error_format: Format,
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 the mechanism's fault, 2 usage, 3 the run ended early (what came \
                          before is written), 4 not proved, 5 a file.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Position, velocity and acceleration over time
    Run(Run),
    /// The same, once more each time the file changes
    Watch(Run),
    /// Reads a file, builds the mechanism and assembles it
    Check(Check),
    /// Rank, redundancies, contradictions and freedoms by name
    Diagnose(Diagnose),
    /// All assemblies at one time, as CSV
    Assemblies(Assemblies),
    /// A measure of a joint or a coordinate over time, as CSV, and its extremes
    Measure(Measure),
    /// A proof, by interval bounds, that nothing else moves like this
    Prove(Prove),
    /// How the motion changes with parameters, as CSV: exact derivatives
    Sensitivities(Sensitivities),
    /// How far a measure may be off where dimensions of the file have tolerances
    Tolerance(Tolerance),
    /// Efforts of drives and forces of joints, as CSV: the file has masses
    Forces(Forces),
    /// Many cases, a row each: what they are, and the extremes of what is kept of them
    Sweep(Sweep),
    /// A file of another program made into a mechanism file; what is left out is told by name
    Import(Import),
    /// The JSON Schema of mechanism files
    Schema,
    /// Completions for a shell, to be put where it looks for them
    Completions { shell: Shell },
    /// The manual page, of the whole or of one command
    Manual { command: Option<String> },
}

/// A mechanism and what is changed in it.
#[derive(Clone, Debug, Args)]
pub struct Model {
    /// The mechanism file; `-` is the standard input
    pub file: String,
    /// Sets a dimension, a parameter, or the guess of a coordinate
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<Setting>,
}

/// The times of a motion and the engine that computes it.
#[derive(Clone, Debug, Args)]
pub struct Motion {
    /// `FROM:TO:COUNT`, such as 0:1:361, or a list, such as 0,0.5,1   [s]
    #[arg(long, allow_hyphen_values = true)]
    pub times: Times,
    /// One time after the other, or many times at once by the compiled mechanism; `auto` takes the
    /// faster one
    #[arg(long, value_enum, default_value = "auto")]
    pub engine: Engine,
    /// Takes the other branch at the change points of these numbers, counted from 0
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS", value_parser = change_point)]
    pub other_branch_at: Vec<usize>,
    /// How much work the run may spend on smaller steps of time than those asked for, as a multiple
    /// of the usual
    #[arg(long, value_name = "MULTIPLE", default_value_t = 1.0)]
    pub effort: f64,
    #[command(flatten)]
    pub misfit: AllowedMisfit,
}

/// How far redundant equations may contradict one another.
#[derive(Clone, Copy, Debug, Args)]
pub struct AllowedMisfit {
    /// How far redundant equations may contradict one another, as a share of the mechanism's size,
    /// from 0 to 0.1; parts of ordinary accuracy need more than the 0 of equations that agree
    #[arg(long = "allowed-misfit", value_name = "SHARE", default_value_t = 0.0)]
    pub share: f64,
}

/// The number of a change point.
fn change_point(text: &str) -> Result<usize, String> {
    let number = text.trim().parse();
    number.map_err(|_| format!("`{text}` is no number of a change point: they are counted 0, 1, 2"))
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Engine {
    Auto,
    StepByStep,
    Compiled,
}

#[derive(Clone, Debug, Args)]
pub struct Run {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// Adds a point of a body, and its path to pictures
    #[arg(long = "point", value_name = "NAME=BODY:X,Y[,Z]")]
    pub points: Vec<NamedPoint>,
    /// Adds a measure of a joint, with its rates
    #[arg(long = "measure", value_name = "NAME")]
    pub measures: Vec<String>,
    /// Solves for the jerk too
    #[arg(long)]
    pub jerk: bool,
    /// The motion as CSV
    #[arg(long, value_name = "FILE")]
    pub csv: Option<String>,
    /// The motion as JSON, without loss
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// The mechanism, moving, as SVG
    #[arg(long, value_name = "FILE")]
    pub svg: Option<String>,
    /// A page on which it moves, with charts of points and measures, as HTML
    #[arg(long, value_name = "FILE")]
    pub page: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Import {
    /// An `.asmt` file of OndselSolver (FreeCAD); `-` is the standard input
    pub file: String,
    /// The mechanism file
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub output: String,
}

#[derive(Clone, Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub model: Model,
    /// The time at which it is assembled   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// Names and values of all dimensions, parameters and coordinates, names of measures, as CSV on
    /// the standard output
    #[arg(long)]
    pub names: bool,
    #[command(flatten)]
    pub misfit: AllowedMisfit,
}

#[derive(Clone, Debug, Args)]
pub struct Diagnose {
    #[command(flatten)]
    pub model: Model,
    /// The time   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// The diagnosis as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Assemblies {
    #[command(flatten)]
    pub model: Model,
    /// The time   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// Where the table goes
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON, with whether the list is complete and why
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Measure {
    #[command(flatten)]
    pub model: Model,
    /// Measures and coordinates, such as `slot.slide` or `crank.theta`; `check --names` lists them
    #[arg(required = true, value_name = "NAME")]
    pub names: Vec<String>,
    #[command(flatten)]
    pub motion: Motion,
    /// Adds the mechanical advantage of each measure over this drive: its force for one of the
    /// drive's
    #[arg(long = "over", value_name = "DRIVE")]
    pub over: Vec<String>,
    /// Where the table goes
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
}

#[derive(Clone, Debug, Args)]
pub struct Prove {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// The steps as CSV: from, to, proved, how near the solution is, the doubt
    #[arg(long, value_name = "FILE")]
    pub csv: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Sensitivities {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// The ones that change: measures or coordinates; without any all coordinates
    #[arg(long = "of", value_name = "NAME")]
    pub measures: Vec<String>,
    /// The parameters by which; `check --names` lists them
    #[arg(long = "by", value_name = "NAME", required = true)]
    pub parameters: Vec<String>,
    /// Where the table goes
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
}

#[derive(Clone, Debug, Args)]
pub struct Tolerance {
    #[command(flatten)]
    pub model: Model,
    /// The measure or coordinate, such as `slot.slide` or `slider.R_x`; `check --names` lists them
    #[arg(value_name = "NAME")]
    pub name: String,
    #[command(flatten)]
    pub motion: Motion,
    /// Of this extreme of the measure, or of its stroke, instead of the time at which it is worst
    #[arg(long, value_enum)]
    pub of: Option<Asked>,
    /// Proves bounds by interval arithmetic too, which hold for every mechanism within the
    /// tolerances
    #[arg(long, requires = "of")]
    pub proved: bool,
    /// Makes so many mechanisms at random too, and tells mean, σ, quantiles and how many cannot be
    /// assembled
    #[arg(long, value_name = "COUNT")]
    pub samples: Option<usize>,
    /// The same seed gives the same samples
    #[arg(long, default_value_t = 1, requires = "samples")]
    pub seed: u64,
    /// The distribution of dimensions for which the file names none
    #[arg(long, value_enum, default_value = "normal", requires = "samples")]
    pub distribution: Distribution,
    /// The values of the samples as CSV, the smallest first
    #[arg(long, value_name = "FILE", requires = "samples")]
    pub samples_csv: Option<String>,
    /// Where the table goes: dimension, tolerance, derivative, how far that is off, both shares
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
}

/// A number that a measure has over all times.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Asked {
    /// Its largest value
    Max,
    /// Its smallest value
    Min,
    /// The largest less the smallest
    Stroke,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Distribution {
    /// Normal, three σ being the tolerance
    Normal,
    /// The same without those that are off by more
    TruncatedNormal,
    /// Uniform within the tolerance
    Uniform,
}

#[derive(Clone, Debug, Args)]
pub struct Forces {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// Where redundant constraints share a force, the shares whose squares have the least sum;
    /// without it no number is given for them
    #[arg(long)]
    pub least_norm: bool,
    /// Where the table goes
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON, with units
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// Charts of efforts and of the forces in joints, as SVG
    #[arg(long, value_name = "FILE")]
    pub chart: Option<String>,
    /// The mechanism with its forces as arrows, where the first drive gives most, as SVG
    #[arg(long, value_name = "FILE")]
    pub svg: Option<String>,
    /// A page on which it moves with its forces, beside their charts, as HTML
    #[arg(long, value_name = "FILE")]
    pub page: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    pub model: Model,
    /// The cases as CSV: the header names parameters, each row is a case; `-` is the standard input
    pub cases: String,
    #[command(flatten)]
    pub motion: Motion,
    /// A measure, coordinate or column of forces, whose least and greatest value are kept, with
    /// their times
    #[arg(long = "keep", value_name = "NAME")]
    pub keep: Vec<String>,
    /// Only the I-th of N parts of the cases; all parts make the rows of the whole, bit for bit
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Where the rows go
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub out: String,
}
