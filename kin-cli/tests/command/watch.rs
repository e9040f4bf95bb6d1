//! `kin watch`: once more each time the file changes.

use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::{SLOT, kin, place};

/// Waits until the file is there and has what is wanted.
fn wait_for(path: &std::path::Path, wanted: &str) {
    let begun = Instant::now();
    while !std::fs::read_to_string(path).is_ok_and(|text| text.contains(wanted)) {
        assert!(begun.elapsed() < Duration::from_secs(60), "{} has no {wanted}", path.display());
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A process that ends with the test, however that ends.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn a_file_that_changes_is_run_again_and_mistakes_are_survived() {
    let model = place("watched.json");
    let table = place("watched.csv");
    let words = place("watched.txt");
    let _ = std::fs::remove_file(&table);
    std::fs::write(&model, SLOT).expect("written");
    let from = model.to_string_lossy();
    let to = table.to_string_lossy();
    let told = std::fs::File::create(&words).expect("a file");
    let child = kin(&["watch", &from, "--times", "0:1:2", "--csv", &to])
        .stdout(Stdio::null())
        .stderr(told)
        .spawn()
        .expect("kin starts");
    let _child = Ended(child);
    wait_for(&table, "2.52441295");
    wait_for(&words, "watching");
    std::fs::write(&model, SLOT.replace("s.y - k", "s.w - k")).expect("written");
    wait_for(&words, "a Vec2 has no field `w`");
    std::fs::write(&model, SLOT.replace("\"amplitude\":0.3", "\"amplitude\":0.4"))
        .expect("written");
    wait_for(&table, "3.3658839");
}
