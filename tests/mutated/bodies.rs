//! The bodies of the corpus, and small changes of them: a word for another of the same body, an
//! operator for another, a literal for another, a token left out or doubled, two exchanged.

use std::path::Path;

use proc_macro2::{Delimiter, Group, Punct, Spacing, TokenStream, TokenTree};
use quote::ToTokens;

/// A constraint of the corpus.
pub struct Body {
    pub name: String,
    /// Its arguments, as the corpus says them.
    pub given: TokenStream,
    /// The function.
    pub function: TokenStream,
    /// The other items of its file.
    pub around: TokenStream,
}

/// Every constraint of the corpus that is written out, in the order of files and lines.
pub fn bodies() -> Vec<Body> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/language/corpus");
    let entries = std::fs::read_dir(folder).expect("the corpus can be read");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
        .iter()
        .flat_map(|path| of_file(&std::fs::read_to_string(path).expect("readable")))
        .collect()
}

fn of_file(source: &str) -> Vec<Body> {
    let file = syn::parse_file(source).expect("the corpus is Rust");
    let mut found = Vec::new();
    let mut around = TokenStream::new();
    for item in file.items {
        match &item {
            syn::Item::Macro(call) if call.mac.path.is_ident("twice") => {
                found.extend(body(&call.mac.tokens))
            }
            // Constraints made by a macro of the corpus, and imports from the tests around it, stay
            // out.
            syn::Item::Macro(_) => {}
            syn::Item::Use(import) if text(&import.tree).starts_with("crate") => {}
            other => around.extend(other.to_token_stream()),
        }
    }
    found.iter_mut().for_each(|body| body.around = around.clone());
    found
}

fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string()
}

/// `Symbolic name(given): fn f…`
fn body(tokens: &TokenStream) -> Option<Body> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let colon = tokens
        .iter()
        .position(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == ':'))?;
    let (TokenTree::Ident(name), TokenTree::Group(given)) =
        (&tokens[colon - 2], &tokens[colon - 1])
    else {
        return None;
    };
    Some(Body {
        name: name.to_string(),
        given: given.stream(),
        function: tokens[colon + 1..].iter().cloned().collect(),
        around: TokenStream::new(),
    })
}

/// The function with one change somewhere in its block.
pub fn mutated(function: &TokenStream, random: &mut SplitMix) -> TokenStream {
    let mut tokens: Vec<TokenTree> = function.clone().into_iter().collect();
    let Some(TokenTree::Group(block)) = tokens.last().cloned() else { return function.clone() };
    let inside = block.stream();
    let mut places = Vec::new();
    collect(&inside, &mut places);
    if places.is_empty() {
        return function.clone();
    }
    // Two of three changes are such that the types stay: an operator or a literal for another.
    let gentle: Vec<usize> = (0..places.len()).filter(|&k| keeps_types(&places[k])).collect();
    let place = match gentle.len() {
        n if n > 0 && random.below(3) > 0 => gentle[random.below(n)],
        _ => random.below(places.len()),
    };
    let change = change(&places, place, random);
    let mut counter = place;
    let last = tokens.len() - 1;
    tokens[last] = Group::new(Delimiter::Brace, changed(inside, &mut counter, &change)).into();
    tokens.into_iter().collect()
}

/// All tokens, each group before what is in it.
fn collect(tokens: &TokenStream, found: &mut Vec<TokenTree>) {
    for token in tokens.clone() {
        found.push(token.clone());
        if let TokenTree::Group(group) = &token {
            collect(&group.stream(), found);
        }
    }
}

/// Operators between numbers that give a number.
const ARITHMETIC: [char; 5] = ['+', '-', '*', '/', '%'];
const OPERATORS: [char; 9] = ['+', '-', '*', '/', '%', '<', '>', '&', '!'];

/// True of an operator between numbers, and of a literal.
fn keeps_types(token: &TokenTree) -> bool {
    match token {
        TokenTree::Punct(punct) => ARITHMETIC.contains(&punct.as_char()),
        token => matches!(token, TokenTree::Literal(_)),
    }
}

/// The tokens that stand in the place of one.
fn change(all: &[TokenTree], place: usize, random: &mut SplitMix) -> Vec<TokenTree> {
    let token = &all[place];
    match random.below(10) {
        0 => return vec![],
        1 => return vec![token.clone(), token.clone()],
        _ => {}
    }
    let alike: Vec<&TokenTree> = all.iter().filter(|other| kind(other) == kind(token)).collect();
    match token {
        TokenTree::Punct(punct) if ARITHMETIC.contains(&punct.as_char()) => {
            vec![Punct::new(ARITHMETIC[random.below(ARITHMETIC.len())], Spacing::Alone).into()]
        }
        TokenTree::Punct(punct) if OPERATORS.contains(&punct.as_char()) => {
            vec![Punct::new(OPERATORS[random.below(OPERATORS.len())], Spacing::Alone).into()]
        }
        _ => vec![alike[random.below(alike.len())].clone()],
    }
}

/// Tokens of one kind stand for one another; of groups those of one bracket.
fn kind(token: &TokenTree) -> u8 {
    match token {
        TokenTree::Ident(_) => 0,
        TokenTree::Literal(_) => 1,
        TokenTree::Punct(_) => 2,
        TokenTree::Group(group) => match group.delimiter() {
            Delimiter::Parenthesis => 3,
            Delimiter::Brace => 4,
            Delimiter::Bracket => 5,
            Delimiter::None => 6,
        },
    }
}

/// The tokens with another in the place of number `counter`.
fn changed(tokens: TokenStream, counter: &mut usize, change: &[TokenTree]) -> TokenStream {
    let mut out = Vec::new();
    for token in tokens {
        let is_here = *counter == 0;
        *counter = counter.wrapping_sub(1);
        match token {
            _ if is_here => {
                *counter = usize::MAX;
                out.extend(change.iter().cloned());
            }
            TokenTree::Group(group) if *counter < usize::MAX / 2 => {
                out.push(
                    Group::new(group.delimiter(), changed(group.stream(), counter, change)).into(),
                );
            }
            other => out.push(other),
        }
    }
    out.into_iter().collect()
}

/// Reproducible random numbers (SplitMix64).
pub struct SplitMix(pub u64);

impl SplitMix {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}
