//! Functions inside the body: closures, functions declared in it, and paths of functions.

use std::rc::Rc;

use proc_macro2::TokenStream;
use syn::{Expr, ItemFn, Pat, ReturnType};

use super::Value;
use crate::lower::scope::Scopes;

/// A function that can be applied to values.
#[derive(Clone)]
pub enum Function {
    Closure(Rc<Closure>),
    /// A function declared inside the body, and the number of the scope that declares it.
    Inner(Rc<ItemFn>, usize),
    /// `f64::sin`, or the name of a function of the user's program.
    Path(Rc<syn::ExprPath>),
}

/// A closure with the variables in its scope.
pub struct Closure {
    /// The arguments with the bars around them, for messages.
    pub head: TokenStream,
    pub inputs: Vec<Pat>,
    pub output: ReturnType,
    pub body: Expr,
    pub scopes: Scopes<Value>,
}

impl Function {
    pub fn is(&self, other: &Function) -> bool {
        match (self, other) {
            (Function::Closure(a), Function::Closure(b)) => Rc::ptr_eq(a, b),
            (Function::Inner(a, _), Function::Inner(b, _)) => Rc::ptr_eq(a, b),
            (Function::Path(a), Function::Path(b)) => {
                crate::vocabulary::names(a) == crate::vocabulary::names(b)
            }
            _ => false,
        }
    }
}
