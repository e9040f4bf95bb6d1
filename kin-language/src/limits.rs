//! Limits of an item: its depth and length, because every reader of it recurses on a stack of a few
//! megabytes; and its numbers, because emitted code repeats for each of them.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::error::mistake;
use crate::parse::{Argument, Kind, Shape};

/// The greatest length of the path to a token. An operator counts once and a group `GROUP` times.
const LONGEST_WAY: usize = 640;
const GROUP: usize = 10;

/// The most coordinates of all arguments of a constraint. Each has a column of C_q and code in
/// every kernel.
const MOST_COORDINATES: usize = 256;
/// The most numbers of all parameters, and the most rows.
const MOST_NUMBERS: usize = 4_096;

/// Refuses arguments with too many coordinates or numbers, at the first argument beyond the limit.
pub fn arguments(all: &[Argument]) -> syn::Result<()> {
    let mut coordinates = 0_usize;
    let mut numbers = 0_usize;
    for Argument { kind, ty, .. } in all {
        coordinates = coordinates.saturating_add(kind.columns());
        if let Kind::Numbers(shape) = kind {
            numbers = numbers.saturating_add(count(shape));
        }
        if coordinates > MOST_COORDINATES {
            let text = format!(
                "a constraint takes at most {MOST_COORDINATES} coordinates: split the equations into several constraints"
            );
            return Err(syn::Error::new_spanned(ty, text));
        }
        if numbers > MOST_NUMBERS {
            let text = format!(
                "a constraint takes at most {MOST_NUMBERS} numbers as parameters: pass a `Law`, or a user-defined type with a method"
            );
            return Err(syn::Error::new_spanned(ty, text));
        }
    }
    Ok(())
}

/// Refuses too many rows.
pub fn rows(shape: &Shape, ty: &syn::Type) -> syn::Result<()> {
    if count(shape) <= MOST_NUMBERS {
        return Ok(());
    }
    let text = format!(
        "a constraint has at most {MOST_NUMBERS} rows: split the rows into several constraints"
    );
    Err(syn::Error::new_spanned(ty, text))
}

/// Returns how many numbers a type has. A list without numbers counts as one, because code also
/// loops over a list of such lists.
fn count(shape: &Shape) -> usize {
    match shape {
        Shape::Scalar | Shape::Any => 1,
        Shape::Vector(n) => *n,
        Shape::Matrix(n) => n * n,
        Shape::Euler => 4,
        Shape::Array(inner, n) => count(inner).max(1).saturating_mul(*n),
        Shape::Tuple(all) => all.iter().map(count).fold(0, usize::saturating_add),
    }
}

/// Refuses an item that would overflow the stack.
pub fn check(item: &TokenStream) -> syn::Result<()> {
    within(item, LONGEST_WAY)
}

fn within(tokens: &TokenStream, budget: usize) -> syn::Result<()> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    // The reader recurses from one arm of a `match` into the next.
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

const TOO_LONG: &str =
    "this expression is nested too deeply, or is too long: name parts of the expression with `let`";

/// Splits the tokens at commas and semicolons, and after blocks that end a statement.
fn expressions(tokens: &[TokenTree]) -> Vec<&[TokenTree]> {
    let ends = |k: &usize| match (&tokens[*k], tokens.get(k + 1)) {
        (TokenTree::Punct(punct), _) => matches!(punct.as_char(), ',' | ';'),
        (TokenTree::Group(group), Some(TokenTree::Ident(next))) => {
            group.delimiter() == Delimiter::Brace && next != "else"
        }
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
