//! The command line: subcommands, arguments and their help texts, as `clap` reads them.

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::points::{Given, NamedPoint, Pull, Range, Setting, Shard};
use crate::say::Format;
use crate::times::{self, Times};

/// Runs, checks, diagnoses, proves, sweeps and draws mechanism files.
///
/// Data go to standard output or to files, messages to standard error. `-` means standard input or
/// output.
#[derive(Debug, Parser)]
#[command(name = "kin", version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// The format of notes and errors on standard error
    #[arg(long, value_enum, default_value = "text", global = true)]
    pub error_format: Format,
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 success; 1 fault in the mechanism; 2 wrong usage; 3 the run ended early, with results up to there; 4 not proved; 5 file error.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Position, velocity and acceleration over time
    Run(Run),
    /// Runs again each time the file changes
    Watch(Run),
    /// Reads a file, builds the mechanism and assembles it
    Check(Check),
    /// Reports rank, redundancies, contradictions and freedoms by name
    Diagnose(Diagnose),
    /// All assemblies at one time, as CSV
    Assemblies(Assemblies),
    /// The position at given values of the drivers, on the branch of the assembled position
    Pose(Pose),
    /// The position with the drivers released, moved by wishes: points, values of measures
    Drag(Drag),
    /// Wanted values at given ones, both ways round, with their slopes
    Map(Map),
    /// All positions that are reached while one driver moves, past dead centres, by arc length
    Circuit(Circuit),
    /// A measure of a joint or a coordinate over time, as CSV, and its extremes
    Measure(Measure),
    /// Proves by interval bounds that the computed motion is the only one
    Prove(Prove),
    /// Exact derivatives of the motion by parameters, as CSV
    Sensitivities(Sensitivities),
    /// The deviation of a measure that the tolerances in the file allow
    Tolerance(Tolerance),
    /// Efforts of drives and forces of joints, as CSV, for a file with masses
    Forces(Forces),
    /// Prints the mechanism as a file of C: positions by the values of the drivers
    Emit(Emit),
    /// Runs many cases and writes a row with extremes for each
    Sweep(Sweep),
    /// Converts a file of another program into a mechanism file, and names what it leaves out
    Import(Import),
    /// The JSON Schema of mechanism files
    Schema,
    /// Writes completions for a shell
    Completions { shell: Shell },
    /// Writes the manual page of `kin` or of one command
    Manual { command: Option<String> },
}

/// A mechanism and changes of its values.
#[derive(Clone, Debug, Args)]
pub struct Model {
    /// The mechanism file; `-` means standard input
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
    /// The direction in which a run leaves the dead centre at which it begins: a coordinate or a
    /// planar body, with +1 or -1
    #[arg(long, value_name = "NAME=SIGN")]
    pub start: Option<Setting>,
    /// How much work the run may spend on smaller steps of time than those asked for, as a multiple
    /// of the usual
    #[arg(long, value_name = "MULTIPLE", default_value_t = 1.0, value_parser = times::plain)]
    pub effort: f64,
    #[command(flatten)]
    pub misfit: AllowedMisfit,
}

/// How far redundant equations may contradict one another.
#[derive(Clone, Copy, Debug, Args)]
pub struct AllowedMisfit {
    /// How far redundant equations may contradict one another, as a share of the mechanism's size,
    /// from 0 to 0.1; parts of ordinary accuracy need more than the 0 of equations that agree
    #[arg(long = "allowed-misfit", value_name = "SHARE", default_value_t = 0.0, value_parser = times::plain)]
    pub share: f64,
}

/// The number of a change point.
fn change_point(text: &str) -> Result<usize, String> {
    let number = text.trim().parse();
    number.map_err(|_| {
        format!("`{text}` is no number of a change point. Count change points 0, 1, 2")
    })
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
    /// Adds a point of a body to the results, and its path to pictures
    #[arg(long = "point", value_name = "NAME=BODY:X,Y[,Z]")]
    pub points: Vec<NamedPoint>,
    /// Adds a measure of a joint, with its velocity and acceleration
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
    /// An `.asmt` file of OndselSolver (FreeCAD); `-` means standard input
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
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true, value_parser = times::time)]
    pub at: f64,
    /// Lists names and values of all dimensions, parameters and coordinates, and names of measures,
    /// as CSV on standard output
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
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true, value_parser = times::time)]
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
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true, value_parser = times::time)]
    pub at: f64,
    /// The file for the table; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON, with the reason why the list is complete or not
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Pose {
    #[command(flatten)]
    pub model: Model,
    /// Moves a driver to this value, along the branch; all of them together on a straight line
    #[arg(long = "to", required_unless_present = "given", value_name = "DRIVER=VALUE")]
    pub to: Vec<Setting>,
    /// Gives a measure or a coordinate in place of the drivers, as many as there are freedoms, and
    /// moves it to this value; drivers that are not given are left out
    #[arg(long = "given", conflicts_with = "to", value_name = "NAME=VALUE")]
    pub given: Vec<Setting>,
    /// Proves by interval bounds that the move stays on its branch, over so many equal steps
    #[arg(long, value_name = "STEPS")]
    pub prove: Option<usize>,
    /// The time at which the mechanism is assembled before it moves   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// The file for the table of drivers, coordinates and measures; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// The position as SVG
    #[arg(long, value_name = "FILE")]
    pub svg: Option<String>,
    #[command(flatten)]
    pub misfit: AllowedMisfit,
}

#[derive(Clone, Debug, Args)]
pub struct Drag {
    #[command(flatten)]
    pub model: Model,
    /// Moves a point of a body to a target, or as near to it as the mechanism can follow
    #[arg(long = "point", value_name = "BODY:X,Y=X,Y")]
    pub points: Vec<Pull>,
    /// Moves a measure or a coordinate to a value; points come first
    #[arg(long = "wish", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub wishes: Vec<Setting>,
    /// Keeps the present value of a measure or a coordinate; points and wishes come first
    #[arg(long = "hold", value_name = "NAME")]
    pub holds: Vec<String>,
    /// The time at which the mechanism is assembled before its drivers are released   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// The file for the table of wishes, coordinates and measures; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON, with the freedoms that are left
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// The position as SVG
    #[arg(long, value_name = "FILE")]
    pub svg: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Map {
    #[command(flatten)]
    pub model: Model,
    /// A driver, measure or coordinate that is given, with the value to which it moves or without
    /// one; as many as there are freedoms
    #[arg(long = "given", required = true, value_name = "NAME[=VALUE]")]
    pub given: Vec<Given>,
    /// A driver, measure or coordinate that is wanted
    #[arg(long = "wanted", required = true, value_name = "NAME")]
    pub wanted: Vec<String>,
    /// The time at which the mechanism is assembled before it moves   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
    /// The file for the table of wanted values and slopes; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// The range of a given value, for the border
    #[arg(long = "range", requires = "border", value_name = "NAME=FROM:TO")]
    pub ranges: Vec<Range>,
    /// The file for a table of all values along the border of the ranges
    #[arg(long, requires = "ranges", value_name = "FILE")]
    pub border: Option<String>,
    /// How many configurations each side of the border has
    #[arg(long, default_value_t = 33)]
    pub points: usize,
}

#[derive(Clone, Debug, Args)]
pub struct Emit {
    #[command(flatten)]
    pub model: Model,
    /// Prints C99, which needs <math.h> and nothing else
    #[arg(long = "c", required = true)]
    pub c: bool,
    /// The file to write; `-` means standard output
    #[arg(short = 'o', long = "output", value_name = "FILE", default_value = "-")]
    pub output: String,
    /// The prefix of all names in the file instead of the name of the mechanism
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Dimensions that the file leaves free, such as `crank,rod`
    #[arg(long, value_delimiter = ',', value_name = "DIMENSIONS")]
    pub free: Vec<String>,
    /// Coordinates that the file returns as measures, such as `rocker.theta`
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    pub measures: Vec<String>,
    /// The time at which the mechanism is assembled: there the file starts   [s]
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub at: f64,
}

#[derive(Clone, Debug, Args)]
pub struct Circuit {
    #[command(flatten)]
    pub model: Model,
    /// The driver that moves; the others are at rest
    #[arg(long, value_name = "DRIVER")]
    pub input: String,
    /// How many positions are written, equally spaced by arc length
    #[arg(long, default_value_t = 361)]
    pub points: usize,
    /// The file for the table of arc length, input and coordinates; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// A page on which the mechanism goes round its circuit, as HTML
    #[arg(long, value_name = "FILE")]
    pub page: Option<String>,
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
    /// Adds the mechanical advantage of each measure over this drive
    #[arg(long = "over", value_name = "DRIVE")]
    pub over: Vec<String>,
    /// The file for the table; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
}

#[derive(Clone, Debug, Args)]
pub struct Prove {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// The steps as CSV: from, to, proved, radius of the tube, reason without proof
    #[arg(long, value_name = "FILE")]
    pub csv: Option<String>,
}

#[derive(Clone, Debug, Args)]
pub struct Sensitivities {
    #[command(flatten)]
    pub model: Model,
    #[command(flatten)]
    pub motion: Motion,
    /// The measures or coordinates to differentiate; without any, all coordinates
    #[arg(long = "of", value_name = "NAME")]
    pub measures: Vec<String>,
    /// The parameters of the derivatives; `check --names` lists them
    #[arg(long = "by", value_name = "NAME", required = true)]
    pub parameters: Vec<String>,
    /// The file for the table; `-` means standard output
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
    /// Uses this extreme or the stroke of the measure, instead of its worst time
    #[arg(long, value_enum)]
    pub of: Option<Asked>,
    /// Also proves bounds for every mechanism within the tolerances, by interval arithmetic
    #[arg(long, requires = "of")]
    pub proved: bool,
    /// Also samples this many random mechanisms: mean, σ, quantiles, and the number that cannot be
    /// assembled
    #[arg(long, value_name = "COUNT", value_parser = times::count)]
    pub samples: Option<usize>,
    /// The same seed gives the same samples
    #[arg(long, default_value_t = 1, requires = "samples", value_parser = times::seed)]
    pub seed: u64,
    /// The distribution of dimensions without one in the file
    #[arg(long, value_enum, default_value = "normal", requires = "samples")]
    pub distribution: Distribution,
    /// The values of the samples as CSV, the smallest first
    #[arg(long, value_name = "FILE", requires = "samples")]
    pub samples_csv: Option<String>,
    /// The file for the table: dimension, tolerance, derivative, deviation, both shares
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
    /// Normal, with three σ equal to the tolerance
    Normal,
    /// Normal, without values beyond the tolerance
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
    /// Shares forces of redundant constraints with the least sum of squares; without this option
    /// they have no number
    #[arg(long)]
    pub least_norm: bool,
    /// The file for the table; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub csv: String,
    /// The same as JSON, with units
    #[arg(long, value_name = "FILE")]
    pub json: Option<String>,
    /// Charts of efforts and of the forces in joints, as SVG
    #[arg(long, value_name = "FILE")]
    pub chart: Option<String>,
    /// The mechanism with its forces as arrows at the largest effort of the first drive, as SVG
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
    /// The cases as CSV: the header names parameters, each row is a case; `-` means standard
    /// input
    pub cases: String,
    #[command(flatten)]
    pub motion: Motion,
    /// A measure, coordinate or column of forces; keeps its minimum and maximum with their times
    #[arg(long = "keep", value_name = "NAME")]
    pub keep: Vec<String>,
    /// Only the I-th of N parts of the cases; all parts together give the same rows, bit for bit
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// The file for the rows; `-` means standard output
    #[arg(long, value_name = "FILE", default_value = "-")]
    pub out: String,
}
