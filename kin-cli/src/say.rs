//! Words, which go to the standard error: notes, faults, progress.

use std::io::{IsTerminal, Write, stderr};

use clap::ValueEnum;
use kin::Motion;
use kin::results::Warning;
use serde_json::{Value, json};

use crate::fault::Fault;

/// How notes and faults are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Sentences.
    Text,
    /// One object of JSON a line: `{"note": …}`, `{"warning": …}`, and at the end
    /// `{"error": {"code": …, "kind": …, …}}`.
    Json,
}

impl Format {
    /// The format that arguments ask for which do not make sense otherwise.
    pub fn of_arguments(all: impl Iterator<Item = String>) -> Format {
        let all: Vec<String> = all.collect();
        let apart = all.windows(2).any(|pair| pair[0] == "--error-format" && pair[1] == "json");
        if apart || all.iter().any(|one| one == "--error-format=json") {
            Format::Json
        } else {
            Format::Text
        }
    }
}

/// Where the warnings of a motion stand already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// In the summary, which has been written.
    InSummary,
    /// Nowhere.
    Nowhere,
}

/// The one that says words.
pub struct Say {
    format: Format,
    color: bool,
    terminal: bool,
}

impl Say {
    /// Colours are for terminals, unless `NO_COLOR` is set to anything.
    pub fn new(format: Format) -> Say {
        let terminal = stderr().is_terminal();
        let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        Say { format, color: terminal && !plain, terminal }
    }

    /// A note beside the data.
    pub fn note(&self, text: &str) {
        match self.format {
            Format::Text => line(&visible(text)),
            Format::Json => self.object(&json!({ "note": text })),
        }
    }

    /// The warnings of a motion; in JSON an object each: `{"warning": {"kind": …, "names": …,
    /// "text": …}}`. As text they are left out where the summary has them already.
    pub fn warnings(&self, motion: &Motion, written: Written) {
        self.each_warning(motion.warnings(), written, "");
    }

    /// The same warnings, with words before each of them as text.
    pub fn each_warning(&self, warnings: &[Warning], written: Written, before: &str) {
        for warning in warnings {
            match (self.format, written) {
                (Format::Json, _) => self.object(&json!({ "warning": warning })),
                (Format::Text, Written::InSummary) => {}
                (Format::Text, Written::Nowhere) => {
                    line(&visible(&format!("{before}warning: {warning}")));
                }
            }
        }
    }

    /// Tells how a command has ended, and gives the exit code.
    pub fn ended(&self, end: Result<(), Fault>) -> u8 {
        let Err(fault) = end else { return 0 };
        match (self.format, fault.message()) {
            (Format::Json, _) if !matches!(fault, Fault::Pipe) => self.object(&fault.to_json()),
            (Format::Text, Some(text)) => {
                let mark = if self.color { "\u{1b}[1;31merror:\u{1b}[0m" } else { "error:" };
                line(&format!("{mark} {}", visible(&text)));
            }
            _ => {}
        }
        fault.code()
    }

    /// So many of so many are done; on terminals only.
    pub fn progress(&self, done: usize, all: usize, what: &str) {
        if self.terminal && self.format == Format::Text {
            let _ =
                write!(stderr(), "\r{done} of {all} {what}{}", if done == all { "\n" } else { "" });
        }
    }

    fn object(&self, value: &Value) {
        line(&value.to_string());
    }
}

/// Nobody may listen any more, which is no fault of what is said.
fn line(text: &str) {
    let _ = writeln!(stderr(), "{text}");
}

/// The text without characters that move a terminal's cursor, colour its text or turn its
/// direction: files have names in them that may come from anywhere.
pub fn visible(text: &str) -> String {
    let shown = |c: char| match c {
        '\n' | '\t' => c.to_string(),
        c if c.is_control() || turns_direction(c) => c.escape_unicode().to_string(),
        c => c.to_string(),
    };
    text.chars().map(shown).collect()
}

fn turns_direction(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_a_terminal_is_shown_as_its_number() {
        assert_eq!(visible("a\u{1b}[2J\rb\u{202e}\n\tθ"), "a\\u{1b}[2J\\u{d}b\\u{202e}\n\tθ");
    }

    #[test]
    fn the_format_of_faults_is_found_in_arguments_that_make_no_sense() {
        let format = |all: &[&str]| Format::of_arguments(all.iter().map(|one| one.to_string()));
        assert_eq!(format(&["kin", "--error-format", "json", "rum"]), Format::Json);
        assert_eq!(format(&["kin", "rum", "--error-format=json"]), Format::Json);
        assert_eq!(format(&["kin", "rum", "json"]), Format::Text);
    }
}
