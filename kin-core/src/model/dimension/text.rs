//! Expressions of dimensions as text.

use kin_graph::{Function, Function2, Graph, Node, infix};

use super::Entry;

/// No expression is written that is longer.   \[bytes\]
const LONGEST: usize = 20_000;

/// A node as text, dimensions by their names; `None` where that is too long.
pub(crate) fn text_of(graph: &Graph, entries: &[Entry], node: Node) -> Option<String> {
    let named = |node: Node| {
        entries.iter().find(|entry| entry.node == node).map(|entry| quoted(&entry.name))
    };
    infix(graph, node, named, LONGEST)
}

/// A name as it stands in an expression: in backticks unless it is a word, and not one of a
/// function.
fn quoted(name: &str) -> String {
    let mut letters = name.chars();
    let word = letters.next().is_some_and(|c| c.is_alphabetic() || c == '_')
        && letters.all(|c| c.is_alphanumeric() || c == '_' || c == '.');
    let called = Function::from_method(name).is_some() || Function2::from_method(name).is_some();
    if word && !called { name.to_string() } else { format!("`{name}`") }
}
