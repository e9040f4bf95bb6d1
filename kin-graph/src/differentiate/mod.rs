//! Differentiates nodes of the graph with the constructors of the graph, so that derivatives are
//! simplified and share common nodes.

mod adjoint;
mod curve;
mod derivatives;
mod jets;
mod moves;
mod partial;
mod rules;
mod scaled;
mod term;
#[cfg(test)]
mod tests;

use crate::Node;

use adjoint::{by_columns, promise_of_columns};
pub use derivatives::{Derivatives, Promises};
pub use jets::{Jet, Jets};
pub use partial::Partial;

/// The findings about each node, by its number.
#[derive(Default)]
struct Memo<T>(Vec<Option<T>>);

impl<T: Copy + Default> Memo<T> {
    fn has(&self, node: Node) -> bool {
        matches!(self.0.get(node.index()), Some(Some(_)))
    }

    /// The finding about a node; the default where there is none.
    fn of(&self, node: Node) -> T {
        self.0.get(node.index()).copied().flatten().unwrap_or_default()
    }

    fn set(&mut self, node: Node, value: T) {
        if self.0.len() <= node.index() {
            self.0.resize(node.index() + 1, None);
        }
        self.0[node.index()] = Some(value);
    }
}
