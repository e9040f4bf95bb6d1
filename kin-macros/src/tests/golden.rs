//! What is emitted for four constraints, kept in `golden/` to be read: `KIN_BLESS=1` stores it anew.

use std::path::Path;

use proc_macro2::{Group, Span, TokenStream, TokenTree};

use super::attributes::{attributed, compiled};
use super::compared;

#[test]
fn expansions_are_the_ones_that_were_reviewed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let source = std::fs::read_to_string(folder.join("source.rs")).unwrap_or_else(|error| panic!("golden/source.rs: {error}"));
    let constraints = attributed(nowhere(source.parse().unwrap_or_else(|error| panic!("golden/source.rs: {error}"))));
    assert_eq!(constraints.len(), 4);
    let differences: Vec<String> = constraints
        .iter()
        .filter_map(|constraint| {
            let file = compiled(constraint.expand()).unwrap_or_else(|error| panic!("`{}` expands to no Rust: {error}", constraint.name));
            compared(&folder.join(&constraint.name).with_extension("rs"), &prettyplease::unparse(&file))
        })
        .collect();
    assert!(differences.is_empty(), "KIN_BLESS=1 stores what is found\n\n{}", differences.join("\n\n"));
}

/// The same tokens without a place in a file: texts in emitted code are then what they are under rustc, where spans cannot be joined.
fn nowhere(tokens: TokenStream) -> TokenStream {
    let moved = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => TokenTree::Group(Group::new(group.delimiter(), nowhere(group.stream()))),
        mut other => {
            other.set_span(Span::call_site());
            other
        }
    });
    moved.collect()
}
