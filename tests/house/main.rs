//! How the workspace is built: short files and functions, plain comments, imports from the bottom
//! up.

mod calls;
mod comments;
mod imports;
mod limits;
mod lists;
mod messages;
mod papers;
mod reading;
mod roots;
mod signatures;
mod words;

use std::path::{Path, PathBuf};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The sources of every crate of the workspace but the facade, which is one file.
fn sources() -> Vec<String> {
    let entries =
        Path::new(ROOT).read_dir().expect("readable").map(|entry| entry.expect("an entry"));
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut all: Vec<String> =
        names.filter(|name| name.starts_with("kin-")).map(|name| format!("{name}/src")).collect();
    all.sort();
    assert!(all.len() > 5, "{all:?} are not all crates");
    all
}

/// Every Rust file in a folder of the workspace but expansions that are stored to be compared, and
/// programs that are wrong on purpose.
fn rust_files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(ROOT).join(folder);
    let left_out = ["target", "out", "golden", "ui", "data"];
    let mut open = vec![root.clone()];
    let mut found = Vec::new();
    while let Some(path) = open.pop() {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_left_out = name.starts_with('.')
            || left_out.contains(&name.as_str()) && !path.join("mod.rs").exists();
        if path.is_dir() && (path == root || !is_left_out) {
            open.extend(
                path.read_dir().expect("readable").map(|entry| entry.expect("an entry").path()),
            );
        } else if name.ends_with(".rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}
