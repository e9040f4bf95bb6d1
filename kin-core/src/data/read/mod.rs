//! Reads JSON, and tells mistakes by their place, their key and the cure.
//!
//! `serde_json` reads the text. If it fails, Kin reads the text again to find the place: first its
//! syntax (`syntax.rs`), then member by member (`member.rs`). Each mistake is data (`mistake.rs`)
//! until it becomes a sentence.

mod member;
mod mistake;
mod place;
mod syntax;

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::once;

/// Reads the data in a text. Errors: the first mistake, with its place, line and column.
pub(super) fn text<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    serde_json::from_str(text).map_err(|error| report::<T>(text, &error))
}

/// Reads data from a value of JSON. Errors: the first mistake, with its place in the value.
pub(super) fn value<T: DeserializeOwned>(from: &Value) -> Result<T, String> {
    member::read(from).map_err(|mistake| mistake.sentence("it"))
}

/// The sentence for a mistake that `serde_json` has found.
fn report<T: DeserializeOwned>(text: &str, error: &serde_json::Error) -> String {
    let mut whole = serde_json::Deserializer::from_str(text);
    let value = once::value(&mut whole).and_then(|value| whole.end().map(|()| value));
    let value = match value {
        Ok(value) => value,
        Err(error) if error.is_data() => {
            let here = place::line_and_column(text, place::byte(text, &error));
            return at(&place::reason(&error), here);
        }
        Err(error) => return syntax::report(text, &error),
    };
    match member::read::<T>(&value) {
        Err(mistake) => {
            let here = place::line_and_column(text, mistake.byte(text));
            at(&mistake.sentence("the file"), here)
        }
        // Both readers read the same data, so that no such text is known.
        Ok(_) => {
            let here = place::line_and_column(text, place::byte(text, error));
            at(&place::reason(error), here)
        }
    }
}

/// A sentence with its line and column.
fn at(sentence: &str, [line, column]: [usize; 2]) -> String {
    format!("line {line}, column {column}: {sentence}")
}
