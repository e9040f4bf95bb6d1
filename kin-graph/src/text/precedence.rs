//! Defines how tightly operators bind, and sets brackets.

use crate::Comparison;

/// The binding strength of the outermost operation of a text, from the weakest to the strongest.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Binding {
    /// A choice between two values, `c ? a : b`.
    Choice,
    Or,
    And,
    Comparison,
    Sum,
    Product,
    Sign,
    /// A number, a name, a call, or a text in brackets.
    Atom,
}

/// An operator between two operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Infix {
    Sum,
    Difference,
    Product,
    Quotient,
    Remainder,
    And,
    Or,
    Comparison(Comparison),
}

impl Infix {
    /// Returns the binding of the operation, the weakest binding of a left operand without
    /// brackets, and that of a right operand.
    pub fn bindings(self) -> [Binding; 3] {
        match self {
            Infix::Sum | Infix::Difference => [Binding::Sum, Binding::Sum, Binding::Product],
            Infix::Product | Infix::Quotient | Infix::Remainder => {
                [Binding::Product, Binding::Product, Binding::Sign]
            }
            Infix::Comparison(_) => [Binding::Comparison, Binding::Sum, Binding::Sum],
            Infix::And => [Binding::And, Binding::Comparison, Binding::Comparison],
            Infix::Or => [Binding::Or, Binding::Comparison, Binding::Comparison],
        }
    }
}

/// A printed operand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Piece {
    pub text: String,
    /// The binding of its outermost operation.
    pub binding: Binding,
}

impl Piece {
    pub fn new(text: impl Into<String>, binding: Binding) -> Self {
        Piece { text: text.into(), binding }
    }

    /// Returns a number, name or call.
    pub fn atom(text: impl Into<String>) -> Self {
        Piece::new(text, Binding::Atom)
    }

    /// Returns the text, in these brackets if it binds less tightly than `least`.
    pub fn within(&self, least: Binding, [open, close]: [&str; 2]) -> String {
        let Piece { text, binding } = self;
        if *binding >= least { text.clone() } else { format!("{open}{text}{close}") }
    }
}
