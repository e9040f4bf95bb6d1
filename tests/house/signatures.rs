//! Arguments of public functions say by their type or name what they are: no number that stands for
//! a case, no row of slices in an order that is to be remembered, no `true` among other arguments.

use quote::ToTokens;
use syn::visit::{self, Visit};

use crate::{ROOT, rust_files};

/// Rooms whose public functions users call; `emitted/` is called by emitted code, `linear/` by
/// solvers, which a user sees nothing of.
const FOLDERS: [&str; 7] = [
    "src",
    "kin-core/src/model",
    "kin-core/src/joints",
    "kin-core/src/solve",
    "kin-core/src/ask",
    "kin-core/src/design",
    "kin-core/src/data",
];

/// Public functions with an argument that does not say what it is.
#[derive(Default)]
struct Unclear(Vec<String>);

impl Unclear {
    fn look(&mut self, visibility: &syn::Visibility, signature: &syn::Signature) {
        if !matches!(visibility, syn::Visibility::Public(_)) {
            return;
        }
        let typed = signature.inputs.iter().filter_map(|input| match input {
            syn::FnArg::Typed(typed) => Some(typed),
            syn::FnArg::Receiver(_) => None,
        });
        let arguments: Vec<&syn::PatType> = typed.collect();
        for argument in &arguments {
            let name = argument.pat.to_token_stream().to_string();
            let ty = &*argument.ty;
            let is_case = ["what", "which", "kind", "mode", "second"].contains(&&*name);
            let number = |ty: &syn::Type| is_named(ty, &["usize", "u8", "u32", "i32", "bool"]);
            let is_switch = is_named(ty, &["bool"]) && arguments.len() > 1;
            if is_case && number(ty) || is_switch || is_row_of_slices(ty) {
                self.0.push(format!("{}({name}: {})", signature.ident, ty.to_token_stream()));
            }
        }
    }
}

fn is_named(ty: &syn::Type, names: &[&str]) -> bool {
    matches!(ty, syn::Type::Path(path) if names.iter().any(|name| path.path.is_ident(name)))
}

/// An array or a slice of slices, lists or pairs of numbers: `[&[f64]; 3]`, `&[[u32; 2]]`.
fn is_row_of_slices(ty: &syn::Type) -> bool {
    let inner = |ty: &syn::Type| match ty {
        syn::Type::Reference(reference) => matches!(&*reference.elem, syn::Type::Slice(_)),
        syn::Type::Array(array) => is_named(&array.elem, &["u32", "usize"]),
        syn::Type::Path(path) => path.path.segments.last().is_some_and(|last| last.ident == "Vec"),
        _ => false,
    };
    match ty {
        syn::Type::Array(array) => inner(&array.elem),
        syn::Type::Slice(slice) => inner(&slice.elem),
        syn::Type::Reference(reference) => is_row_of_slices(&reference.elem),
        _ => false,
    }
}

impl<'a> Visit<'a> for Unclear {
    fn visit_item_fn(&mut self, function: &'a syn::ItemFn) {
        self.look(&function.vis, &function.sig);
    }

    fn visit_impl_item_fn(&mut self, function: &'a syn::ImplItemFn) {
        self.look(&function.vis, &function.sig);
    }

    fn visit_item_trait(&mut self, item: &'a syn::ItemTrait) {
        for method in item.items.iter() {
            if let syn::TraitItem::Fn(method) = method {
                self.look(&item.vis, &method.sig);
            }
        }
        visit::visit_item_trait(self, item);
    }
}

fn unclear(text: &str) -> Vec<String> {
    let mut found = Unclear::default();
    found.visit_file(&syn::parse_file(text).expect("Rust"));
    found.0
}

#[test]
fn public_functions_name_what_they_take() {
    let mut found = Vec::new();
    for path in FOLDERS.iter().flat_map(|folder| rust_files(folder)) {
        let own = path.strip_prefix(ROOT).expect("below the root").display().to_string();
        let text = std::fs::read_to_string(&path).expect("readable");
        found.extend(unclear(&text).into_iter().map(|found| format!("{own}: {found}")));
    }
    assert!(found.is_empty(), "types with a name say what these are: {found:#?}");
}

#[test]
fn an_unclear_argument_is_seen() {
    let text = "pub fn a(what: usize, x: f64) {} pub fn b([q, qd]: [&[f64]; 2]) {} fn c(what: usize) {}
        pub fn d(offsets: &[[u32; 2]]) {} pub fn e(on: bool) {} pub struct S; impl S { pub fn f(&self, x: f64, second: bool) {} }
        pub trait T { fn g(&self, x: f64, on: bool); } pub(crate) fn h(rows: [&[f64]; 2]) {} pub fn i(r: [f64; 3]) {}";
    let names: Vec<String> = unclear(text)
        .iter()
        .map(|found| found.split('(').next().unwrap_or_default().to_string())
        .collect();
    assert_eq!(names, ["a", "b", "d", "f", "g"]);
}

/// The one trait of the library stays small: its description, ten formulas, and one way each to see
/// and to change what has traits of its own.
#[test]
fn the_trait_of_constraints_is_small() {
    const MOST: usize = 14;
    let path = std::path::Path::new(ROOT).join("kin-core/src/model/constraint/mod.rs");
    let file = syn::parse_file(&std::fs::read_to_string(path).expect("readable")).expect("Rust");
    let methods = file.items.iter().find_map(|item| match item {
        syn::Item::Trait(item) if item.ident == "Constraint" => Some(item.items.len()),
        _ => None,
    });
    assert!(methods.expect("the trait") <= MOST, "{methods:?} methods, at most {MOST}");
}
