//! Expressions of dimensions as text.

use kin_graph::text::{Kin, print};
use kin_graph::{Function, Function2, Graph, Node};

use super::Entry;

/// The longest text of an expression. \[bytes\]
const LONGEST: usize = 20_000;

/// Returns the text of a node, with dimensions by their names. Returns `None` if the text is too
/// long.
pub(crate) fn text_of(graph: &Graph, entries: &[Entry], node: Node) -> Option<String> {
    let named = |node: Node| {
        entries.iter().find(|entry| entry.node == node).map(|entry| quoted(&entry.name))
    };
    print(graph, node, &Kin, named, LONGEST)
}

/// Returns a name as an expression contains it: in backticks, unless it is a word that no function
/// has.
fn quoted(name: &str) -> String {
    let mut letters = name.chars();
    let word = letters.next().is_some_and(|c| c.is_alphabetic() || c == '_')
        && letters.all(|c| c.is_alphanumeric() || c == '_' || c == '.');
    let called = Function::from_method(name).is_some() || Function2::from_method(name).is_some();
    if word && !called { name.to_string() } else { format!("`{name}`") }
}
