//! Comments are sentences, or noun phrases that name the thing.

use std::path::Path;

use crate::rust_files;

/// Text of a comment that has its line to itself.
fn comment(line: &str) -> Option<&str> {
    let text = line.trim_start().strip_prefix("//")?;
    Some(text.trim_start_matches(['/', '!']).trim())
}

/// Lines, counted from 1, at which a comment or a paragraph of one begins with "What" or "Whether":
/// a clause that leaves its subject and its verb to be guessed.
fn clauses(text: &str) -> Vec<usize> {
    let lines: Vec<&str> = text.lines().collect();
    let begins = |k: usize| k == 0 || comment(lines[k - 1]).is_none_or(str::is_empty);
    let is_clause = |text: &str| matches!(text.split(' ').next(), Some("What" | "Whether"));
    (0..lines.len())
        .filter(|&k| begins(k) && comment(lines[k]).is_some_and(is_clause))
        .map(|k| k + 1)
        .collect()
}

#[test]
fn comments_begin_with_what_they_are_about() {
    let root = Path::new(crate::ROOT);
    let mut found = Vec::new();
    for path in rust_files(".") {
        let own = path.strip_prefix(root.join(".")).expect("a path of the workspace");
        // The head of an example has a title: what to see.
        if own.starts_with("examples") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable");
        found.extend(clauses(&text).into_iter().map(|line| format!("{}:{line}", own.display())));
    }
    assert!(found.is_empty(), "name the thing, or say when it is true: {found:#?}");
}

#[test]
fn a_clause_is_seen() {
    let text = [
        "//! Whether it is.",
        "",
        "/// What is left.",
        "///",
        "/// What",
        "/// Whether it goes on",
        "let what = 1; // A sentence.",
        "    // A sentence.",
        "    // What follows goes on.",
        "    fn what() {}",
        "    // What is inner.",
        "/// Whatever.",
    ];
    assert_eq!(clauses(&text.join("\n")), [1, 3, 5, 11]);
}
