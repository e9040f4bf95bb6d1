//! How deep and how long an item may be: everything that reads it recurses over it, on a stack of a few megabytes.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::error::mistake;

/// The way to a token may be this long, operators counted once and groups `GROUP` times.
const LONGEST_WAY: usize = 640;
const GROUP: usize = 10;

/// Refuses an item that would overflow the stack.
pub fn check(item: &TokenStream) -> syn::Result<()> {
    within(item, LONGEST_WAY)
}

fn within(tokens: &TokenStream, budget: usize) -> syn::Result<()> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    // The arms of a `match` are read one inside of the other.
    let budget = budget.saturating_sub(arms(&tokens));
    for expression in expressions(&tokens) {
        let operators = expression.iter().filter(|token| is_operator(token)).count();
        for token in expression {
            let rest = budget.checked_sub(operators);
            match (token, rest.and_then(|rest| rest.checked_sub(GROUP))) {
                (TokenTree::Group(group), Some(rest)) => within(&group.stream(), rest)?,
                (TokenTree::Group(_), None) => return Err(mistake(token, TOO_LONG)),
                _ if rest.is_none() => return Err(mistake(token, TOO_LONG)),
                _ => {}
            }
        }
    }
    Ok(())
}

const TOO_LONG: &str = "this is nested too deeply, or goes on for too long in one expression: name parts of it with `let`";

/// The tokens cut at commas and semicolons, and behind blocks that end a statement.
fn expressions(tokens: &[TokenTree]) -> Vec<&[TokenTree]> {
    let ends = |k: &usize| match (&tokens[*k], tokens.get(k + 1)) {
        (TokenTree::Punct(punct), _) => matches!(punct.as_char(), ',' | ';'),
        (TokenTree::Group(group), Some(TokenTree::Ident(next))) => group.delimiter() == Delimiter::Brace && next != "else",
        _ => false,
    };
    let mut start = 0;
    let mut all = Vec::new();
    for end in (0..tokens.len()).filter(ends).chain([tokens.len().saturating_sub(1)]) {
        all.push(tokens.get(start..=end).unwrap_or_default());
        start = end + 1;
    }
    all
}

fn arms(tokens: &[TokenTree]) -> usize {
    let is = |token: &TokenTree, sign| matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign);
    tokens.windows(2).filter(|pair| is(&pair[0], '=') && is(&pair[1], '>')).count()
}

fn is_operator(token: &TokenTree) -> bool {
    match token {
        TokenTree::Punct(_) => true,
        TokenTree::Ident(word) => word == "else",
        _ => false,
    }
}
