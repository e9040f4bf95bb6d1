//! Places that differ in one index: `self.pieces[0][1]`, `self.pieces[1][1]`, …

use proc_macro2::{Delimiter, Group, Literal, TokenStream, TokenTree};
use quote::quote;

/// Places at one step from each other, as one place by the row.
pub struct Progression {
    first: TokenStream,
    /// Where the index is: the number of a token, of the token in that group, and so on.
    path: Vec<usize>,
    begin: usize,
    step: usize,
}

impl Progression {
    /// `None` if the places are not at one step from each other.
    pub fn of(places: &[TokenStream]) -> Option<Self> {
        let first = places.first()?;
        let second = places.get(1)?;
        let (path, begin, next) = difference(first, second)?;
        let step = next.checked_sub(begin).filter(|&step| step > 0)?;
        let is = |(row, place): (usize, &TokenStream)| {
            difference(first, place) == Some((path.clone(), begin, begin + row * step))
        };
        let all = places.iter().enumerate().skip(1).all(is);
        all.then(|| Progression { first: first.clone(), path, begin, step })
    }

    /// The place in a row.
    pub fn at(&self, row: &TokenStream) -> TokenStream {
        let begin = Literal::usize_unsuffixed(self.begin);
        let step = Literal::usize_unsuffixed(self.step);
        let index = if self.step == 1 { quote!(#row) } else { quote!(#row * #step) };
        let index = if self.begin == 0 { index } else { quote!(#index + #begin) };
        replaced(self.first.clone(), &self.path, &index)
    }
}

/// The only index in which two places differ: where it is, and both of its values.
fn difference(a: &TokenStream, b: &TokenStream) -> Option<(Vec<usize>, usize, usize)> {
    let (a, b): (Vec<TokenTree>, Vec<TokenTree>) =
        (a.clone().into_iter().collect(), b.clone().into_iter().collect());
    if a.len() != b.len() {
        return None;
    }
    let mut found = None;
    for (k, (a, b)) in a.iter().zip(&b).enumerate() {
        let inner = match (a, b) {
            (TokenTree::Ident(a), TokenTree::Ident(b)) if a == b => continue,
            (TokenTree::Punct(a), TokenTree::Punct(b)) if a.as_char() == b.as_char() => continue,
            (TokenTree::Literal(a), TokenTree::Literal(b)) if a.to_string() == b.to_string() => {
                continue;
            }
            (TokenTree::Group(a), TokenTree::Group(b)) if a.delimiter() == b.delimiter() => {
                match (index(a), index(b)) {
                    (Some(a), Some(b)) if a == b => continue,
                    (Some(a), Some(b)) => (vec![], a, b),
                    _ => difference(&a.stream(), &b.stream())?,
                }
            }
            _ => return None,
        };
        let (inside, a, b) = inner;
        let path = [k].into_iter().chain(inside).collect();
        if found.replace((path, a, b)).is_some() {
            return None;
        }
    }
    found
}

/// The number in brackets.
fn index(group: &Group) -> Option<usize> {
    let mut tokens = group.stream().into_iter();
    match (group.delimiter(), tokens.next()?, tokens.next()) {
        (Delimiter::Bracket, TokenTree::Literal(number), None) => number.to_string().parse().ok(),
        _ => None,
    }
}

fn replaced(tokens: TokenStream, path: &[usize], index: &TokenStream) -> TokenStream {
    let Some((&at, path)) = path.split_first() else { return index.clone() };
    let of = |(k, token)| match token {
        TokenTree::Group(group) if k == at => {
            TokenTree::Group(Group::new(group.delimiter(), replaced(group.stream(), path, index)))
        }
        token => token,
    };
    tokens.into_iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(places: &[&str]) -> Option<String> {
        let places: Vec<TokenStream> =
            places.iter().map(|place| place.parse().unwrap_or_default()).collect();
        Progression::of(&places).map(|found| found.at(&quote!(row)).to_string().replace(' ', ""))
    }

    #[test]
    fn one_index_by_equal_steps_is_read_by_the_row() {
        assert_eq!(
            at(&["self.a[1][2]", "self.a[2][2]", "self.a[3][2]"]).as_deref(),
            Some("self.a[row+1][2]")
        );
        assert_eq!(at(&["self.a[0].x", "self.a[2].x"]).as_deref(), Some("self.a[row*2].x"));
    }

    #[test]
    fn anything_else_is_not() {
        assert_eq!(at(&["self.a[1]", "self.b[2]"]), None);
        assert_eq!(at(&["self.a.0", "self.a.1"]), None);
        assert_eq!(at(&["self.a[0]", "self.a[1]", "self.a[3]"]), None);
        assert_eq!(at(&["self.a[1][1]", "self.a[2][2]"]), None);
        assert_eq!(at(&["self.a[2]", "self.a[1]"]), None);
        assert_eq!(at(&["self.a[1]", "self.a[1]"]), None);
        assert_eq!(at(&["self.a"]), None);
    }
}
