//! Golden expansions: emitted code of four constraints, kept in `golden/` to be read; `KIN_BLESS=1`
//! stores it anew.

use std::path::Path;

use proc_macro2::{Group, Span, TokenStream, TokenTree};

use super::attributes::{attributed, compiled};
use super::compared;

#[test]
fn expansions_are_the_ones_that_were_reviewed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    let source = std::fs::read_to_string(folder.join("source.rs"))
        .unwrap_or_else(|error| panic!("golden/source.rs: {error}"));
    let constraints = attributed(nowhere(
        source.parse().unwrap_or_else(|error| panic!("golden/source.rs: {error}")),
    ));
    assert_eq!(constraints.len(), 4);
    let differences: Vec<String> = constraints
        .iter()
        .filter_map(|constraint| {
            let file = compiled(constraint.expand()).unwrap_or_else(|error| {
                panic!("`{}` expands to no Rust: {error}", constraint.name)
            });
            compared(
                &folder.join(&constraint.name).with_extension("rs"),
                &prettyplease::unparse(&file),
            )
        })
        .collect();
    assert!(
        differences.is_empty(),
        "KIN_BLESS=1 stores what is found\n\n{}",
        differences.join("\n\n")
    );
}

/// The same tokens without a place in a file: texts in emitted code are then what they are under
/// rustc, where spans cannot be joined.
fn nowhere(tokens: TokenStream) -> TokenStream {
    let moved = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            TokenTree::Group(Group::new(group.delimiter(), nowhere(group.stream())))
        }
        mut other => {
            other.set_span(Span::call_site());
            other
        }
    });
    moved.collect()
}

/// The functions that a solver calls at each step.
const KERNELS: [&str; 5] =
    ["residual", "jacobian", "linearize", "velocity_rhs", "acceleration_rhs"];

#[test]
fn kernels_name_nothing_of_the_standard_library() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden");
    for name in ["cylindrical", "on_cam", "revolute", "slider_crank"] {
        let text = std::fs::read_to_string(folder.join(name).with_extension("rs"))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let tokens: Vec<TokenTree> =
            flat(text.parse().unwrap_or_else(|error| panic!("{name}: {error}")));
        let is =
            |k: usize, word: &str| tokens.get(k).is_some_and(|token| token.to_string() == word);
        let mut found = 0;
        for k in 0..tokens.len() {
            let Some(kernel) = KERNELS.iter().find(|kernel| is(k, "fn") && is(k + 1, kernel))
            else {
                continue;
            };
            let Some(TokenTree::Group(body)) = tokens[k..].iter().find(|token| is_block(token))
            else {
                continue;
            };
            found += 1;
            let words: Vec<String> = flat(body.stream()).iter().map(ToString::to_string).collect();
            for (word, next) in words.iter().zip(words.iter().skip(1)) {
                assert!(
                    !matches!(word.as_str(), "std" | "alloc"),
                    "{name}: `{kernel}` names `{word}`"
                );
                assert!(
                    word != "f64" || next != ":",
                    "{name}: `{kernel}` calls a function of f64 that the standard library has"
                );
                assert!(
                    word != "." || next != "sin_cos",
                    "{name}: `{kernel}` calls `sin_cos` of the standard library"
                );
            }
        }
        assert!(found >= KERNELS.len(), "{name}: {found} kernels");
    }
}

fn is_block(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Group(group) if group.delimiter() == proc_macro2::Delimiter::Brace)
}

/// All tokens, each group before what is in it.
fn flat(tokens: TokenStream) -> Vec<TokenTree> {
    let each = tokens.into_iter().flat_map(|token| {
        let inside =
            if let TokenTree::Group(group) = &token { flat(group.stream()) } else { vec![] };
        std::iter::once(token).chain(inside)
    });
    each.collect()
}
