//! Differentiation over the graph, by its own constructors: derivatives are born simplified and share what they have in common.

mod derivatives;
mod jets;
mod partial;
mod rules;
#[cfg(test)]
mod tests;

pub use derivatives::{Derivatives, local_column};
pub use jets::Jets;
pub use partial::Partial;
