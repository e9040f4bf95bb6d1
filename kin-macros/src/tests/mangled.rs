//! The macro never panics: good constraints with tokens left out, doubled, exchanged or replaced, a
//! few hundred of them from a fixed seed.

use std::panic::{AssertUnwindSafe, catch_unwind};

use proc_macro2::{Group, TokenStream, TokenTree};

use super::attributes::{Attributed, attributed, compiled};
use super::rust_files;

/// How many streams are tried.
const STREAMS: usize = 800;

#[test]
fn mangled_constraints_give_messages_and_never_panic() {
    let refused = refused(&originals(), STREAMS);
    assert!(
        (STREAMS / 4..STREAMS).contains(&refused),
        "{refused} of {STREAMS} streams are refused"
    );
}

/// `KIN_STREAMS=4000` tries as many of them.
#[test]
fn mangled_bodies_of_honest_rust_give_messages_and_never_panic() {
    let streams =
        std::env::var("KIN_STREAMS").ok().and_then(|n| n.parse().ok()).unwrap_or(STREAMS / 2);
    let bodies = bodies();
    assert!(bodies.len() > 60, "only {} bodies", bodies.len());
    let refused = refused(&bodies, streams);
    assert!(refused > streams / 8, "{refused} of {streams} streams are refused");
}

/// How many of so many mangled items are refused.
fn refused(originals: &[Attributed], streams: usize) -> usize {
    let mut random = SplitMix(0x005E_ED0F_0CA7_C0DE);
    let mut refused = 0;
    for _ in 0..streams {
        let original = &originals[random.below(originals.len())];
        let mut item = original.item.clone();
        for _ in 0..1 + random.below(3) {
            item = mangled(&item, &mut random);
        }
        let text = item.to_string();
        let mangled = Attributed {
            name: original.name.clone(),
            item,
            arguments: original.arguments.clone(),
            mark: original.mark.clone(),
        };
        let Ok(expansion) = catch_unwind(AssertUnwindSafe(|| mangled.expand())) else {
            panic!("the macro panics at\n{text}")
        };
        let expansion_text = expansion.to_string();
        refused += usize::from(expansion_text.contains("compile_error"));
        if let Err(error) = compiled(expansion) {
            panic!("the macro emits no Rust ({error}) for\n{text}\n\n{expansion_text}");
        }
    }
    refused
}

/// The functions of the language's tests that are compiled twice.
pub fn bodies() -> Vec<Attributed> {
    let files = ["../tests/language", "../tests/language/corpus"].into_iter().flat_map(rust_files);
    let mut all = Vec::new();
    for (name, path) in files.filter(|(name, _)| name != "twice") {
        let source = std::fs::read_to_string(path).unwrap_or_default();
        let tokens: TokenStream = source.parse().unwrap_or_else(|error| panic!("{name}: {error}"));
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        for three in tokens.windows(3) {
            let (TokenTree::Ident(word), TokenTree::Group(group)) = (&three[0], &three[2]) else {
                continue;
            };
            let item = group.stream().into_iter().skip_while(|token| token.to_string() != "fn");
            if word == "twice" {
                all.push(Attributed {
                    name: "f".into(),
                    mark: "constraint".to_string(),
                    arguments: TokenStream::new(),
                    item: item.collect(),
                });
            }
        }
    }
    all
}

/// Everything under an attribute in the golden source and in the programs with one slip.
fn originals() -> Vec<Attributed> {
    let files = rust_files("golden")
        .into_iter()
        .filter(|(name, _)| name == "source")
        .chain(rust_files("../tests/ui"));
    let mut all = Vec::new();
    for (name, path) in files {
        let source = std::fs::read_to_string(path).unwrap_or_default();
        all.extend(attributed(source.parse().unwrap_or_else(|error| panic!("{name}: {error}"))));
    }
    all
}

/// The same tokens with one change somewhere among them.
pub fn mangled(tokens: &TokenStream, random: &mut SplitMix) -> TokenStream {
    let place = random.below(count(tokens));
    let other = nth(tokens, &mut random.below(count(tokens)));
    changed(tokens.clone(), &mut { place }, &mut |all, k| match random.below(4) {
        0 => drop(all.remove(k)),
        1 => all.insert(k, all[k].clone()),
        2 if k + 1 < all.len() => all.swap(k, k + 1),
        _ => all[k] = other.clone().unwrap_or_else(|| all[k].clone()),
    })
}

fn count(tokens: &TokenStream) -> usize {
    tokens
        .clone()
        .into_iter()
        .map(|token| {
            1 + if let TokenTree::Group(group) = token { count(&group.stream()) } else { 0 }
        })
        .sum()
}

/// Token number `place` of all, those inside of groups counted too.
fn nth(tokens: &TokenStream, place: &mut usize) -> Option<TokenTree> {
    for token in tokens.clone() {
        if *place == 0 {
            return Some(token);
        }
        *place -= 1;
        if let TokenTree::Group(group) = &token
            && let Some(found) = nth(&group.stream(), place)
        {
            return Some(found);
        }
    }
    None
}

/// `change` at token number `place`.
fn changed(
    tokens: TokenStream,
    place: &mut usize,
    change: &mut dyn FnMut(&mut Vec<TokenTree>, usize),
) -> TokenStream {
    let mut all: Vec<TokenTree> = tokens.into_iter().collect();
    for k in 0..all.len() {
        if *place == 0 {
            change(&mut all, k);
            *place = usize::MAX;
            break;
        }
        *place -= 1;
        if let TokenTree::Group(group) = &all[k] {
            let mut inner = Group::new(group.delimiter(), changed(group.stream(), place, change));
            inner.set_span(group.span());
            all[k] = TokenTree::Group(inner);
        }
        if *place > usize::MAX / 2 {
            break;
        }
    }
    all.into_iter().collect()
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
