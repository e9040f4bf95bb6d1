//! Mistakes of the user. The macro collects them, so that one compilation shows all of them, each
//! at its token.

use proc_macro2::Span;
use quote::ToTokens;

/// Makes an error at `tokens`.
pub fn mistake(tokens: &dyn ToTokens, message: impl std::fmt::Display) -> syn::Error {
    syn::Error::new_spanned(tokens.to_token_stream(), message)
}

/// Returns the message for an integer k (a literal such as `2`, or a name) at a place that needs a
/// number.
pub fn integer_for_a_number(tokens: &dyn ToTokens, k: i64) -> String {
    let text = tidy_text(tokens);
    if text.trim_start_matches('-').starts_with(|first: char| first.is_ascii_digit()) {
        return format!("`{text}` is an integer: write the number `{k}.0`");
    }
    let is_one = tokens.to_token_stream().into_iter().count() == 1;
    let of = if is_one { text.clone() } else { format!("({text})") };
    format!("`{text}` is an integer: write `{of} as f64` for a number")
}

/// Returns the text of tokens without the blanks that nobody writes.
pub fn tidy_text(tokens: &dyn ToTokens) -> String {
    tidy(&tokens.to_token_stream().to_string())
}

/// Returns the text of a token stream without the blanks that nobody writes.
pub fn tidy(text: &str) -> String {
    let mut text = text.to_owned();
    for (from, to) in [
        (" . ", "."),
        (" (", "("),
        ("( ", "("),
        (" )", ")"),
        (" ,", ","),
        ("[ ", "["),
        (" ]", "]"),
        (" [", "["),
        ("& ", "&"),
        (" :: ", "::"),
    ] {
        text = text.replace(from, to);
    }
    text
}

/// All mistakes found so far.
#[derive(Default)]
pub struct Mistakes(Option<syn::Error>);

impl Mistakes {
    /// Adds a mistake at `tokens`.
    pub fn add(&mut self, tokens: &dyn ToTokens, message: impl std::fmt::Display) {
        self.push(mistake(tokens, message));
    }

    /// Adds an error, unless another turn of a loop has already added it for the same tokens.
    pub fn push(&mut self, error: syn::Error) {
        let said = |known: &syn::Error| {
            let a = known.span().start();
            let b = error.span().start();
            (a.line, a.column) == (b.line, b.column) && known.to_string() == error.to_string()
        };
        match &mut self.0 {
            Some(all) if all.clone().into_iter().any(|known| said(&known)) => {}
            Some(all) => all.combine(error),
            none => *none = Some(error),
        }
    }

    /// Returns the value, or keeps the mistake and returns `None`.
    pub fn catch<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    /// Returns all mistakes as one error, or `Ok` if there are none.
    pub fn finish(self) -> syn::Result<()> {
        self.0.map_or(Ok(()), Err)
    }

    pub fn into_error(self) -> syn::Error {
        self.0.unwrap_or_else(|| syn::Error::new(Span::call_site(), "unknown mistake"))
    }
}

/// An expression that may be good Rust, but that the interpreter cannot read.
pub struct Unreadable {
    pub span: Span,
    pub what: String,
}

impl Unreadable {
    pub fn new(at: &dyn ToTokens, what: impl Into<String>) -> Self {
        Unreadable { span: first_span(at), what: what.into() }
    }
}

/// Returns the span at which an expression begins.
pub fn first_span(at: &dyn ToTokens) -> Span {
    at.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| token.span())
}

/// Returns a message such as "`vec2` takes 2 numbers, not 1".
pub fn counted(what: &str, takes: usize, of: &str, given: usize) -> String {
    format!("{what} takes {takes} {of}{}, not {given}", if takes == 1 { "" } else { "s" })
}
