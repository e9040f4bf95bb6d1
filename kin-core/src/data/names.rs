//! Checks the names in files, because programs write these names to terminals, tables, pictures and
//! pages.

use crate::outcome::error::{Error, Result};

/// Returns the name, unless it contains a character that moves a terminal's cursor, breaks a line
/// or changes the direction of the surrounding text.
///
/// Errors: a name with such a character; the error contains the character's number.
pub(super) fn plain<'a>(what: &str, name: &'a str) -> Result<&'a str> {
    let Some(odd) = name.chars().find(|c| c.is_control() || turns_direction(*c)) else {
        return Ok(name);
    };
    let shown: String =
        name.chars().map(|c| if c.is_control() || turns_direction(c) { '·' } else { c }).collect();
    let reason = format!("its name has the control character {}. Remove it", odd.escape_unicode());
    Err(Error::Data { place: format!("{what} `{shown}`"), reason })
}

/// Returns true for marks that change the direction or the order of text.
fn turns_direction(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_any_script_are_plain_and_those_that_move_the_cursor_are_not() {
        for name in ["crank", "link 2", "Kurbel ü", "曲柄", "θ₁", "<b>&\"'"] {
            assert!(plain("body", name).is_ok(), "{name}");
        }
        for name in ["a\u{1b}[2J", "a\nb", "a\tb", "a\0", "a\u{9b}2J", "a\u{202e}b", "a\u{2028}b"] {
            let told = plain("body", name).err().map(|error| error.to_string()).unwrap_or_default();
            assert!(
                told.contains("control character") && !told.chars().any(char::is_control),
                "{told}"
            );
        }
    }
}
