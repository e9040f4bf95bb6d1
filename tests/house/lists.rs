//! The operations of a graph and its functions are listed once: a `match` over most of them is the
//! evaluator, a pass, a printer, or a second list.

use std::collections::BTreeSet;
use std::path::Path;

use syn::visit::{self, Visit};

use crate::{ROOT, rust_files, sources};

/// Files that may tell operations apart one by one: the graph itself with its evaluator, its passes
/// and its text, and what writes code (or a tape) of it.
const OF_OPERATIONS: [&str; 4] = [
    "kin-graph/src/",
    "kin-macros/src/emit/",
    "kin-core/src/program/tape/",
    "kin-core/src/program/print/",
];

/// Matches that name so many variants are lists; fewer ask for something in particular.
const SHARE: f64 = 0.4;

/// Names that the arms of each `match` tell apart.
#[derive(Default)]
struct Matches(Vec<BTreeSet<String>>);

impl<'a> Visit<'a> for Matches {
    fn visit_expr_match(&mut self, expression: &'a syn::ExprMatch) {
        let mut names = Names::default();
        expression.arms.iter().for_each(|arm| names.visit_pat(&arm.pat));
        self.0.push(names.0);
        visit::visit_expr_match(self, expression);
    }
}

/// The last names of the paths in patterns.
#[derive(Default)]
struct Names(BTreeSet<String>);

impl<'a> Visit<'a> for Names {
    fn visit_path(&mut self, path: &'a syn::Path) {
        self.0.extend(path.segments.last().map(|last| last.ident.to_string()));
    }

    fn visit_pat_ident(&mut self, name: &'a syn::PatIdent) {
        self.0.insert(name.ident.to_string());
    }
}

/// The variants of an enum of `kin-graph`.
fn variants(file: &str, name: &str) -> BTreeSet<String> {
    let text = std::fs::read_to_string(Path::new(ROOT).join(file)).expect("readable");
    let items = syn::parse_file(&text).expect("Rust").items;
    let found = items.into_iter().find_map(|item| match item {
        syn::Item::Enum(item) if item.ident == name => Some(item.variants),
        _ => None,
    });
    found.expect("the enum").into_iter().map(|variant| variant.ident.to_string()).collect()
}

/// The functions of one scalar, as their list has them.
fn functions() -> BTreeSet<String> {
    macro_rules! names {
        ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => { [$(stringify!($variant)),*] };
    }
    kin_graph::functions_of_one!(names).into_iter().map(str::to_string).collect()
}

/// Files with a `match` over a good share of these names, beside those that may have one.
fn lists(of: &BTreeSet<String>, allowed: &[&str]) -> Vec<String> {
    let most = SHARE * of.len() as f64;
    let mut found = Vec::new();
    for folder in sources().into_iter().chain(["src".to_string()]) {
        for path in rust_files(&folder) {
            let name = path
                .strip_prefix(ROOT)
                .expect("below the root")
                .to_string_lossy()
                .replace('\\', "/");
            let mut matches = Matches::default();
            matches.visit_file(
                &syn::parse_file(&std::fs::read_to_string(&path).expect("readable")).expect("Rust"),
            );
            let is_list =
                matches.0.iter().any(|names| names.intersection(of).count() as f64 > most);
            if is_list && !allowed.iter().any(|known| name.starts_with(known)) {
                found.push(name);
            }
        }
    }
    found
}

#[test]
fn operations_are_told_apart_by_the_evaluator_passes_and_printers_alone() {
    let operations = variants("kin-graph/src/graph/op.rs", "Op");
    assert!(operations.len() > 10 && operations.contains("Call2"), "{operations:?}");
    let second = lists(&operations, &OF_OPERATIONS);
    assert!(second.is_empty(), "a second evaluation of a graph's operations: {second:#?}");
    assert!(
        lists(&operations, &[]).contains(&"kin-graph/src/evaluate.rs".to_string()),
        "the evaluator is not seen"
    );
}

#[test]
fn functions_are_listed_once() {
    let second = lists(&functions(), &[]);
    assert!(second.is_empty(), "a second list of functions: {second:#?}");
}
