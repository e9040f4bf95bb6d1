//! The dialect of C99 with `<math.h>`: `0.5 * sin(t)`.

use crate::text::{Binding, Dialect, Infix, Piece};
use crate::{Function, Function2};

/// Expressions of double in C99.
///
/// The standard library of C lacks some functions; a file that calls them contains their
/// definitions from [`C::HELPERS`].
#[derive(Clone, Copy, Debug, Default)]
pub struct C;

impl C {
    /// The functions that the standard library of C lacks, as (name, definition).
    pub const HELPERS: [(&'static str, &'static str); 5] = [
        (
            "kin_power",
            "static double kin_power(double x, int n)\n{\n    double y = 1.0;\n    unsigned int left = n < 0 ? 0u - (unsigned int)n : (unsigned int)n;\n    for (; left > 0u; left /= 2u) {\n        if (left % 2u == 1u) {\n            y *= x;\n        }\n        x *= x;\n    }\n    return n < 0 ? 1.0 / y : y;\n}\n",
        ),
        (
            "kin_sign",
            "static double kin_sign(double x)\n{\n    return isnan(x) ? x : copysign(1.0, x);\n}\n",
        ),
        ("kin_fraction", "static double kin_fraction(double x)\n{\n    return x - trunc(x);\n}\n"),
        (
            "kin_remainder",
            "static double kin_remainder(double x, double y)\n{\n    const double r = fmod(x, y);\n    return r < 0.0 ? r + fabs(y) : r;\n}\n",
        ),
        (
            "kin_whole_quotient",
            "static double kin_whole_quotient(double x, double y)\n{\n    const double q = trunc(x / y);\n    if (fmod(x, y) < 0.0) {\n        return y > 0.0 ? q - 1.0 : q + 1.0;\n    }\n    return q;\n}\n",
        ),
    ];

    /// Returns the name of a function of one number.
    fn function(function: Function) -> &'static str {
        match function {
            Function::ExpM1 => "expm1",
            Function::Ln => "log",
            Function::Ln1p => "log1p",
            Function::Abs => "fabs",
            Function::Signum => "kin_sign",
            Function::Fract => "kin_fraction",
            other => other.method(),
        }
    }

    /// Returns the name of a function of two numbers.
    fn function2(function: Function2) -> &'static str {
        match function {
            Function2::Powf => "pow",
            Function2::Max => "fmax",
            Function2::Min => "fmin",
            Function2::RemEuclid => "kin_remainder",
            Function2::DivEuclid => "kin_whole_quotient",
            Function2::Rem => "fmod",
            other => other.method(),
        }
    }
}

impl Dialect for C {
    fn number(&self, x: f64) -> Piece {
        match x {
            x if x.is_nan() => Piece::atom("NAN"),
            f64::INFINITY => Piece::atom("INFINITY"),
            f64::NEG_INFINITY => Piece::new("-INFINITY", Binding::Sign),
            x if x.is_sign_negative() => Piece::new(format!("{x:?}"), Binding::Sign),
            x => Piece::atom(format!("{x:?}")),
        }
    }

    fn truth(&self, holds: bool) -> Piece {
        Piece::atom(u8::from(holds).to_string())
    }

    fn sign(&self, operator: Infix) -> &'static str {
        super::sign(operator)
    }

    fn call(&self, function: Function, a: &Piece) -> Piece {
        Piece::atom(format!("{}({})", C::function(function), a.text))
    }

    fn call2(&self, function: Function2, a: &Piece, b: &Piece) -> Piece {
        Piece::atom(format!("{}({}, {})", C::function2(function), a.text, b.text))
    }

    fn power(&self, a: &Piece, n: i32) -> Piece {
        let is_name = a.text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        match n {
            2 if is_name => self.infix(a, Infix::Product, a),
            3 if is_name => self.infix(&self.infix(a, Infix::Product, a), Infix::Product, a),
            _ => Piece::atom(format!("kin_power({}, {n})", a.text)),
        }
    }

    fn not(&self, a: &Piece) -> Piece {
        Piece::new(format!("!{}", a.within(Binding::Atom, self.brackets())), Binding::Sign)
    }

    fn choice(&self, condition: &Piece, a: &Piece, b: &Piece) -> Piece {
        let inner = |piece: &Piece| piece.within(Binding::Or, self.brackets());
        let text = format!("{} ? {} : {}", inner(condition), inner(a), inner(b));
        Piece::new(text, Binding::Choice)
    }

    // `--a` is another operator.
    fn negative(&self, a: &Piece) -> Piece {
        Piece::new(format!("-{}", a.within(Binding::Atom, self.brackets())), Binding::Sign)
    }
}

/// Words that a program in C, C++ or Rust cannot use as names.
const RESERVED: [&str; 82] = [
    "alignas",
    "alignof",
    "and",
    "as",
    "asm",
    "auto",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "class",
    "const",
    "constexpr",
    "continue",
    "crate",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "else",
    "enum",
    "explicit",
    "export",
    "extern",
    "false",
    "float",
    "fn",
    "for",
    "friend",
    "goto",
    "if",
    "impl",
    "in",
    "inline",
    "int",
    "let",
    "long",
    "loop",
    "match",
    "mod",
    "move",
    "mut",
    "namespace",
    "new",
    "not",
    "operator",
    "or",
    "private",
    "protected",
    "pub",
    "ref",
    "register",
    "restrict",
    "return",
    "self",
    "short",
    "signed",
    "sizeof",
    "static",
    "struct",
    "super",
    "switch",
    "template",
    "this",
    "throw",
    "trait",
    "true",
    "try",
    "typedef",
    "typename",
    "union",
    "unsigned",
    "use",
    "using",
    "virtual",
    "void",
    "volatile",
    "where",
    "while",
    "xor",
];

/// Returns a valid name in C and Rust for any text: letters, digits and `_`, at most 40 of them.
///
/// Different texts can give the same name.
pub fn identifier(text: &str) -> String {
    let mut name = String::new();
    for letter in text.chars() {
        let next = if letter.is_ascii_alphanumeric() { letter } else { '_' };
        if next != '_' || !name.ends_with('_') {
            name.push(next);
        }
        if name.len() == 40 {
            break;
        }
    }
    let name = name.trim_matches('_');
    let begins = name.starts_with(|c: char| c.is_ascii_alphabetic());
    // Names of macros such as `NAN` are in capitals.
    let is_macro = name.len() > 1 && !name.contains(|c: char| c.is_ascii_lowercase());
    let is_reserved =
        ["linux", "unix", "main", "errno"].iter().chain(&RESERVED).any(|word| *word == name);
    match begins && !is_macro && !is_reserved {
        true => name.to_string(),
        false => format!("k_{name}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::testing::{Names, TEXTS, comes_back, printed};

    #[test]
    fn printed_c_has_the_same_value() {
        for text in TEXTS {
            comes_back(text, &C, Names::C, str::to_string);
        }
    }

    #[test]
    fn c_has_its_own_names_and_signs() {
        for (text, expected) in [
            ("a - (-(-b))", "a - b"),
            ("abs(ln(a)) % 2", "fmod(fabs(log(a)), 2.0)"),
            ("powi(a, 2) / powi(b + 1, -3)", "a * a / kin_power(b + 1.0, -3)"),
            ("max(a, 1e-7)", "fmax(a, 1e-7)"),
        ] {
            assert_eq!(printed(text, &C), expected);
        }
        assert_eq!(C.negative(&C.number(-1.0)).text, "-(-1.0)");
        assert_eq!(C.number(-0.0).binding, Binding::Sign);
        let [a, b] = ["a", "b"].map(Piece::atom);
        let less = C.infix(&a, Infix::Comparison(crate::Comparison::Less), &b);
        assert_eq!(C.choice(&less, &a, &C.choice(&a, &b, &a)).text, "a < b ? a : (a ? b : a)");
    }

    #[test]
    fn any_text_becomes_a_valid_name() {
        for (text, expected) in [
            ("rocker.theta", "rocker_theta"),
            ("*/ system(\"x\")", "system_x"),
            ("while", "k_while"),
            ("2nd", "k_2nd"),
            ("NAN", "k_NAN"),
            ("é", "k_"),
            ("", "k_"),
            ("a??/\nb", "a_b"),
        ] {
            assert_eq!(identifier(text), expected);
        }
        assert!(identifier(&"x".repeat(1000)).len() <= 40);
    }
}
