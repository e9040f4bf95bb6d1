//! Data on the standard output alone, words on the standard error alone; pipes.

use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

use crate::{SLOT, code, done, example, fed, kin, words};

#[test]
fn nothing_but_data_is_on_the_standard_output() {
    let output = done(&["run", &example("04_four_bar"), "--times", "0:1:31", "--csv", "-"]);
    let table = String::from_utf8(output.stdout.clone()).expect("text");
    assert_eq!(table.lines().count(), 32);
    assert!(words(&output).starts_with("four-bar: 9 coordinates, 9 equations, 31 times"));
    let silent = done(&["run", &example("04_four_bar"), "--times", "0:1:31"]);
    assert!(silent.stdout.is_empty() && words(&silent) == words(&output));
}

#[test]
fn words_have_no_colour_where_nobody_sees_it() {
    for (name, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
        for arguments in [&["check", "missing.json"][..], &["rum"], &["help"]] {
            let output = kin(arguments).env(name, value).output().expect("kin runs");
            assert!(
                !output.stderr.contains(&0x1b) && !output.stdout.contains(&0x1b),
                "{arguments:?}"
            );
        }
    }
}

#[test]
fn a_mechanism_comes_from_the_standard_input() {
    let output = fed(&["run", "-", "--times", "0:6:5", "--csv", "-"], SLOT);
    assert_eq!(code(&output), 0, "{}", words(&output));
    assert_eq!(String::from_utf8(output.stdout).expect("text").lines().count(), 6);
}

/// The reader takes one line and goes, as `head -1` does.
#[test]
fn a_broken_pipe_is_silence() {
    let m = example("02_two_link_manipulator");
    for asked in [
        vec!["run", &m, "--times", "0:24:2401", "--csv", "-"],
        vec!["run", &m, "--times", "0:24:2401", "--json", "-"],
        vec!["measure", &m, "A.angle", "--times", "0:24:2401"],
    ] {
        let mut child =
            kin(&asked).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("kin starts");
        let mut first = [0; 16];
        let mut output = BufReader::with_capacity(16, child.stdout.take().expect("an output"));
        assert!(output.read(&mut first).is_ok_and(|n| n > 0), "{asked:?}");
        drop(output);
        let mut told = String::new();
        child.stderr.take().expect("words").read_to_string(&mut told).expect("text");
        let status = child.wait().expect("kin ends");
        assert!(!told.contains("error") && !told.contains("panic"), "{asked:?}: {told}");
        assert_eq!(status.code(), Some(0), "{asked:?}: {told}");
    }
}

#[test]
fn a_full_disk_is_told() {
    let Ok(full) = std::fs::OpenOptions::new().write(true).open("/dev/full") else { return };
    let arguments = ["run", &example("04_four_bar"), "--times", "0:1:361", "--csv", "-"];
    let output = kin(&arguments).stdout(full).stderr(Stdio::piped()).output().expect("kin runs");
    assert_eq!(code(&output), 5);
    assert!(words(&output).contains("cannot write to standard output"), "{}", words(&output));
}

/// Progress is for terminals: nothing of it in a file.
#[test]
fn progress_is_not_written_to_files() {
    let cases = crate::file("progress.csv", "O.u_j.x\n-0.5\n-0.5\n");
    let output = done(&[
        "sweep",
        &example("04_four_bar"),
        &cases,
        "--times",
        "0:1:3",
        "--keep",
        "rocker.theta",
    ]);
    assert_eq!((code(&output), words(&output).as_str()), (0, ""));
    assert_eq!(BufReader::new(&output.stdout[..]).lines().count(), 3);
}
