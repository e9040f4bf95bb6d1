//! Messages are in plain English, as papers are: string literals of all crates and of the wheel's
//! Python use no words of a private dialect, and are short.

use std::fs;
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::papers::{LONG, RETIRED, WORDS, has, sentences, without_code};
use crate::{ROOT, rust_files, sources};

/// Phrases that only papers may use, each with what a message says instead.
const INSIDES: [(&str, &str); 8] = [
    ("asks", "requires, requests"),
    ("of your own", "user-defined"),
    ("hanging on", "that depends on"),
    ("plain step", "the step-by-step solver"),
    ("by a program", "compiled"),
    ("the tape", "the compiled mechanism"),
    ("pivot", "how near C_q is to a singular matrix"),
    ("stands still, and", "does not move, and"),
];

/// A text with fewer words is no sentence.
const SENTENCE: usize = 3;

/// A string literal and where it is.
struct Message {
    place: String,
    text: String,
}

/// The literals of sources; those of tests and of documentation are left out.
fn literals(tokens: TokenStream, place: &str, found: &mut Vec<Message>) {
    let mut is_test = false;
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == '#' => {
                let is_inner = |next: &TokenTree| matches!(next, TokenTree::Punct(mark) if mark.as_char() == '!');
                tokens.next_if(is_inner);
                let Some(TokenTree::Group(group)) = tokens.peek() else { continue };
                let attribute = group.stream().to_string();
                is_test |= attribute.starts_with("cfg") && attribute.contains("test");
                if attribute.starts_with("doc") || attribute.starts_with("cfg") {
                    tokens.next();
                }
            }
            // The end of the item that the attribute is on.
            TokenTree::Group(group) if is_test && group.delimiter() == Delimiter::Brace => {
                is_test = false;
            }
            TokenTree::Punct(punct) if is_test && punct.as_char() == ';' => is_test = false,
            TokenTree::Group(group) => literals(group.stream(), place, found),
            TokenTree::Literal(literal) if !is_test => {
                let Ok(text) = syn::parse_str::<syn::LitStr>(&literal.to_string()) else {
                    continue;
                };
                let line = literal.span().start().line;
                found.push(Message { place: format!("{place}:{line}"), text: text.value() });
            }
            _ => {}
        }
    }
}

/// The string literals of the crates, without those of their tests.
fn of_crates() -> Vec<Message> {
    let mut found = Vec::new();
    for path in sources().iter().flat_map(|folder| rust_files(folder)) {
        let name = path.strip_prefix(ROOT).expect("below the root").to_string_lossy().into_owned();
        if ["/testing/", "/tests/", "/plant/", "tests.rs"].iter().any(|part| name.contains(part)) {
            continue;
        }
        let text = fs::read_to_string(&path).expect("readable");
        literals(text.parse().expect("Rust"), &name, &mut found);
    }
    found
}

/// The strings of a Python file that are on one line; comments and docstrings are left out.
fn of_python(text: &str, place: &str, found: &mut Vec<Message>) {
    let mut is_documentation = false;
    for (number, line) in text.lines().enumerate() {
        let marks = line.matches("\"\"\"").count();
        if is_documentation || marks > 0 {
            is_documentation ^= marks % 2 == 1;
            continue;
        }
        let mut rest = line;
        while let Some(at) = rest.find(['"', '\'', '#']) {
            let mark = &rest[at..=at];
            let after = &rest[at + 1..];
            let Some(end) = after.find(mark).filter(|_| mark != "#") else { break };
            found.push(Message {
                place: format!("{place}:{}", number + 1),
                text: after[..end].to_string(),
            });
            rest = &after[end + 1..];
        }
    }
}

/// All messages: texts with a verb's worth of words.
fn messages() -> Vec<Message> {
    let mut found = of_crates();
    let folder = Path::new(ROOT).join("kin-python/python/kin");
    for entry in folder.read_dir().expect("readable") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|end| end == "py") {
            let text = fs::read_to_string(&path).expect("readable");
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            of_python(&text, &name, &mut found);
        }
    }
    found.retain(|message| {
        let is_markup = message.text.trim_start().starts_with(['<', '#']);
        let is_code = ["fn ", "let ", "=> {"].iter().any(|code| message.text.contains(code));
        !is_markup && !is_code && words(&message.text) >= SENTENCE
    });
    assert!(found.len() > 1000, "{} are not all messages", found.len());
    found
}

/// Each placeholder of a text becomes one word.
fn filled(text: &str) -> String {
    let mut depth = 0_usize;
    let mut kept = String::new();
    for c in text.chars() {
        match c {
            '{' => depth += 1,
            '}' => {
                depth = depth.saturating_sub(1);
                kept.push_str(if depth == 0 { "code" } else { "" });
            }
            c if depth == 0 => kept.push(c),
            _ => {}
        }
    }
    without_code(&kept)
}

fn words(text: &str) -> usize {
    filled(text).split_whitespace().count()
}

#[test]
fn messages_use_no_retired_words() {
    let mut wrong = Vec::new();
    for Message { place, text } in messages() {
        let plain = filled(&text).to_lowercase();
        let found = RETIRED.iter().chain(&INSIDES).filter(|(phrase, _)| has(&plain, phrase));
        wrong.extend(
            found.map(|(phrase, instead)| format!("{place}: `{phrase}`; write: {instead}: {text}")),
        );
    }
    assert!(wrong.is_empty(), "{}\n{}", wrong.join("\n"), wrong.len());
}

/// A chain of calls with `?` is Rust: `surface.rs` has other words for Python and the command.
#[test]
fn messages_have_no_chains_of_rust() {
    let is_core = |one: &Message| {
        one.place.starts_with("kin-core/") && !one.place.contains("outcome/error/surface.rs")
    };
    let mut wrong = Vec::new();
    for Message { place, text } in messages().into_iter().filter(is_core) {
        if ["?.", ")?", ".unwrap(", "SolverOptions::"].iter().any(|mark| text.contains(mark)) {
            wrong.push(format!("{place}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn sentences_of_messages_are_short() {
    let mut count = 0;
    let mut long = Vec::new();
    for Message { place, text } in messages() {
        let all = sentences(&filled(&text));
        count += all.len();
        let too_long = all.iter().filter(|one| one.split_whitespace().count() > WORDS);
        long.extend(too_long.map(|one| format!("{place}: {one}")));
    }
    assert!(
        100 * long.len() <= LONG * count,
        "{} of {count} are long:\n{}",
        long.len(),
        long.join("\n")
    );
}

#[test]
fn texts_of_sources_are_seen() {
    let source = "//! All told.\n/// One told.\n#[error(\"a told {b}\")] struct A; fn f() { g!(\"{x} is told\", 1); }\n\
                  #[cfg(test)] mod tests { const C: &str = \"told there\"; } const D: &str = \"e\";";
    let mut found = Vec::new();
    literals(source.parse().expect("Rust"), "a.rs", &mut found);
    let texts: Vec<&str> = found.iter().map(|one| one.text.as_str()).collect();
    assert_eq!(texts, ["a told {b}", "{x} is told", "e"]);
    let mut found = Vec::new();
    of_python("\"\"\"Told.\"\"\"\nf(f\"a {b} told\", 'c')  # \"told\"\n", "a.py", &mut found);
    let texts: Vec<&str> = found.iter().map(|one| one.text.as_str()).collect();
    assert_eq!(texts, ["a {b} told", "c"]);
    assert_eq!(filled("{a:?} is `b c` of {{d}}").trim(), "code is code of code");
}
