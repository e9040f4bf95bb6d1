//! Reads expressions of dimensions from a file: `crank / 2`, `hypot(dx, dy)`.

use kin_graph::{Function, Function2};

use crate::dimensions::Dimension;
use crate::outcome::similar;

/// The largest depth of nested expressions. It keeps the recursive reader within the stack.
const DEEPEST: usize = 200;

/// Returns the number of the text; `named` looks up a dimension, and says which ones there are if
/// there is no such one. Errors: the mistake in words.
pub(super) fn read(
    text: &str,
    named: &mut dyn FnMut(&str) -> Result<Dimension, Vec<String>>,
) -> Result<Dimension, String> {
    let mut reader = Reader { rest: text, depth: 0, named };
    let number = reader.sum().and_then(|number| match reader.peek() {
        None => Ok(number),
        Some(c) => Err(format!("`{c}` is not allowed here")),
    });
    number.map_err(|reason| format!("the expression `{text}`: {reason}"))
}

/// The rest of a text, with the meaning of its names.
struct Reader<'a> {
    rest: &'a str,
    depth: usize,
    named: &'a mut dyn FnMut(&str) -> Result<Dimension, Vec<String>>,
}

impl<'a> Reader<'a> {
    /// Returns the next character that is no space.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    /// Takes the next character and returns true if it is this one.
    fn takes(&mut self, letter: char) -> bool {
        let there = self.peek() == Some(letter);
        if there {
            self.rest = &self.rest[letter.len_utf8()..];
        }
        there
    }

    /// Takes characters as long as the condition holds.
    fn word(&mut self, holds: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !holds(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    fn sum(&mut self) -> Result<Dimension, String> {
        let mut sum = self.product()?;
        loop {
            sum = match self.peek() {
                Some('+') if self.takes('+') => sum + self.product()?,
                Some('-') if self.takes('-') => sum - self.product()?,
                _ => return Ok(sum),
            };
        }
    }

    fn product(&mut self) -> Result<Dimension, String> {
        let mut product = self.signed()?;
        loop {
            product = match self.peek() {
                Some('*') if self.takes('*') => product * self.signed()?,
                Some('/') if self.takes('/') => product / self.signed()?,
                Some('%') if self.takes('%') => product % self.signed()?,
                _ => return Ok(product),
            };
        }
    }

    fn signed(&mut self) -> Result<Dimension, String> {
        let mut negative = false;
        while self.takes('-') {
            negative = !negative;
        }
        let number = self.single()?;
        Ok(if negative { -number } else { number })
    }

    fn single(&mut self) -> Result<Dimension, String> {
        match self.peek() {
            None => Err("a number must follow at the end of the expression".to_string()),
            Some('(') => self.bracketed(|reader| reader.sum()),
            Some('`') if self.takes('`') => {
                let name = self.word(|c| c != '`');
                if self.takes('`') {
                    self.look_up(name)
                } else {
                    Err("a closing ` is missing".to_string())
                }
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => {
                let name = self.word(|c| c.is_alphanumeric() || c == '_' || c == '.');
                if self.peek() == Some('(') { self.call(name) } else { self.look_up(name) }
            }
            Some(c) => Err(format!("`{c}` is not allowed here")),
        }
    }

    fn look_up(&mut self, name: &str) -> Result<Dimension, String> {
        (self.named)(name).map_err(|known| {
            let cure = match known[..] {
                [] => ". Declare it in `dimensions`".to_string(),
                _ => similar::cure(name, &known),
            };
            format!("there is no dimension `{name}`{cure}")
        })
    }

    fn number(&mut self) -> Result<Dimension, String> {
        let before = self.rest;
        self.word(|c| c.is_ascii_digit() || c == '.');
        if self.rest.starts_with(['e', 'E']) {
            self.rest = &self.rest[1..];
            if self.rest.starts_with(['+', '-']) {
                self.rest = &self.rest[1..];
            }
            self.word(|c| c.is_ascii_digit());
        }
        let text = &before[..before.len() - self.rest.len()];
        text.parse().map(|x: f64| x.into()).map_err(|_| format!("`{text}` is no number"))
    }

    /// Reads the content of brackets.
    fn bracketed<T>(
        &mut self,
        inside: impl FnOnce(&mut Self) -> Result<T, String>,
    ) -> Result<T, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("it is nested deeper than {DEEPEST} brackets"));
        }
        self.takes('(');
        let found = inside(self)?;
        self.depth -= 1;
        if self.takes(')') { Ok(found) } else { Err("a closing bracket is missing".to_string()) }
    }

    fn call(&mut self, name: &str) -> Result<Dimension, String> {
        let arguments = self.bracketed(|reader| {
            let mut all = vec![reader.sum()?];
            while reader.takes(',') {
                all.push(reader.sum()?);
            }
            Ok(all)
        })?;
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
