//! Finds places in a text of JSON.

use super::mistake::Step;

/// Returns the reason of an error without the place, which `serde_json` writes behind it.
pub(super) fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    text.strip_suffix(&place).unwrap_or(&text).to_string()
}

/// Returns the byte at which `serde_json` has found a mistake; its columns count bytes from 1.
pub(super) fn byte(text: &str, error: &serde_json::Error) -> usize {
    let before = text.split_inclusive('\n').take(error.line().saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    let mut at = (start + error.column().saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Returns line and column of a byte; both count from 1, columns in characters.
pub(super) fn line_and_column(text: &str, at: usize) -> [usize; 2] {
    let before = &text[..at];
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    [before.matches('\n').count() + 1, before[start..].chars().count() + 1]
}

/// Returns the byte at which the value at a path begins. The text is JSON.
pub(super) fn of(text: &str, path: &[Step]) -> usize {
    first(text, path)[1]
}

/// Returns the byte at which the key at a path begins. The text is JSON.
pub(super) fn of_key(text: &str, path: &[Step]) -> usize {
    first(text, path)[0]
}

/// Returns the bytes at which the key and the value at a path begin.
fn first(text: &str, path: &[Step]) -> [usize; 2] {
    let mut found = [0, 0];
    walk(text, |key, at, here| {
        if here == path {
            found = [key, at];
        }
        here != path
    });
    found
}

/// Returns the path of the innermost object or list around a byte. The text before it is JSON.
pub(super) fn around(text: &str, end: usize) -> Vec<Step> {
    walk(&text[..end], |_, _, _| true)
}

/// An object or a list around the place that is read.
struct Holder {
    /// The step to the value that is read; `None` before the first key.
    step: Option<Step>,
    is_object: bool,
    /// True where the next text is a key.
    before_key: bool,
    /// The byte at which the last key begins.
    key: usize,
}

/// Calls `visit` for each value in order until it returns false: with the bytes at which its key
/// and the value begin, and its path. Returns the path to the innermost object or list that is open
/// then.
fn walk(text: &str, mut visit: impl FnMut(usize, usize, &[Step]) -> bool) -> Vec<Step> {
    let mut holders: Vec<Holder> = Vec::new();
    let mut letters = text.char_indices().peekable();
    let mut is_in_word = false;
    while let Some((at, letter)) = letters.next() {
        let is_word = !(letter.is_whitespace() || "{}[],:\"".contains(letter));
        let begins = "{[\"".contains(letter) || (is_word && !is_in_word);
        is_in_word = is_word;
        let before_key = holders.last().is_some_and(|holder| holder.before_key);
        let key = holders.last().map_or(at, |holder| holder.key);
        if begins && !before_key && !visit(key, at, &steps(&holders)) {
            return steps(&holders);
        }
        match letter {
            '"' => {
                let mut is_escaped = false;
                let mut end = text.len();
                for (k, letter) in letters.by_ref() {
                    if letter == '"' && !is_escaped {
                        end = k + 1;
                        break;
                    }
                    is_escaped = letter == '\\' && !is_escaped;
                }
                if let Some(holder) = holders.last_mut().filter(|holder| holder.before_key) {
                    holder.key = at;
                    holder.step = serde_json::from_str(&text[at..end]).ok().map(Step::Key);
                }
            }
            '{' => holders.push(Holder { step: None, is_object: true, before_key: true, key: at }),
            '[' => {
                let step = Some(Step::Item(0));
                holders.push(Holder { step, is_object: false, before_key: false, key: at });
            }
            '}' | ']' => drop(holders.pop()),
            ':' | ',' => {
                let Some(holder) = holders.last_mut() else { continue };
                holder.before_key = holder.is_object && letter == ',';
                if let (',', Some(Step::Item(k))) = (letter, &mut holder.step) {
                    *k += 1;
                }
            }
            _ => {}
        }
    }
    holders.pop();
    steps(&holders)
}

/// The path to the innermost value.
fn steps(holders: &[Holder]) -> Vec<Step> {
    holders.iter().filter_map(|holder| holder.step.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_found_by_their_path() {
        let text = "{\"a\": [1, {\"b\\\"\": \"x, ]\"},\n 25],\n  \"ü\": {\"c\": null}}";
        let key = |key: &str| Step::Key(key.to_string());
        let found = |path: &[Step]| {
            let at = of(text, path);
            (text[at..].chars().next().unwrap_or(' '), line_and_column(text, at))
        };
        assert_eq!(found(&[]), ('{', [1, 1]));
        assert_eq!(found(&[key("a"), Step::Item(0)]), ('1', [1, 8]));
        assert_eq!(found(&[key("a"), Step::Item(1), key("b\"")]), ('"', [1, 19]));
        assert_eq!(found(&[key("a"), Step::Item(2)]), ('2', [2, 2]));
        assert_eq!(found(&[key("ü"), key("c")]), ('n', [3, 14]));
        let at = of_key(text, &[key("ü"), key("c")]);
        assert_eq!(line_and_column(text, at), [3, 9]);
        let open = text.find("x, ]").unwrap_or(0);
        assert_eq!(around(text, open), [key("a"), Step::Item(1)]);
        assert_eq!(around(text, 2), []);
    }
}
