//! Functions inside the body: closures, functions declared in it, and paths of functions; how they are applied.

use std::rc::Rc;

use quote::ToTokens;
use syn::{Expr, FnArg, ItemFn, Pat, ReturnType};

use super::scope::Scopes;
use super::template::Template;
use super::value::Value;
use super::{MOST_CALLS, Read, Reader, Unreadable};

/// Something that can be applied to values.
#[derive(Clone)]
pub enum Function {
    Closure(Rc<Closure>),
    /// A function declared inside the body, and the number of the scope it is declared in.
    Inner(Rc<ItemFn>, usize),
    /// `f64::sin`, or a function of the user's by its name.
    Path(Rc<syn::ExprPath>),
}

/// A closure with the variables it saw.
pub struct Closure {
    inputs: Vec<Pat>,
    output: ReturnType,
    body: Expr,
    scopes: Scopes,
}

impl Function {
    pub fn is(&self, other: &Function) -> bool {
        match (self, other) {
            (Function::Closure(a), Function::Closure(b)) => Rc::ptr_eq(a, b),
            (Function::Inner(a, _), Function::Inner(b, _)) => Rc::ptr_eq(a, b),
            (Function::Path(a), Function::Path(b)) => crate::vocabulary::names(a) == crate::vocabulary::names(b),
            _ => false,
        }
    }
}

impl Reader {
    pub fn closure(&mut self, closure: &syn::ExprClosure) -> Read {
        let inputs = closure.inputs.iter().cloned().collect();
        let (output, body) = (closure.output.clone(), (*closure.body).clone());
        Ok(Value::Function(Function::Closure(Rc::new(Closure { inputs, output, body, scopes: self.scopes.clone() }))))
    }

    /// A value as a function, where it may be one.
    pub fn function(&mut self, value: Value, at: &Expr) -> Read<Function> {
        match value {
            Value::Function(function) => Ok(function),
            Value::Opaque(Template::Path(path, _)) => Ok(Function::Path(Rc::new(path))),
            _ => Err(Unreadable::new(at, "a function that is not a closure")),
        }
    }

    /// The value of a function at `arguments`; `places` are their expressions, for messages.
    pub fn apply(&mut self, function: &Function, arguments: Vec<Value>, places: &[&Expr], at: &dyn ToTokens) -> Read {
        self.calls += 1;
        if self.calls > MOST_CALLS {
            return Err(Unreadable::new(at, "a recursion this deep"));
        }
        let value = match function {
            Function::Closure(closure) => self.apply_closure(closure, arguments, at),
            Function::Inner(item, depth) => self.apply_inner(item, *depth, arguments, at),
            Function::Path(path) => self.call_path(path, arguments, places, at),
        };
        self.calls -= 1;
        value
    }

    fn apply_closure(&mut self, closure: &Closure, arguments: Vec<Value>, at: &dyn ToTokens) -> Read {
        if closure.inputs.len() != arguments.len() {
            let text = super::counted("this closure", closure.inputs.len(), "argument", arguments.len());
            return Ok(self.mistake(at, text));
        }
        let mut scopes = closure.scopes.clone();
        scopes.raise_floor();
        self.within(scopes, |reader| {
            closure.inputs.iter().zip(arguments).try_for_each(|(pattern, value)| reader.bind(pattern, value))?;
            let value = match &closure.body {
                Expr::Block(block) => reader.body(&block.block),
                body => reader.expression(body),
            }?;
            reader.returned(value, &closure.output, &closure.body)
        })
    }

    /// A function inside the body sees none of its variables.
    fn apply_inner(&mut self, item: &ItemFn, depth: usize, arguments: Vec<Value>, at: &dyn ToTokens) -> Read {
        if item.sig.inputs.len() != arguments.len() {
            let text = super::counted(&format!("`{}`", item.sig.ident), item.sig.inputs.len(), "argument", arguments.len());
            return Ok(self.mistake(at, text));
        }
        let scopes = self.scopes.around_function(depth);
        self.within(scopes, |reader| {
            for (input, value) in item.sig.inputs.iter().zip(arguments) {
                match input {
                    FnArg::Typed(typed) => reader.bind(&Pat::Type(typed.clone()), value)?,
                    FnArg::Receiver(receiver) => return Err(Unreadable::new(receiver, "`self`")),
                }
            }
            let value = reader.body(&item.block)?;
            reader.returned(value, &item.sig.output, &item.block)
        })
    }

    /// Reads something with other variables in sight.
    pub fn within(&mut self, scopes: Scopes, read: impl FnOnce(&mut Self) -> Read) -> Read {
        let outer = std::mem::replace(&mut self.scopes, scopes);
        self.scopes.push();
        let value = read(self);
        self.scopes = outer;
        value
    }

    fn returned(&mut self, value: Value, output: &ReturnType, at: &dyn ToTokens) -> Read {
        match output {
            ReturnType::Default => Ok(value),
            ReturnType::Type(_, ty) => self.typed(value, ty, at),
        }
    }
}
