//! The dialect of Rust: `0.5 * t.sin()`.

use crate::text::{Binding, Dialect, Infix, Piece};
use crate::{Function, Function2};

/// Expressions of f64 in Rust, which is the language of equations and laws as text too.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rust;

impl Rust {
    /// Returns an operand in front of a method; a literal states its type.
    fn receiver(&self, a: &Piece) -> String {
        let text = a.within(Binding::Atom, self.brackets());
        let is_literal = text.starts_with(|c: char| c.is_ascii_digit());
        if is_literal { format!("{text}_f64") } else { text }
    }
}

impl Dialect for Rust {
    fn number(&self, x: f64) -> Piece {
        match x {
            x if x.is_nan() => Piece::atom("f64::NAN"),
            f64::INFINITY => Piece::atom("f64::INFINITY"),
            f64::NEG_INFINITY => Piece::atom("f64::NEG_INFINITY"),
            x if x.is_sign_negative() => Piece::new(format!("{x:?}"), Binding::Sign),
            x => Piece::atom(format!("{x:?}")),
        }
    }

    fn truth(&self, holds: bool) -> Piece {
        Piece::atom(holds.to_string())
    }

    fn sign(&self, operator: Infix) -> &'static str {
        super::sign(operator)
    }

    fn call(&self, function: Function, a: &Piece) -> Piece {
        Piece::atom(format!("{}.{}()", self.receiver(a), function.method()))
    }

    fn call2(&self, function: Function2, a: &Piece, b: &Piece) -> Piece {
        match function {
            Function2::Rem => self.infix(a, Infix::Remainder, b),
            _ => Piece::atom(format!("{}.{}({})", self.receiver(a), function.method(), b.text)),
        }
    }

    fn power(&self, a: &Piece, n: i32) -> Piece {
        Piece::atom(format!("{}.powi({n})", self.receiver(a)))
    }

    fn not(&self, a: &Piece) -> Piece {
        Piece::new(format!("!{}", a.within(Binding::Atom, self.brackets())), Binding::Sign)
    }

    fn choice(&self, condition: &Piece, a: &Piece, b: &Piece) -> Piece {
        let text = format!("if {} {{ {} }} else {{ {} }}", condition.text, a.text, b.text);
        Piece::new(text, Binding::Choice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::testing::printed;

    #[test]
    fn functions_are_methods_of_their_first_operand() {
        for (text, expected) in [
            ("sin(a + 1) * -2", "(a + 1.0).sin() * -2.0"),
            ("powf(2, a)", "2.0_f64.powf(a)"),
            ("powi(-a, 3) - (b - c)", "(-a).powi(3) - (b - c)"),
            ("atan2(a, b) % c", "a.atan2(b) % c"),
        ] {
            assert_eq!(printed(text, &Rust), expected);
        }
    }
}
