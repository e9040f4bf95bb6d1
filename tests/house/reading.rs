//! The imports of a file: each `use` in it, and each path.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

/// A module by its path from the root of the crate.
pub type Module = Vec<String>;

/// Items of `kin-core` by file: what they import, and what they give on.
#[derive(Default)]
pub struct File {
    pub imports: BTreeSet<Vec<String>>,
    pub gives_on: BTreeMap<String, Vec<String>>,
    /// Names that come from elsewhere: what a path in the file may begin with.
    pub names: BTreeMap<String, Vec<String>>,
}

pub fn module(root: &Path, path: &Path) -> Module {
    let path = path.strip_prefix(root).expect("below the root").with_extension("");
    let mut parts: Vec<String> =
        path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod" || last == "lib") {
        parts.pop();
    }
    parts
}

/// True of what only tests compile.
pub fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes
        .iter()
        .any(|attribute| attribute.path().is_ident("cfg") && quote_of(attribute).contains("test"))
}

fn quote_of(attribute: &syn::Attribute) -> String {
    attribute.meta.require_list().map(|list| list.tokens.to_string()).unwrap_or_default()
}

/// Reads a file; modules of tests are told apart.
pub struct Reader<'a> {
    pub here: &'a Module,
    pub file: File,
    pub tests: Vec<Module>,
}

impl Reader<'_> {
    /// The path from the root of the crate, if it is one within the crate.
    fn whole(&self, path: &[String]) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => Some(rest.to_vec()),
            "self" => Some([&self.here[..], rest].concat()),
            "super" => {
                let up = path.iter().take_while(|part| *part == "super").count();
                Some([self.here.get(..self.here.len().checked_sub(up)?)?, &path[up..]].concat())
            }
            name => self.file.names.get(name).map(|known| [&known[..], rest].concat()),
        }
    }

    fn tree(&mut self, before: &[String], tree: &syn::UseTree, public: bool) {
        match tree {
            syn::UseTree::Path(path) => {
                self.tree(&[before, &[path.ident.to_string()]].concat(), &path.tree, public)
            }
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.tree(before, tree, public))
            }
            syn::UseTree::Name(name) => {
                self.brought(before, &name.ident.to_string(), &name.ident.to_string(), public)
            }
            syn::UseTree::Rename(name) => {
                self.brought(before, &name.ident.to_string(), &name.rename.to_string(), public)
            }
            // All names of a module: an import of it.
            syn::UseTree::Glob(_) => {
                let known = self.whole(before);
                if let Some(whole) = known.filter(|_| !public) {
                    self.file.imports.insert(whole);
                }
            }
        }
    }

    fn brought(&mut self, before: &[String], item: &str, name: &str, public: bool) {
        let path =
            if item == "self" { before.to_vec() } else { [before, &[item.to_string()]].concat() };
        let name = if name == "self" {
            path.last().cloned().unwrap_or_default()
        } else {
            name.to_string()
        };
        // A module of this file's own may be named without `self`.
        let Some(whole) =
            self.whole(&path).or_else(|| public.then(|| [&self.here[..], &path[..]].concat()))
        else {
            return;
        };
        self.file.names.insert(name.clone(), whole.clone());
        if public {
            self.file.gives_on.insert(name, whole);
        } else {
            self.file.imports.insert(whole);
        }
    }
}

impl<'a> Visit<'a> for Reader<'_> {
    fn visit_item(&mut self, item: &'a syn::Item) {
        let attributes = match item {
            syn::Item::Mod(module) => &module.attrs,
            syn::Item::Use(import) => &import.attrs,
            syn::Item::Fn(function) => &function.attrs,
            syn::Item::Impl(block) => &block.attrs,
            _ => return visit::visit_item(self, item),
        };
        match item {
            syn::Item::Mod(module) if is_test(attributes) => {
                self.tests.push([&self.here[..], &[module.ident.to_string()]].concat())
            }
            _ if is_test(attributes) => {}
            syn::Item::Use(import) => {
                self.tree(&[], &import.tree, !matches!(import.vis, syn::Visibility::Inherited))
            }
            _ => visit::visit_item(self, item),
        }
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        let parts: Vec<String> = path.segments.iter().map(|part| part.ident.to_string()).collect();
        if parts.len() > 1
            && let Some(whole) = self.whole(&parts)
        {
            self.file.imports.insert(whole);
        }
        visit::visit_path(self, path);
    }

    /// Paths among the tokens of a macro's call, which are no syntax to the reader.
    fn visit_macro(&mut self, call: &'a syn::Macro) {
        self.tokens(call.tokens.clone());
        visit::visit_macro(self, call);
    }
}

impl Reader<'_> {
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path = Vec::new();
        let mut colons = 0;
        let mut is_users = false;
        for token in tokens.into_iter().map(Some).chain([None]) {
            match token {
                Some(TokenTree::Punct(punct)) if punct.as_char() == ':' => colons += 1,
                Some(TokenTree::Ident(name)) if colons == 2 && !path.is_empty() => {
                    path.push(name.to_string());
                    colons = 0;
                }
                token => {
                    if let Some(whole) = self.whole(&path).filter(|_| path.len() > 1) {
                        self.file.imports.insert(whole);
                    }
                    (path, colons) = (Vec::new(), 0);
                    match &token {
                        // `$crate::a` in a macro that others call is resolved where it is called.
                        Some(TokenTree::Ident(name)) if !is_users => path.push(name.to_string()),
                        Some(TokenTree::Group(group)) => self.tokens(group.stream()),
                        _ => {}
                    }
                    is_users =
                        matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == '$');
                }
            }
        }
    }
}
