//! The names that a function uses from outside its body. With their values and texts put before it,
//! the text of the function is complete.

use proc_macro2::Ident;
use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{Block, Expr, ExprPath};

use super::{Lowered, Template};
use crate::constants;
use crate::parse::{Argument, ConstraintFn, Kind, LawFn};
use crate::vocabulary::{is_kin_function, is_std_function};

/// The names that a function uses from outside its body.
#[derive(Default)]
pub struct Beside {
    /// Constants.
    pub constants: Vec<Ident>,
    /// The functions, as the body calls them.
    pub functions: Vec<String>,
    /// All other names that only a program knows, as words for a message.
    pub unknown: Vec<String>,
}

impl Beside {
    /// Finds the names in a function and its attributes.
    pub fn of(source: &ConstraintFn, lowered: &Lowered) -> Self {
        let demands =
            source.requirements.iter().chain(&source.branches).map(|demand| &demand.condition);
        let ends = source.measures.iter().filter_map(|measure| measure.ends.as_ref());
        let ends = ends.flat_map(|(from, to)| [from, to]);
        let asked = demands.chain(source.measures.iter().map(|measure| &measure.value)).chain(ends);
        Beside::read(&source.arguments, &asked.collect::<Vec<_>>(), source.written(), lowered)
    }

    /// Finds the names in a law.
    pub fn of_law(source: &LawFn, lowered: &Lowered) -> Self {
        let asked: Vec<&Expr> =
            source.requirements.iter().map(|demand| &demand.condition).collect();
        Beside::read(&source.parameters, &asked, source.written(), lowered)
    }

    /// Finds the names in a body, in its interpreted form, and in the expressions of its
    /// attributes.
    fn read(arguments: &[Argument], asked: &[&Expr], body: &Block, lowered: &Lowered) -> Self {
        let mut beside = Beside::default();
        for argument in arguments.iter().filter(|argument| argument.kind == Kind::Other) {
            let ty = of_type(&argument.ty);
            beside.lacks(format!("the type `{ty}` of `{}`", argument.name));
        }
        let values = lowered.opaques.iter().chain(&lowered.leaves).map(|value| &value.template);
        values.chain(&lowered.laws).for_each(|template| beside.template(template));
        asked.iter().for_each(|expression| beside.visit_expr(expression));
        let mut inside = Inside::default();
        inside.visit_block(body);
        let own = |name: &Ident| arguments.iter().any(|argument| argument.name == *name);
        beside.constants.retain(|name| !own(name) && !inside.declared.contains(name));
        beside.functions.retain(|name| !inside.functions.contains(name));
        // Names that the body imports are known only there, except the constants of the standard
        // library.
        let (brought, others) = std::mem::take(&mut beside.constants)
            .into_iter()
            .partition(|name| inside.has_glob || inside.brought.contains(name));
        beside.constants = others;
        let brought: Vec<Ident> = brought;
        let unknown = brought.iter().filter(|name| !constants::is_known(&syn::parse_quote!(#name)));
        unknown.for_each(|name| beside.lacks(format!("`{name}`")));
        beside
    }

    fn template(&mut self, template: &Template) {
        match template {
            Template::Path(path, _) => self.path(path),
            Template::Call(callee, all, _) => {
                match &**callee {
                    Template::Path(path, _) => self.function(path),
                    other => self.lacks(format!("`{}`", other.key())),
                }
                all.iter().for_each(|part| self.template(part));
            }
            // A text can read a parameter whose type it knows. The code above reports other types.
            Template::Parameter(_) | Template::Numbers(..) | Template::State(..) => {}
            Template::Tokens(tokens) if syn::parse2::<syn::Lit>(tokens.clone()).is_ok() => {}
            Template::Tokens(tokens) => self.lacks(format!("`{tokens}`")),
            Template::Part(value, ..) | Template::Matches(value, _) => self.template(value),
            // A method of a number that the language does not know.
            Template::Method(receiver, name, _) if matches!(**receiver, Template::Numbers(..)) => {
                self.lacks(format!("the method `{name}` of a number"));
            }
            Template::Struct(path, fields, _) => {
                self.lacks(format!("the type `{}`", tidy(path)));
                fields.iter().for_each(|(_, part)| self.template(part));
            }
            other => other.parts().into_iter().for_each(|part| self.template(part)),
        }
    }

    /// Visits a path that is no call.
    fn path(&mut self, path: &ExprPath) {
        match path.path.get_ident() {
            Some(name) if name.to_string().starts_with(char::is_uppercase) => {
                if !self.constants.contains(name) {
                    self.constants.push(name.clone());
                }
            }
            None if constants::is_known(path) => {}
            Some(name) if self.constants.contains(name) => {}
            _ => self.lacks(format!("`{}`", tidy(path))),
        }
    }

    fn function(&mut self, path: &ExprPath) {
        let name = tidy(path);
        let is_known = is_kin_function(path) || is_std_function(path) || name == "f64::from";
        if !is_known && !self.functions.contains(&name) {
            self.functions.push(name);
        }
    }

    fn lacks(&mut self, what: String) {
        if !self.unknown.contains(&what) {
            self.unknown.push(what);
        }
    }
}

/// The expressions of attributes use parameters and names from outside the function.
impl<'a> Visit<'a> for Beside {
    fn visit_expr(&mut self, expression: &'a Expr) {
        match expression {
            // Parameters have names in small letters.
            Expr::Path(path)
                if path
                    .path
                    .get_ident()
                    .is_some_and(|name| name.to_string().starts_with(char::is_lowercase)) => {}
            Expr::Path(path) => self.path(path),
            Expr::Call(call) => {
                match &*call.func {
                    Expr::Path(path) => self.function(path),
                    other => self.lacks(format!("`{}`", tidy(other))),
                }
                call.args.iter().for_each(|argument| self.visit_expr(argument));
            }
            other => visit::visit_expr(self, other),
        }
    }
}

fn tidy(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().replace(' ', "")
}

/// Returns a type as the user wrote it.
fn of_type(ty: &syn::Type) -> String {
    let spaced = [
        (" < ", "<"),
        (" >", ">"),
        (" ,", ","),
        ("& ", "&"),
        (" :: ", "::"),
        ("( ", "("),
        (" )", ")"),
        (" ;", ";"),
    ];
    spaced.iter().fold(ty.to_token_stream().to_string(), |text, (from, to)| text.replace(from, to))
}

/// The names that a body declares or imports, at any depth.
#[derive(Default)]
struct Inside {
    declared: Vec<Ident>,
    functions: Vec<String>,
    brought: Vec<Ident>,
    has_glob: bool,
}

impl<'a> Visit<'a> for Inside {
    fn visit_item_const(&mut self, item: &'a syn::ItemConst) {
        self.declared.push(item.ident.clone());
        visit::visit_item_const(self, item);
    }

    fn visit_item_fn(&mut self, item: &'a syn::ItemFn) {
        self.functions.push(item.sig.ident.to_string());
        visit::visit_item_fn(self, item);
    }

    fn visit_item_static(&mut self, item: &'a syn::ItemStatic) {
        self.declared.push(item.ident.clone());
        visit::visit_item_static(self, item);
    }

    fn visit_impl_item_const(&mut self, item: &'a syn::ImplItemConst) {
        self.declared.push(item.ident.clone());
        visit::visit_impl_item_const(self, item);
    }

    fn visit_variant(&mut self, item: &'a syn::Variant) {
        self.declared.push(item.ident.clone());
        visit::visit_variant(self, item);
    }

    fn visit_const_param(&mut self, parameter: &'a syn::ConstParam) {
        self.declared.push(parameter.ident.clone());
    }

    fn visit_use_name(&mut self, name: &'a syn::UseName) {
        self.brought.push(name.ident.clone());
    }

    fn visit_use_rename(&mut self, name: &'a syn::UseRename) {
        self.brought.push(name.rename.clone());
    }

    fn visit_use_glob(&mut self, _: &'a syn::UseGlob) {
        self.has_glob = true;
    }
}
