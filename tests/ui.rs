//! Mistakes, as rustc shows them: every program of `tests/ui` has one slip, named by its file, and
//! must be refused with exactly the errors listed in `NAME.message`: where, at which token, and
//! what is said (of rustc's own errors the number only, since their text moves). Programs of
//! `tests/ui/warned` compile, with exactly the warnings listed: those that any function of theirs
//! would have.
//!
//! `NAME.stderr` is the whole picture on the pinned toolchain. `KIN_BLESS=1 cargo test --test ui`
//! writes both anew, for review.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

#[path = "scratch/mod.rs"]
mod scratch;

use scratch::Scratch;

/// The toolchain whose rendering the `.stderr` files hold.
const PINNED: &str = "rustc 1.95.0";

/// Programs with a message of Kin's own whose rendering is kept too, to prove the caret.
const SHOWN: [&str; 5] = [
    "law_used_as_a_number",
    "integer_beside_a_number",
    "row_without_a_coordinate",
    "symbolic_asked_of_a_while",
    "two_mistakes_at_once",
];

#[test]
fn every_slip_is_one_error_at_its_token() {
    let programs = programs("tests/ui");
    let mut errors = check("ui", &programs, "error");
    assert!(!errors.is_empty(), "cargo check says nothing of the programs");
    let pinned = version().starts_with(PINNED);
    if !pinned {
        println!("note: {} is not {PINNED}: the .stderr files are not compared", version());
    }
    let mut differences = Vec::new();
    for (name, path) in &programs {
        let errors = errors.remove(name).unwrap_or_default();
        if errors.is_empty() {
            differences.push(format!("{name}.rs compiles, but it must be refused"));
        }
        let messages: String = errors.iter().map(|error| format!("{}\n", error.message)).collect();
        differences.extend(compared(&path.with_extension("message"), &messages));
        if pinned && (errors.iter().any(|error| error.is_rustcs) || SHOWN.contains(&name.as_str()))
        {
            let rendered: Vec<&str> = errors.iter().map(|error| error.rendered.as_str()).collect();
            differences.extend(compared(&path.with_extension("stderr"), &rendered.join("\n")));
        }
    }
    assert!(differences.is_empty(), "{}", differences.join("\n\n"));
}

#[test]
fn bodies_are_warned_of_like_any_function() {
    let programs = programs("tests/ui/warned");
    let errors = check("warned", &programs, "error");
    assert!(errors.is_empty(), "{:?}", errors.keys());
    let mut warnings = check("warned", &programs, "warning");
    let differences = programs.iter().filter_map(|(name, path)| {
        let warnings = warnings.remove(name).unwrap_or_default();
        let messages: String =
            warnings.iter().map(|warning| format!("{}\n", warning.message)).collect();
        compared(&path.with_extension("message"), &messages)
    });
    let differences: Vec<String> = differences.collect();
    assert!(differences.is_empty(), "{}", differences.join("\n\n"));
}

/// One error of rustc, or one warning.
struct Error {
    /// `line:column `token`: message`
    message: String,
    rendered: String,
    /// Not Kin's own message: it has a number.
    is_rustcs: bool,
}

/// The programs of a folder by name.
fn programs(folder: &str) -> BTreeMap<String, PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = fs::read_dir(&folder)
        .expect("the folder can be read")
        .map(|entry| entry.expect("the folder can be read").path());
    let programs = files.filter(|path| path.extension().is_some_and(|end| end == "rs"));
    programs
        .map(|path| (path.file_stem().expect("a name").to_string_lossy().into_owned(), path))
        .collect()
}

/// The errors, or warnings, of each program.
fn check(
    package: &str,
    programs: &BTreeMap<String, PathBuf>,
    level: &str,
) -> BTreeMap<String, Vec<Error>> {
    let said = Scratch::new(package, programs).check(level);
    let of_one = said.into_iter().map(|(name, messages)| {
        let rendered = messages[0]["rendered"].as_str().unwrap_or_default();
        assert!(programs.contains_key(&name), "{rendered}");
        let mut errors: Vec<Error> = Vec::new();
        for error in messages.iter().map(error) {
            // Cargo too prints equal errors once.
            if errors.iter().all(|earlier| earlier.rendered != error.rendered) {
                errors.push(error);
            }
        }
        (name, errors)
    });
    of_one.collect()
}

fn error(message: &Value) -> Error {
    let spans = message["spans"].as_array().into_iter().flatten();
    let places: Vec<String> = spans.filter(|span| span["is_primary"] == true).map(place).collect();
    let code = message["code"]["code"].as_str();
    let text = message["message"].as_str().unwrap_or_default();
    // Of what is deprecated the text is Kin's.
    let said = code
        .filter(|code| *code != "deprecated")
        .map_or(text.to_owned(), |code| format!("[{code}]"));
    let root = format!("{}/", env!("CARGO_MANIFEST_DIR"));
    let rendered = message["rendered"].as_str().unwrap_or_default().replace(&root, "");
    // Notes inside of a panic at compile time are the standard library's, with its text where the
    // sources are installed and without it where they are not.
    let rendered =
        rendered.split("\nnote: inside `kin").next().unwrap_or_default().trim_end().to_owned();
    Error {
        message: format!("{}: {said}", places.join(", ")),
        rendered: without_foreign_notes(&rendered) + "\n",
        is_rustcs: code.is_some(),
    }
}

/// A picture without notes at places outside of the workspace. They show the text of the standard
/// library where its sources are installed, in a gutter as wide as its line numbers, so that goes
/// too.
fn without_foreign_notes(rendered: &str) -> String {
    let lines: Vec<&str> = rendered.lines().collect();
    let begins = |k: usize| {
        let at = lines.get(k + 1).map_or("", |line| line.trim_start());
        lines[k].starts_with("note: ") && at.starts_with("--> /")
    };
    let goes_on = |line: &str| line.starts_with(|c: char| c == ' ' || c.is_ascii_digit());
    let (mut kept, mut inside) = (Vec::new(), false);
    for (k, line) in lines.iter().enumerate() {
        inside = begins(k) || inside && goes_on(line);
        if !inside {
            kept.push(*line);
        }
    }
    if kept.len() == lines.len() {
        return rendered.to_owned();
    }
    kept.iter().map(|line| line.trim_start()).collect::<Vec<_>>().join("\n")
}

#[test]
fn notes_of_the_standard_library_are_left_out_with_and_without_its_sources() {
    let head = "error: e\n    --> tests/ui/a.rs:5:1\n     |\n   5 | x\n     | ^\nnote: n\n";
    let with = format!("{head}    --> /std.rs:1224:18\n     |\n1224 | fn f\n     |    ^\nhelp: h");
    let without = "error: e\n --> tests/ui/a.rs:5:1\n  |\n5 | x\n  | ^\nnote: n\n --> /std.rs:1224:17\nhelp: h";
    assert_eq!(without_foreign_notes(&with), without_foreign_notes(without));
    assert!(without_foreign_notes(&with).ends_with("| ^\nhelp: h"));
    let own = "error: e\nnote: n\n --> tests/ui/a.rs:1:1";
    assert_eq!(without_foreign_notes(own), own);
}

/// `line:column `token``
fn place(span: &Value) -> String {
    let at = |key: &str| span[key].as_u64().unwrap_or_default() as usize;
    let lines = span["text"].as_array().into_iter().flatten();
    let parts = lines.map(|line| {
        let (start, end) = (
            line["highlight_start"].as_u64().unwrap_or(1),
            line["highlight_end"].as_u64().unwrap_or(1),
        );
        let text = line["text"].as_str().unwrap_or_default().chars();
        text.skip(start as usize - 1)
            .take((end - start) as usize)
            .collect::<String>()
            .trim()
            .to_owned()
    });
    format!("{}:{} `{}`", at("line_start"), at("column_start"), parts.collect::<Vec<_>>().join(" "))
}

/// The difference from the stored text; with `KIN_BLESS=1` none, and the text is stored.
fn compared(path: &Path, found: &str) -> Option<String> {
    if std::env::var_os("KIN_BLESS").is_some() {
        fs::write(path, found).expect("a reference can be written");
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    (expected != found).then(|| format!("{name}\nexpected:\n{expected}\nfound:\n{found}"))
}

fn version() -> String {
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let output = Command::new(rustc).arg("--version").output().expect("rustc runs");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}
