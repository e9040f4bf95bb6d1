//! Describes mistakes in a text: the message, the place, and the line with carets.

use std::fmt;

use proc_macro2::{LineColumn, Span};

/// One mistake in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mistake {
    /// The mistake, and how to correct it.
    pub message: String,
    /// The line of the mistake, counted from 1.
    pub line: usize,
    /// The column of the mistake, counted from 1.
    pub column: usize,
    /// The line of the text, with the wrong tokens underlined.
    pub excerpt: String,
}

/// All mistakes of a text, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistakes(pub Vec<Mistake>);

impl Mistakes {
    /// The mistakes that `error` tells about `text`.
    pub(crate) fn of(error: syn::Error, text: &str) -> Self {
        Mistakes(
            error.into_iter().map(|one| Mistake::at(one.span(), one.to_string(), text)).collect(),
        )
    }

    /// A mistake of the text as a whole.
    pub(crate) fn whole(message: impl Into<String>) -> Self {
        Mistakes(vec![Mistake {
            message: message.into(),
            line: 1,
            column: 1,
            excerpt: String::new(),
        }])
    }
}

impl Mistake {
    fn at(span: Span, message: String, text: &str) -> Self {
        let start = span.start();
        let end = span.end();
        Mistake {
            message,
            line: start.line,
            column: start.column + 1,
            excerpt: excerpt(start, end, text),
        }
    }
}

/// Longer lines are shown from a little before the place on.
const WIDEST: usize = 120;

/// The line of `start` with its tokens underlined. What would move the cursor of a terminal is
/// shown as a blank.
fn excerpt(start: LineColumn, end: LineColumn, text: &str) -> String {
    let Some(line) = text.lines().nth(start.line.saturating_sub(1)) else { return String::new() };
    let all: Vec<char> = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let first = if all.len() > WIDEST { start.column.saturating_sub(WIDEST / 3) } else { 0 };
    let shown: String = all.iter().skip(first).take(WIDEST).collect();
    let last = if end.line == start.line { end.column } else { all.len() };
    let blank = start.column - first;
    let width = last.saturating_sub(start.column).max(1);
    let width = width.min(WIDEST.saturating_sub(blank).max(1));
    let gutter = " ".repeat(start.line.to_string().len());
    format!(
        "{gutter} |\n{} | {shown}\n{gutter} | {}{}",
        start.line,
        " ".repeat(blank),
        "^".repeat(width)
    )
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n --> text:{}:{}", self.message, self.line, self.column)?;
        if self.excerpt.is_empty() { Ok(()) } else { write!(f, "\n{}", self.excerpt) }
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, mistake) in self.0.iter().enumerate() {
            write!(f, "{}{mistake}", if k == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

impl std::error::Error for Mistakes {}
