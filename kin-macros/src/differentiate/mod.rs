//! Differentiation over the graph, by its own constructors: derivatives are born simplified and share what they have in common.

mod jets;
mod partial;
mod rules;
#[cfg(test)]
mod tests;

pub use jets::Jets;
pub use partial::Partial;
pub use rules::{derivative, derivatives2};
