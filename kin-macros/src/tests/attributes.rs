//! Finds `#[constraint]`, `#[potential]`, `#[force]` and `#[law]` in a file and expands what is
//! under them, as rustc would.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use crate::expand;

/// An item under one of the attributes.
pub struct Attributed {
    pub name: String,
    /// Name of the attribute.
    pub mark: String,
    pub arguments: TokenStream,
    pub item: TokenStream,
}

impl Attributed {
    pub fn expand(&self) -> TokenStream {
        let arguments = self.arguments.clone();
        let item = self.item.clone();
        match self.mark.as_str() {
            "law" => expand::law(&arguments, item),
            "potential" => expand::potential(arguments, item),
            "force" => expand::force(arguments, item),
            _ => expand::constraint(arguments, item),
        }
    }
}

/// The part of an expansion that the compiler sees, taken out of the macros that choose between it
/// and an editor. What an editor is shown need be no Rust, since the user's body is in it.
pub fn compiled(expansion: TokenStream) -> syn::Result<syn::File> {
    let mut file: syn::File = syn::parse2(expansion)?;
    let mut items = Vec::new();
    for item in file.items {
        match &item {
            syn::Item::Macro(call)
                if call
                    .mac
                    .path
                    .segments
                    .last()
                    .is_some_and(|last| last.ident == "outside_editor") =>
            {
                items.extend(syn::parse2::<syn::File>(call.mac.tokens.clone())?.items);
            }
            syn::Item::Macro(call)
                if call
                    .mac
                    .path
                    .segments
                    .last()
                    .is_some_and(|last| last.ident == "inside_editor") => {}
            _ => items.push(item),
        }
    }
    file.items = items;
    Ok(file)
}

/// Every item of `file` under one of the attributes. Works on tokens, so that the item need not be
/// good Rust.
pub fn attributed(file: TokenStream) -> Vec<Attributed> {
    let mut found = Vec::new();
    let mut item: Vec<TokenTree> = Vec::new();
    for token in file {
        let is_end = match &token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            TokenTree::Punct(punct) => punct.as_char() == ';',
            _ => false,
        };
        item.push(token);
        if is_end {
            found.extend(without_attribute(&std::mem::take(&mut item)));
        }
    }
    found
}

fn without_attribute(item: &[TokenTree]) -> Option<Attributed> {
    let place = item.windows(2).position(|pair| is_attribute(&pair[0], &pair[1]).is_some())?;
    let (mark, arguments) = is_attribute(&item[place], &item[place + 1])?;
    let rest: Vec<TokenTree> = item
        .iter()
        .enumerate()
        .filter(|(k, _)| *k != place && *k != place + 1)
        .map(|(_, t)| t.clone())
        .collect();
    let keyword = rest.iter().position(
        |token| matches!(token, TokenTree::Ident(word) if word == "fn" || word == "struct"),
    );
    let name = keyword.and_then(|k| rest.get(k + 1)).map(ToString::to_string).unwrap_or_default();
    Some(Attributed { name, mark, arguments, item: rest.into_iter().collect() })
}

/// Recognises two tokens that are `#` and `[constraint(…)]` or `[law]`: gives which of them, and
/// the attribute's own arguments.
fn is_attribute(hash: &TokenTree, content: &TokenTree) -> Option<(String, TokenStream)> {
    let (TokenTree::Punct(hash), TokenTree::Group(content)) = (hash, content) else { return None };
    let mut tokens = content.stream().into_iter();
    let name = tokens.next()?.to_string();
    let arguments = match tokens.next() {
        Some(TokenTree::Group(arguments)) => Group::stream(&arguments),
        _ => TokenStream::new(),
    };
    let is_known = ["constraint", "potential", "force", "law"].contains(&name.as_str());
    (hash.as_char() == '#' && is_known).then_some((name, arguments))
}
