//! Papers are in plain English: no words of a private dialect, and short sentences.

use std::fs;
use std::path::{Path, PathBuf};

use crate::ROOT;

/// Phrases that papers do not use, each with what to write instead.
pub const RETIRED: [(&str, &str); 14] = [
    ("told", "reported, named"),
    ("asked", "requested, evaluated"),
    ("hangs on", "depends on"),
    ("hang on", "depend on"),
    ("of its own", "separate, its"),
    ("of their own", "separate, their"),
    ("of one's own", "user-defined"),
    ("of what", "the noun"),
    ("plain steps", "the step-by-step solver"),
    ("stands in", "is in"),
    ("goes by", "is computed by"),
    ("makes of it", "computes from it"),
    ("rubs", "has friction"),
    ("faint", "close to zero"),
];

/// The longest sentence that is not counted as long.   \[words\]
pub const WORDS: usize = 25;

/// How many of a hundred sentences may be long.
pub const LONG: usize = 5;

/// All papers of the repository.
fn papers() -> Vec<PathBuf> {
    let root = Path::new(ROOT);
    let mut found = vec![root.join("benches/README.md")];
    for folder in ["", "docs", "docs/guide", "docs/decisions"] {
        let entries = root.join(folder).read_dir().expect("readable");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        found.extend(paths.filter(|path| path.extension().is_some_and(|end| end == "md")));
    }
    found.sort();
    assert!(found.len() > 40, "{found:?} are not all papers");
    found
}

/// The text without its code: blocks and what is between backticks become one word.
pub fn without_code(text: &str) -> String {
    let mut is_code = false;
    let mut kept = String::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
            kept.push('\n');
        } else if !is_code {
            let parts = line.split('`').enumerate();
            kept.extend(parts.map(|(k, part)| if k % 2 == 0 { part } else { "code" }));
            kept.push('\n');
        }
    }
    kept
}

/// The sentences of paragraphs, items of lists and cells of tables; headings have none.
pub fn sentences(text: &str) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    for line in without_code(text).lines().map(str::trim) {
        let item = ["* ", "- "].iter().find_map(|mark| line.strip_prefix(mark));
        if line.is_empty() || line.starts_with('#') {
            paragraphs.push(String::new());
        } else if line.starts_with('|') {
            paragraphs.extend(line.split('|').map(ToString::to_string));
            paragraphs.push(String::new());
        } else {
            if item.is_some() {
                paragraphs.push(String::new());
            }
            let last = paragraphs.last_mut().expect("there is one");
            last.push(' ');
            last.push_str(item.unwrap_or(line));
        }
    }
    let mut found = Vec::new();
    for paragraph in paragraphs {
        let mut sentence: Vec<&str> = Vec::new();
        for word in paragraph.split_whitespace() {
            sentence.push(word);
            if word.ends_with(['.', '!', '?', ':']) {
                found.push(std::mem::take(&mut sentence).join(" "));
            }
        }
        found.push(sentence.join(" "));
    }
    found.retain(|sentence| sentence.split_whitespace().count() > 2);
    found
}

/// True if the phrase is in the text as whole words.
pub fn has(text: &str, phrase: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    text.match_indices(phrase).any(|(at, _)| {
        !is_letter(text[..at].chars().next_back())
            && !is_letter(text[at + phrase.len()..].chars().next())
    })
}

#[test]
fn papers_use_no_retired_words() {
    let mut wrong = Vec::new();
    for path in papers() {
        let text = fs::read_to_string(&path).expect("readable");
        for (number, line) in without_code(&text).to_lowercase().lines().enumerate() {
            let found = RETIRED.iter().filter(|(phrase, _)| has(line, phrase));
            wrong.extend(found.map(|(phrase, instead)| {
                format!(
                    "{}, near line {}: `{phrase}`; write: {instead}",
                    path.display(),
                    number + 1
                )
            }));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
pub fn sentences_of_papers_are_short() {
    let mut wrong = Vec::new();
    for path in papers() {
        let all = sentences(&fs::read_to_string(&path).expect("readable"));
        let long: Vec<&String> =
            all.iter().filter(|one| one.split_whitespace().count() > WORDS).collect();
        if 100 * long.len() > LONG * all.len() {
            wrong.push(format!(
                "{}: {} of {} are long, such as: {}",
                path.display(),
                long.len(),
                all.len(),
                long[0]
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn retired_words_and_long_sentences_are_seen() {
    let text = "# A heading is told\n\nOne. Two words here: three\nmore words. `told`\n\n```text\ntold\n```\n* It is retold, not told.\n";
    assert_eq!(
        sentences(text),
        ["Two words here:", "three more words.", "It is retold, not told."]
    );
    assert!(has("it is told.", "told") && !has("it is retold", "told") && !has("a toldo", "told"));
    assert!(without_code("a `told` b").trim() == "a code b");
}
