//! Compiles emitted files together with a small program, and runs them.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A program that reads the numbers u, u̇ and ü of each step, and writes the code, q, q̇ and q̈. It
/// halves a step that is too long.
const MAIN: &str = include_str!("program.c");

/// The flags of all compilations.
pub const FLAGS: [&str; 6] = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O0"];

/// Flags with which a program stops at an error of memory or of arithmetic.
const CHECKED: [&str; 3] = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

/// Returns the flags with which a program stops at an error of memory or of arithmetic. Returns
/// none, and prints it, if this machine cannot run such a program.
pub fn checks() -> &'static [&'static str] {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emit/checks");
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("main.c"), "int main(void) { return 0; }\n").expect("written");
    let mut compile = Command::new("cc");
    compile.args(CHECKED).args(["main.c", "-o", "program"]).current_dir(&folder);
    let is_made = compile.output().is_ok_and(|out| out.status.success());
    let runs = || Command::new(folder.join("program")).output();
    if is_made && runs().is_ok_and(|out| out.status.success()) {
        return &CHECKED;
    }
    println!("NOT RUN: the sanitizers of the C compiler");
    &[]
}

/// Returns true if there is a C compiler; otherwise prints that the test does not run.
pub fn there_is_a_compiler() -> bool {
    let there = Command::new("cc").arg("--version").output().is_ok_and(|out| out.status.success());
    if !there {
        println!("NOT RUN: there is no C compiler `cc`");
    }
    there
}

/// A compiled program of an emitted file.
pub struct Program {
    path: PathBuf,
}

/// Returns the prefix of all names in an emitted file.
pub fn prefix(text: &str) -> &str {
    let (_, rest) = text.split_once("\nint ").expect("functions");
    rest.split_once("_start(").expect("a start").0
}

/// Compiles an emitted file; `name` is that of its folder. Errors: the messages of the compiler.
pub fn compiled(name: &str, text: &str, flags: &[&str]) -> Result<Program, String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emit").join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    let emitted = folder.join("emitted.c");
    std::fs::write(&emitted, text).expect("written");
    std::fs::write(folder.join("main.c"), MAIN).expect("written");
    let path = folder.join("program");
    let free = if text.contains("_nominal") { "-DFREE" } else { "-DFOLDED" };
    let timed = if text.contains("_at(") { "-DTIMED" } else { "-DUNTIMED" };
    let made = Command::new("cc")
        .args(FLAGS)
        .args(flags)
        .arg(format!("-DPREFIX={}", prefix(text)))
        .args([free, timed])
        .arg("main.c")
        .args(["-o", "program", "-lm"])
        .current_dir(&folder)
        .output()
        .expect("the compiler runs");
    match made.status.success() {
        true => Ok(Program { path }),
        false => Err(String::from_utf8_lossy(&made.stderr).into_owned()),
    }
}

impl Program {
    /// Returns the result of the self test.
    pub fn selftest(&self) -> String {
        let out = Command::new(&self.path).arg("selftest").output().expect("runs");
        assert!(out.stderr.is_empty(), "{}", String::from_utf8_lossy(&out.stderr));
        String::from_utf8_lossy(&out.stdout).trim().to_string()
    }

    /// Returns the output lines as numbers for these input lines.
    pub fn run(&self, arguments: &[&str], lines: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut child = Command::new(&self.path)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("runs");
        let words = |line: &Vec<f64>| line.iter().map(|x| format!("{x:e} ")).collect::<String>();
        let text: String = lines.iter().map(|line| words(line) + "\n").collect();
        let mut stdin = child.stdin.take().expect("an input");
        let writer = std::thread::spawn(move || {
            let _ = stdin.write_all(text.as_bytes());
        });
        let out = child.wait_with_output().expect("ends");
        writer.join().expect("written");
        assert!(out.stderr.is_empty(), "{}", String::from_utf8_lossy(&out.stderr));
        let numbers = |line: &str| {
            line.split_whitespace().map(|word| word.parse().expect("a number")).collect()
        };
        String::from_utf8_lossy(&out.stdout).lines().map(numbers).collect()
    }
}
