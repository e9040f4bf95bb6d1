//! The dialects of the printer: one file for each language.

mod c;
mod kin;
mod latex;
mod rust;

pub use c::{C, identifier};
pub use kin::Kin;
pub use latex::Latex;
pub use rust::Rust;

use super::Infix;
use crate::Comparison;

/// Returns the sign of an operator in C and Rust.
fn sign(operator: Infix) -> &'static str {
    match operator {
        Infix::Sum => "+",
        Infix::Difference => "-",
        Infix::Product => "*",
        Infix::Quotient => "/",
        Infix::Remainder => "%",
        Infix::And => "&&",
        Infix::Or => "||",
        Infix::Comparison(Comparison::Less) => "<",
        Infix::Comparison(Comparison::LessEqual) => "<=",
        Infix::Comparison(Comparison::Greater) => ">",
        Infix::Comparison(Comparison::GreaterEqual) => ">=",
        Infix::Comparison(Comparison::Equal) => "==",
        Infix::Comparison(Comparison::NotEqual) => "!=",
    }
}
