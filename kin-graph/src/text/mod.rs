//! Reads and prints expressions: one reader and one printer for all languages of text.
//!
//! `read` reads sums, products, brackets and calls; a [`Language`] gives the values of names and
//! the words of mistakes. `print` prints an operation of which the operands are already printed; a
//! [`Dialect`] gives its words, and `precedence` places the brackets. `steps` converts a whole
//! formula to text and back, one step a line.
//!
//! Rust code is read by `kin-language`.

mod dialects;
mod precedence;
mod print;
mod read;
mod steps;
#[cfg(test)]
mod testing;

pub use dialects::{C, Kin, Latex, Rust, identifier};
pub use precedence::{Binding, Infix, Piece};
pub use print::{Dialect, print, print_operation};
pub use read::{Language, Meaning, Mistake, Token, Tokens, read};
pub use steps::Unreadable;
