//! The list of mutants that may live, each with its reason.
//!
//! A line that is not indented names a mutant; indented lines below one or several of them are the
//! reason for all of these. Lines that begin with `#` are headings. `*` instead of the last part of
//! a name means every change of that place.

use std::collections::BTreeMap;

use crate::Result;

/// The mutants of a list, and their reasons.
pub fn read(text: &str) -> Result<BTreeMap<String, String>> {
    let mut listed: BTreeMap<String, String> = BTreeMap::new();
    let (mut open, mut reason): (Vec<&str>, String) = (Vec::new(), String::new());
    for line in
        text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')).chain(["end"])
    {
        if line.starts_with(char::is_whitespace) {
            reason = format!("{reason} {}", line.trim()).trim().to_string();
            continue;
        }
        if !reason.is_empty() {
            listed.extend(open.drain(..).map(|key| (key.to_string(), reason.clone())));
            reason.clear();
        }
        open.push(line.trim_end());
    }
    open.pop();
    if open.is_empty() {
        Ok(listed)
    } else {
        Err(format!("listed without a reason: {}", open.join("\n")).into())
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_reason_holds_for_all_mutants_above_it() {
        let listed =
            super::read("# heading\na | b\nc | d\n  one\n  reason\n\ne | f\n  another\n").unwrap();
        let found: Vec<(&str, &str)> =
            listed.iter().map(|(key, reason)| (key.as_str(), reason.as_str())).collect();
        assert_eq!(found, [("a | b", "one reason"), ("c | d", "one reason"), ("e | f", "another")]);
        assert!(super::read("a | b\n").is_err());
    }
}
