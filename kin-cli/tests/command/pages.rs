//! The command lines of the guide: each is run.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The blocks of a page in this language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let text = std::fs::read_to_string(format!("{ROOT}/docs/guide/{page}.md")).expect("a page");
    let fence = format!("```{language}\n");
    text.split(&fence)
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap_or_default().to_string())
        .collect()
}

/// A folder that looks like the root of the repository, with `out/`.
fn folder(page: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages").join(page);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("out")).expect("a folder");
    for ready in ["examples/mechanisms", "examples/import"] {
        std::fs::create_dir_all(folder.join(ready)).expect("a folder");
        for entry in std::fs::read_dir(format!("{ROOT}/{ready}")).expect("the ready mechanisms") {
            let from = entry.expect("an entry").path();
            std::fs::copy(&from, folder.join(ready).join(from.file_name().expect("a name")))
                .expect("copied");
        }
    }
    folder
}

/// The names of the pages of the guide, without `.md`.
fn pages() -> Vec<String> {
    let entries = std::fs::read_dir(format!("{ROOT}/docs/guide")).expect("the guide");
    let names =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    names.filter_map(|name| name.strip_suffix(".md").map(ToString::to_string)).collect()
}

fn shell(line: &str, folder: &Path) -> Command {
    let kin = Path::new(env!("CARGO_BIN_EXE_kin")).parent().expect("a folder");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(folder).env("PATH", format!("{}:{path}", kin.display()));
    shell
}

/// Runs a line of `kin watch` until it has run once.
fn watched(line: &str, folder: &Path) {
    let told = folder.join("watched.txt");
    let words = std::fs::File::create(&told).expect("a file");
    let mut child = shell(&format!("exec {line}"), folder)
        .stdout(Stdio::null())
        .stderr(words)
        .spawn()
        .expect("a shell");
    let begun = Instant::now();
    while !std::fs::read_to_string(&told).is_ok_and(|text| text.contains("watching"))
        && begun.elapsed() < Duration::from_secs(60)
    {
        std::thread::sleep(Duration::from_millis(50));
    }
    let _ = child.kill();
    let _ = child.wait();
    let text = std::fs::read_to_string(&told).expect("words");
    assert!(text.contains("watching") && !text.contains("error"), "{line}: {text}");
}

#[test]
fn every_command_line_of_the_guide_does_what_it_says() {
    let mut count = 0;
    for page in &pages() {
        let folder = folder(page);
        for (file, json) in [("slot", blocks("text", "json")), ("arm", blocks("command", "json"))] {
            std::fs::write(folder.join(format!("out/{file}.json")), json.concat())
                .expect("written");
        }
        for line in blocks(page, "sh").iter().flat_map(|block| block.lines()) {
            count += 1;
            if line.starts_with("kin watch") {
                watched(line, &folder);
                continue;
            }
            let output = shell(line, &folder).output().expect("a shell");
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success() && !told.contains("error"), "{line}: {told}");
            let has_file = line
                .split_whitespace()
                .filter(|word| word.starts_with("out/") && !line.contains("cat "));
            for file in has_file {
                let size = std::fs::metadata(folder.join(file)).map(|of| of.len()).unwrap_or(0);
                assert!(size > 0, "{line}: {file} is not there");
            }
        }
    }
    assert!(count > 15, "only {count} lines");
}

/// The page shows what was reached, and says in words that it is not all and why.
#[test]
fn the_page_of_a_run_that_ended_early_says_why() {
    let page = folder("early").join("out/early.html");
    let line = format!(
        "kin run examples/mechanisms/04_four_bar.json --set C.u_i.x=5.7 --page {}",
        page.display()
    );
    let ran = |times: &str| {
        let output =
            shell(&format!("{line} --times {times}"), &folder("early")).output().expect("a shell");
        (output.status.code(), std::fs::read_to_string(&page).expect("a page"))
    };
    let (code, html) = ran("0:1:91");
    assert_eq!(code, Some(3));
    let note = html.split_once("<aside id=\"ended\" role=\"note\">").expect("a note").1;
    let note = note.split_once("</aside>").expect("its end").0;
    assert!(note.contains("up to t = 0.38889 s, of 1 s"), "{note}");
    assert!(note.contains("no position exists beyond the toggle"), "{note}");
    // The note itself says up to when the page shows the motion: once.
    assert!(!note.contains("motion up to") && !note.contains("error.motion"), "{note}");
    assert!(html.contains("\"frames\":36,"), "the page has the times that were reached");
    let (code, html) = ran("0:0.3:31");
    assert!(code == Some(0) && !html.contains("<aside"), "{code:?}");
}

#[test]
fn every_ready_mechanism_runs() {
    for entry in
        std::fs::read_dir(format!("{ROOT}/examples/mechanisms")).expect("the ready mechanisms")
    {
        let path = entry.expect("an entry").path();
        let table =
            crate::data(&["run", &path.to_string_lossy(), "--times", "0:0.1:3", "--csv", "-"]);
        assert_eq!(table.lines().count(), 4, "{}", path.display());
    }
}
