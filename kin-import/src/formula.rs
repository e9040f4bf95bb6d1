//! Reads laws as text, such as `0.5d + 0.3d*sin(2.0d*pi*time - pi/2.0d)`, and writes them in Kin's
//! language.

use std::f64::consts::PI;

use kin::Law;
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
    /// A method of f64 by its name.
    Call(&'static str, Box<Formula>),
}

/// Functions as the files write them, and as Kin does.
const FUNCTIONS: [(&str, &str); 18] = [
    ("sin", "sin"),
    ("cos", "cos"),
    ("tan", "tan"),
    ("asin", "asin"),
    ("arcsin", "asin"),
    ("acos", "acos"),
    ("arccos", "acos"),
    ("atan", "atan"),
    ("arctan", "atan"),
    ("sinh", "sinh"),
    ("cosh", "cosh"),
    ("tanh", "tanh"),
    ("exp", "exp"),
    ("ln", "ln"),
    ("log", "ln"),
    ("log10", "log10"),
    ("sqrt", "sqrt"),
    ("abs", "abs"),
];

impl Formula {
    /// Reads a formula and ignores remarks in quotes.
    ///
    /// Errors: Kin cannot read a part of the text; the error contains this part.
    pub fn read(text: &str) -> Result<Formula, String> {
        let mut reader = Reader { tokens: tokens(text)?, at: 0, depth: 0 };
        let formula = reader.sum()?;
        match reader.tokens.get(reader.at) {
            None => Ok(formula),
            Some(token) => Err(format!("the formula has an unexpected `{}`", token.word())),
        }
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
        let text = format!("fn law(time: f64) -> f64 {{ {} }}", self.written(0));
        let read = LawText::read(&text).map_err(|mistakes| mistakes.to_string())?;
        read.law(&[]).map_err(|error| error.to_string())
    }

    /// The text in Kin's language; in brackets where something stronger binds it.
    fn written(&self, stronger: u8) -> String {
        let (binds, text) = match self {
            Formula::Number(value) if *value < 0.0 => (2, format!("{value:?}")),
            Formula::Number(value) => (4, format!("{value:?}")),
            Formula::Time => (4, "time".to_string()),
            Formula::Negative(inner) => (2, format!("-{}", inner.written(3))),
            Formula::Two('^', base, power) => {
                let base = base.written(4);
                let power = power.as_ref();
                match power.constant().filter(|n| n.fract() == 0.0 && n.abs() < 1e3) {
                    Some(n) => (4, format!("{base}.powi({n})")),
                    None => (4, format!("{base}.powf({})", power.written(0))),
                }
            }
            Formula::Two(sign, a, b) => {
                let binds = if matches!(sign, '+' | '-') { 1 } else { 2 };
                (binds, format!("{} {sign} {}", a.written(binds), b.written(binds + 1)))
            }
            Formula::Call(name, inner) => (4, format!("{}.{name}()", inner.written(4))),
        };
        if binds < stronger { format!("({text})") } else { text }
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

    fn call(name: &'static str, inner: Formula) -> Formula {
        let Some(x) = inner.constant() else { return Formula::Call(name, Box::new(inner)) };
        Formula::Number(match name {
            "sin" => x.sin(),
            "cos" => x.cos(),
            "tan" => x.tan(),
            "asin" => x.asin(),
            "acos" => x.acos(),
            "atan" => x.atan(),
            "sinh" => x.sinh(),
            "cosh" => x.cosh(),
            "tanh" => x.tanh(),
            "exp" => x.exp(),
            "ln" => x.ln(),
            "log10" => x.log10(),
            "sqrt" => x.sqrt(),
            _ => x.abs(),
        })
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    Sign(char),
}

impl Token {
    fn word(&self) -> String {
        match self {
            Token::Number(value) => value.to_string(),
            Token::Name(name) => name.clone(),
            Token::Sign(sign) => sign.to_string(),
        }
    }
}

/// Numbers, names and signs. A number may end in `d`, which begins an exponent where digits follow
/// (`1.0d-3`); `<n>` is a new line.
fn tokens(text: &str) -> Result<Vec<Token>, String> {
    let text: String =
        text.split('"').step_by(2).collect::<Vec<&str>>().join(" ").replace("<n>", " ");
    let mut rest = text.trim_start();
    let mut all = Vec::new();
    while let Some(first) = rest.chars().next() {
        let length = if first.is_ascii_digit() || first == '.' {
            number_length(rest)
        } else if first.is_alphabetic() {
            rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (word, after) = rest.split_at(length);
        all.push(match first {
            '0'..='9' | '.' => {
                let value = word.trim_end_matches('d').replace('d', "e").parse::<f64>();
                Token::Number(value.map_err(|_| format!("`{word}` is not a number"))?)
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' => Token::Sign(first),
            _ if first.is_alphabetic() => Token::Name(word.to_string()),
            _ => return Err(format!("Kin does not know `{first}` in a formula")),
        });
        rest = after.trim_start();
    }
    Ok(all)
}

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

struct Reader {
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

impl Reader {
    fn takes(&mut self, signs: &[char]) -> Option<char> {
        match self.tokens.get(self.at) {
            Some(Token::Sign(sign)) if signs.contains(sign) => {
                self.at += 1;
                Some(*sign)
            }
            _ => None,
        }
    }

    fn sum(&mut self) -> Result<Formula, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("brackets are deeper than {DEEPEST}"));
        }
        let mut left = self.product()?;
        while let Some(sign) = self.takes(&['+', '-']) {
            left = Formula::two(sign, left, self.product()?);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn product(&mut self) -> Result<Formula, String> {
        let mut left = self.signed()?;
        while let Some(sign) = self.takes(&['*', '/']) {
            left = Formula::two(sign, left, self.signed()?);
        }
        Ok(left)
    }

    fn signed(&mut self) -> Result<Formula, String> {
        let mut negative = false;
        while let Some(sign) = self.takes(&['+', '-']) {
            negative ^= sign == '-';
        }
        let inner = self.power()?;
        Ok(match (negative, inner) {
            (false, inner) => inner,
            (true, Formula::Number(value)) => Formula::Number(-value),
            (true, inner) => Formula::Negative(Box::new(inner)),
        })
    }

    fn power(&mut self) -> Result<Formula, String> {
        let base = self.atom()?;
        match self.takes(&['^']) {
            Some(_) => {
                let sign = self.takes(&['-']);
                let power = self.atom()?;
                let power = if sign.is_some() {
                    Formula::two('*', Formula::Number(-1.0), power)
                } else {
                    power
                };
                Ok(Formula::two('^', base, power))
            }
            None => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Formula, String> {
        let token =
            self.tokens.get(self.at).cloned().ok_or("the formula ends before a number or name")?;
        self.at += 1;
        match token {
            Token::Number(value) => Ok(Formula::Number(value)),
            Token::Sign('(') => self.bracket(),
            Token::Sign(sign) => Err(format!("the formula has an unexpected `{sign}`")),
            Token::Name(name) => match name.to_ascii_lowercase().as_str() {
                "time" | "t" => Ok(Formula::Time),
                "pi" => Ok(Formula::Number(PI)),
                lower => {
                    let known = FUNCTIONS.iter().find(|(known, _)| *known == lower);
                    let (_, function) =
                        known.ok_or_else(|| format!("Kin does not know `{name}` in a formula"))?;
                    if self.takes(&['(']).is_none() {
                        return Err(format!("`{name}` needs an argument in brackets"));
                    }
                    Ok(Formula::call(function, self.bracket()?))
                }
            },
        }
    }

    fn bracket(&mut self) -> Result<Formula, String> {
        let inner = self.sum()?;
        self.takes(&[')']).map(|_| inner).ok_or_else(|| "a bracket is not closed".to_string())
    }
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
