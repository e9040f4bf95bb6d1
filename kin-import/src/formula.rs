//! Reads laws as text, such as `0.5d + 0.3d*sin(2.0d*pi*time - pi/2.0d)`, and writes them in Kin's
//! language.

use std::f64::consts::PI;

use kin::Law;
use kin_graph::text::{
    self, Dialect, Infix, Language, Meaning, Mistake, Piece, Rust, Token, Tokens,
};
use kin_graph::{Function, Function2};
use kin_text::LawText;

/// Deeper formulas are refused.
const DEEPEST: usize = 200;

/// A formula of time.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    Number(f64),
    Time,
    Negative(Box<Formula>),
    /// `+ - * / ^`
    Two(char, Box<Formula>, Box<Formula>),
    Call(Function, Box<Formula>),
}

/// Functions as the files write them, and as Kin does.
const FUNCTIONS: [(&str, Function); 18] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("asin", Function::Asin),
    ("arcsin", Function::Asin),
    ("acos", Function::Acos),
    ("arccos", Function::Acos),
    ("atan", Function::Atan),
    ("arctan", Function::Atan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("log", Function::Ln),
    ("log10", Function::Log10),
    ("sqrt", Function::Sqrt),
    ("abs", Function::Abs),
];

impl Formula {
    /// Reads a formula and ignores remarks in quotes.
    ///
    /// Errors: Kin cannot read a part of the text; the error contains this part.
    pub fn read(text: &str) -> Result<Formula, String> {
        let text = text.split('"').step_by(2).collect::<Vec<&str>>().join(" ").replace("<n>", " ");
        check(&text)?;
        text::read(&text, &mut OfTime)
    }

    /// Returns the value of the formula, or `None` if the formula depends on time.
    pub fn constant(&self) -> Option<f64> {
        if let Formula::Number(value) = self { Some(*value) } else { None }
    }

    /// Returns the formula as a law of time.
    ///
    /// Errors: a number is not finite; the formula is too long.
    pub fn law(&self) -> Result<Law, String> {
        if let Some(value) = self.constant() {
            return match value.is_finite() {
                true => Ok(Law::constant(value)),
                false => Err(format!("the value is {value}")),
            };
        }
        let text = format!("fn law(time: f64) -> f64 {{ {} }}", self.printed().text);
        let read = LawText::read(&text).map_err(|mistakes| mistakes.to_string())?;
        read.law(&[]).map_err(|error| error.to_string())
    }

    /// Prints the formula in the language of laws.
    fn printed(&self) -> Piece {
        match self {
            Formula::Number(value) => Rust.number(*value),
            Formula::Time => Piece::atom("time"),
            Formula::Negative(inner) => Rust.negative(&inner.printed()),
            Formula::Two('^', base, power) => {
                let base = base.printed();
                match power.constant().filter(|n| n.fract() == 0.0 && n.abs() < 1e3) {
                    Some(n) => Rust.power(&base, n as i32),
                    None => Rust.call2(Function2::Powf, &base, &power.printed()),
                }
            }
            Formula::Two(sign, a, b) => {
                let operator = match sign {
                    '+' => Infix::Sum,
                    '-' => Infix::Difference,
                    '*' => Infix::Product,
                    _ => Infix::Quotient,
                };
                Rust.infix(&a.printed(), operator, &b.printed())
            }
            Formula::Call(function, inner) => Rust.call(*function, &inner.printed()),
        }
    }

    /// Two joined by a sign: computed where both are numbers, less where one is nothing.
    fn two(sign: char, a: Formula, b: Formula) -> Formula {
        match (sign, a.constant(), b.constant()) {
            ('+', Some(a), Some(b)) => Formula::Number(a + b),
            ('-', Some(a), Some(b)) => Formula::Number(a - b),
            ('*', Some(a), Some(b)) => Formula::Number(a * b),
            ('/', Some(a), Some(b)) => Formula::Number(a / b),
            ('^', Some(a), Some(b)) => Formula::Number(a.powf(b)),
            ('+', Some(0.0), None) => b,
            ('+' | '-', None, Some(0.0)) => a,
            ('*' | '/', Some(0.0), None) | ('*', None, Some(0.0)) => Formula::Number(0.0),
            _ => Formula::Two(sign, Box::new(a), Box::new(b)),
        }
    }

    fn call(function: Function, inner: Formula) -> Formula {
        match inner.constant() {
            Some(x) => Formula::Number(function.value()(x)),
            None => Formula::Call(function, Box::new(inner)),
        }
    }
}

/// The language of formulas in the files. A number may end in `d`, which begins an exponent where
/// digits follow (`1.0d-3`).
struct OfTime;

impl Language for OfTime {
    type Value = Formula;
    const SIGNS: &'static [char] = &['+', '-'];
    const POWER: bool = true;
    const DEEPEST: usize = DEEPEST - 1;

    fn number_length(text: &str) -> usize {
        let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let mantissa =
            if text[whole..].starts_with('.') { whole + 1 + digits(whole + 1) } else { whole };
        let rest = &text[mantissa..];
        if !rest.starts_with(['d', 'e', 'E']) {
            return mantissa;
        }
        let sign = usize::from(rest[1..].starts_with(['+', '-']));
        let length = match digits(mantissa + 1 + sign) {
            0 => mantissa,
            exponent => mantissa + 1 + sign + exponent,
        };
        length + usize::from(text[length..].starts_with('d'))
    }

    fn is_in_name(letter: char, first: bool) -> bool {
        letter.is_alphabetic() || !first && (letter.is_alphanumeric() || letter == '_')
    }

    fn words(mistake: Mistake<'_>) -> String {
        match mistake {
            Mistake::Ends => "the formula ends before a number or name".to_string(),
            Mistake::Unexpected(text) => {
                let word = value(text).map_or(text.to_string(), |value| value.to_string());
                format!("the formula has an unexpected `{word}`")
            }
            // The files have no quotes: `read` takes remarks out.
            Mistake::OpenBracket | Mistake::OpenQuote => "a bracket is not closed".to_string(),
            Mistake::Deep => format!("brackets are deeper than {DEEPEST}"),
        }
    }

    fn number(&mut self, text: &str) -> Result<Formula, String> {
        value(text).map(Formula::Number).ok_or_else(|| format!("`{text}` is not a number"))
    }

    fn name(&mut self, name: &str, called: bool) -> Result<Meaning<Formula>, String> {
        match name.to_ascii_lowercase().as_str() {
            "time" | "t" => Ok(Meaning::Value(Formula::Time)),
            "pi" => Ok(Meaning::Value(Formula::Number(PI))),
            lower if function(lower).is_none() => {
                Err(format!("Kin does not know `{name}` in a formula"))
            }
            _ if !called => Err(format!("`{name}` needs an argument in brackets")),
            _ => Ok(Meaning::Function),
        }
    }

    fn call(&mut self, name: &str, arguments: Vec<Formula>) -> Result<Formula, String> {
        let known = function(&name.to_ascii_lowercase());
        let argument = arguments.into_iter().next();
        let made = known.zip(argument).map(|(function, inner)| Formula::call(function, inner));
        made.ok_or_else(|| format!("Kin does not know `{name}` in a formula"))
    }

    fn negative(&mut self, a: Formula) -> Formula {
        match a {
            Formula::Number(value) => Formula::Number(-value),
            inner => Formula::Negative(Box::new(inner)),
        }
    }

    fn two(&mut self, a: Formula, operator: char, b: Formula) -> Formula {
        Formula::two(operator, a, b)
    }
}

/// Returns the function with this name in lower case.
fn function(name: &str) -> Option<Function> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

/// Returns the value of a number of the files.
fn value(text: &str) -> Option<f64> {
    text.trim_end_matches('d').replace('d', "e").parse().ok()
}

/// Checks all characters and numbers of a text before Kin reads it.
fn check(text: &str) -> Result<(), String> {
    for token in Tokens::<OfTime>::new(text) {
        match token {
            Token::Sign(sign) if !"+-*/^()".contains(sign) => {
                return Err(format!("Kin does not know `{sign}` in a formula"));
            }
            Token::Number(text) => OfTime.number(text).map(|_| ())?,
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_laws() {
        let at = |text: &str, t: f64| Formula::read(text).unwrap().law().unwrap().at(t);
        assert_eq!(at("2*pi*time", 0.25), PI / 2.0);
        let swing = at("(45.0d + 45.0d*sin((360.0d*time - 90.0d)*pi/180.0d))*pi/180.0d", 0.1);
        assert!(
            (swing - (45.0 + 45.0 * (-54.0_f64).to_radians().sin()).to_radians()).abs() < 1e-15
        );
        assert_eq!(at("-time^2 - (1 - -2)", 3.0), -12.0);
        assert_eq!(at("2^-1*time^0.5", 4.0), 1.0);
        assert_eq!(at("\"a remark (of T1\"<n>1.5e-1d*arctan(1000*(time - 2))<n>", 2.0), 0.0);
        assert_eq!(at("0*(time - 3) + 1.0e2", 7.0), 100.0);
        assert_eq!(at("time/(2 - 4)/2", 8.0), -2.0);
        assert_eq!(at("2^time - (-2)^2", 3.0), 4.0);
        assert_eq!(at("3 - -(-(time - 1))*(-2)", 3.0), 7.0);
        for (text, factor) in [
            ("1.0d-3", 1e-3),
            ("1d+2", 100.0),
            ("5d-1", 0.5),
            ("1.0d2", 100.0),
            ("2.5E-1d", 0.25),
            (".5d", 0.5),
        ] {
            assert_eq!(at(&format!("{text}*time"), 2.0), 2.0 * factor, "{text}");
        }
        assert_eq!(at("2.0d - 3.0d*time", 1.0), -1.0);
        assert_eq!(at("2.0d-time", 1.0), 1.0);
    }

    #[test]
    fn mistakes_in_formulas_are_told() {
        let told = |text: &str| Formula::read(text).unwrap_err();
        assert_eq!(told("2*speed"), "Kin does not know `speed` in a formula");
        assert_eq!(told("sin time"), "`sin` needs an argument in brackets");
        assert_eq!(told("(1 + time"), "a bracket is not closed");
        assert_eq!(told("1 + "), "the formula ends before a number or name");
        assert_eq!(told("1 time"), "the formula has an unexpected `time`");
        assert_eq!(told("1 $ 2"), "Kin does not know `$` in a formula");
        assert!(told(&"(".repeat(1000)).contains("deeper"));
        assert!(Formula::read("1/0").unwrap().law().is_err());
    }
}
