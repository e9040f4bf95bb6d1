//! The C program of the guide prints what the guide says.

use std::path::Path;
use std::process::Command;

use kin::emit::{self, Options};

use crate::examples::mechanisms;
use crate::programs::{FLAGS, there_is_a_compiler};

/// Returns the first block of a page after `start` that begins with this line.
fn block<'a>(page: &'a str, start: &str) -> (&'a str, &'a str) {
    let (_, rest) = page.split_once(start).expect("the block");
    rest.split_once("\n```").expect("its end")
}

#[test]
fn the_program_of_the_guide_prints_what_the_page_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("docs/guide/firmware.md")).expect("readable");
    let (program, rest) = block(&page, "```c\n");
    let (expected, _) = block(rest, "```text\n");
    let (_, system) =
        mechanisms().into_iter().find(|(name, _)| name == "04_four_bar").expect("the example");
    let measures = vec!["rocker.theta".to_string()];
    let text = emit::c(&system, &Options { measures, ..Options::default() }).expect("emitted");
    if !there_is_a_compiler() {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emit/guide");
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("four_bar.c"), text).expect("written");
    std::fs::write(folder.join("main.c"), program).expect("written");
    let mut compiler = Command::new("cc");
    compiler.args(FLAGS).args(["main.c", "-o", "program", "-lm"]).current_dir(&folder);
    assert!(compiler.status().expect("runs").success());
    let out = Command::new(folder.join("program")).output().expect("runs");
    assert_eq!(String::from_utf8_lossy(&out.stdout).trim(), expected.trim());
}
