//! The root of the crate `kin` has few names: what most programs use. Modules have the rest.

use std::fs;
use std::path::Path;

use crate::ROOT;

/// Names in the root of `kin` at most: items, modules and macros.
const MOST: usize = 60;

fn is_hidden(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("doc")
            && attribute.meta.require_list().is_ok_and(|list| list.tokens.to_string() == "hidden")
    })
}

/// The names that a tree of imports gives on.
fn leaves(tree: &syn::UseTree, found: &mut Vec<String>) {
    match tree {
        syn::UseTree::Path(path) => leaves(&path.tree, found),
        syn::UseTree::Name(name) => found.push(name.ident.to_string()),
        syn::UseTree::Rename(rename) => found.push(rename.rename.to_string()),
        syn::UseTree::Group(group) => group.items.iter().for_each(|tree| leaves(tree, found)),
        syn::UseTree::Glob(_) => {}
    }
}

/// Public names of a file that users see.
fn names(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for item in syn::parse_file(text).expect("Rust").items {
        match item {
            syn::Item::Use(item)
                if matches!(item.vis, syn::Visibility::Public(_)) && !is_hidden(&item.attrs) =>
            {
                leaves(&item.tree, &mut found);
            }
            syn::Item::Mod(item)
                if matches!(item.vis, syn::Visibility::Public(_)) && !is_hidden(&item.attrs) =>
            {
                found.push(item.ident.to_string());
            }
            _ => {}
        }
    }
    found
}

#[test]
fn the_root_of_the_crate_has_few_names() {
    let read = |path| fs::read_to_string(Path::new(ROOT).join(path)).expect("readable");
    let mut all = names(&read("kin-core/src/lib.rs"));
    all.extend(names(&read("src/lib.rs")));
    assert!(all.len() > 40, "{all:?} are not all names");
    assert!(all.len() <= MOST, "{} names, at most {MOST}: {all:?}", all.len());
}

#[test]
fn names_of_the_root_are_counted() {
    let text = "pub use a::{b, c as d, e::{f, g}}; #[doc(hidden)] pub use h; use i; pub mod j {}
        #[doc(hidden)] pub mod k {} pub use l::*;";
    assert_eq!(names(text), ["b", "d", "f", "g", "j"]);
}
