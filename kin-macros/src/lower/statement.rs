//! Blocks and statements.

use syn::{Block, Expr, Item, Local, Pat, Stmt};

use super::value::{Closure, Value};
use super::{Read, Reader, Unreadable};
use crate::parse::{Shape, shape};

impl Reader {
    /// The body of the function: a block whose last statement may be a `return`.
    pub fn function_body(&mut self, body: &Block) -> Read {
        let Some((Stmt::Expr(Expr::Return(last), _), before)) = body.stmts.split_last() else { return self.block(body) };
        self.scopes.push();
        let value = self.statements(before).and_then(|_| match &last.expr {
            Some(value) => self.expression(value),
            None => Ok(unit()),
        });
        self.scopes.pop();
        value
    }

    /// The value of a block: that of its last expression, or nothing.
    pub fn block(&mut self, block: &Block) -> Read {
        self.scopes.push();
        let value = self.statements(&block.stmts);
        self.scopes.pop();
        value
    }

    fn statements(&mut self, statements: &[Stmt]) -> Read {
        let mut value = unit();
        for (k, statement) in statements.iter().enumerate() {
            let last = k + 1 == statements.len();
            match statement {
                Stmt::Local(local) => self.let_statement(local)?,
                Stmt::Expr(expression, None) if last => value = self.expression(expression)?,
                Stmt::Expr(expression, _) => drop(self.expression(expression)?),
                Stmt::Item(item) => self.item(item)?,
                Stmt::Macro(mac) => return Err(Unreadable::new(&mac.mac.path, "a macro")),
            }
        }
        Ok(value)
    }

    /// Items inside the body: constants and imports are repeated in emitted code, a function is read like a closure.
    fn item(&mut self, item: &Item) -> Read<()> {
        match item {
            Item::Use(_) | Item::Const(_) => self.items.push(item.clone()),
            Item::Fn(function) if function.sig.generics.params.is_empty() => {
                let closure = self.inner_function(function)?;
                self.scopes.declare(function.sig.ident.to_string(), closure);
            }
            other => return Err(Unreadable::new(other, "an item inside the body")),
        }
        Ok(())
    }

    /// A function inside the body sees none of its variables.
    fn inner_function(&mut self, function: &syn::ItemFn) -> Read {
        let inputs = function.sig.inputs.iter().map(|input| match input {
            syn::FnArg::Typed(typed) => Ok(Pat::Type(typed.clone())),
            syn::FnArg::Receiver(receiver) => Err(Unreadable::new(receiver, "`self`")),
        });
        let body = Expr::Block(syn::ExprBlock { attrs: vec![], label: None, block: (*function.block).clone() });
        let mut scopes = super::Scopes::default();
        scopes.push();
        Ok(Value::Closure(std::rc::Rc::new(Closure { inputs: inputs.collect::<Read<_>>()?, body, scopes })))
    }

    fn let_statement(&mut self, local: &Local) -> Read<()> {
        let (pattern, ty) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
            pattern => (pattern, None),
        };
        let Some(init) = &local.init else {
            return self.bind(pattern, Value::Unassigned);
        };
        if let Some((_, other)) = &init.diverge {
            return Err(Unreadable::new(other, "`let … else`"));
        }
        let mut value = self.expression(&init.expr)?;
        match ty.map(|ty| (ty, shape(ty))) {
            Some((_, Some(shape))) => value = self.shaped_deep(value, &shape, &init.expr),
            Some((ty, None)) => value = self.other_type(value, ty, &init.expr)?,
            None => {}
        }
        self.bind(pattern, value)
    }

    /// As `shaped`, but tuples and arrays with `_` in their type are looked into.
    fn shaped_deep(&mut self, value: Value, shape: &Shape, at: &Expr) -> Value {
        match (&value, shape) {
            (_, Shape::Any) => value,
            _ => self.shaped(value, shape, at),
        }
    }

    /// A `let` with a type that is not made of numbers.
    fn other_type(&mut self, value: Value, ty: &syn::Type, at: &Expr) -> Read {
        let name = quote::ToTokens::to_token_stream(ty).to_string();
        match (name.as_str(), value) {
            ("bool", value) => Ok(Value::Condition(self.condition(value, at))),
            ("usize" | "i32" | "u32" | "i64" | "u64" | "isize" | "u8" | "i16" | "u16" | "i8", value @ (Value::Integer(_) | Value::Opaque(_) | Value::Poison)) => Ok(value),
            ("usize" | "i32" | "u32" | "i64" | "u64" | "f32", other) => Ok(self.mistake(at, format!("expected {name}, but this is {}", other.name()))),
            (_, value @ (Value::Opaque(_) | Value::Poison)) => Ok(value),
            _ => Err(Unreadable::new(ty, format!("a value of type `{}`", super::tidy(&name)))),
        }
    }
}

pub fn unit() -> Value {
    Value::Tuple(vec![])
}
