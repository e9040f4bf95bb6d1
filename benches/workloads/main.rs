//! The workloads: `cargo bench --bench workloads -- W1 W4-N100 [more names]` prints one JSON line a
//! figure; no name: all of them. Standard output holds nothing else; a summary for people goes to
//! standard error.
//!
//! `once W6-planar_revolute kin 10` runs one route alone ten times, for counting instructions.

mod design;
mod hand;
mod measure;
mod sweep;
mod w1;
mod w2;
mod w3;
mod w4;
mod w5;
mod w6;
mod w7;
mod w8;
mod w9;

use std::process::{Command, ExitCode};
use std::time::Duration;

use measure::Figure;
use sweep::Workload;

const NAMES: [&str; 9] = ["W1", "W2", "W3", "W4", "W5", "W6", "W7", "W8", "W9"];

/// CPU time for the rounds of one workload.
const BUDGET: Duration = Duration::from_millis(2500);

fn main() -> ExitCode {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if let Some(code) = with_kept_memory(&arguments) {
        return code;
    }
    let done = match words[..] {
        ["once", name, route, repeats] => once(name, route, repeats),
        [] => NAMES.iter().try_for_each(|name| run(name)),
        // All names are looked at before the first one takes its time.
        _ => words
            .iter()
            .try_for_each(|name| known(name))
            .and_then(|()| words.iter().try_for_each(|name| run(name))),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

/// Runs this program again with an allocator that keeps what is freed: else each sweep would give
/// its results' pages back to the system and fault them in again, which costs a third of a step of
/// W4 and says nothing about anyone's code. `None` where that is done.
fn with_kept_memory(arguments: &[String]) -> Option<ExitCode> {
    const SETTINGS: [&str; 2] = ["MALLOC_MMAP_THRESHOLD_", "MALLOC_TRIM_THRESHOLD_"];
    if arguments.first().is_some_and(|word| word == "once")
        || std::env::var_os(SETTINGS[0]).is_some()
    {
        return None;
    }
    let program = std::env::current_exe().ok()?;
    let status = Command::new(program)
        .args(arguments)
        .envs(SETTINGS.map(|name| (name, "1000000000")))
        .status()
        .ok()?;
    Some(ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)))
}

fn known(name: &str) -> Result<(), String> {
    let parts: Vec<String> = [w1::TEXT.to_string()]
        .into_iter()
        .chain(w4::names())
        .chain(w6::names())
        .chain(w8::names())
        .chain(w9::names())
        .collect();
    if NAMES.contains(&name) || parts.iter().any(|part| part == name) {
        return Ok(());
    }
    Err(format!(
        "there is no workload `{name}`; there are {} and {}",
        NAMES.join(", "),
        parts.join(", ")
    ))
}

fn run(name: &str) -> Result<(), String> {
    for workload in sweeps(name) {
        workload.run(BUDGET).iter().for_each(Figure::print);
    }
    if name.starts_with("W6") {
        w6::run(name, BUDGET).iter().for_each(Figure::print);
    }
    if name.starts_with("W8") {
        w8::run(name, BUDGET).iter().for_each(Figure::print);
    }
    if name.starts_with("W9") {
        w9::run(name, BUDGET).iter().for_each(Figure::print);
    }
    if name == "W7" {
        w7::run().iter().for_each(Figure::print);
    }
    Ok(())
}

/// The workloads that are sweeps of one system.
fn sweeps(name: &str) -> Vec<Workload> {
    match name {
        "W1" => vec![w1::workload()],
        w1::TEXT => vec![w1::with_text()],
        "W2" => vec![w2::workload()],
        "W3" => vec![w3::workload()],
        "W5" => vec![w5::workload()],
        _ => w4::workloads(name),
    }
}

fn once(name: &str, route: &str, repeats: &str) -> Result<(), String> {
    known(name)?;
    let repeats = repeats.parse().map_err(|_| format!("`{repeats}` is no number of repeats"))?;
    let done = match (name, sweeps(name).first()) {
        (_, Some(workload)) => workload.once(route, repeats),
        ("W7", None) => w7::once(route, repeats),
        _ if name.starts_with("W9") => w9::once(name, route, repeats),
        _ if name.starts_with("W8") => w8::once(name, route, repeats),
        _ => w6::once(name, route, repeats),
    };
    done.ok_or(format!("`{name}` has no route `{route}`, or has parts of which one must be named"))
}
