//! The command as users run it: the binary, its streams, its exit codes.

#[path = "../../../tests/data/campaign.rs"]
mod campaign;
mod classes;
mod examples;
mod faults;
mod files;
mod hostile;
mod import;
#[path = "../../../tests/data/own.rs"]
mod own;
mod pages;
mod programs;
mod questions;
mod shell;
mod streams;
mod sweep;
mod warnings;
mod watch;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The binary with these arguments.
fn kin(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kin"));
    command.args(arguments).env_remove("NO_COLOR");
    command
}

/// The end of the binary with these arguments and this standard input.
fn fed(arguments: &[&str], input: &str) -> Output {
    let mut child = kin(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("kin starts");
    // A command that does not read its input closes it.
    let _ = child.stdin.take().expect("an input").write_all(input.as_bytes());
    child.wait_with_output().expect("kin ends")
}

/// The end of the binary with these arguments.
fn done(arguments: &[&str]) -> Output {
    kin(arguments).output().expect("kin runs")
}

/// The standard output of a call that ends well.
fn data(arguments: &[&str]) -> String {
    let output = done(arguments);
    assert_eq!(code(&output), 0, "{arguments:?}: {}", words(&output));
    String::from_utf8(output.stdout).expect("text")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("an exit code")
}

fn words(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("text")
}

/// The mechanism of an example.
fn example(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/examples");
    root.join(format!("{name}.json")).to_string_lossy().into_owned()
}

/// A place for files of a test.
fn place(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("command");
    std::fs::create_dir_all(&folder).expect("a folder");
    folder.join(name)
}

/// A file of a test with this content, by its path.
fn file(name: &str, content: &str) -> String {
    let path = place(name);
    std::fs::write(&path, content).expect("written");
    path.to_string_lossy().into_owned()
}

/// The four-bar of the examples as data, to be changed.
fn four_bar() -> serde_json::Value {
    let text = std::fs::read_to_string(example("04_four_bar")).expect("readable");
    serde_json::from_str(&text).expect("JSON")
}

/// The slider in a slot, whose equation stands in the file.
const SLOT: &str = r#"{"format":1,"name":"slider in a slot",
"equations":["fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {\n    let s = j.local(i.point(u_i));\n    s.y - k * s.x * s.x\n}"],
"bodies":[{"name":"slider","kind":"planar","guess":[0.2,0.1,0.0]}],
"constraints":[
{"name":"slot","kind":"parabolic_slot","arguments":[{"planar":"slider"},{"planar":null}],"parameters":{"k":2.0,"u_i":[0.0,0.0]}},
{"name":"upright","kind":"drive_angle","arguments":[{"planar":"slider"}],"parameters":{"law":{"kind":"constant","numbers":{"c":0.0}}}},
{"name":"motor","kind":"drive","arguments":[{"coord":"slider.R_x"}],"parameters":{"law":{"kind":"sine","numbers":{"amplitude":0.3,"omega":1.0,"phase":0.0}}}}]}"#;
