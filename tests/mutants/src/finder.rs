//! Finds the places of a file.

use std::collections::BTreeMap;
use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Arm, Attribute, Block, Expr, FnArg, Item, Pat, ReturnType, Signature, Stmt};

use crate::operators::{Operators, literal};
use crate::results::{self, Input};
use crate::source::{Alternative, Shape, Site, Source};

/// Named numbers: the file and the name, and what they may be instead.
pub type Constants = BTreeMap<(String, String), syn::Lit>;

/// The named numbers of a file, those in its functions too.
pub fn constants(path: &str, file: &syn::File, found: &mut Constants) {
    struct Finder<'a>(&'a str, &'a mut Constants);
    impl<'ast> Visit<'ast> for Finder<'_> {
        fn visit_item_const(&mut self, item: &'ast syn::ItemConst) {
            if let Expr::Lit(lit) = &*item.expr {
                self.1.insert((self.0.to_string(), item.ident.to_string()), lit.lit.clone());
            }
        }
    }
    Finder(path, found).visit_file(file);
}

/// The names of modules that are there for tests only.
pub fn test_modules(file: &syn::File) -> Vec<String> {
    let tests = file.items.iter().filter_map(|item| match item {
        Item::Mod(module) if is_for_tests(&module.attrs) => Some(module.ident.to_string()),
        _ => None,
    });
    tests.collect()
}

/// The file with its places.
pub fn source(path: &str, text: String, file: &syn::File, constants: &Constants) -> Source {
    let mut finder = Finder {
        path,
        operators: Operators { text: &text },
        constants,
        names: Vec::new(),
        sites: Vec::new(),
    };
    finder.visit_file(file);
    let mut sites = finder.sites;
    sites.retain(|site| !site.alternatives.is_empty());
    sites.sort_by_key(|site| (site.range.start, std::cmp::Reverse(site.range.end)));
    Source { path: path.to_string(), text, sites }
}

struct Finder<'a> {
    path: &'a str,
    operators: Operators<'a>,
    constants: &'a Constants,
    /// The type and the functions around.
    names: Vec<String>,
    sites: Vec<Site>,
}

/// True for a function that a macro of Kin reads: with a mutant in it the macro finds no equation.
fn is_read_by_kin(attributes: &[Attribute]) -> bool {
    const MACROS: [&str; 4] = ["constraint", "force", "law", "potential"];
    attributes.iter().any(|attribute| MACROS.iter().any(|name| attribute.path().is_ident(name)))
}

fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("test")
            || (attribute.path().is_ident("cfg")
                && attribute.parse_args::<syn::Ident>().is_ok_and(|name| name == "test"))
    })
}

/// True if a condition takes something apart, so that no value can stand instead of it.
fn has_let(expr: &Expr) -> bool {
    match expr {
        Expr::Let(_) => true,
        Expr::Binary(binary) => has_let(&binary.left) || has_let(&binary.right),
        _ => false,
    }
}

/// True if an arm takes whatever is left.
fn takes_all(arm: &Arm) -> bool {
    let named = |pat: &syn::PatIdent| {
        pat.subpat.is_none() && pat.ident.to_string().starts_with(char::is_lowercase)
    };
    arm.guard.is_none() && matches!(&arm.pat, Pat::Wild(_))
        || matches!(&arm.pat, Pat::Ident(pat) if named(pat) && arm.guard.is_none())
}

impl Finder<'_> {
    fn add(&mut self, range: Range<usize>, shape: Shape, alternatives: Vec<Alternative>) {
        let function = self.names.join("::");
        self.sites.push(Site { range, shape, function, constant: None, alternatives, first: 0 });
    }

    fn function(&mut self, signature: &Signature, attributes: &[Attribute], block: &Block) {
        if signature.constness.is_some() || is_for_tests(attributes) || is_read_by_kin(attributes) {
            return;
        }
        self.names.push(signature.ident.to_string());
        let inputs = signature.inputs.iter().filter_map(|input| match input {
            FnArg::Receiver(receiver) => Some(Input {
                name: "self".to_string(),
                kind: self.operators.code(receiver.ty.span()).to_string(),
            }),
            FnArg::Typed(typed) => match &*typed.pat {
                Pat::Ident(pat) => Some(Input {
                    name: pat.ident.to_string(),
                    kind: self.operators.code(typed.ty.span()).to_string(),
                }),
                _ => None,
            },
        });
        let inputs: Vec<Input> = inputs.collect();
        let values = match &signature.output {
            ReturnType::Default => vec!["()".to_string()],
            ReturnType::Type(_, kind) => results::of(kind, &inputs),
        };
        let at = block.brace_token.span.open().byte_range().end;
        let alternatives = values
            .into_iter()
            .map(|value| Alternative::new(value.clone(), format!("returns {value}")))
            .collect();
        self.add(at..at, Shape::Early, alternatives);
        self.visit_block(block);
        self.names.pop();
    }

    /// A named number that is read here.
    fn constant(&mut self, name: &str, range: Range<usize>) {
        let key = (self.path.to_string(), name.to_string());
        let found = self.constants.get_key_value(&key).or_else(|| {
            let mut others = self.constants.iter().filter(|((_, other), _)| other == name);
            others.next().filter(|_| others.next().is_none())
        });
        if let Some(((file, _), lit)) = found {
            let function = format!("const {name}");
            let constant = Some(file.clone());
            self.sites.push(Site {
                range,
                shape: Shape::Instead,
                function,
                constant,
                alternatives: literal(lit),
                first: 0,
            });
        }
    }

    fn condition(&mut self, condition: &Expr, values: &[&str]) {
        let known = matches!(condition, Expr::Binary(_) | Expr::Unary(_) | Expr::Lit(_))
            || has_let(condition);
        if !known {
            let alternatives = values
                .iter()
                .map(|value| Alternative::new(*value, format!("becomes {value}")))
                .collect();
            self.add(condition.span().byte_range(), Shape::Instead, alternatives);
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !is_for_tests(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if is_for_tests(&item.attrs) {
            return;
        }
        let code = |span: proc_macro2::Span| {
            self.operators.code(span).split('<').next().unwrap_or_default().to_string()
        };
        let of = item.trait_.as_ref().map(|(_, name, _)| code(name.span()));
        let name = code(item.self_ty.span());
        self.names.push(of.map_or(name.clone(), |of| format!("{of} for {name}")));
        visit::visit_item_impl(self, item);
        self.names.pop();
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.sig, &item.attrs, block);
        }
    }

    fn visit_stmt(&mut self, stmt: &'ast Stmt) {
        let left_out = match stmt {
            Stmt::Expr(Expr::ForLoop(_), _) => true,
            Stmt::Expr(expr, Some(_)) => {
                matches!(expr, Expr::Call(_) | Expr::MethodCall(_) | Expr::Try(_))
            }
            _ => false,
        };
        if left_out {
            self.add(
                stmt.span().byte_range(),
                Shape::Statement,
                vec![Alternative::new("", "left out")],
            );
        }
        visit::visit_stmt(self, stmt);
    }

    fn visit_expr(&mut self, expr: &'ast Expr) {
        let range = expr.span().byte_range();
        match expr {
            Expr::Binary(_) if has_let(expr) => {}
            Expr::Path(path) if path.path.get_ident().is_some() => {
                self.constant(&self.operators.code(path.span()).to_string(), range)
            }
            _ => self.add(range, Shape::Instead, self.operators.of(expr)),
        }
        match expr {
            Expr::If(expr) => self.condition(&expr.cond, &["true", "false"]),
            Expr::While(expr) => self.condition(&expr.cond, &["false"]),
            _ => {}
        }
        visit::visit_expr(self, expr);
    }

    fn visit_expr_match(&mut self, expr: &'ast syn::ExprMatch) {
        self.visit_expr(&expr.expr);
        let open = expr.arms.last().is_some_and(takes_all);
        for (k, arm) in expr.arms.iter().enumerate() {
            if open && k + 1 < expr.arms.len() {
                let pattern = self
                    .operators
                    .code(arm.pat.span())
                    .split_whitespace()
                    .collect::<Vec<_>>()
                    .join(" ");
                let end = arm.pat.span().byte_range().end;
                let range =
                    arm.guard.as_ref().map_or(end..end, |(_, guard)| guard.span().byte_range());
                self.add(
                    range,
                    Shape::Arm,
                    vec![Alternative::new("", format!("arm `{pattern}` never taken"))],
                );
            }
            if let Some((_, guard)) = &arm.guard {
                self.condition(guard, &["true", "false"]);
                self.visit_expr(guard);
            }
            self.visit_expr(&arm.body);
        }
    }

    /// The length of an array is known before a program runs.
    fn visit_expr_repeat(&mut self, expr: &'ast syn::ExprRepeat) {
        self.visit_expr(&expr.expr);
    }

    fn visit_pat(&mut self, _: &'ast Pat) {}

    fn visit_type(&mut self, _: &'ast syn::Type) {}

    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}

    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}

    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}

    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::{mutants, number};

    fn found(code: &str) -> Vec<Source> {
        let file = syn::parse_file(code).unwrap();
        let mut all = Constants::new();
        constants("a.rs", &file, &mut all);
        let mut sources = vec![source("a.rs", code.to_string(), &file, &all)];
        number(&mut sources);
        sources
    }

    fn keys(code: &str) -> Vec<String> {
        mutants(&found(code)).iter().map(|mutant| mutant.key()).collect()
    }

    #[test]
    fn each_kind_of_code_has_its_mutants() {
        let code = "impl A { fn f(a: f64, b: f64) -> bool { a.abs() <= 0.5 && !g(b) } }";
        let expected = [
            "all of it | returns true",
            "all of it | returns false",
            "⟦a.abs() <= 0.5 && !g(b)⟧ } } | `&&` without its right side",
            "⟦a.abs() <= 0.5 && !g(b)⟧ } } | `&&` without its left side",
            "⟦a.abs() <= 0.5⟧ && !g(b) } } | `<=` becomes `<`",
            "⟦a.abs() <= 0.5⟧ && !g(b) } } | `<=` becomes true",
            "⟦a.abs() <= 0.5⟧ && !g(b) } } | `<=` becomes false",
            "⟦a.abs() <= 0.5⟧ && !g(b) } } | `<=` with 1.5 times its right side",
            "⟦a.abs()⟧ <= 0.5 && !g(b) } } | without `abs`",
            "⟦!g(b)⟧ } } | without `!`",
        ];
        let found = keys(code);
        assert_eq!(found.len(), expected.len(), "{found:#?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                found.starts_with("a.rs | A::f | ") && found.ends_with(expected),
                "{found}\n{expected}"
            );
        }
    }

    #[test]
    fn a_constant_changes_wherever_it_is_read() {
        let sources = found(
            "const SAFE: f64 = 0.25; fn f(a: f64) -> bool { a < SAFE } fn g() -> usize { let a = SAFE; 3 }",
        );
        let uses: Vec<usize> = sources[0]
            .sites
            .iter()
            .filter(|site| site.constant.is_some())
            .map(|site| site.first)
            .collect();
        assert!(uses.len() == 2 && uses[0] == uses[1]);
        let keys = mutants(&sources)
            .iter()
            .map(|mutant| mutant.key())
            .filter(|key| key.contains("SAFE |"))
            .collect::<Vec<_>>();
        assert_eq!(
            keys,
            [
                "a.rs | const SAFE | all of it | becomes 2.0",
                "a.rs | const SAFE | all of it | becomes 0.03125"
            ]
        );
    }

    #[test]
    fn what_is_known_before_a_program_runs_stays() {
        assert!(keys("const fn f() -> u32 { 1 + 2 } #[cfg(test)] mod tests { fn g() -> u32 { 3 } } static A: u32 = 4;").is_empty());
        assert!(
            keys("fn f(x: u8) { let _ = [x; 4]; if let 3 = x {} }")
                .iter()
                .all(|key| key.ends_with("returns ()"))
        );
    }

    #[test]
    fn arms_can_be_left_out_where_another_takes_all() {
        let found = keys("fn f(x: u8) { match x { 1 => g(), 2 if h() => g(), _ => {} } }");
        assert!(
            found.iter().any(|key| key.contains("arm `1` never taken"))
                && found.iter().any(|key| key.contains("arm `2` never taken")),
            "{found:?}"
        );
        assert!(
            !keys("fn f(x: E) { match x { E::A => g(), E::B => g() } }")
                .iter()
                .any(|key| key.contains("arm"))
        );
    }

    #[test]
    fn what_is_instrumented_can_be_read_and_is_the_same_without_mutants() {
        let code = "//! Doc.\nfn f(a: f64, k: usize) -> f64 {\n    for j in 0..k { g(j); }\n    match k { 0 => -a + 1.0, n if n > 2 => a, _ => a.max(2.0) }\n}\n";
        let mut sources = found(code);
        let text = sources[0].instrumented();
        syn::parse_file(&text).unwrap();
        assert!(text.contains("crate::mutants::at("));
        sources[0]
            .sites
            .iter_mut()
            .flat_map(|site| &mut site.alternatives)
            .for_each(|alternative| alternative.compiles = false);
        assert_eq!(sources[0].instrumented(), code);
    }
}
