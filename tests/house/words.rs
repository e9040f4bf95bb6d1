//! Names of items and fields are words of the field, or say what they are: some that hid it do not
//! come back.

use syn::visit::{self, Visit};

use crate::{ROOT, rust_files, sources};

/// Words that say how something looks or what it is among friends, each with the word of the field.
const HIDING: [(&str, &str); 7] = [
    ("fours", "quads of numbers"),
    ("squares", "least squares, or a sum of squares"),
    ("tall", "least squares"),
    ("crew", "a batch of systems in lanes"),
    ("kept", "a cache, or the thing that is kept"),
    ("told", "a report, a sentence, or the thing that is told"),
    ("untold", "a refusal"),
];

/// Names of functions, types, modules, constants, variants and fields.
#[derive(Default)]
struct Names(Vec<String>);

impl<'a> Visit<'a> for Names {
    fn visit_item(&mut self, item: &'a syn::Item) {
        let name = match item {
            syn::Item::Fn(item) => Some(&item.sig.ident),
            syn::Item::Struct(item) => Some(&item.ident),
            syn::Item::Enum(item) => Some(&item.ident),
            syn::Item::Trait(item) => Some(&item.ident),
            syn::Item::Type(item) => Some(&item.ident),
            syn::Item::Mod(item) => Some(&item.ident),
            syn::Item::Const(item) => Some(&item.ident),
            syn::Item::Static(item) => Some(&item.ident),
            _ => None,
        };
        self.0.extend(name.map(ToString::to_string));
        visit::visit_item(self, item);
    }

    fn visit_impl_item_fn(&mut self, function: &'a syn::ImplItemFn) {
        self.0.push(function.sig.ident.to_string());
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_variant(&mut self, variant: &'a syn::Variant) {
        self.0.push(variant.ident.to_string());
        visit::visit_variant(self, variant);
    }

    fn visit_field(&mut self, field: &'a syn::Field) {
        self.0.extend(field.ident.as_ref().map(ToString::to_string));
    }
}

fn hiding(text: &str) -> Vec<String> {
    let mut names = Names::default();
    names.visit_file(&syn::parse_file(text).expect("Rust"));
    let is_hiding = |name: &String| HIDING.iter().any(|(word, _)| *word == name.to_lowercase());
    names.0.into_iter().filter(is_hiding).collect()
}

#[test]
fn names_are_words_of_the_field() {
    let mut found = Vec::new();
    for path in sources().iter().flat_map(|folder| rust_files(folder)) {
        let own = path.strip_prefix(ROOT).expect("below the root").display().to_string();
        let names = hiding(&std::fs::read_to_string(&path).expect("readable"));
        found.extend(names.into_iter().map(|name| format!("{own}: {name}")));
    }
    assert!(found.is_empty(), "say instead, of {HIDING:?}: {found:#?}");
}

#[test]
fn a_hiding_name_is_seen() {
    let text = "mod fours {} struct Crew { tall: f64 } enum E { Squares } impl E { fn tall() {} } fn f() { let tall = 1; }";
    assert_eq!(hiding(text), ["fours", "Crew", "tall", "Squares", "tall"]);
}

/// Types of one room that are called the same as those of another make a reader ask which one is
/// meant.
#[test]
fn common_names_are_given_once_in_the_core() {
    let names = ["Place", "Sweep", "Driver", "Stop", "Motion", "System", "Linear"];
    let mut found = std::collections::BTreeMap::<String, Vec<_>>::new();
    for path in rust_files("kin-core/src") {
        let file =
            syn::parse_file(&std::fs::read_to_string(&path).expect("readable")).expect("Rust");
        for ident in
            file.items.iter().filter_map(type_name).filter(|ident| names.iter().any(|n| ident == n))
        {
            found.entry(ident.to_string()).or_default().push(path.clone());
        }
    }
    assert!(found.len() > 3, "{found:#?}");
    found.retain(|_, places| places.len() > 1);
    assert!(found.is_empty(), "{found:#?}");
}

/// The name of the type that an item is.
fn type_name(item: &syn::Item) -> Option<&syn::Ident> {
    match item {
        syn::Item::Struct(item) => Some(&item.ident),
        syn::Item::Enum(item) => Some(&item.ident),
        syn::Item::Trait(item) => Some(&item.ident),
        syn::Item::Type(item) => Some(&item.ident),
        _ => None,
    }
}

#[test]
fn folders_of_the_core_have_names_of_their_own() {
    let root = std::path::Path::new(ROOT).join("kin-core/src");
    let mut folders: std::collections::BTreeMap<String, Vec<String>> = Default::default();
    for path in rust_files("kin-core/src") {
        let folder = path.parent().expect("a folder").to_path_buf();
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let own = folder.strip_prefix(&root).expect("below the root").display().to_string();
        let known = folders.entry(name).or_default();
        if !known.contains(&own) {
            known.push(own);
        }
    }
    // Code over lanes, checks and tests stand beside their own subject, a motion as data below its
    // making.
    let twice = folders.iter().filter(|(name, all)| {
        all.len() > 1 && !["tests", "lanes", "check", "motion"].contains(&name.as_str())
    });
    assert_eq!(twice.collect::<Vec<_>>(), []);
}
