//! The corpus of constraints with one or two small changes in each, through rustc. A change that is
//! refused is told at a token of the user's, in words of the user's; one that compiles has the
//! numbers and the derivatives that rustc's reading has.
//!
//! `cargo test --test mutated -- --ignored`; `KIN_MUTANTS=1000` tries as many of them.

mod bodies;
#[path = "../scratch/mod.rs"]
mod scratch;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use bodies::{Body, SplitMix, bodies, mutated};
use scratch::Scratch;
use serde_json::Value;

/// Words that nobody writes: names of emitted code, and of the machinery.
const HIDDEN: [&str; 8] = [
    "__",
    "emitted",
    "Foreign",
    "panicked",
    "proc-macro",
    "proc macro",
    "compiler error",
    "Returned",
];

/// How rustc calls a type that a body declares: it is declared in each of several copies of the
/// body.
const COPY: &str = "__WRITTEN::{closure#0}::";

/// A function in an endless loop, or one that calls itself without an end, is stopped.
const LONGEST: Duration = Duration::from_secs(20);

#[test]
#[ignore = "takes minutes: `.ci/nightly campaigns` runs it"]
fn mutants_are_refused_in_the_users_words_or_are_read_as_rustc_reads_them() {
    let wanted = std::env::var("KIN_MUTANTS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let mutants = mutants(wanted);
    let programs: BTreeMap<String, PathBuf> = mutants
        .iter()
        .map(|(name, mutant)| (name.clone(), written(name, &program(mutant))))
        .collect();
    let errors = Scratch::new("mutated", &programs).check("error");
    let faults: Vec<String> = errors
        .iter()
        .flat_map(|(name, errors)| errors.iter().filter_map(|error| fault(name, error)))
        .collect();
    assert!(faults.is_empty(), "{} of them:\n{}", faults.len(), faults.join("\n"));

    let compiling: BTreeMap<&String, &Body> =
        mutants.iter().filter(|(name, _)| !errors.contains_key(*name)).collect();
    assert!(
        compiling.len() > wanted / 5 && errors.len() > wanted / 5,
        "{} compile",
        compiling.len()
    );
    let (wrong, endless) = run(&compiling);
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), compiling.len(), wrong.join("\n"));
    assert!(10 * endless < compiling.len(), "{endless} of {} do not end", compiling.len());
    println!(
        "{} are refused, {} are right, {endless} do not end",
        errors.len(),
        compiling.len() - endless
    );
}

/// So many different mutants, by name.
fn mutants(wanted: usize) -> BTreeMap<String, Body> {
    let all = bodies();
    let mut random = SplitMix(0x005E_ED0F_0CA7_C0DE);
    assert!(all.len() > 200, "only {} bodies", all.len());
    let mut found: BTreeMap<String, Body> = BTreeMap::new();
    while found.len() < wanted {
        let body = &all[random.below(all.len())];
        let mut function = mutated(&body.function, &mut random);
        if random.below(3) == 0 {
            function = mutated(&function, &mut random);
        }
        let known = |other: &Body| other.function.to_string() == function.to_string();
        if function.to_string() != body.function.to_string() && !found.values().any(known) {
            let name = format!("m{:03}_{}", found.len(), body.name);
            let given = body.given.clone();
            let around = body.around.clone();
            found.insert(name.clone(), Body { name, given, function, around });
        }
    }
    found
}

/// Lines of a program on which the function stands.
const FUNCTION_LINE: u64 = 5;

fn program(mutant: &Body) -> String {
    let Body { around, function, .. } = mutant;
    format!(
        "#![allow(warnings)]\nuse kin::prelude::*;\n{}\n#[constraint]\n{function}\nfn main() {{}}\n",
        without_prelude(&around.to_string())
    )
}

/// The items around a function, without an import that stands there already.
fn without_prelude(around: &str) -> String {
    around.replace("use kin :: prelude :: * ;", "")
}

fn written(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutants");
    fs::create_dir_all(&folder).expect("a folder can be made");
    let path = folder.join(name).with_extension("rs");
    // A program that is the same as before need not be looked at again.
    if fs::read_to_string(&path).ok().as_deref() != Some(text) {
        fs::write(&path, text).expect("a mutant can be written");
    }
    path
}

/// The fault of an error: its place or its words.
fn fault(name: &str, error: &Value) -> Option<String> {
    let message = error["message"].as_str().unwrap_or_default();
    let spans = error["spans"].as_array()?;
    let misplaced = |span: &&Value| {
        span["is_primary"] == true && span["line_start"].as_u64() != Some(FUNCTION_LINE)
    };
    let place = spans.iter().find(misplaced);
    let labels = spans.iter().filter_map(|span| span["label"].as_str());
    let mut texts = std::iter::once(message).chain(labels).map(|text| text.replace(COPY, ""));
    let hidden = texts.find(|text| HIDDEN.iter().any(|hidden| text.contains(hidden)));
    let what = match (place, hidden) {
        (_, Some(text)) => format!("speaks of what the user did not write: {text}"),
        (Some(_), _) => "is not at a token of the body".to_owned(),
        (None, None) => return None,
    };
    Some(format!("{name}: {what}\n{}", error["rendered"].as_str().unwrap_or_default()))
}

/// Those that compile, compared with rustc's reading of them: what is wrong, and how many do not
/// end.
fn run(compiling: &BTreeMap<&String, &Body>) -> (Vec<String>, usize) {
    let root = env!("CARGO_MANIFEST_DIR");
    let mut text = String::from("#![allow(warnings)]\n");
    for module in ["twice", "differences"] {
        text += &format!("#[path = \"{root}/tests/language/{module}.rs\"]\nmod {module};\n");
    }
    for (name, Body { given, function, around, .. }) in compiling {
        let around = without_prelude(&around.to_string());
        text += &format!(
            "mod in_{name} {{ use kin::prelude::*; use crate::twice; {around} twice! {{ Any {name}({given}): {function} }} }}\n"
        );
    }
    let path = written("all", &text);
    let scratch = Scratch::with_targets("mutants_run", &format!("[lib]\npath = {path:?}\n"));
    let built = scratch.cargo(&["test", "--offline", "--lib", "--no-run", "--message-format=json"]);
    assert!(built.status.success(), "{}", rendered(&built.stdout));
    let stdout = String::from_utf8_lossy(&built.stdout).into_owned();
    let executable = stdout
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .find_map(|report| report["executable"].as_str().map(str::to_owned))
        .expect("the tests are built");
    let mut wrong = Vec::new();
    let mut endless = 0;
    for name in compiling.keys() {
        match run_one(&executable, name) {
            Some(said) if said.contains("test result: ok. 1 passed") => {}
            Some(said) if said.contains("test result: FAILED") => {
                wrong.push(format!("{name}: {said}"))
            }
            _ => endless += 1,
        }
    }
    (wrong, endless)
}

/// The report of the test of one mutant; `None` if it does not end, or ends by a signal as where a
/// stack is full.
fn run_one(executable: &str, name: &str) -> Option<String> {
    let test = format!("in_{name}::{name}::is_read_as_rustc_reads_it");
    let mut child = Command::new(executable)
        .args(["--exact", &test])
        .env("RUST_BACKTRACE", "0")
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the tests run");
    let start = Instant::now();
    while child.try_wait().expect("a process").is_none() {
        if start.elapsed() > LONGEST {
            child.kill().expect("it is stopped");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    let output = child.wait_with_output().expect("what it says");
    output.status.code().map(|_| String::from_utf8_lossy(&output.stdout).into_owned())
}

fn rendered(stdout: &[u8]) -> String {
    let stdout = String::from_utf8_lossy(stdout);
    let reports = stdout.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let errors = reports.filter(|report| report["message"]["level"] == "error");
    errors.filter_map(|report| report["message"]["rendered"].as_str().map(str::to_owned)).collect()
}
