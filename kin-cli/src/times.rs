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
                let n = count
                    .trim()
                    .parse::<usize>()
                    .map_err(|_| format!("`{count}` is no number of times"))?;
                if n == 0 || n > MOST {
                    return Err(format!("{n} times are too few or too many. Give 1 to {MOST}"));
                }
                let from = number(from)?;
                let to = number(to)?;
                if !(to - from).is_finite() {
                    return Err(format!(
                        "from {from:e} to {to:e} is further than the largest number, {:e}. Give times that are closer together",
                        f64::MAX
                    ));
                }
                Ok(Times(linspace(from, to, n)))
            }
            [list] => list.split(',').map(number).collect::<Result<_, _>>().map(Times),
            _ => {
                Err("write FROM:TO:COUNT, such as 0:1:361, or a list, such as 0,0.5,1".to_string())
            }
        }
    }
}

/// A finite number. Errors: none.
pub fn number(text: &str) -> Result<f64, String> {
    let parsed = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    parsed.ok_or_else(|| format!("`{text}` is no number"))
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
    fn what_is_none_is_told() {
        for (text, told) in [
            ("", "`` is no number"),
            ("0:1", "write FROM:TO:COUNT"),
            ("0:1:2:3", "write FROM:TO:COUNT"),
            ("0:1:0", "0 times"),
            ("0:1:-3", "`-3` is no number of times"),
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
