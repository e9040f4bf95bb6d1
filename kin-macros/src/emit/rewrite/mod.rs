//! The user's own body for the two emitted copies of it: plain f64 as written, and generic over
//! dual numbers.
//!
//! In the dual copy f64 means `Real<D>` everywhere: literals, types and parameters are lifted. What
//! only rustc knows (constants, fields of the user's types, the user's functions) is lifted where
//! it comes in, and calls of the user's functions hand over what they ask for.

mod foreign;
mod inner;
mod lift;
mod macros;
mod mark;
mod nature;
mod probed;
mod scopes;
mod sure;

use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::visit::Visit;
use syn::visit_mut::{self, VisitMut};
use syn::{Block, Expr, Item, Pat, Stmt, Type};

use inner::takes_numbers;
use kin_language::lower::Expressions;
use kin_language::parse::{Argument, Kind};
use lift::Lifter;
use scopes::{Name, Nature, Scopes, Variable};

pub use lift::is_liftable;
pub use sure::is_sure;

/// The body in plain f64: as written, but that calls of the user's generic functions convert
/// numbers.
pub fn plain(body: &Block, arguments: &[Argument]) -> Block {
    rewrite(body, arguments, Copy::Plain, None)
}

/// The body of a law in plain f64.
pub fn plain_law(body: &Block, parameters: &[Argument], variable: &Ident) -> Block {
    rewrite(body, parameters, Copy::Plain, Some(variable))
}

/// The body generic over `Real<__D>`.
pub fn dual(body: &Block, arguments: &[Argument]) -> Block {
    rewrite(body, arguments, Copy::Dual, None)
}

/// The same with the end of each expression marked, and the expressions by their numbers.
pub fn traced(body: &Block, arguments: &[Argument]) -> (Block, Expressions) {
    let mut rewriter =
        Rewriter { expressions: Some(Expressions::default()), ..Rewriter::new(Copy::Dual) };
    let body = rewriter.rewrite(body, arguments, None);
    (body, rewriter.expressions.unwrap_or_default())
}

/// The body of a law generic over `Real<__D>`.
pub fn dual_law(body: &Block, parameters: &[Argument], variable: &Ident) -> Block {
    rewrite(body, parameters, Copy::Dual, Some(variable))
}

/// A type of the signature or the body, with f64 lifted.
pub fn lifted_type(ty: &Type) -> Type {
    let mut ty = ty.clone();
    Lifter(&dual_parameter()).visit_type_mut(&mut ty);
    ty
}

/// The type that the copies are generic over.
fn dual_parameter() -> Ident {
    Ident::new("__D", Span::call_site())
}

#[derive(Clone, Copy, PartialEq)]
enum Copy {
    Plain,
    Dual,
}

fn rewrite(body: &Block, arguments: &[Argument], copy: Copy, variable: Option<&Ident>) -> Block {
    Rewriter::new(copy).rewrite(body, arguments, variable)
}

struct Rewriter {
    copy: Copy,
    /// The dual number that the code in hand is generic over.
    dual: Ident,
    scopes: Scopes,
    /// The expressions whose ends are marked, if any are.
    expressions: Option<Expressions>,
}

impl VisitMut for Rewriter {
    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        let number = self.number_to_mark(expression);
        self.by_kind(expression);
        if let Some(number) = number {
            self.mark(expression, number);
        }
    }

    fn visit_block_mut(&mut self, block: &mut Block) {
        self.scopes.push();
        self.declare_items(block);
        block.stmts.iter_mut().for_each(|statement| self.visit_stmt_mut(statement));
        self.scopes.pop();
    }

    fn visit_stmt_mut(&mut self, statement: &mut Stmt) {
        match statement {
            Stmt::Item(Item::Fn(function)) => self.inner_item(function),
            Stmt::Item(_) => {}
            Stmt::Macro(call) => self.macro_call(&mut call.mac),
            Stmt::Expr(Expr::MethodCall(call), Some(_)) => {
                // A method that is called for what it does puts its arguments into its receiver.
                let nature = call
                    .args
                    .iter()
                    .fold(Nature::default(), |all, argument| all.or(self.nature(argument)));
                self.feed(&call.receiver, nature);
                visit_mut::visit_stmt_mut(self, statement);
            }
            _ => visit_mut::visit_stmt_mut(self, statement),
        }
    }

    fn visit_local_mut(&mut self, local: &mut syn::Local) {
        let mut nature = Nature::default();
        let mut inputs = None;
        if let Some(init) = &mut local.init {
            nature = self.nature(&init.expr);
            self.unname(&mut local.pat, &init.expr, nature);
            match &mut *init.expr {
                Expr::Closure(closure) => inputs = Some(self.closure(closure, Nature::default())),
                other => self.visit_expr_mut(other),
            }
            if let Some((_, diverge)) = &mut init.diverge {
                self.visit_expr_mut(diverge);
            }
        }
        self.lift_pattern(&mut local.pat);
        match (&local.pat, inputs) {
            (Pat::Ident(name), Some(inputs)) => {
                let variable = Variable {
                    number: self.scopes.binding(nature),
                    own: false,
                    inputs: Some(inputs),
                };
                self.scopes.declare(name.ident.to_string(), Name::Variable(variable));
            }
            (pattern, _) => drop(self.declare(pattern, nature)),
        }
    }

    fn visit_expr_if_mut(&mut self, branch: &mut syn::ExprIf) {
        self.scopes.push();
        self.visit_expr_mut(&mut branch.cond);
        self.visit_block_mut(&mut branch.then_branch);
        self.scopes.pop();
        if let Some((_, otherwise)) = &mut branch.else_branch {
            self.visit_expr_mut(otherwise);
        }
    }

    fn visit_expr_while_mut(&mut self, each: &mut syn::ExprWhile) {
        self.scopes.push();
        self.visit_expr_mut(&mut each.cond);
        self.visit_block_mut(&mut each.body);
        self.scopes.pop();
    }

    fn visit_expr_let_mut(&mut self, test: &mut syn::ExprLet) {
        let nature = self.nature(&test.expr);
        self.visit_expr_mut(&mut test.expr);
        self.declare(&test.pat, nature);
    }

    fn visit_expr_for_loop_mut(&mut self, each: &mut syn::ExprForLoop) {
        let nature = self.nature(&each.expr);
        self.visit_expr_mut(&mut each.expr);
        self.scopes.push();
        self.declare(&each.pat, nature);
        self.visit_block_mut(&mut each.body);
        self.scopes.pop();
    }

    fn visit_expr_match_mut(&mut self, branch: &mut syn::ExprMatch) {
        let nature = self.nature(&branch.expr);
        self.visit_expr_mut(&mut branch.expr);
        for arm in &mut branch.arms {
            self.scopes.push();
            self.declare(&arm.pat, nature);
            if let Some((_, guard)) = &mut arm.guard {
                self.visit_expr_mut(guard);
            }
            self.visit_expr_mut(&mut arm.body);
            self.scopes.pop();
        }
        self.lift_arms(&mut branch.arms);
    }

    fn visit_type_mut(&mut self, ty: &mut Type) {
        self.lift_type(ty);
    }

    fn visit_pat_mut(&mut self, pattern: &mut Pat) {
        self.lift_pattern(pattern);
    }
}

impl Rewriter {
    fn new(copy: Copy) -> Self {
        Rewriter { copy, dual: dual_parameter(), scopes: Scopes::default(), expressions: None }
    }

    /// `let x: Length = a + b;`, where only rustc knows that a `Length` is an f64: what is made of
    /// numbers alone says itself what it is.
    fn unname(&self, pattern: &mut Pat, value: &Expr, nature: Nature) {
        if let Pat::Type(typed) = &*pattern
            && self.copy == Copy::Dual
            && !nature.foreign
            && lift::is_unknown(&typed.ty)
            && computes(value)
        {
            *pattern = (*typed.pat).clone();
        }
    }

    /// The body rewritten, as often as something new is learnt of its variables.
    fn rewrite(&mut self, body: &Block, arguments: &[Argument], variable: Option<&Ident>) -> Block {
        loop {
            self.scopes.restart();
            self.declare_arguments(arguments, variable);
            let mut rewritten = body.clone();
            self.visit_block_mut(&mut rewritten);
            if !self.scopes.changed() {
                return rewritten;
            }
        }
    }

    fn by_kind(&mut self, expression: &mut Expr) {
        match expression {
            Expr::Path(_) => self.path(expression),
            Expr::Lit(_) => self.literal(expression),
            Expr::Field(_)
            | Expr::Index(_)
            | Expr::Unary(syn::ExprUnary { op: syn::UnOp::Deref(_), .. })
                if self.is_foreign(expression) =>
            {
                self.place(expression);
                self.lift_place(expression);
            }
            Expr::MethodCall(_) => self.method_call(expression),
            Expr::Call(_) => self.call(expression),
            Expr::Struct(literal) => self.struct_literal(literal),
            Expr::Reference(reference) if reference.mutability.is_some() => {
                self.place(&mut reference.expr)
            }
            Expr::Assign(assign) if self.is_part_of_foreign(&assign.left) => {
                self.assign_to(&mut assign.left, &assign.right);
                self.put(&mut assign.right);
            }
            Expr::Assign(assign) => self.assignment(&mut assign.left, &mut assign.right),
            Expr::Binary(binary) if is_compound(&binary.op) => {
                self.assignment(&mut binary.left, &mut binary.right)
            }
            Expr::Cast(_) => self.cast(expression),
            Expr::Closure(closure) => drop(self.closure(closure, Nature::ANY)),
            Expr::Macro(call) => self.macro_call(&mut call.mac),
            // Array lengths are no numbers of the equation.
            Expr::Repeat(repeat) => self.visit_expr_mut(&mut repeat.expr),
            _ => visit_mut::visit_expr_mut(self, expression),
        }
    }

    fn declare_arguments(&mut self, arguments: &[Argument], variable: Option<&Ident>) {
        for argument in arguments {
            let varies = argument.kind.slots() > 0 || argument.kind == Kind::Time;
            let own = argument.kind == Kind::Other && !is_liftable(&argument.ty);
            let number = self.scopes.binding(Nature { varies, foreign: own });
            self.scopes.declare(
                argument.name.to_string(),
                Name::Variable(Variable { number, own, inputs: None }),
            );
        }
        if let Some(name) = variable {
            let number = self.scopes.binding(Nature { varies: true, foreign: false });
            self.scopes.declare(
                name.to_string(),
                Name::Variable(Variable { number, own: false, inputs: None }),
            );
        }
    }

    /// Brings in the variables of a pattern; their numbers.
    fn declare(&mut self, pattern: &Pat, nature: Nature) -> Vec<usize> {
        let nature = match pattern {
            Pat::Type(typed) => {
                Nature { foreign: nature.foreign && !is_liftable(&typed.ty), ..nature }
            }
            _ => nature,
        };
        let mut numbers = Vec::new();
        for name in names(pattern) {
            let number = self.scopes.binding(nature);
            numbers.push(number);
            self.scopes
                .declare(name, Name::Variable(Variable { number, own: false, inputs: None }));
        }
        numbers
    }

    /// The items of a block are seen from before their own line.
    fn declare_items(&mut self, block: &Block) {
        for statement in &block.stmts {
            let Stmt::Item(item) = statement else { continue };
            match item {
                Item::Fn(function) if !inner::is_over_duals(function) => {
                    let inputs = self.input_bindings(function);
                    let name = Name::Function { inputs, lifted: takes_numbers(function) };
                    self.scopes.declare(function.sig.ident.to_string(), name);
                }
                Item::Fn(function) => {
                    self.scopes.declare(function.sig.ident.to_string(), Name::Item)
                }
                Item::Const(constant) => {
                    self.scopes.declare(constant.ident.to_string(), Name::Item)
                }
                Item::Static(constant) => {
                    self.scopes.declare(constant.ident.to_string(), Name::Item)
                }
                _ => {}
            }
        }
    }

    /// `place = value` and `place += value`
    fn assignment(&mut self, place: &mut Expr, value: &mut Expr) {
        self.assign_to(place, value);
        self.visit_expr_mut(value);
    }

    fn assign_to(&mut self, place: &mut Expr, value: &Expr) {
        let nature = self.nature(value);
        self.feed(place, nature);
        self.place(place);
    }

    /// The variables of a place may hold something of this nature from now on.
    fn feed(&mut self, place: &Expr, nature: Nature) {
        match place {
            Expr::Path(path) => {
                if let Some(number) = self.variable(path).map(|variable| variable.number) {
                    self.scopes.add(number, nature);
                }
            }
            Expr::Tuple(tuple) => tuple.elems.iter().for_each(|part| self.feed(part, nature)),
            Expr::Array(array) => array.elems.iter().for_each(|part| self.feed(part, nature)),
            Expr::Field(field) => self.feed(&field.base, nature),
            Expr::Index(index) => self.feed(&index.expr, nature),
            Expr::Paren(inner) => self.feed(&inner.expr, nature),
            Expr::Unary(inner) => self.feed(&inner.expr, nature),
            Expr::MethodCall(call) => self.feed(&call.receiver, nature),
            Expr::Reference(inner) => self.feed(&inner.expr, nature),
            _ => {}
        }
    }
}

/// The names that a pattern binds, in order.
fn names(pattern: &Pat) -> Vec<String> {
    struct Names(Vec<String>);
    impl Visit<'_> for Names {
        fn visit_pat_ident(&mut self, pattern: &syn::PatIdent) {
            if !pattern.ident.to_string().starts_with(char::is_uppercase) {
                self.0.push(pattern.ident.to_string());
            }
            syn::visit::visit_pat_ident(self, pattern);
        }
    }
    let mut names = Names(Vec::new());
    names.visit_pat(pattern);
    names.0
}

/// True if an expression is a number, or made of some, by its form.
fn computes(value: &Expr) -> bool {
    match value {
        Expr::Paren(inner) => computes(&inner.expr),
        Expr::Group(inner) => computes(&inner.expr),
        Expr::Binary(_) | Expr::Unary(_) | Expr::Path(_) | Expr::Field(_) | Expr::Index(_) => true,
        Expr::Lit(literal) => matches!(literal.lit, syn::Lit::Float(_)),
        Expr::MethodCall(call) => {
            kin_language::vocabulary::is_number_method(&call.method.to_string())
        }
        _ => false,
    }
}

/// `+=` and the like.
pub fn is_compound(op: &syn::BinOp) -> bool {
    let text = op.to_token_stream().to_string();
    text.ends_with('=') && !matches!(text.as_str(), "==" | "!=" | "<=" | ">=")
}
