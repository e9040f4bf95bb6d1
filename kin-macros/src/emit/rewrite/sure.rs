//! The bodies of which a copy over dual numbers is sure to be good Rust. It is made without knowing
//! a type: where types of the user's meet numbers, or references and conversions hang on them, the
//! equation over dual numbers comes out of the graph.

use syn::visit::{self, Visit};
use syn::{Block, Expr, Item, Pat, Type};

use kin_language::parse::{Argument, Kind};
use kin_language::vocabulary::{
    is_integer, is_kin_function, is_kin_type, is_number_function, is_number_method, is_type_name,
    names,
};

/// True if the copy of this body is sure to be good Rust.
pub fn is_sure(body: &Block, arguments: &[Argument]) -> bool {
    let states = arguments
        .iter()
        .filter(|argument| matches!(argument.kind, Kind::Planar | Kind::Spatial | Kind::Axis));
    let mut search = Search {
        states: states.map(|argument| argument.name.to_string()).collect(),
        unsure: false,
    };
    search.visit_block(body);
    let several = arguments
        .iter()
        .any(|argument| matches!(argument.kind, Kind::Planars(_) | Kind::Spatials(_)));
    !search.unsure && !several
}

struct Search {
    states: Vec<String>,
    unsure: bool,
}

/// Methods beside those of numbers.
const METHODS: &[&str] = &[
    "point",
    "direction",
    "local",
    "a",
    "iter",
    "into_iter",
    "map",
    "sum",
    "fold",
    "zip",
    "enumerate",
    "rev",
    "skip",
    "take",
    "len",
    "clone",
    "windows",
    "copied",
    "cloned",
    "collect",
    "any",
    "all",
];

impl Search {
    fn path(&mut self, path: &syn::ExprPath) {
        let names = names(path);
        let functions = is_number_function(path)
            || is_kin_function(path) && names.last().is_some_and(|name| name != "from");
        let kin = names.iter().any(|name| {
            matches!(name.as_str(), "Planar" | "Spatial" | "Law" | "Vector2" | "Vector3")
        });
        let of_type =
            names.len() > 1 && names[names.len() - 2].starts_with(char::is_uppercase) && !functions;
        let wrapped = names
            .last()
            .is_some_and(|name| matches!(name.as_str(), "Some" | "None" | "Ok" | "Err"));
        self.unsure |= kin || wrapped || of_type && !is_type_name(path);
    }
}

impl Visit<'_> for Search {
    fn visit_expr_path(&mut self, path: &syn::ExprPath) {
        self.path(path);
    }

    fn visit_expr_struct(&mut self, literal: &syn::ExprStruct) {
        self.unsure |= !is_kin_type(&literal.path);
        visit::visit_expr_struct(self, literal);
    }

    fn visit_expr_reference(&mut self, reference: &syn::ExprReference) {
        self.unsure |= reference.mutability.is_some();
        visit::visit_expr_reference(self, reference);
    }

    fn visit_expr_call(&mut self, call: &syn::ExprCall) {
        let is_state = |argument: &Expr| match argument {
            Expr::Path(path) => {
                path.path.get_ident().is_some_and(|name| self.states.contains(&name.to_string()))
            }
            Expr::Reference(_) => true,
            _ => false,
        };
        self.unsure |= call.args.iter().any(is_state);
        self.unsure |= matches!(&*call.func, Expr::Path(path) if is_type_name(path));
        visit::visit_expr_call(self, call);
    }

    fn visit_expr_method_call(&mut self, call: &syn::ExprMethodCall) {
        let name = call.method.to_string();
        self.unsure |= !is_number_method(&name) && !METHODS.contains(&name.as_str())
            || matches!(name.as_str(), "total_cmp" | "partial_cmp");
        visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_closure(&mut self, closure: &syn::ExprClosure) {
        self.unsure |= closure.capture.is_some();
        visit::visit_expr_closure(self, closure);
    }

    fn visit_expr_let(&mut self, test: &syn::ExprLet) {
        self.unsure = true;
        visit::visit_expr_let(self, test);
    }

    fn visit_local(&mut self, local: &syn::Local) {
        self.unsure |= local.init.is_none() && !matches!(local.pat, Pat::Ident(_));
        self.unsure |= local.init.as_ref().is_some_and(|init| init.diverge.is_some());
        visit::visit_local(self, local);
    }

    fn visit_pat(&mut self, pattern: &Pat) {
        self.unsure |= matches!(pattern, Pat::TupleStruct(_));
        self.unsure |= matches!(pattern, Pat::Struct(fields) if !is_kin_type(&fields.path));
        visit::visit_pat(self, pattern);
    }

    fn visit_macro(&mut self, call: &syn::Macro) {
        self.unsure |= !call
            .path
            .segments
            .last()
            .is_some_and(|last| last.ident == "matches" || last.ident == "unreachable");
    }

    fn visit_item(&mut self, item: &Item) {
        self.unsure |= match item {
            Item::Use(_) => false,
            Item::Const(constant) => !is_single(&constant.ty),
            Item::Fn(function) => {
                !function.sig.generics.params.is_empty()
                    || function.sig.inputs.iter().any(takes_reference)
            }
            _ => true,
        };
        visit::visit_item(self, item);
    }
}

fn takes_reference(input: &syn::FnArg) -> bool {
    !matches!(input, syn::FnArg::Typed(typed) if !matches!(*typed.ty, Type::Reference(_) | Type::ImplTrait(_)))
}

/// A number, or a whole number.
fn is_single(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.get_ident().is_some_and(|name| name == "f64" || name == "bool" || is_integer(&name.to_string())))
}
