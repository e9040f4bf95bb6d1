//! The dialect of expressions in Kin's mechanism files: `crank / 2.0`, `hypot(dx, dy)`.

use crate::text::{Binding, Dialect, Infix, Piece};
use crate::{Function, Function2};

/// The expressions of dimensions in mechanism files.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kin;

impl Dialect for Kin {
    fn number(&self, x: f64) -> Piece {
        let binding = if x < 0.0 { Binding::Sign } else { Binding::Atom };
        Piece::new(format!("{x:?}"), binding)
    }

    fn truth(&self, holds: bool) -> Piece {
        self.number(f64::from(u8::from(holds)))
    }

    fn sign(&self, operator: Infix) -> &'static str {
        super::sign(operator)
    }

    fn call(&self, function: Function, a: &Piece) -> Piece {
        Piece::atom(format!("{}({})", function.method(), a.text))
    }

    fn call2(&self, function: Function2, a: &Piece, b: &Piece) -> Piece {
        match function {
            Function2::Rem => self.infix(a, Infix::Remainder, b),
            _ => Piece::atom(format!("{}({}, {})", function.method(), a.text, b.text)),
        }
    }

    fn power(&self, a: &Piece, n: i32) -> Piece {
        Piece::atom(format!("powi({}, {n})", a.text))
    }

    fn not(&self, a: &Piece) -> Piece {
        Piece::new(format!("!{}", a.within(Binding::Atom, self.brackets())), Binding::Sign)
    }

    fn choice(&self, condition: &Piece, a: &Piece, b: &Piece) -> Piece {
        Piece::atom(format!("select({}, {}, {})", condition.text, a.text, b.text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::testing::{Names, TEXTS, comes_back, printed};

    #[test]
    fn printed_expressions_of_files_have_the_same_value() {
        for text in TEXTS {
            comes_back(text, &Kin, Names::Kin, str::to_string);
        }
    }

    #[test]
    fn brackets_stand_where_they_are_needed() {
        for (text, expected) in [
            ("(a - b) - (c - 1)", "a - b - (c - 1.0)"),
            ("(a * b) / (c * a)", "a * b / (c * a)"),
            ("-(a + b) * 2", "-(a + b) * 2.0"),
            ("hypot(a, b) % c", "hypot(a, b) % c"),
            ("powi(a, -2)", "powi(a, -2)"),
            ("a - -b", "a - -b"),
        ] {
            assert_eq!(printed(text, &Kin), expected);
        }
    }
}
