//! The user's own body for the two emitted copies of it: plain f64 as written, and generic over dual numbers.
//!
//! In the dual copy f64 means `Real<D>` everywhere: literals, types and parameters are lifted. What only rustc knows (constants, fields of the
//! user's types, the user's functions) is lifted where it comes in, and calls of the user's functions hand over what they ask for.

use std::collections::HashSet;

use proc_macro2::Span;
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::visit::Visit;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Expr, Lit, Pat, Stmt, Type, parse_quote, parse_quote_spanned};

use super::variables::{Names, mentions, varying_names};
use crate::parse::{Argument, Kind};

/// The body in plain f64: as written, but that calls of the user's generic functions convert numbers.
pub fn plain(body: &Block, arguments: &[Argument]) -> Block {
    rewrite(body, arguments, Copy::Plain)
}

/// The body generic over `Real<__D>`.
pub fn dual(body: &Block, arguments: &[Argument]) -> Block {
    rewrite(body, arguments, Copy::Dual)
}

/// The body of a law in plain f64.
pub fn plain_law(body: &Block, parameters: &[Argument], variable: &syn::Ident) -> Block {
    rewrite_with(body, parameters, Copy::Plain, Some(variable))
}

/// The body of a law generic over `Real<__D>`.
pub fn dual_law(body: &Block, parameters: &[Argument], variable: &syn::Ident) -> Block {
    rewrite_with(body, parameters, Copy::Dual, Some(variable))
}

/// A type of the signature or the body, with f64 lifted.
pub fn lifted_type(ty: &Type) -> Type {
    let mut ty = ty.clone();
    Lifter.visit_type_mut(&mut ty);
    ty
}

#[derive(Clone, Copy, PartialEq)]
enum Copy {
    Plain,
    Dual,
}

fn rewrite(body: &Block, arguments: &[Argument], copy: Copy) -> Block {
    rewrite_with(body, arguments, copy, None)
}

fn rewrite_with(body: &Block, arguments: &[Argument], copy: Copy, variable: Option<&syn::Ident>) -> Block {
    let mut names = Names::default();
    names.visit_block(body);
    names.local.extend(arguments.iter().map(|a| a.name.to_string()));
    let own = arguments.iter().filter(|a| a.kind == Kind::Other).map(|a| a.name.to_string()).collect();
    names.local.extend(variable.map(ToString::to_string));
    let varying = varying_names(body, arguments, variable);
    let mut body = body.clone();
    Rewriter { copy, names, own, varying }.visit_block_mut(&mut body);
    body
}

struct Rewriter {
    copy: Copy,
    names: Names,
    /// Parameters of types that only rustc knows.
    own: HashSet<String>,
    varying: HashSet<String>,
}

impl VisitMut for Rewriter {
    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        if self.is_foreign(expression) {
            return self.foreign(expression);
        }
        visit_mut::visit_expr_mut(self, expression);
        if self.copy == Copy::Dual {
            lift_expression(expression);
        }
    }

    // A function called by its name is no value to be lifted.
    fn visit_expr_call_mut(&mut self, call: &mut syn::ExprCall) {
        match (&*call.func, self.copy) {
            (Expr::Path(path), Copy::Dual) if is_number_function(path) => lift_expression(&mut call.func),
            (Expr::Path(_), _) => {}
            _ => self.visit_expr_mut(&mut call.func),
        }
        call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
    }

    fn visit_type_mut(&mut self, ty: &mut Type) {
        if self.copy == Copy::Dual {
            Lifter.visit_type_mut(ty);
        }
    }

    fn visit_generic_argument_mut(&mut self, argument: &mut syn::GenericArgument) {
        if let (syn::GenericArgument::Type(ty), Copy::Dual) = (argument, self.copy) {
            Lifter.visit_type_mut(ty);
        }
    }

    // Array lengths are no numbers of the equation.
    fn visit_expr_repeat_mut(&mut self, repeat: &mut syn::ExprRepeat) {
        self.visit_expr_mut(&mut repeat.expr);
    }

    // Patterns hold literals that are not lifted.
    fn visit_pat_mut(&mut self, pattern: &mut Pat) {
        if let (Pat::Type(typed), Copy::Dual) = (pattern, self.copy) {
            Lifter.visit_type_mut(&mut typed.ty);
        }
    }

    fn visit_stmt_mut(&mut self, statement: &mut Stmt) {
        match (&*statement, self.copy) {
            (Stmt::Item(syn::Item::Fn(function)), Copy::Dual) => {
                if let Some(closure) = as_closure(function) {
                    *statement = closure;
                    visit_mut::visit_stmt_mut(self, statement);
                }
            }
            (Stmt::Item(_), _) => {}
            _ => visit_mut::visit_stmt_mut(self, statement),
        }
    }
}

impl Rewriter {
    /// Whether only rustc knows what this is: a path that is no variable, something of a parameter of the user's type, a call of the user's.
    fn is_foreign(&self, expression: &Expr) -> bool {
        match expression {
            Expr::Path(path) => self.foreign_path(path),
            Expr::Field(field) => self.rooted_in_own(&field.base),
            Expr::Index(index) => self.rooted_in_own(&index.expr),
            Expr::MethodCall(call) => self.rooted_in_own(&call.receiver),
            Expr::Call(call) => matches!(&*call.func, Expr::Path(path) if self.foreign_path(path) && !is_kin_function(path)),
            _ => false,
        }
    }

    fn foreign_path(&self, path: &syn::ExprPath) -> bool {
        path.path.get_ident().is_none_or(|name| !self.names.local.contains(&name.to_string())) && !is_number_function(path)
    }

    fn rooted_in_own(&self, expression: &Expr) -> bool {
        match expression {
            Expr::Path(path) => path.path.get_ident().is_some_and(|name| self.own.contains(&name.to_string())),
            Expr::Field(field) => self.rooted_in_own(&field.base),
            Expr::Index(index) => self.rooted_in_own(&index.expr),
            Expr::MethodCall(call) => self.rooted_in_own(&call.receiver),
            Expr::Paren(inner) => self.rooted_in_own(&inner.expr),
            Expr::Reference(inner) => self.rooted_in_own(&inner.expr),
            _ => false,
        }
    }

    /// Lifts the value of something foreign, and converts what is handed to it.
    fn foreign(&mut self, expression: &mut Expr) {
        if let Expr::MethodCall(call) = expression
            && holds_closure(call)
        {
            return self.adaptor(call);
        }
        match expression {
            Expr::Call(call) => call.args.iter_mut().for_each(|argument| self.argument(argument)),
            Expr::MethodCall(call) => {
                self.inside_foreign(&mut call.receiver);
                call.args.iter_mut().for_each(|argument| self.argument(argument));
            }
            Expr::Field(field) => self.inside_foreign(&mut field.base),
            Expr::Index(index) => {
                self.inside_foreign(&mut index.expr);
                self.visit_expr_mut(&mut index.index);
            }
            _ => {}
        }
        let inner = &*expression;
        // An item with the span of the user's expression, so that a wrong type is blamed there.
        let at = Span::mixed_site().located_at(inner.span());
        *expression = match self.copy {
            Copy::Plain => match inner {
                Expr::Call(_) | Expr::MethodCall(_) => parse_quote_spanned!(at=> (&::kin::rt::Foreign(#inner)).lowered()),
                _ => return,
            },
            Copy::Dual => {
                let value = match inner {
                    Expr::Call(_) | Expr::MethodCall(_) => quote!(#inner),
                    place => quote!(::core::clone::Clone::clone(&#place)),
                };
                parse_quote_spanned!(at=> (&::kin::rt::Foreign(#value)).lifted(::core::marker::PhantomData::<__D>))
            }
        };
    }

    /// A chain of iterator adaptors: its closures decide what goes through it, so nothing is converted on the way.
    fn adaptor(&mut self, call: &mut syn::ExprMethodCall) {
        if let Expr::MethodCall(inner) = &mut *call.receiver {
            self.adaptor(inner);
        } else {
            self.inside_foreign(&mut call.receiver);
        }
        call.args.iter_mut().filter(|argument| !self.rooted_in_own(argument)).collect::<Vec<_>>().into_iter().for_each(|a| self.visit_expr_mut(a));
        if let Some(turbofish) = &mut call.turbofish {
            self.visit_angle_bracketed_generic_arguments_mut(turbofish);
        }
    }

    /// Inside of something foreign only arguments and indices are of this world.
    fn inside_foreign(&mut self, expression: &mut Expr) {
        match expression {
            Expr::Field(field) => self.inside_foreign(&mut field.base),
            Expr::Paren(inner) => self.inside_foreign(&mut inner.expr),
            Expr::Reference(inner) => self.inside_foreign(&mut inner.expr),
            Expr::MethodCall(call) => {
                self.inside_foreign(&mut call.receiver);
                call.args.iter_mut().for_each(|argument| self.argument(argument));
            }
            Expr::Index(index) => {
                self.inside_foreign(&mut index.expr);
                self.visit_expr_mut(&mut index.index);
            }
            _ => {}
        }
    }

    /// An argument of the user's function: as it is, or as the plain or dual number that the function asks for.
    fn argument(&mut self, argument: &mut Expr) {
        if matches!(argument, Expr::Closure(_)) || matches!(argument, Expr::Lit(literal) if !matches!(literal.lit, Lit::Float(_))) {
            return;
        }
        if let Expr::Path(path) = argument
            && path.path.get_ident().is_some_and(|name| self.own.contains(&name.to_string()))
        {
            *argument = parse_quote!(#path.clone());
            return;
        }
        if let Expr::Reference(reference) = argument
            && self.rooted_in_own(&reference.expr)
        {
            return;
        }
        let varies = mentions(argument, &self.varying);
        let at = Span::mixed_site().located_at(argument.span());
        self.visit_expr_mut(argument);
        let convert = match (self.copy, varies) {
            (Copy::Plain, _) => quote_spanned!(at=> ::kin::rt::plain_argument),
            (Copy::Dual, true) => quote_spanned!(at=> ::kin::rt::jet_argument),
            (Copy::Dual, false) => quote_spanned!(at=> ::kin::rt::constant_argument),
        };
        *argument = parse_quote_spanned!(at=> #convert(#argument));
    }
}

/// Whether some method of the chain is given a closure.
fn holds_closure(call: &syn::ExprMethodCall) -> bool {
    let inner = if let Expr::MethodCall(inner) = &*call.receiver { holds_closure(inner) } else { false };
    inner || call.args.iter().any(|argument| matches!(argument, Expr::Closure(_)))
}

/// Literals, casts and paths of f64 in the dual copy.
fn lift_expression(expression: &mut Expr) {
    match expression {
        Expr::Lit(literal) => {
            let float = match &literal.lit {
                Lit::Float(_) => true,
                Lit::Int(k) => k.suffix() == "f64",
                _ => false,
            };
            if float {
                let at = Span::mixed_site().located_at(literal.span());
                *expression = parse_quote_spanned!(at=> ::kin::rt::Real::<__D>::from(#literal));
            }
        }
        Expr::Cast(cast) if cast.ty.to_token_stream().to_string().contains("Real") => {
            let inner = &cast.expr;
            *expression = parse_quote!(::kin::rt::cast::<__D, _>(#inner));
        }
        Expr::Call(call) if call.args.is_empty() && matches!(&*call.func, Expr::Path(path) if is_kin_function(path)) => {
            *expression = parse_quote!(::kin::rt::Lift::<__D>::lift(#call));
        }
        Expr::Path(path) if is_number_function(path) => {
            let rest = path.path.segments.iter().skip(1);
            *expression = parse_quote!(<::kin::rt::Real<__D>>::#(#rest)::*);
        }
        _ => {}
    }
}

/// `f64::sin`, but not `f64::EPSILON` or `f64::consts::PI`.
fn is_number_function(path: &syn::ExprPath) -> bool {
    let names: Vec<String> = path.path.segments.iter().map(|s| s.ident.to_string()).collect();
    matches!(&names[..], [ty, function] if ty == "f64" && function.starts_with(char::is_lowercase))
}

/// Functions of Kin's that take any numbers.
fn is_kin_function(path: &syn::ExprPath) -> bool {
    let names: Vec<String> = path.path.segments.iter().map(|s| s.ident.to_string()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    matches!(names[..], [.., "vec2" | "vec3"] | [.., "Vec2" | "Vec3" | "Mat2" | "Mat3", _] | ["Some" | "Ok" | "Err"])
}

/// `fn f(x: f64) -> f64 { … }` inside the body as `let f = |x: f64| -> f64 { … };`
fn as_closure(function: &syn::ItemFn) -> Option<Stmt> {
    let inputs: Vec<&syn::PatType> = function
        .sig
        .inputs
        .iter()
        .map(|input| if let syn::FnArg::Typed(typed) = input { Some(typed) } else { None })
        .collect::<Option<_>>()?;
    if !function.sig.generics.params.is_empty() {
        return None;
    }
    let (name, output, block) = (&function.sig.ident, &function.sig.output, &function.block);
    Some(parse_quote!(let #name = |#(#inputs),*| #output #block;))
}

/// f64 → `Real<__D>` in types.
struct Lifter;

impl VisitMut for Lifter {
    fn visit_type_mut(&mut self, ty: &mut Type) {
        if let Type::Path(path) = ty
            && let Some(last) = path.path.segments.last()
        {
            let bare = last.arguments.is_empty();
            match last.ident.to_string().as_str() {
                "f64" if bare => return *ty = parse_quote!(::kin::rt::Real<__D>),
                name @ ("Vec2" | "Vec3" | "Mat2" | "Mat3") if bare => {
                    let name = syn::Ident::new(name, Span::call_site());
                    return *ty = parse_quote!(::kin::rt::#name<::kin::rt::Real<__D>>);
                }
                _ => {}
            }
        }
        visit_mut::visit_type_mut(self, ty);
    }

    fn visit_expr_mut(&mut self, _: &mut Expr) {}
}
