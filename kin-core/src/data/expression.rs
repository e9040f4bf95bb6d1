//! Reads expressions of dimensions from a file: `crank / 2`, `hypot(dx, dy)`.

use kin_graph::text::{self, Language, Meaning, Mistake};
use kin_graph::{Function, Function2};

use crate::dimensions::Dimension;
use crate::outcome::similar;

/// Returns the number of the text; `named` looks up a dimension, and says which ones there are if
/// there is no such one. Errors: the mistake in words.
pub(super) fn read(
    text: &str,
    named: &mut dyn FnMut(&str) -> Result<Dimension, Vec<String>>,
) -> Result<Dimension, String> {
    text::read(text, &mut Dimensions { named })
        .map_err(|reason| format!("the expression `{text}`: {reason}"))
}

/// Expressions of dimensions, with the meaning of their names.
struct Dimensions<'a> {
    named: &'a mut dyn FnMut(&str) -> Result<Dimension, Vec<String>>,
}

impl Language for Dimensions<'_> {
    type Value = Dimension;
    const REMAINDER: bool = true;
    const QUOTES: bool = true;
    const DEEPEST: usize = 200;

    fn number_length(text: &str) -> usize {
        let count =
            |text: &str, holds: fn(char) -> bool| text.find(|c| !holds(c)).unwrap_or(text.len());
        let mantissa = count(text, |c| c.is_ascii_digit() || c == '.');
        if !text[mantissa..].starts_with(['e', 'E']) {
            return mantissa;
        }
        let exponent = &text[mantissa + 1..];
        let sign = usize::from(exponent.starts_with(['+', '-']));
        mantissa + 1 + sign + count(&exponent[sign..], |c| c.is_ascii_digit())
    }

    fn is_in_name(letter: char, first: bool) -> bool {
        let begins = letter.is_alphabetic() || letter == '_';
        begins || !first && (letter.is_alphanumeric() || letter == '.')
    }

    fn words(mistake: Mistake<'_>) -> String {
        match mistake {
            Mistake::Ends => "a number must follow at the end of the expression".to_string(),
            Mistake::Unexpected(text) => {
                let first = text.chars().next().unwrap_or_default();
                format!("`{first}` is not allowed here")
            }
            Mistake::OpenBracket => "a closing bracket is missing".to_string(),
            Mistake::OpenQuote => "a closing ` is missing".to_string(),
            Mistake::Deep => format!("it is nested deeper than {} brackets", Self::DEEPEST),
        }
    }

    fn number(&mut self, text: &str) -> Result<Dimension, String> {
        text.parse().map(|x: f64| x.into()).map_err(|_| format!("`{text}` is no number"))
    }

    fn name(&mut self, name: &str, called: bool) -> Result<Meaning<Dimension>, String> {
        if called {
            return Ok(Meaning::Function);
        }
        (self.named)(name).map(Meaning::Value).map_err(|known| {
            let cure = match known[..] {
                [] => ". Declare it in `dimensions`".to_string(),
                _ => similar::cure(name, &known),
            };
            format!("there is no dimension `{name}`{cure}")
        })
    }

    fn call(&mut self, name: &str, arguments: Vec<Dimension>) -> Result<Dimension, String> {
        let one = Function::from_method(name);
        let two = Function2::from_method(name);
        match (arguments.as_slice(), one, two) {
            ([a], Some(f), _) => Ok(a.call(f)),
            ([a, b], _, Some(f)) => Ok(a.call2(f, *b)),
            ([a, n], ..) if name == "powi" && n.value().fract() == 0.0 && n.value().abs() < 1e9 => {
                Ok(a.powi(n.value() as i32))
            }
            (_, None, None) => {
                let one = Function::ALL.iter().map(|function| function.method());
                let two = Function2::ALL.iter().map(|function| function.method());
                let all: Vec<String> = one.chain(two).chain(["powi"]).map(str::to_string).collect();
                Err(format!("there is no function `{name}`{}", similar::cure(name, &all)))
            }
            (all, ..) => Err(format!("`{name}` does not take {} numbers", all.len())),
        }
    }

    fn negative(&mut self, a: Dimension) -> Dimension {
        -a
    }

    fn two(&mut self, a: Dimension, operator: char, b: Dimension) -> Dimension {
        match operator {
            '+' => a + b,
            '-' => a - b,
            '*' => a * b,
            '/' => a / b,
            _ => a % b,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let named = |name: &str| {
            [("a", 3.0), ("O.x", 4.0), ("link 2", 0.5)].iter().find(|known| known.0 == name)
        };
        let known = || ["a", "O.x", "link 2"].map(str::to_string).to_vec();
        let mut number = |name: &str| named(name).map(|(_, x)| (*x).into()).ok_or_else(known);
        read(text, &mut number).map(Dimension::value)
    }

    #[test]
    fn expressions_have_the_value_that_they_have_on_paper() {
        for (text, expected) in [
            ("a", 3.0),
            ("2 + a * O.x / 2 - 1.5e0", 6.5),
            ("-a - -1", -2.0),
            ("(a - 1) - (O.x - 1)", -1.0),
            ("hypot(a, O.x) + `link 2`", 5.5),
            ("powi(a, -1) * a", 1.0),
            ("8 / O.x / 2", 1.0),
            ("7 % O.x", 3.0),
            ("max(a, O.x)", 4.0),
        ] {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn slips_are_told_and_nesting_ends() {
        for (text, told) in [
            ("b", "there is no dimension `b`. Use one of `a`, `O.x` and `link 2`"),
            ("link2", "there is no dimension `link2`. Did you mean `link 2`? Use one of `link 2`"),
            ("hypott(a, a)", "no function `hypott`. Did you mean `hypot`? Use one of `hypot`, "),
            ("a +", "must follow at the end"),
            ("(a", "closing bracket"),
            ("sin(a, a)", "does not take 2 numbers"),
            ("wave(a)", "no function `wave`"),
            ("1.2.3", "`1.2.3` is no number"),
            ("a b", "`b` is not allowed"),
            ("`a", "closing `"),
            ("", "must follow at the end"),
            ("é", "there is no dimension"),
            ("€", "not allowed"),
        ] {
            assert!(
                value(text).is_err_and(|reason| reason.contains(told)),
                "{text}: {:?}",
                value(text)
            );
        }
        assert!(
            value(&"(".repeat(1_000_000)).is_err_and(|reason| reason.contains("nested deeper"))
        );
        assert_eq!(value(&format!("{}a", "-".repeat(1_000_000))), Ok(3.0));
    }
}
