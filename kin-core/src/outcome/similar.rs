//! Finds the known names that are most similar to a name that nothing has.

use crate::outcome::words::list;

/// The edit distance looks at so many characters of a name. Names in files have any length.
const COMPARED: usize = 64;

/// Returns the cure for a name that nothing has: the name that is probably meant, and the known
/// names, the most similar one first. The text is empty if there are no names.
///
/// ". Did you mean \`crank\`? Use one of \`crank\`, \`rod\`"
pub(crate) fn cure(name: &str, known: &[String]) -> String {
    match known {
        [] => String::new(),
        [only] => format!(". Use `{only}`"),
        all => {
            let meant = meant(name, all).map(|meant| format!(" Did you mean `{meant}`?"));
            let sorted = nearest_first(name, all.iter().cloned());
            format!(".{} Use one of {}", meant.unwrap_or_default(), list(&sorted))
        }
    }
}

/// Returns the names, the most similar one first. If no name is similar, the order stays.
pub(crate) fn nearest_first(name: &str, known: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut all: Vec<(usize, String)> =
        known.into_iter().map(|other| (ranked(name, &other), other)).collect();
    all.sort_by_key(|(distance, _)| *distance);
    all.into_iter().map(|(_, other)| other).collect()
}

/// Returns the one name that is so similar that it is probably meant. Returns `None` if there is
/// none, or if two names are equally similar.
pub(crate) fn meant<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let nearest = known.iter().min_by_key(|other| distance(name, other))?;
    let least = distance(name, nearest);
    let is_one = known.iter().filter(|other| distance(name, other) == least).count() == 1;
    (is_one && is_similar(name, least)).then_some(nearest)
}

/// True if at most a third of the characters of the name differ, and one does not.
fn is_similar(name: &str, distance: usize) -> bool {
    let length = name.chars().count();
    distance <= length.div_ceil(3) && distance < length.max(1)
}

/// The edit distance of similar names, and one distance for all others.
fn ranked(name: &str, other: &str) -> usize {
    let distance = distance(name, other);
    if is_similar(name, distance) { distance } else { usize::MAX }
}

/// Returns the number of characters to insert, remove, replace or swap with their neighbour
/// (optimal string alignment) without regard to case.
fn distance(a: &str, b: &str) -> usize {
    let letters =
        |text: &str| -> Vec<char> { text.to_lowercase().chars().take(COMPARED).collect() };
    let a = letters(a);
    let b = letters(b);
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            let is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if is_swap {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(name: &str, known: &[&str]) -> String {
        cure(name, &known.iter().map(|one| one.to_string()).collect::<Vec<String>>())
    }

    #[test]
    fn distances_count_edits_without_regard_to_case() {
        for (a, b, expected) in [
            ("", "", 0),
            ("crank", "crank", 0),
            ("Crank", "crank", 0),
            ("crnk", "crank", 1),
            ("carnk", "crank", 1),
            ("", "rod", 3),
            ("θ", "theta", 5),
        ] {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
    }

    #[test]
    fn the_most_similar_name_is_the_first() {
        let known = ["rod", "slider", "crank"];
        let expected = ". Did you mean `crank`? Use one of `crank`, `rod` and `slider`";
        assert_eq!(report("crnk", &known), expected);
        assert_eq!(report("wheel", &known), ". Use one of `rod`, `slider` and `crank`");
        assert_eq!(report("pin.z", &["pin.x", "pin.y"]), ". Use one of `pin.x` and `pin.y`");
        assert_eq!(report("b", &["a", "link"]), ". Use one of `a` and `link`");
        assert_eq!(report("crnk", &["crank"]), ". Use `crank`");
        assert_eq!(report("crnk", &[]), "");
    }

    #[test]
    fn at_most_eight_names_are_listed() {
        let all: Vec<String> = (0..20).map(|k| format!("body {k}")).collect();
        let report = cure("crank", &all);
        assert!(report.ends_with("`body 7` and 12 more"), "{report}");
    }

    #[test]
    fn long_names_take_no_long_time() {
        let long = "x".repeat(1_000_000);
        assert!(cure(&long, &[long.clone(), "a".to_string()]).contains("`a`"));
    }
}
