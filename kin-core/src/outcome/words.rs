//! Writes numbers, times and lists of names for messages.

use crate::coordinates::units::Units;

/// The name of the ground in results and messages. No body has it.
pub(crate) const GROUND: &str = "ground";

/// "3 equations", "1 equation".
pub(crate) fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

/// "2.4 GB", to three digits.
pub(crate) fn bytes(n: f64) -> String {
    let units = [(1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let (size, unit) = units.into_iter().find(|(size, _)| n >= *size).unwrap_or((1.0, "bytes"));
    let digits = 2 - ((n / size).max(1.0).log10().floor() as usize).min(2);
    format!("{:.digits$} {unit}", n / size)
}

/// Rounds a number, such as a time, to nine digits, without the noise of binary fractions.
pub(crate) fn time(t: f64) -> f64 {
    format!("{t:.8e}").parse().unwrap_or(t)
}

/// A time with its unit: "0.31 s".
pub(crate) fn at(t: f64, units: &Units) -> String {
    format!("{} {}", time(t), units.time())
}

/// The unit of a coordinate of a body behind its value: " rad" or " m"; nothing for a coordinate
/// whose name does not tell it.
pub(crate) fn of_coordinate(name: &str, length: &str) -> String {
    match name.rsplit_once('.').map(|(_, end)| end) {
        Some("theta") => " rad".to_string(),
        Some("R_x" | "R_y" | "R_z") if !length.is_empty() => format!(" {length}"),
        _ => String::new(),
    }
}

/// " row y", or nothing for a constraint of one row.
pub(crate) fn row(row: &str) -> String {
    if row.is_empty() { String::new() } else { format!(" row {row}") }
}

/// "`a`, `b` and `c`"; of a long list "`a`, `b` and 3 more".
pub(crate) fn list(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let mut all: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    if names.len() > SHOWN {
        all.push(format!("{} more", names.len() - SHOWN));
    }
    joined(&all, "and")
}

/// "a, b and c", with this word before the last text.
pub(crate) fn joined(texts: &[String], word: &str) -> String {
    match texts {
        [] => String::new(),
        [only] => only.clone(),
        [others @ .., last] => format!("{} {word} {last}", others.join(", ")),
    }
}

/// Three decimals, or three digits of what is smaller; as a power of ten where it is far from 1.
pub(crate) fn number(x: f64) -> String {
    with_digits(x, 0)
}

/// The same with so many more digits.
fn with_digits(x: f64, more: usize) -> String {
    let decimals = 3 + more;
    match x.abs() {
        size if size < 1e-12 => "0".to_string(),
        size if (0.1..1e4).contains(&size) => format!("{x:.decimals$}"),
        size if (1e-4..0.1).contains(&size) => {
            let decimals = (2.0 - size.log10().floor()) as usize + more;
            format!("{x:.decimals$}")
        }
        _ => format!("{x:.decimals$e}", decimals = 2 + more),
    }
}

/// Differences below this share of two numbers are rounding, which no text shows.   \[-\]
const ROUNDING: f64 = 1e-12;

/// Nor are those below this share of the largest difference of a list.   \[-\]
const BESIDE: f64 = 1e-2;

/// No text has more digits than these beyond the usual ones.
const MORE: usize = 14;

/// True if texts of two numbers differ by what the numbers do, to half of that difference.
fn tells_apart([a, b]: [f64; 2], [text, other]: [&str; 2]) -> bool {
    let difference = a - b;
    let [shown_a, shown_b] = [text, other].map(|text| text.parse().unwrap_or(f64::NAN));
    let shown: f64 = shown_a - shown_b;
    difference.abs() <= ROUNDING * a.abs().max(b.abs())
        || (shown - difference).abs() <= 0.5 * difference.abs()
}

/// Lists of numbers that a message compares, such as two points: every number has as many digits
/// as it takes to tell it from its partner, the usual ones at least ([`number`]).
pub(crate) fn apart(a: &[f64], b: &[f64]) -> [Vec<String>; 2] {
    let most = a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let with = |more: usize| [a, b].map(|all| -> Vec<String> { written(all, more) });
    let enough = |[texts, others]: &[Vec<String>; 2]| {
        let all = texts.iter().zip(others).zip(a.iter().zip(b));
        all.into_iter().all(|((text, other), (a, b))| {
            (a - b).abs() <= BESIDE * most || tells_apart([*a, *b], [text, other])
        })
    };
    (0..MORE).map(with).find(enough).unwrap_or_else(|| with(MORE))
}

/// Numbers of one list: what is only rounding beside the largest is zero.
fn written(all: &[f64], more: usize) -> Vec<String> {
    let largest = all.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let noise = 1e-6 * largest * 10.0_f64.powi(-(more.min(9) as i32));
    all.iter().map(|x| with_digits(if x.abs() < noise { 0.0 } else { *x }, more)).collect()
}

/// A number with four decimals, or four digits of what is smaller.
pub(crate) fn value(x: f64) -> String {
    let [text, _] = different(x, x);
    text
}

/// Two numbers with as many decimals as tell them apart, at least four decimals, or four digits of
/// what is smaller.
pub(crate) fn different(a: f64, b: f64) -> [String; 2] {
    let largest = a.abs().max(b.abs());
    let small = if (1e-12..0.1).contains(&largest) { -largest.log10().floor() } else { 1.0 };
    let least = 3 + small as usize;
    let with = |decimals: usize| [format!("{a:.decimals$}"), format!("{b:.decimals$}")];
    let enough = |[text, other]: &[String; 2]| tells_apart([a, b], [text, other]);
    (least..least + MORE).map(with).find(enough).unwrap_or_else(|| with(least + MORE))
}

/// "0.100 m", or the number alone if its unit is not known.
pub(crate) fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.to_string() } else { format!("{number} {unit}") }
}

/// A sentence that begins with a capital letter.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_differ_are_written_apart() {
        assert_eq!(different(1.77, 1.77003), ["1.77000", "1.77003"]);
        assert_eq!(different(2.0, 1.7893), ["2.0000", "1.7893"]);
        assert_eq!(different(0.5, 0.5), ["0.5000", "0.5000"]);
        assert_eq!([value(0.0), value(1.2e-5), value(-0.1)], ["0.0000", "0.00001200", "-0.1000"]);
        let [from, to] = apart(&[4.0, 0.0], &[4.0001, 0.0]);
        assert_eq!((from.join(", "), to.join(", ")), ("4.0000, 0".into(), "4.0001, 0".into()));
        // A bound with four digits is no other number for it.
        let [is, fits] = apart(&[0.1496], &[0.15]);
        assert_eq!((is.join(""), fits.join("")), ("0.1496".into(), "0.1500".into()));
        let [is, fits] = apart(&[1.0 + 5e-9], &[1.0]);
        assert_eq!((is.join(""), fits.join("")), ("1.000000005".into(), "1.000000000".into()));
        // Of two numbers, and of large, small and equal ones.
        for a in [1e-9, 3.2e-5, 0.02, 0.7, 25.0, 4000.0, 7.3e6] {
            for part in [0.3, 1e-3, 1e-6, 1e-9] {
                let b = a * (1.0 + part);
                let [from, to] = apart(&[a, 1.0], &[b, 1.0]);
                let shown = [&from[0], &to[0]].map(|text| text.parse::<f64>().unwrap());
                let share = (shown[1] - shown[0]) / (b - a);
                assert!((0.5..=1.5).contains(&share), "{a} {b}: {from:?} {to:?}");
                let [from, to] = different(a, b);
                assert!(from != to || a * part < 1e-18, "{a} {b}: {from} {to}");
            }
            assert_eq!(apart(&[a], &[a])[0], [number(a)]);
        }
    }

    #[test]
    fn lists_end_with_a_word() {
        let names = |count: usize| (1..=count).map(|k| format!("p{k}")).collect::<Vec<_>>();
        assert_eq!([list(&names(0)), list(&names(1))], ["", "`p1`"]);
        assert_eq!([list(&names(2)), list(&names(3))], ["`p1` and `p2`", "`p1`, `p2` and `p3`"]);
        assert!(list(&names(11)).ends_with("`p8` and 3 more"));
        assert_eq!(joined(&names(3), "or"), "p1, p2 or p3");
    }

    #[test]
    fn what_is_rounding_beside_other_numbers_is_zero() {
        let [point, other] = apart(&[2.0, 1e-15], &[3.0, -1e-9]);
        assert_eq!((point.join(", "), other.join(", ")), ("2.000, 0".into(), "3.000, 0".into()));
        assert_eq!(number(0.0), "0");
        assert_eq!(capital("éa `b`."), "Éa `b`.");
    }
}
