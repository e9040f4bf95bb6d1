//! The messages for the mistakes of `tests/ui`, each at its token. `tests/ui.rs` asks rustc about
//! the same programs; lines that begin with the number of one of rustc's own errors are only for
//! that test.

use proc_macro2::{TokenStream, TokenTree};

use super::attributes::attributed;
use super::{compared, rust_files};

#[test]
fn every_slip_gives_its_message_at_its_token() {
    let programs = rust_files("../tests/ui");
    assert!(programs.len() >= 28, "only {} programs in tests/ui", programs.len());
    let mut differences = Vec::new();
    for (_, path) in programs {
        let source = std::fs::read_to_string(&path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        // A constraint that a macro of the program writes is seen by rustc alone.
        if source.contains("macro_rules!") {
            continue;
        }
        let tokens: TokenStream =
            source.parse().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut lines: Vec<String> =
            attributed(tokens).iter().flat_map(|item| messages(&source, item.expand())).collect();
        let stored = path.with_extension("message");
        lines.extend(
            std::fs::read_to_string(&stored)
                .unwrap_or_default()
                .lines()
                .filter(|line| is_rustcs(line))
                .map(str::to_owned),
        );
        let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
        differences.extend(compared(&stored, &text));
    }
    assert!(
        differences.is_empty(),
        "KIN_BLESS=1 stores what is found\n\n{}",
        differences.join("\n\n")
    );
}

/// ``line:column `token`: [E0308]``
fn is_rustcs(line: &str) -> bool {
    line.ends_with(']') && line.contains(": [E")
}

/// Every `compile_error!` in the expansion, as ``line:column `token`: message``.
fn messages(source: &str, expansion: TokenStream) -> Vec<String> {
    let tokens: Vec<TokenTree> = expansion.into_iter().collect();
    let mut found = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        match (token, tokens.get(k + 2)) {
            (TokenTree::Ident(name), Some(TokenTree::Group(text))) if name == "compile_error" => {
                let start = name.span().start();
                let end = text.span().end();
                let text: syn::LitStr =
                    syn::parse2(text.stream()).unwrap_or_else(|error| panic!("{error}"));
                let token = between(source, (start.line, start.column), (end.line, end.column));
                found.push(format!(
                    "{}:{} `{token}`: {}",
                    start.line,
                    start.column + 1,
                    text.value()
                ));
            }
            (TokenTree::Group(group), _) => found.extend(messages(source, group.stream())),
            _ => {}
        }
    }
    found
}

/// The source text between two places, lines joined.
fn between(source: &str, start: (usize, usize), end: (usize, usize)) -> String {
    let lines = source
        .lines()
        .enumerate()
        .map(|(k, line)| (k + 1, line))
        .filter(|(k, _)| (start.0..=end.0).contains(k));
    let parts = lines.map(|(k, line)| {
        let from = if k == start.0 { start.1 } else { 0 };
        let to = if k == end.0 { end.1 } else { line.chars().count() };
        line.chars().skip(from).take(to.saturating_sub(from)).collect::<String>().trim().to_owned()
    });
    parts.collect::<Vec<_>>().join(" ")
}
