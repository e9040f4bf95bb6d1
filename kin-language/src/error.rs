//! Mistakes of the user: collected, so that one compilation shows them all, each at its own token.

use quote::ToTokens;

/// A mistake at `tokens`.
pub fn mistake(tokens: &dyn ToTokens, message: impl std::fmt::Display) -> syn::Error {
    syn::Error::new_spanned(tokens.to_token_stream(), message)
}

/// An integer k where a number is wanted, as it is written: `2`, or a name for one.
pub fn integer_for_a_number(tokens: &dyn ToTokens, k: i64) -> String {
    let text = tidy(&tokens.to_token_stream().to_string());
    if text.trim_start_matches('-').starts_with(|first: char| first.is_ascii_digit()) {
        return format!("`{text}` is an integer; a number is written `{k}.0`");
    }
    let is_one = tokens.to_token_stream().into_iter().count() == 1;
    let of = if is_one { text.clone() } else { format!("({text})") };
    format!("`{text}` is an integer; as a number it is `{of} as f64`")
}

/// A token stream's text without the blanks that nobody writes.
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
    /// A mistake at `tokens`.
    pub fn add(&mut self, tokens: &dyn ToTokens, message: impl std::fmt::Display) {
        self.push(mistake(tokens, message));
    }

    /// Adds an error, but for one that has been said already of the same tokens, in another turn of
    /// a loop.
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

    /// The value, or `None` with its mistake kept.
    pub fn catch<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    /// All of them as one error, if there are any.
    pub fn finish(self) -> syn::Result<()> {
        self.0.map_or(Ok(()), Err)
    }

    pub fn into_error(self) -> syn::Error {
        self.0.unwrap_or_else(|| syn::Error::new(proc_macro2::Span::call_site(), "unknown mistake"))
    }
}
