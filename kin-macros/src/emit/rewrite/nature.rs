//! The nature of an expression's value, before any type is known.

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::Visit;
use syn::{Block, Expr, Stmt, UnOp};

use super::Rewriter;
use super::scopes::{Name, Nature, Variable};
use kin_language::vocabulary::{
    is_kin_function, is_kin_type, is_number_function, is_number_method, is_std_function,
};

impl Rewriter {
    pub fn nature(&self, expression: &Expr) -> Nature {
        Nature { varies: self.varies(expression), foreign: self.is_foreign(expression) }
    }

    /// The variable that a name stands for.
    pub fn variable(&self, path: &syn::ExprPath) -> Option<&Variable> {
        match self.scopes.get(&path.path.get_ident()?.to_string())? {
            Name::Variable(variable) => Some(variable),
            _ => None,
        }
    }

    /// The function inside the body that a name stands for: its inputs, and whether it is lifted.
    pub fn inner_function(&self, path: &syn::ExprPath) -> Option<(&super::scopes::Inputs, bool)> {
        match self.scopes.get(&path.path.get_ident()?.to_string())? {
            Name::Function { inputs, lifted } => Some((inputs, *lifted)),
            _ => None,
        }
    }

    /// True if an expression reads a variable that depends on coordinates or time.
    fn varies(&self, expression: &Expr) -> bool {
        let mut search = Search { rewriter: self, found: false };
        search.visit_expr(expression);
        search.found
    }

    /// True if a value may be of a type that only rustc knows, or f64 where the copy has `Real`.
    pub fn is_foreign(&self, expression: &Expr) -> bool {
        match expression {
            Expr::Path(path) => match (self.variable(path), self.inner_function(path)) {
                (Some(variable), _) => self.scopes.nature(variable.number).foreign,
                (None, Some(_)) => false,
                (None, None) => !is_number_function(path) && !path.path.is_ident("None"),
            },
            Expr::Paren(inner) => self.is_foreign(&inner.expr),
            Expr::Group(inner) => self.is_foreign(&inner.expr),
            Expr::Reference(inner) => self.is_foreign(&inner.expr),
            Expr::Unary(unary) => {
                matches!(unary.op, UnOp::Deref(_)) && self.is_foreign(&unary.expr)
            }
            Expr::Try(inner) => self.is_foreign(&inner.expr),
            Expr::Field(field) => {
                self.is_foreign(&field.base) || self.is_made_of_foreign(&field.base)
            }
            Expr::Index(index) => self.is_foreign(&index.expr),
            Expr::MethodCall(call) => {
                !is_number_method(&call.method.to_string())
                    && (self.is_foreign(&call.receiver)
                        || call.args.iter().any(|a| self.is_foreign(a)))
            }
            Expr::Call(call) => self.gives_foreign(call),
            Expr::Struct(literal) => !is_kin_type(&literal.path),
            Expr::Tuple(tuple) => tuple.elems.iter().any(|part| self.is_foreign(part)),
            Expr::Array(array) => array.elems.iter().any(|part| self.is_foreign(part)),
            Expr::Repeat(repeat) => self.is_foreign(&repeat.expr),
            Expr::Closure(closure) => {
                !self.is_of_its_own(&closure.body) && self.is_foreign(&closure.body)
            }
            Expr::Block(block) => self.tail_is_foreign(&block.block),
            Expr::If(branch) => {
                let otherwise = branch
                    .else_branch
                    .as_ref()
                    .is_some_and(|(_, otherwise)| self.is_foreign(otherwise));
                otherwise || self.tail_is_foreign(&branch.then_branch)
            }
            Expr::Match(branch) => branch.arms.iter().any(|arm| self.is_foreign(&arm.body)),
            Expr::Macro(call) => super::macros::elements(&call.mac)
                .is_some_and(|all| all.iter().any(|part| self.is_foreign(part))),
            _ => false,
        }
    }

    /// True of operators between values of the user's types: numbers have no fields.
    fn is_made_of_foreign(&self, base: &Expr) -> bool {
        match base {
            Expr::Paren(inner) => self.is_made_of_foreign(&inner.expr),
            Expr::Binary(binary) => [&binary.left, &binary.right]
                .into_iter()
                .any(|operand| self.is_foreign(operand) || self.is_made_of_foreign(operand)),
            Expr::Unary(unary) => self.is_foreign(&unary.expr),
            _ => false,
        }
    }

    /// True if a closure gives a variable that is declared inside of it.
    fn is_of_its_own(&self, body: &Expr) -> bool {
        let Expr::Block(block) = body else { return false };
        let Some(Stmt::Expr(Expr::Path(tail), None)) = block.block.stmts.last() else {
            return false;
        };
        let small = |name: &syn::Ident| {
            name.to_string().starts_with(|c: char| c.is_lowercase() || c == '_')
        };
        tail.path.get_ident().is_some_and(small)
            && self.variable(tail).is_none()
            && self.inner_function(tail).is_none()
    }

    fn tail_is_foreign(&self, block: &Block) -> bool {
        matches!(block.stmts.last(), Some(Stmt::Expr(tail, None)) if self.is_foreign(tail))
    }

    fn gives_foreign(&self, call: &syn::ExprCall) -> bool {
        let Expr::Path(path) = &*call.func else { return self.is_foreign(&call.func) };
        if let Some(variable) = self.variable(path) {
            return self.scopes.nature(variable.number).foreign;
        }
        match self.inner_function(path) {
            Some(_) => false,
            None if is_kin_function(path) || is_number_function(path) => false,
            None => {
                !is_std_function(path) || call.args.iter().any(|argument| self.is_foreign(argument))
            }
        }
    }
}

/// Looks for a variable that varies.
struct Search<'a> {
    rewriter: &'a Rewriter,
    found: bool,
}

impl Search<'_> {
    fn tokens(&mut self, tokens: TokenStream) {
        for token in tokens {
            match token {
                TokenTree::Ident(name) => self.name(&name.to_string()),
                TokenTree::Group(group) => self.tokens(group.stream()),
                _ => {}
            }
        }
    }

    fn name(&mut self, name: &str) {
        if let Some(Name::Variable(variable)) = self.rewriter.scopes.get(name) {
            self.found |= self.rewriter.scopes.nature(variable.number).varies;
        }
    }
}

impl Visit<'_> for Search<'_> {
    fn visit_expr_path(&mut self, path: &syn::ExprPath) {
        if let Some(name) = path.path.get_ident() {
            self.name(&name.to_string());
        }
    }

    fn visit_macro(&mut self, call: &syn::Macro) {
        self.tokens(call.tokens.clone());
    }
}
