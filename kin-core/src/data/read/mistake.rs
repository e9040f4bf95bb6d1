//! A mistake in data, and its sentence.

use std::fmt;

use serde::de::{Error, Expected, Unexpected};

use super::place;
use crate::outcome::similar;
use crate::outcome::words::count;

/// A step into a value of JSON.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    /// The member of an object.
    Key(String),
    /// The item of a list, from 0.
    Item(usize),
}

/// The kinds of mistakes of a value.
#[derive(Clone, Debug)]
enum Kind {
    /// A required key is missing.
    Missing { key: String, given: Vec<String> },
    /// A key that the object does not have.
    Unknown { key: String, known: Vec<String> },
    /// A word that is none of the known ones.
    Variant { word: String, known: Vec<String> },
    /// A value of another type.
    Type { found: String, wanted: String },
    /// A list of another length.
    Length { found: usize, wanted: String },
    /// Any other mistake, in words.
    Other(String),
}

/// A mistake with the path to the value.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// The steps from the innermost one outward.
    inward: Vec<Step>,
    kind: Kind,
}

impl Mistake {
    fn new(kind: Kind) -> Mistake {
        Mistake { inward: Vec::new(), kind }
    }

    /// Adds the step that leads to the value of the mistake.
    pub(super) fn inside(mut self, step: Step) -> Mistake {
        self.inward.push(step);
        self
    }

    /// Notes the keys that the object with a missing key has, which may be meant.
    pub(super) fn with_keys<'a>(mut self, all: impl Iterator<Item = &'a String>) -> Mistake {
        if let (Kind::Missing { given, .. }, true) = (&mut self.kind, self.inward.is_empty()) {
            given.extend(all.cloned());
        }
        self
    }

    /// Returns the byte of the text at which the mistake is: an unknown key, or a value.
    pub(super) fn byte(&self, text: &str) -> usize {
        let mut steps: Vec<Step> = self.inward.iter().rev().cloned().collect();
        match &self.kind {
            Kind::Unknown { key, .. } => {
                steps.push(Step::Key(key.clone()));
                place::of_key(text, &steps)
            }
            _ => place::of(text, &steps),
        }
    }

    /// Returns the sentence:
    /// "`/bodies/0` has the unknown key `lenght`. Did you mean `length`? …". `root` is
    /// the word for the outermost value.
    pub(super) fn sentence(&self, root: &str) -> String {
        let path: String = self.inward.iter().rev().map(pointer).collect();
        let subject = if path.is_empty() { root.to_string() } else { format!("`{path}`") };
        match &self.kind {
            Kind::Missing { key, given } => {
                let meant = similar::meant(key, given);
                let rename = meant.map(|meant| format!(", or rename `{meant}` to `{key}`"));
                format!("{subject} lacks the key `{key}`. Add it{}", rename.unwrap_or_default())
            }
            Kind::Unknown { key, known } if known.is_empty() => {
                format!("{subject} has the unknown key `{key}`. Remove it")
            }
            Kind::Unknown { key, known } => {
                format!("{subject} has the unknown key `{key}`{}", similar::cure(key, known))
            }
            Kind::Variant { word, known } => {
                format!("{subject} cannot be `{word}`{}", similar::cure(word, known))
            }
            Kind::Type { found, wanted } => format!("{subject} is {found}. Write {wanted}"),
            Kind::Length { found, wanted } => {
                format!("{subject} has {}. Write {wanted}", count(*found, "item"))
            }
            Kind::Other(reason) if path.is_empty() => reason.clone(),
            Kind::Other(reason) => format!("{subject}: {reason}"),
        }
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence("it"))
    }
}

/// A step as JSON Pointer (RFC 6901) writes it.
pub(super) fn pointer(step: &Step) -> String {
    match step {
        Step::Key(key) => format!("/{}", key.replace('~', "~0").replace('/', "~1")),
        Step::Item(k) => format!("/{k}"),
    }
}

impl std::error::Error for Mistake {}

impl Error for Mistake {
    fn custom<T: fmt::Display>(reason: T) -> Self {
        Mistake::new(Kind::Other(reason.to_string()))
    }

    fn invalid_type(found: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        Mistake::new(Kind::Type { found: value_word(found), wanted: type_word(wanted) })
    }

    fn invalid_value(found: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        Mistake::invalid_type(found, wanted)
    }

    fn invalid_length(found: usize, wanted: &dyn Expected) -> Self {
        Mistake::new(Kind::Length { found, wanted: type_word(wanted) })
    }

    fn unknown_variant(word: &str, known: &'static [&'static str]) -> Self {
        Mistake::new(Kind::Variant { word: word.to_string(), known: owned(known) })
    }

    fn unknown_field(key: &str, known: &'static [&'static str]) -> Self {
        Mistake::new(Kind::Unknown { key: key.to_string(), known: owned(known) })
    }

    fn missing_field(key: &'static str) -> Self {
        Mistake::new(Kind::Missing { key: key.to_string(), given: Vec::new() })
    }
}

fn owned(all: &[&str]) -> Vec<String> {
    all.iter().map(|one| one.to_string()).collect()
}

/// A value in the words of a file.
fn value_word(found: Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(x) => format!("`{x}`"),
        Unexpected::Unsigned(x) => format!("the number {x}"),
        Unexpected::Signed(x) => format!("the number {x}"),
        Unexpected::Float(x) => format!("the number {x}"),
        Unexpected::Str(text) => format!("the text {}", shortened(text)),
        Unexpected::Unit | Unexpected::Option => "`null`".to_string(),
        Unexpected::Seq => "a list".to_string(),
        Unexpected::Map => "an object".to_string(),
        Unexpected::UnitVariant => "a word without a value".to_string(),
        Unexpected::NewtypeVariant | Unexpected::TupleVariant | Unexpected::StructVariant => {
            "a key with a value".to_string()
        }
        other => other.to_string(),
    }
}

/// A text in quotes, at most so long that a line shows it.
fn shortened(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{:?}…", &text[..end]),
        None => format!("{text:?}"),
    }
}

/// A type of serde in the words of a file.
fn type_word(wanted: &dyn Expected) -> String {
    let word = wanted.to_string();
    let first = word.split([' ', ',']).next().unwrap_or_default();
    match (word.as_str(), first) {
        ("a sequence", _) => "a list in [ ]".to_string(),
        ("a map", _) | (_, "struct") => "an object in { }".to_string(),
        ("a string" | "a borrowed string" | "string", _) => "a text in quotes".to_string(),
        ("a boolean", _) => "`true` or `false`".to_string(),
        ("f64" | "f32", _) => "a number".to_string(),
        ("u8" | "u16" | "u32" | "u64" | "usize", _) => "a whole number from 0 on".to_string(),
        ("i8" | "i16" | "i32" | "i64" | "isize", _) => "a whole number".to_string(),
        (_, "enum") | ("variant identifier" | "string or map", _) => {
            "a known word in quotes, or an object with one known key".to_string()
        }
        (_, "tuple" | "an") if word.contains("of length ") || word.contains("of size ") => {
            let count = word.rsplit(' ').next().unwrap_or_default();
            format!("a list of {count} items")
        }
        _ => word.clone(),
    }
}
