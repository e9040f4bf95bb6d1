//! The rooms of `kin-language`'s interpreter: a file imports from its own room and from earlier
//! rooms, and calls methods of the interpreter that these rooms define. Methods of one object lead
//! from file to file as imports do, without a word in the head of a file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

use crate::imports::{House, rings};
use crate::reading::{Module, is_test, module};
use crate::{ROOT, rust_files};

const FOLDER: &str = "kin-language/src";

/// The rooms of `lower/`, each a folder that may lead to those before it and to its own.
const ROOMS: [&str; 5] = ["scope", "opaque", "values", "methods", "walk"];

/// The interpreter, the values that it holds, and the trait that both have.
const SHARED: [&str; 3] = ["Reader", "Values", "Branching"];

/// The most files that lead to one another.
const MOST: usize = 12;

/// The methods of the interpreter, and calls of them.
#[derive(Default)]
struct Methods {
    here: Module,
    is_shared: bool,
    defined: BTreeMap<String, BTreeSet<Module>>,
    calls: BTreeSet<(Module, String)>,
}

impl Methods {
    fn read(root: &Path) -> Self {
        let mut methods = Methods::default();
        for path in rust_files(&root.to_string_lossy()) {
            let text = std::fs::read_to_string(&path).expect("readable");
            methods.here = module(&Path::new(ROOT).join(root), &path);
            methods.visit_file(&syn::parse_file(&text).expect("Rust"));
        }
        methods
    }

    fn call(&mut self, method: &syn::Ident) {
        self.calls.insert((self.here.clone(), method.to_string()));
    }

    fn tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let text: Vec<String> = tokens.iter().map(ToString::to_string).collect();
        for (k, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Ident(method) => {
                    let before = |back: usize| k.checked_sub(back).map_or("", |k| text[k].as_str());
                    let is_called = before(1) == "." && self.is_object(before(2), before(3) == ".");
                    let is_named = before(1) == ":" && SHARED.contains(&before(3));
                    if is_called || is_named {
                        self.call(method);
                    }
                }
                _ => {}
            }
        }
    }

    /// Returns true for a variable that holds the interpreter; `is_part` is true for a field.
    fn is_object(&self, name: &str, is_part: bool) -> bool {
        !is_part && (name == "reader" || name == "values" || name == "self" && self.is_shared)
    }

    /// Reads an `impl` or a trait; its methods are those of the interpreter if `name` is.
    fn within(&mut self, name: &str, methods: Vec<&syn::Signature>, read: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.is_shared, SHARED.contains(&name));
        for method in methods.into_iter().filter(|_| self.is_shared) {
            self.defined.entry(method.ident.to_string()).or_default().insert(self.here.clone());
        }
        read(self);
        self.is_shared = outer;
    }

    /// All pairs of a file and another one whose method it calls.
    fn edges(&self) -> BTreeSet<(&Module, &Module)> {
        let called = |(here, name)| {
            self.defined.get(name).into_iter().flatten().map(move |there| (here, there))
        };
        self.calls
            .iter()
            .map(|(here, name)| (here, name))
            .flat_map(called)
            .filter(|(here, there)| here != there)
            .collect()
    }
}

impl<'a> Visit<'a> for Methods {
    fn visit_item_mod(&mut self, item: &'a syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'a syn::ItemImpl) {
        let name = match &*item.self_ty {
            syn::Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
            _ => None,
        };
        let methods = item.items.iter().filter_map(|item| match item {
            syn::ImplItem::Fn(method) => Some(&method.sig),
            _ => None,
        });
        // Methods of a trait of another crate are no methods of the interpreter.
        let methods = methods.filter(|_| item.trait_.is_none()).collect();
        self.within(&name.unwrap_or_default(), methods, |this| visit::visit_item_impl(this, item));
    }

    fn visit_item_trait(&mut self, item: &'a syn::ItemTrait) {
        let methods = item.items.iter().filter_map(|item| match item {
            syn::TraitItem::Fn(method) => Some(&method.sig),
            _ => None,
        });
        self.within(&item.ident.to_string(), methods.collect(), |this| {
            visit::visit_item_trait(this, item)
        });
    }

    fn visit_expr_method_call(&mut self, call: &'a syn::ExprMethodCall) {
        let is_shared = match &*call.receiver {
            syn::Expr::Path(path) => {
                path.path.get_ident().is_some_and(|name| self.is_object(&name.to_string(), false))
            }
            syn::Expr::MethodCall(inner) => inner.method == "as_mut" && self.is_shared,
            _ => false,
        };
        if is_shared {
            self.call(&call.method);
        }
        visit::visit_expr_method_call(self, call);
    }

    /// Calls among the tokens of a macro, such as the table of methods.
    fn visit_macro(&mut self, call: &'a syn::Macro) {
        self.tokens(call.tokens.clone());
    }

    /// A method that is named, not called: `Reader::expression`.
    fn visit_path(&mut self, path: &'a syn::Path) {
        let mut names = path.segments.iter().rev();
        if let (Some(method), Some(of)) = (names.next(), names.next())
            && (SHARED.iter().any(|shared| of.ident == shared)
                || of.ident == "Self" && self.is_shared)
        {
            self.call(&method.ident);
        }
        visit::visit_path(self, path);
    }
}

/// The number of a module's room in `lower/`.
fn room(module: &Module) -> Option<usize> {
    let [first, second, ..] = &module[..] else { return None };
    ROOMS.iter().position(|room| first == "lower" && room == second)
}

/// Files of `lower/` that lead to one another by imports and by methods, each set once.
fn largest_ring(house: &House, methods: &Methods) -> Vec<String> {
    let edges = house.edges().into_iter().chain(methods.edges()).collect();
    rings(&edges).into_iter().max_by_key(Vec::len).unwrap_or_default()
}

#[test]
fn the_interpreter_leads_down() {
    let house = House::read(FOLDER);
    let methods = Methods::read(Path::new(FOLDER));
    let up = |(from, to): &(&Module, &Module)| match (room(from), room(to)) {
        (Some(from), Some(to)) => from < to,
        // The rooms know nothing of what begins the walk.
        (Some(_), None) => to.first().is_some_and(|first| first == "lower"),
        _ => false,
    };
    let found: Vec<String> = house
        .edges()
        .into_iter()
        .chain(methods.edges())
        .filter(up)
        .map(|(from, to)| format!("{} -> {}", from.join("/"), to.join("/")))
        .collect();
    assert!(found.is_empty(), "these lead to a room above their own: {found:#?}");
}

#[test]
fn few_files_of_the_interpreter_lead_to_one_another() {
    let ring = largest_ring(&House::read(FOLDER), &Methods::read(Path::new(FOLDER)));
    assert!(ring.len() > 1, "the walk leads from file to file");
    assert!(ring.len() <= MOST, "these {} files lead to one another: {ring:#?}", ring.len());
    let outside: Vec<&String> =
        ring.iter().filter(|file| !file.starts_with("lower/walk/")).collect();
    assert!(outside.is_empty(), "outside of the walk: {outside:?}");
}

#[test]
fn every_folder_of_the_interpreter_is_a_room() {
    let folders = Path::new(ROOT).join(FOLDER).join("lower").read_dir().expect("readable");
    let names = folders
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().unwrap_or_default().to_string_lossy().into_owned());
    let homeless: Vec<String> = names.filter(|name| !ROOMS.contains(&&**name)).collect();
    assert!(homeless.is_empty(), "no rooms: {homeless:?}");
}

/// Methods are found where an `impl` of the interpreter defines them. Calls are found on the
/// interpreter itself, on variables named after it, and by the path of a method.
#[test]
fn calls_of_methods_are_seen() {
    let mut methods = Methods::default();
    for (file, text) in [
        ("a", "impl Reader { fn f(&mut self) { self.g(); all.k(); run(|reader| reader.h()) } }"),
        (
            "b",
            "impl Values { fn g(&self) {} fn k(&self) {} } impl Other { fn f(&self) { self.k() } }",
        ),
        ("c", "trait Branching { fn h(&mut self) { each(Self::g) } }"),
        ("e", "table! { \"k\" => |reader, x| { x.f(); reader.k() }; \"h\" => Reader::h; }"),
        ("d", "#[cfg(test)] mod tests { fn f(reader: &mut Reader) { reader.g() } }"),
    ] {
        methods.here = vec![file.to_string()];
        methods.visit_file(&syn::parse_file(text).expect("Rust"));
    }
    let edges = methods.edges();
    let found: Vec<String> =
        edges.iter().map(|(from, to)| format!("{}{}", from.join(""), to.join(""))).collect();
    assert_eq!(found, ["ab", "ac", "cb", "eb", "ec"]);
}
