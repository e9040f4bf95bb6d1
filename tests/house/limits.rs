//! The limits that CONTRIBUTING.md states, of every file of the workspace that is written by hand.

use std::collections::BTreeMap;
use std::path::PathBuf;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::rust_files;

/// Lines of a file, and of a function from its signature to its end.
const FILE: usize = 800;
const FUNCTION: usize = 100;

/// Functions that are too long, with their lines.
struct Long {
    found: Vec<(String, usize)>,
    /// An example reads from top to bottom.
    is_example: bool,
}

impl Long {
    fn look(&mut self, name: &syn::Ident, from: Span, block: &syn::Block) {
        let lines = block.span().end().line + 1 - from.start().line;
        if lines > FUNCTION && !(self.is_example && name == "main") {
            self.found.push((name.to_string(), lines));
        }
    }
}

impl<'a> Visit<'a> for Long {
    fn visit_item_fn(&mut self, function: &'a syn::ItemFn) {
        self.look(&function.sig.ident, function.sig.span(), &function.block);
        visit::visit_item_fn(self, function);
    }

    fn visit_impl_item_fn(&mut self, function: &'a syn::ImplItemFn) {
        self.look(&function.sig.ident, function.sig.span(), &function.block);
        visit::visit_impl_item_fn(self, function);
    }

    fn visit_trait_item_fn(&mut self, function: &'a syn::TraitItemFn) {
        if let Some(block) = &function.default {
            self.look(&function.sig.ident, function.sig.span(), block);
        }
        visit::visit_trait_item_fn(self, function);
    }
}

#[test]
fn files_and_functions_are_short() {
    let all = rust_files(".");
    let mut long = Vec::new();
    assert!(all.len() > 300, "{} files are not all of them", all.len());
    for path in all {
        let text = std::fs::read_to_string(&path).expect("readable");
        let lines = text.lines().count();
        if lines > FILE {
            long.push(format!("{}: {lines} lines", path.display()));
        }
        let file =
            syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut functions = Long {
            found: Vec::new(),
            is_example: path.parent().is_some_and(|folder| folder.ends_with("examples")),
        };
        functions.visit_file(&file);
        long.extend(
            functions
                .found
                .iter()
                .map(|(name, lines)| format!("{}: `{name}` has {lines} lines", path.display())),
        );
    }
    assert!(
        long.is_empty(),
        "at most {FILE} lines a file and {FUNCTION} a function:\n{}",
        long.join("\n")
    );
}

/// Code is held to the width by rustfmt; comments are not, but for tables.
#[test]
fn lines_end_at_100_columns() {
    const WIDTH: usize = 100;
    let settings = std::fs::read_to_string(std::path::Path::new(crate::ROOT).join("rustfmt.toml"))
        .expect("readable");
    assert!(settings.contains(&format!("max_width = {WIDTH}")), "{settings}");
    let mut wide = Vec::new();
    for path in rust_files(".") {
        let text = std::fs::read_to_string(&path).expect("readable");
        for (k, line) in text.lines().enumerate() {
            let comment = line.trim_start();
            let is_table = comment.trim_start_matches(['/', '!', ' ']).starts_with('|');
            if comment.starts_with("//") && !is_table && line.chars().count() > WIDTH {
                wide.push(format!("{}:{}", path.display(), k + 1));
            }
        }
    }
    assert!(wide.is_empty(), "comments beyond column {WIDTH}: {wide:#?}");
}

/// The map and the first page are read as a whole: they end where a reader's patience does.
#[test]
fn the_map_and_the_first_page_are_short() {
    for (page, most) in [("ARCHITECTURE.md", 80), ("README.md", 100)] {
        let text = std::fs::read_to_string(std::path::Path::new(crate::ROOT).join(page))
            .expect("readable");
        let lines = text.lines().count();
        assert!(lines <= most, "{page} has {lines} lines, at most {most}");
    }
}

#[test]
fn folders_of_the_core_have_few_files() {
    const MOST: usize = 24;
    let mut folders: BTreeMap<PathBuf, usize> = BTreeMap::new();
    for path in rust_files("kin-core/src") {
        *folders.entry(path.parent().expect("a folder").to_path_buf()).or_default() += 1;
    }
    assert!(folders.len() > 20, "{} folders are not all of them", folders.len());
    let full: Vec<_> = folders.iter().filter(|(_, files)| **files > MOST).collect();
    assert!(full.is_empty(), "at most {MOST} files in a folder: {full:#?}");
}

#[test]
fn a_long_function_is_seen() {
    let text =
        format!("fn short() {{}}\nimpl A {{ fn long() {{ {} }} }}", "call();\n".repeat(FUNCTION));
    let mut functions = Long { found: Vec::new(), is_example: false };
    functions.visit_file(&syn::parse_file(&text).expect("is Rust"));
    assert_eq!(functions.found, [("long".to_string(), FUNCTION + 1)]);
}
