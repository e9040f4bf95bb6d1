//! Blocks, statements, and the items among them.

use std::rc::Rc;

use syn::punctuated::Punctuated;
use syn::{Block, Expr, Item, Local, Pat, Stmt, Token};

use super::Reader;
use crate::lower::scope::Kind;
use crate::lower::values::{Branching, Function, Read, Unreadable, Value};
use crate::parse::SecondReader;
use crate::vocabulary::last_name;

impl Reader {
    /// Returns the value of a function's body, which may `return` early.
    pub fn body(&mut self, body: &Block) -> Read {
        self.enter(Kind::Function, None);
        let value = self.block(body)?;
        self.exit(value, body)
    }

    /// Returns the value of a block: that of its last expression, or `()`.
    pub fn block(&mut self, block: &Block) -> Read {
        self.scopes.push();
        let value = self.items(&block.stmts).and_then(|()| self.statements(&block.stmts));
        self.scopes.pop();
        value
    }

    fn statements(&mut self, statements: &[Stmt]) -> Read {
        let mut value = Value::unit();
        for (k, statement) in statements.iter().enumerate() {
            let last = self.statement(statement)?;
            if matches!(last, Value::Left) {
                return Ok(last);
            }
            if k + 1 == statements.len() {
                value = last;
            }
        }
        Ok(value)
    }

    /// Returns the value of a statement: `()`, unless it is an expression without `;`.
    fn statement(&mut self, statement: &Stmt) -> Read {
        match statement {
            Stmt::Local(local) => self.let_statement(local),
            Stmt::Expr(expression, None) => self.raw_expression(expression),
            Stmt::Expr(expression, Some(_)) => Ok(match self.raw_expression(expression)? {
                value @ (Value::Never | Value::Left) => value,
                _ => Value::unit(),
            }),
            Stmt::Item(_) => Ok(Value::unit()),
            Stmt::Macro(mac) => self.macro_call(&mac.mac),
        }
    }

    /// Reads the functions, constants and types of a block, which are visible before their
    /// declaration. Emitted code repeats the other items.
    fn items(&mut self, statements: &[Stmt]) -> Read<()> {
        let items = || {
            statements.iter().filter_map(|statement| {
                if let Stmt::Item(item) = statement { Some(item) } else { None }
            })
        };
        let depth = self.scopes.depth();
        for item in items() {
            if let Item::Fn(function) = item
                && !is_over_duals(function)
            {
                let value = Value::Function(Function::Inner(Rc::new(function.clone()), depth));
                self.scopes.declare_item(function.sig.ident.to_string(), value);
            }
            if let Item::Struct(_) | Item::Enum(_) | Item::Trait(_) = item {
                self.own.take(item, depth);
            }
        }
        items().try_for_each(|item| self.item(item, depth))
    }

    fn item(&mut self, item: &Item, depth: usize) -> Read<()> {
        let known = match item {
            Item::Fn(function) => !is_over_duals(function),
            Item::Const(constant) => {
                self.constant(&constant.ident, &constant.expr, &constant.ty, depth)
            }
            Item::Static(constant) => {
                self.constant(&constant.ident, &constant.expr, &constant.ty, depth)
            }
            Item::Impl(_) if !self.own.take(item, depth) => {
                return Err(Unreadable::new(item, "an item inside the function body"));
            }
            Item::Macro(_) => return Err(Unreadable::new(item, "a user-defined macro")),
            _ => false,
        };
        let of_types =
            matches!(item, Item::Struct(_) | Item::Enum(_) | Item::Impl(_) | Item::Trait(_));
        if known || of_types && depth != self.body_depth {
            return Ok(());
        }
        // Emitted code repeats an item for the whole body, so the item must not come from an inner
        // block.
        if depth != self.body_depth {
            return Err(Unreadable::new(item, "an item inside an inner block"));
        }
        self.repeated_items.push(item.clone());
        Ok(())
    }

    /// Reads a constant of the body, and returns true if its value is known here.
    fn constant(&mut self, name: &syn::Ident, value: &Expr, ty: &syn::Type, depth: usize) -> bool {
        let scopes = self.scopes.around_function(depth);
        let frames = self.flow.frames.len();
        let path = self.flow.path.len();
        let value = self.within(scopes, |reader| {
            let value = reader.raw_expression(value)?;
            reader.typed(value, ty, ty)
        });
        self.flow.frames.truncate(frames);
        self.flow.path.truncate(path);
        match value {
            Ok(value) if self.is_known(&value) => {
                self.hold_length(name, &value);
                self.scopes.declare_item(name.to_string(), value);
                true
            }
            _ => false,
        }
    }

    fn let_statement(&mut self, local: &Local) -> Read {
        let (pattern, ty) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
            pattern => (pattern, None),
        };
        let Some(init) = &local.init else {
            return self.bind(pattern, Value::Unassigned).map(|()| Value::unit());
        };
        let value = self.raw_expression(&init.expr)?;
        if matches!(value, Value::Left) {
            return Ok(value);
        }
        let value = match ty {
            Some(ty) => self.typed(value, ty, &init.expr)?,
            None => value,
        };
        match &init.diverge {
            None => self.bind(pattern, value).map(|()| Value::unit()),
            Some((_, otherwise)) => {
                let condition = self.test(pattern, &value)?;
                self.choose(
                    condition,
                    |_| Ok(Value::unit()),
                    |reader| reader.leaving(otherwise),
                    local,
                )
            }
        }
    }

    /// Reads `panic!` and similar macros, which have no value, and the few other macros that the
    /// interpreter knows. Any other macro is unreadable.
    pub fn macro_call(&mut self, call: &syn::Macro) -> Read {
        let name = last_name(&call.path);
        match name.as_str() {
            "unreachable" | "panic" | "todo" | "unimplemented" => Ok(Value::Never),
            "assert" | "debug_assert" if self.signature.second_reader == SecondReader::Nobody => {
                self.asserted(call)
            }
            // Rustc handles them when it compiles the user's function.
            "assert" | "assert_eq" | "assert_ne" | "debug_assert" | "debug_assert_eq"
            | "debug_assert_ne" => Ok(Value::unit()),
            "vec" => self.vec_macro(call),
            "matches" => self.matches_macro(call),
            _ => Err(unknown_macro(call)),
        }
    }

    /// Reads `matches!(value, pattern if guard)`.
    fn matches_macro(&mut self, call: &syn::Macro) -> Read {
        let parse = |input: syn::parse::ParseStream| {
            let value: Expr = input.parse()?;
            input.parse::<syn::Token![,]>()?;
            let pattern = Pat::parse_multi_with_leading_vert(input)?;
            let guard: Option<Expr> =
                input.parse::<Option<syn::Token![if]>>()?.map(|_| input.parse()).transpose()?;
            input.parse::<Option<syn::Token![,]>>()?;
            Ok((value, pattern, guard))
        };
        let Ok((value, pattern, guard)) = call.parse_body_with(parse) else {
            return Err(unknown_macro(call));
        };
        let value = self.matchable(&value)?;
        self.scopes.push();
        let matched = self.tested(&pattern, guard.as_ref(), &value);
        self.scopes.pop();
        matched.map(Value::Condition)
    }

    /// Reads `vec![a, b]`, `vec![x; n]`.
    fn vec_macro(&mut self, call: &syn::Macro) -> Read {
        if let Ok(list) = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            return self.expressions(list.iter()).map(Value::Array);
        }
        let repeat = |input: syn::parse::ParseStream| {
            let value = input.parse()?;
            input.parse::<Token![;]>()?;
            Ok((value, input.parse()?))
        };
        match call.parse_body_with(repeat) {
            Ok((value, length)) => self.repeated(&value, &length),
            Err(_) => Err(unknown_macro(call)),
        }
    }

    /// Reads `assert!(condition, …)`.
    pub fn asserted(&mut self, call: &syn::Macro) -> Read {
        let all = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated);
        if let Some(condition) = all.ok().and_then(|all| all.into_iter().next()) {
            match self.expression(&condition)? {
                Value::Condition(_)
                | Value::Opaque(_)
                | Value::Poison
                | Value::Never
                | Value::Left => {}
                other => {
                    let message =
                        format!("expected a condition (bool), but found {}", other.name());
                    self.told_by_rustc(call, &message);
                }
            }
        }
        Ok(Value::unit())
    }

    /// Reads the block of a `let … else`, which must leave the code around it.
    pub fn leaving(&mut self, block: &Expr) -> Read {
        let value = self.expression(block)?;
        if !matches!(value, Value::Left | Value::Never | Value::Poison) {
            let told = self.told_by_rustc(block, GOES_ON);
            return Ok(told.unwrap_or(value));
        }
        Ok(value)
    }
}

/// Returns true if a function takes dual numbers: emitted code then calls it, and the interpreter
/// does not read it.
fn is_over_duals(function: &syn::ItemFn) -> bool {
    let bounds = quote::ToTokens::to_token_stream(&function.sig.generics).to_string();
    bounds.split(|c: char| !c.is_alphanumeric()).any(|word| word == "Dual")
}

/// Returns the remark on a macro of the program, or on one of the standard library that the
/// interpreter does not read.
fn unknown_macro(call: &syn::Macro) -> Unreadable {
    let name = crate::error::tidy_text(&call.path);
    Unreadable::new(&call.path, format!("the macro `{name}!`"))
}

const GOES_ON: &str =
    "the block after `else` must leave the function: `return`, `break`, `continue` or `panic!`";

#[cfg(test)]
mod tests {
    use crate::lower::values::Value;
    use crate::lower::walk::Reader;
    use kin_graph::Graph;

    fn read(expression: syn::Expr) -> (Reader, Option<Value>) {
        let mut reader = Reader::new(Graph::default());
        let value = reader.expression(&expression).ok();
        (reader, value)
    }

    #[test]
    fn items_are_visible_before_their_declaration() {
        let (reader, value) = read(syn::parse_quote!({
            let x = 2.0 * LENGTH;
            const LENGTH: f64 = 1.5;
            x
        }));
        let Some(Value::Scalar(x)) = value else { panic!("a number") };
        assert_eq!(reader.graph.constant_value(x), Some(3.0));
        assert!(read(syn::parse_quote!({ users_macro!(1.0) })).1.is_none());
    }
}
