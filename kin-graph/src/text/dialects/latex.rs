//! The dialect of LaTeX in mathematical mode: `\frac{a}{2} \cdot \sin\left(\theta\right)`.

use crate::text::{Binding, Dialect, Infix, Piece};
use crate::{Comparison, Function, Function2};

/// Formulas in LaTeX's mathematical mode, with the package `amsmath`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Latex;

/// Characters that LaTeX does not take as they are.
const ESCAPED: [(char, &str); 12] = [
    ('\\', "\\backslash "),
    ('{', "\\{"),
    ('}', "\\}"),
    ('$', "\\$"),
    ('&', "\\&"),
    ('#', "\\#"),
    ('%', "\\%"),
    ('_', "\\_"),
    ('^', "\\hat{\\ }"),
    ('~', "\\sim "),
    (' ', "\\ "),
    ('\n', "\\ "),
];

/// The names of functions that LaTeX or mathematicians write in another way than Rust.
const NAMES: [(Function, &str); 16] = [
    (Function::Sin, "\\sin"),
    (Function::Cos, "\\cos"),
    (Function::Tan, "\\tan"),
    (Function::Asin, "\\arcsin"),
    (Function::Acos, "\\arccos"),
    (Function::Atan, "\\arctan"),
    (Function::Sinh, "\\sinh"),
    (Function::Cosh, "\\cosh"),
    (Function::Tanh, "\\tanh"),
    (Function::Asinh, "\\operatorname{arsinh}"),
    (Function::Acosh, "\\operatorname{arcosh}"),
    (Function::Atanh, "\\operatorname{artanh}"),
    (Function::Ln, "\\ln"),
    (Function::Log2, "\\log_{2}"),
    (Function::Log10, "\\log_{10}"),
    (Function::Signum, "\\operatorname{sgn}"),
];

impl Latex {
    /// Returns any text as an upright name.
    pub fn name(text: &str) -> String {
        let mut name = String::new();
        for letter in text.chars() {
            match ESCAPED.iter().find(|(escaped, _)| *escaped == letter) {
                Some((_, replaced)) => name.push_str(replaced),
                None => name.push(letter),
            }
        }
        format!("\\mathrm{{{name}}}")
    }

    /// Returns a function with its arguments in brackets.
    fn applied(function: &str, arguments: &str) -> Piece {
        Piece::atom(format!("{function}\\left({arguments}\\right)"))
    }

    /// Returns a base with an exponent.
    fn raised(&self, base: &Piece, exponent: &str) -> Piece {
        let base = base.within(Binding::Atom, self.brackets());
        Piece::new(format!("{base}^{{{exponent}}}"), Binding::Sign)
    }

    /// Returns an operand that does not begin with a sign.
    fn unsigned(&self, a: &Piece) -> Piece {
        match a.text.starts_with('-') {
            true => Piece::atom(a.within(Binding::Atom, self.brackets())),
            false => a.clone(),
        }
    }
}

impl Dialect for Latex {
    fn brackets(&self) -> [&'static str; 2] {
        ["\\left(", "\\right)"]
    }

    fn number(&self, x: f64) -> Piece {
        if !x.is_finite() {
            let text = if x.is_nan() { "\\mathrm{NaN}" } else { "\\infty" };
            let binding = if x < 0.0 { Binding::Sign } else { Binding::Atom };
            return Piece::new(format!("{}{text}", if x < 0.0 { "-" } else { "" }), binding);
        }
        let text = format!("{x:?}");
        let text = text.strip_suffix(".0").unwrap_or(&text);
        match text.split_once('e') {
            Some((digits, exponent)) => {
                Piece::new(format!("{digits} \\cdot 10^{{{exponent}}}"), Binding::Product)
            }
            None if x.is_sign_negative() => Piece::new(text, Binding::Sign),
            None => Piece::atom(text),
        }
    }

    fn truth(&self, holds: bool) -> Piece {
        Piece::atom(if holds { "\\top" } else { "\\bot" })
    }

    fn sign(&self, operator: Infix) -> &'static str {
        match operator {
            Infix::Product => "\\cdot",
            Infix::Remainder => "\\bmod",
            Infix::And => "\\land",
            Infix::Or => "\\lor",
            Infix::Comparison(Comparison::LessEqual) => "\\leq",
            Infix::Comparison(Comparison::GreaterEqual) => "\\geq",
            Infix::Comparison(Comparison::Equal) => "=",
            Infix::Comparison(Comparison::NotEqual) => "\\neq",
            other => super::sign(other),
        }
    }

    fn call(&self, function: Function, a: &Piece) -> Piece {
        let text = &a.text;
        let name = match function {
            Function::Exp2 => return self.raised(&Piece::atom("2"), text),
            Function::ExpM1 => {
                let power = self.raised(&Piece::atom("e"), text);
                return self.infix(&power, Infix::Difference, &Piece::atom("1"));
            }
            Function::Exp => return self.raised(&Piece::atom("e"), text),
            Function::Ln1p => {
                return Latex::applied("\\ln", &self.infix(&Piece::atom("1"), Infix::Sum, a).text);
            }
            Function::Sqrt => return Piece::atom(format!("\\sqrt{{{text}}}")),
            Function::Cbrt => return Piece::atom(format!("\\sqrt[3]{{{text}}}")),
            Function::Abs => return Piece::atom(format!("\\left|{text}\\right|")),
            Function::Floor => {
                return Piece::atom(format!("\\left\\lfloor {text}\\right\\rfloor"));
            }
            Function::Ceil => return Piece::atom(format!("\\left\\lceil {text}\\right\\rceil")),
            other => {
                let known = NAMES.iter().find(|(function, _)| *function == other);
                let name = known.map(|(_, name)| (*name).to_string());
                name.unwrap_or_else(|| format!("\\operatorname{{{}}}", other.method()))
            }
        };
        Latex::applied(&name, text)
    }

    fn call2(&self, function: Function2, a: &Piece, b: &Piece) -> Piece {
        let name = match function {
            Function2::Hypot => {
                let [a, b] = [a, b].map(|side| self.power(side, 2));
                return Piece::atom(format!("\\sqrt{{{}}}", self.infix(&a, Infix::Sum, &b).text));
            }
            Function2::Powf => return self.raised(a, &b.text),
            Function2::Max => "\\max",
            Function2::Min => "\\min",
            Function2::RemEuclid => "\\operatorname{mod}",
            Function2::DivEuclid => "\\operatorname{div}",
            Function2::Rem => "\\operatorname{rem}",
            other => {
                let name = format!("\\operatorname{{{}}}", other.method());
                return Latex::applied(&name, &format!("{}, {}", a.text, b.text));
            }
        };
        Latex::applied(name, &format!("{}, {}", a.text, b.text))
    }

    fn power(&self, a: &Piece, n: i32) -> Piece {
        self.raised(a, &n.to_string())
    }

    fn not(&self, a: &Piece) -> Piece {
        let text = a.within(Binding::Atom, self.brackets());
        Piece::new(format!("\\lnot {text}"), Binding::Sign)
    }

    fn choice(&self, condition: &Piece, a: &Piece, b: &Piece) -> Piece {
        let [condition, a, b] = [condition, a, b].map(|piece| &piece.text);
        let cases = format!("{a} & {condition} \\\\ {b} & \\text{{otherwise}}");
        Piece::atom(format!("\\begin{{cases}} {cases} \\end{{cases}}"))
    }

    fn negative(&self, a: &Piece) -> Piece {
        let inner = self.unsigned(a).within(Binding::Sign, self.brackets());
        Piece::new(format!("-{inner}"), Binding::Sign)
    }

    fn infix(&self, a: &Piece, operator: Infix, b: &Piece) -> Piece {
        if operator == Infix::Quotient {
            let text = format!("\\frac{{{}}}{{{}}}", a.text, b.text);
            return Piece::new(text, Binding::Sign);
        }
        let [binding, left, right] = operator.bindings();
        let left = a.within(left, self.brackets());
        let right = self.unsigned(b).within(right, self.brackets());
        Piece::new(format!("{left} {} {right}", self.sign(operator)), binding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::testing::{Names, TEXTS, comes_back, printed};

    /// Takes the content of braces off the front of a text.
    fn braced(text: &str) -> (&str, &str) {
        let mut depth = 0;
        for (at, letter) in text.char_indices() {
            depth += i32::from(letter == '{') - i32::from(letter == '}');
            if depth == 0 {
                return (&text[1..at], &text[at + 1..]);
            }
        }
        panic!("unbalanced: {text}")
    }

    /// Returns a formula of LaTeX in the words of the reader.
    fn plain(latex: &str) -> String {
        let mut rest = latex.to_string();
        for (latex, word) in [
            ("\\left(", "("),
            ("\\right)", ")"),
            ("\\left|", "abs("),
            ("\\right|", ")"),
            ("\\left\\lfloor ", "floor("),
            ("\\right\\rfloor", ")"),
            ("\\left\\lceil ", "ceil("),
            ("\\right\\rceil", ")"),
            ("\\cdot", "*"),
            ("\\log_{2}", "log2"),
            ("\\log_{10}", "log10"),
            ("\\arc", "\\a"),
        ] {
            rest = rest.replace(latex, word);
        }
        let mut plain = String::new();
        let mut rest = rest.as_str();
        while let Some(letter) = rest.chars().next() {
            let marks = ["\\frac{", "\\sqrt[3]{", "\\sqrt{", "\\operatorname{", "^{"];
            let Some(mark) = marks.into_iter().find(|mark| rest.starts_with(mark)) else {
                if letter != '\\' {
                    plain.push(letter);
                }
                rest = &rest[letter.len_utf8()..];
                continue;
            };
            let (inner, after) = braced(&rest[mark.len() - 1..]);
            rest = after;
            let own = self::plain(inner);
            match mark {
                "\\frac{" => {
                    let (below, after) = braced(rest);
                    rest = after;
                    plain += &format!("(({own}) / ({}))", self::plain(below));
                }
                "\\sqrt[3]{" => plain += &format!("cbrt({own})"),
                "\\sqrt{" => plain += &format!("sqrt({own})"),
                "^{" => plain += &format!("^({own})"),
                _ => plain += &own,
            }
        }
        plain
    }

    #[test]
    fn printed_latex_has_the_same_value() {
        for text in TEXTS {
            comes_back(text, &Latex, Names::Latex, plain);
        }
    }

    #[test]
    fn formulas_look_as_on_paper() {
        for (text, expected) in [
            ("a / 2 * sin(b - c)", "\\frac{a}{2} \\cdot \\sin\\left(b - c\\right)"),
            ("powi(a / b, 2)", "\\left(\\frac{a}{b}\\right)^{2}"),
            ("a + -1.5e-7", "a + \\left(-1.5 \\cdot 10^{-7}\\right)"),
            ("hypot(a, -b)", "\\sqrt{a^{2} + \\left(-b\\right)^{2}}"),
        ] {
            assert_eq!(printed(text, &Latex), expected);
        }
        assert_eq!(Latex::name("a_b {"), "\\mathrm{a\\_b\\ \\{}");
    }
}
