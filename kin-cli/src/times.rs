//! Times as text: `FROM:TO:COUNT`, or a list.

use std::str::FromStr;

use kin::linspace;

/// Times of a run.   \[s\]
#[derive(Clone, Debug, PartialEq)]
pub struct Times(pub Vec<f64>);

/// More are not written on one command line.
const MOST: usize = 100_000_000;

impl FromStr for Times {
    type Err = String;

    /// `0:1:361` is 361 times from 0 to 1, bit for bit those of `linspace(0.0, 1.0, 361)`;
    /// `0,0.5,1` are three times. Errors: what is no time, and a span that is no number.
    fn from_str(text: &str) -> Result<Times, String> {
        let parts: Vec<&str> = text.split(':').collect();
        match parts[..] {
            [from, to, count] => {
                let from = time(from)?;
                let to = time(to)?;
                let n = count.trim().parse::<usize>().map_err(|_| no_count(count, to - from))?;
                if n == 0 || n > MOST {
                    return Err(format!("{n} times are too few or too many. Give 1 to {MOST}"));
                }
                if !(to - from).is_finite() {
                    return Err(format!(
                        "from {from:e} to {to:e} is further than the largest number, {:e}. Give times that are closer together",
                        f64::MAX
                    ));
                }
                Ok(Times(linspace(from, to, n)))
            }
            [list] => list.split(',').map(time).collect::<Result<_, _>>().map(Times),
            _ => {
                Err("write FROM:TO:COUNT, such as 0:1:361, or a list, such as 0,0.5,1".to_string())
            }
        }
    }
}

/// The reason for a third part of `FROM:TO:COUNT` that is no count. Of a step it names the count.
fn no_count(text: &str, span: f64) -> String {
    let what = format!("`{}` is no number of times", text.trim());
    let step = leading_number(text.trim()).map(|(step, _)| step);
    let count = step.map(|step| (span / step).abs().round() + 1.0);
    match count.filter(|n| n.is_finite() && *n <= MOST as f64) {
        Some(n) => format!(
            "{what}. The third part of FROM:TO:COUNT counts the times: for this step it is {n}"
        ),
        None => format!("{what}. Write a whole number from 1 on, such as 361"),
    }
}

/// A time. Errors: no finite number, with the unit of times.
pub fn time(text: &str) -> Result<f64, String> {
    let unit = "Times have no unit behind them: they are in s, or in the file's own unit of time";
    number(text).map_err(|reason| format!("{reason}. {unit}"))
}

/// A number without a unit, such as a share. Errors: no finite number.
pub fn plain(text: &str) -> Result<f64, String> {
    number(text).map_err(|reason| format!("{reason}. This number has no unit"))
}

/// A count. Errors: no whole number from 0 on.
pub fn count(text: &str) -> Result<usize, String> {
    whole(text)
}

/// The seed of random numbers. Errors: no whole number from 0 on.
pub fn seed(text: &str) -> Result<u64, String> {
    whole(text)
}

fn whole<T: FromStr>(text: &str) -> Result<T, String> {
    let parsed = text.trim().parse();
    parsed.map_err(|_| format!("`{text}` is no whole number. Write one from 0 on, such as 1000"))
}

/// A finite number. Errors: none, with the way to write it.
pub fn number(text: &str) -> Result<f64, String> {
    let trimmed = text.trim();
    let parsed = trimmed.parse::<f64>().ok().filter(|x| x.is_finite());
    parsed.ok_or_else(|| format!("`{text}` is no number. {}", written(trimmed)))
}

/// How a number is written, in place of a text that is none.
fn written(text: &str) -> String {
    let point = text.replace(',', ".");
    if text.matches(',').count() == 1 && point.parse::<f64>().is_ok() {
        return format!("Write a decimal point, {point}");
    }
    match leading_number(text) {
        Some((x, "°" | "deg" | "degrees")) => {
            format!("Angles are in radians: write {}", x.to_radians())
        }
        Some((x, rest)) if rest.chars().all(|c| c.is_alphabetic() || c == 'µ') => {
            format!("Write the number alone, without `{rest}`: {x}")
        }
        _ => "Write it like 0.5, -2 or 1e-3".to_string(),
    }
}

/// The number with which a text begins, and the rest, which is not empty of a text that is no
/// number.
fn leading_number(text: &str) -> Option<(f64, &str)> {
    let ends = (1..=text.len()).rev().filter(|end| text.is_char_boundary(*end));
    let mut found = ends.take(64).filter_map(|end| {
        let x = text[..end].trim().parse::<f64>().ok().filter(|x| x.is_finite())?;
        Some((x, text[end..].trim()))
    });
    found.next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_that_of_linspace_bit_for_bit() {
        let bits = |all: &[f64]| -> Vec<u64> { all.iter().map(|t| t.to_bits()).collect() };
        for (text, (a, b, n)) in [
            ("0:1:361", (0.0, 1.0, 361)),
            ("0.1:24:241", (0.1, 24.0, 241)),
            ("1e-3:-2.5:7", (1e-3, -2.5, 7)),
            (" 2 : 3 : 1 ", (2.0, 3.0, 1)),
            ("0:6.283185307179586:361", (0.0, std::f64::consts::TAU, 361)),
        ] {
            let Times(times) = text.parse().expect("times");
            assert_eq!(bits(&times), bits(&linspace(a, b, n)), "{text}");
        }
        assert_eq!("0,0.5,1".parse(), Ok(Times(vec![0.0, 0.5, 1.0])));
        assert_eq!("3".parse(), Ok(Times(vec![3.0])));
    }

    #[test]
    fn a_number_is_told_as_it_is_written() {
        for (text, told) in [
            ("abc", "`abc` is no number. Write it like 0.5, -2 or 1e-3"),
            ("0,5", "`0,5` is no number. Write a decimal point, 0.5"),
            ("90°", "Angles are in radians: write 1.5707963267948966"),
            ("90 deg", "Angles are in radians: write 1.5707963267948966"),
            ("12mm", "Write the number alone, without `mm`: 12"),
            ("1/2", "`1/2` is no number. Write it like 0.5"),
            ("nan", "`nan` is no number. Write it like 0.5"),
            ("", "`` is no number. Write it like 0.5"),
        ] {
            let found = number(text).expect_err(text);
            assert!(found.contains(told), "{text}: {found}");
        }
        let long = "é".repeat(100_000);
        assert!(number(&long).is_err());
    }

    #[test]
    fn what_is_none_is_told() {
        for (text, told) in [
            ("", "`` is no number"),
            ("0:1", "write FROM:TO:COUNT"),
            ("0:1:2:3", "write FROM:TO:COUNT"),
            ("0:1:0", "0 times"),
            ("0:1:-3", "`-3` is no number of times"),
            (
                "0:1:0.1s",
                "`0.1s` is no number of times. The third part of FROM:TO:COUNT counts the times: for this step it is 11",
            ),
            ("0:1:many", "`many` is no number of times. Write a whole number from 1 on"),
            (
                "0:1s:3",
                "`1s` is no number. Write the number alone, without `s`: 1. Times have no unit",
            ),
            ("0;1", "`0;1` is no number. Write it like 0.5, -2 or 1e-3"),
            ("0:x:3", "`x` is no number"),
            ("0:inf:3", "`inf` is no number"),
            ("0:1:1000000000000", "1000000000000 times are too few or too many. Give 1 to"),
            ("1e308:-1e308:3", "from 1e308 to -1e308 is further than the largest number"),
        ] {
            let found = text.parse::<Times>().expect_err(text);
            assert!(found.contains(told), "{text}: {found}");
        }
    }
}
