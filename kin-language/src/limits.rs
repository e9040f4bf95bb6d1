//! How deep and how long an item may be: everything that reads it recurses over it, on a stack of a
//! few megabytes. And how many numbers it may speak of: code is written out for each of them.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::error::mistake;
use crate::parse::{Argument, Kind, Shape};

/// The way to a token may be this long, operators counted once and groups `GROUP` times.
const LONGEST_WAY: usize = 640;
const GROUP: usize = 10;

/// Coordinates of all arguments of a constraint: each has a column of C_q, and code of its own in
/// every kernel.
const MOST_COORDINATES: usize = 256;
/// Numbers of all parameters, and rows.
const MOST_NUMBERS: usize = 4_096;

/// Refuses arguments of more coordinates or numbers than code can be written out for, at the one
/// that is too many.
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
                "a constraint takes {MOST_COORDINATES} coordinates at most, for code is written out for each: add one constraint for each part of \
                 the equations"
            );
            return Err(syn::Error::new_spanned(ty, text));
        }
        if numbers > MOST_NUMBERS {
            let text = format!(
                "a constraint takes {MOST_NUMBERS} numbers as parameters at most, for code is written out for each: hand over a `Law`, or a type of \
                 your own with a method"
            );
            return Err(syn::Error::new_spanned(ty, text));
        }
    }
    Ok(())
}

/// Refuses more rows than code can be written out for.
pub fn rows(shape: &Shape, ty: &syn::Type) -> syn::Result<()> {
    if count(shape) <= MOST_NUMBERS {
        return Ok(());
    }
    let text = format!(
        "a constraint has {MOST_NUMBERS} rows at most, for code is written out for each: add one constraint for each part of them"
    );
    Err(syn::Error::new_spanned(ty, text))
}

/// How many numbers a type has; a list without numbers counts as one, for lists of it are gone
/// through too.
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
