//! The variables of a body: which names it binds, and which of them may depend on coordinates or time.

use std::collections::HashSet;

use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{Block, Expr, Pat};

use crate::parse::{Argument, Kind};

/// Names bound anywhere in the body.
#[derive(Default)]
pub struct Names {
    pub local: HashSet<String>,
}

impl Visit<'_> for Names {
    fn visit_pat_ident(&mut self, pattern: &syn::PatIdent) {
        if !pattern.ident.to_string().starts_with(char::is_uppercase) {
            self.local.insert(pattern.ident.to_string());
        }
        visit::visit_pat_ident(self, pattern);
    }

    // A generic function inside the body is called like one outside of it.
    fn visit_item_fn(&mut self, function: &syn::ItemFn) {
        if function.sig.generics.params.is_empty() {
            self.local.insert(function.sig.ident.to_string());
            visit::visit_item_fn(self, function);
        }
    }
}

/// Names that may depend on coordinates or time: the states, and whatever is bound or assigned from an expression that mentions one of them.
pub fn varying_names(body: &Block, arguments: &[Argument], variable: Option<&syn::Ident>) -> HashSet<String> {
    let varying = |a: &&Argument| matches!(a.kind, Kind::Planar | Kind::Spatial | Kind::Coord | Kind::Coords(_) | Kind::Time);
    let states = arguments.iter().filter(varying).map(|a| a.name.to_string());
    let mut flow = Flow { varying: states.chain(variable.map(ToString::to_string)).collect() };
    loop {
        let before = flow.varying.len();
        flow.visit_block(body);
        if flow.varying.len() == before {
            return flow.varying;
        }
    }
}

struct Flow {
    varying: HashSet<String>,
}

impl Flow {
    fn mark_pattern(&mut self, pattern: &Pat) {
        let mut names = Names::default();
        names.visit_pat(pattern);
        self.varying.extend(names.local);
    }

    fn bind(&mut self, pattern: &Pat, from: &Expr) {
        if mentions(from, &self.varying) {
            self.mark_pattern(pattern);
        }
    }

    fn assign(&mut self, place: &Expr, from: &Expr) {
        if mentions(from, &self.varying)
            && let Some(name) = root(place)
        {
            self.varying.insert(name);
        }
    }
}

/// The variable of which a place is a part.
fn root(place: &Expr) -> Option<String> {
    match place {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        Expr::Field(field) => root(&field.base),
        Expr::Index(index) => root(&index.expr),
        Expr::Paren(inner) => root(&inner.expr),
        Expr::Unary(inner) => root(&inner.expr),
        _ => None,
    }
}

impl Visit<'_> for Flow {
    fn visit_local(&mut self, local: &syn::Local) {
        if let Some(init) = &local.init {
            self.bind(&local.pat, &init.expr);
        }
        visit::visit_local(self, local);
    }

    fn visit_expr(&mut self, expression: &Expr) {
        match expression {
            Expr::Assign(assign) => match &*assign.left {
                Expr::Tuple(places) => places.elems.iter().for_each(|place| self.assign(place, &assign.right)),
                place => self.assign(place, &assign.right),
            },
            // Compound assignments, and comparisons, which do no harm.
            Expr::Binary(binary) if binary.op.to_token_stream().to_string().ends_with('=') => self.assign(&binary.left, &binary.right),
            Expr::ForLoop(each) => self.bind(&each.pat, &each.expr),
            Expr::Match(branch) => branch.arms.iter().for_each(|arm| self.bind(&arm.pat, &branch.expr)),
            Expr::Let(test) => self.bind(&test.pat, &test.expr),
            // What a closure is applied to is not looked for: its arguments may be anything.
            Expr::Closure(closure) => closure.inputs.iter().for_each(|input| self.mark_pattern(input)),
            _ => {}
        }
        visit::visit_expr(self, expression);
    }

    fn visit_item_fn(&mut self, function: &syn::ItemFn) {
        for input in &function.sig.inputs {
            if let syn::FnArg::Typed(typed) = input {
                self.mark_pattern(&typed.pat);
            }
        }
        visit::visit_item_fn(self, function);
    }
}

/// Whether an expression reads one of the variables.
pub fn mentions(expression: &Expr, names: &HashSet<String>) -> bool {
    struct Search<'a>(&'a HashSet<String>, bool);
    impl Visit<'_> for Search<'_> {
        fn visit_expr_path(&mut self, path: &syn::ExprPath) {
            self.1 |= path.path.get_ident().is_some_and(|name| self.0.contains(&name.to_string()));
        }

        fn visit_macro(&mut self, _: &syn::Macro) {
            self.1 = true;
        }
    }
    let mut search = Search(names, false);
    search.visit_expr(expression);
    search.1
}
