//! Tests of the whole macro without rustc: its messages, what it emits, and that nothing makes it
//! panic or run away.

mod attributes;
mod golden;
pub mod mangled;
mod messages;
mod pathological;
mod slopes;
mod tables;

use std::path::Path;

/// The difference from the stored text; with `KIN_BLESS=1` none, and the text is stored for review.
fn compared(path: &Path, found: &str) -> Option<String> {
    if std::env::var_os("KIN_BLESS").is_some() {
        std::fs::write(path, found).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    (expected != found)
        .then(|| format!("{}\nexpected:\n{expected}\nfound:\n{found}", path.display()))
}

/// The Rust files of a folder beside the crate's manifest, by name.
fn rust_files(folder: &str) -> Vec<(String, std::path::PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries =
        std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let files = paths.filter(|path| path.extension().is_some_and(|end| end == "rs"));
    let mut files: Vec<_> = files
        .map(|path| (path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), path))
        .collect();
    files.sort();
    files
}
