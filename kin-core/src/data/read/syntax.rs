//! Texts that are no JSON.

use super::mistake::pointer;
use super::place;

/// Returns the sentence for a text that `serde_json` cannot read as JSON.
pub(super) fn report(text: &str, error: &serde_json::Error) -> String {
    if text.trim().is_empty() {
        return "the file is empty. Write a mechanism in { }, as in the examples".to_string();
    }
    let at = place::byte(text, error);
    let end = if error.is_eof() { text.len() } else { at };
    let path: String = place::around(text, end).iter().map(pointer).collect();
    let inside = if path.is_empty() { String::new() } else { format!("in `{path}` ") };
    let sentence = sentence(&place::reason(error), &text[at..]);
    super::at(&format!("{inside}{sentence}"), place::line_and_column(text, at))
}

/// The sentence for a reason of `serde_json`, before the text that it could not read.
fn sentence(reason: &str, rest: &str) -> String {
    let words = match reason {
        "EOF while parsing a list" => "the text ends inside a list. Close the list with `]`",
        "EOF while parsing an object" => {
            "the text ends inside an object. Close the object with `}`"
        }
        "EOF while parsing a string" => {
            "the text ends inside a text in quotes. Close the quotes with `\"`"
        }
        "EOF while parsing a value" => "the text ends where a value must follow. Add the value",
        "expected `:`" => "a key has no `:` behind it. Write \"key\": value",
        "expected `,` or `]`" => "a list goes on without a comma, or has no end. Add `,` or `]`",
        "expected `,` or `}`" => "an object goes on without a comma, or has no end. Add `,` or `}`",
        "trailing comma" => "a comma has nothing behind it. Remove the comma",
        "trailing characters" => "the text goes on after its last `}`. Remove what follows",
        "recursion limit exceeded" => "lists and objects are nested too deeply. Nest them less",
        "number out of range" => "a number is too large. Write a smaller number",
        "invalid number" => "a number is not complete. Write it like 0.5, -2 or 1e-3",
        "invalid escape" => "a text has an unknown escape. Write `\\` as `\\\\`",
        "key must be a string" => return no_key(rest),
        "expected ident" | "expected value" => return no_value(rest),
        _ if reason.starts_with("control character") => {
            "a text in quotes has a line break or a tab. Write \\n or \\t there"
        }
        other => return format!("this is no JSON: {other}"),
    };
    words.to_string()
}

/// The sentence for something that is no key.
fn no_key(rest: &str) -> String {
    let words = match rest.chars().next() {
        Some('\'') => "a key has single quotes. Write it in double quotes",
        Some('/' | '#') => "JSON has no comments. Remove this comment",
        Some(',') => "a comma has no key before it. Remove the comma",
        _ => "a key has no quotes. Write \"key\": value",
    };
    words.to_string()
}

/// The sentence for something that is no value.
fn no_value(rest: &str) -> String {
    let word: String = rest.chars().take_while(|c| !" \t\r\n,]}:".contains(*c)).take(20).collect();
    let lower = word.trim_start_matches(['+', '-']).to_lowercase();
    match rest.chars().next() {
        Some('\'') => "a text has single quotes. Write it in double quotes".to_string(),
        Some('/' | '#') => "JSON has no comments. Remove this comment".to_string(),
        Some('+' | '.') => {
            format!("`{word}` is no number of JSON. Write it like 0.5, -2 or 1e-3")
        }
        Some(',' | ']' | '}') => "a value is missing. Add the value, or remove a comma".to_string(),
        _ if ["nan", "inf", "infinity"].contains(&lower.as_str()) => {
            format!("JSON has no `{word}`. Write a number, or leave the key out")
        }
        _ => format!(
            "`{word}` is no value. Write a number, a text in double quotes, a list in [ ], an object in {{ }}, \
             `true`, `false` or `null`"
        ),
    }
}
