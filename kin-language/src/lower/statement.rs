//! Blocks, statements, and the items among them.

use std::rc::Rc;

use syn::visit::Visit;
use syn::{Block, Expr, Item, Local, Pat, Stmt};

use super::function::Function;
use super::value::Value;
use super::{Read, Reader, Unreadable};

impl Reader {
    /// The value of a function's body, which may `return` early.
    pub fn body(&mut self, body: &Block) -> Read {
        self.scopes.push();
        let value = self.items(&body.stmts).and_then(|()| self.returning(&body.stmts));
        self.scopes.pop();
        value
    }

    /// The value of a block: that of its last expression, or nothing.
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
            if k + 1 == statements.len() {
                value = last;
            }
        }
        Ok(value)
    }

    /// The value of a statement: nothing, unless it is an expression without `;`.
    fn statement(&mut self, statement: &Stmt) -> Read {
        match statement {
            Stmt::Local(local) => self.let_statement(local).map(|()| Value::unit()),
            Stmt::Expr(expression, None) => self.expression(expression),
            Stmt::Expr(expression, Some(_)) => Ok(match self.expression(expression)? {
                Value::Never => Value::Never,
                _ => Value::unit(),
            }),
            Stmt::Item(_) => Ok(Value::unit()),
            Stmt::Macro(mac) => self.macro_call(&mac.mac),
        }
    }

    /// Statements up to the first that returns; where a branch returns, the others go on with what follows.
    fn returning(&mut self, statements: &[Stmt]) -> Read {
        let Some(place) = statements.iter().position(returns) else { return self.statements(statements) };
        let (before, after) = statements.split_at(place);
        self.statements(before)?;
        match after.first() {
            Some(Stmt::Expr(Expr::Return(last), _)) => match &last.expr {
                Some(value) => self.raw_expression(value),
                None => Ok(Value::unit()),
            },
            Some(Stmt::Expr(Expr::If(branch), _)) => self.if_that_returns(branch, &after[1..]),
            Some(Stmt::Expr(Expr::Block(block), _)) if block.label.is_none() && after.len() == 1 => self.body(&block.block),
            Some(other) => Err(Unreadable::new(other, "an early `return`")),
            None => Ok(Value::unit()),
        }
    }

    /// `if … { …; return x; }`: the branch that goes on is read together with what follows.
    fn if_that_returns(&mut self, branch: &syn::ExprIf, rest: &[Stmt]) -> Read {
        let then: Vec<Stmt> = vec![Stmt::Expr(block_of(branch), None)];
        let otherwise: Vec<Stmt> = branch.else_branch.iter().map(|(_, otherwise)| Stmt::Expr((**otherwise).clone(), None)).collect();
        if matches!(*branch.cond, Expr::Let(_)) {
            return Err(Unreadable::new(&branch.cond, "an early `return`"));
        }
        let condition = self.expression(&branch.cond)?;
        let condition = self.condition(condition, &branch.cond);
        self.choose_value(condition, |reader| reader.branch_and_rest(then, rest), |reader| reader.branch_and_rest(otherwise, rest), branch)
    }

    fn branch_and_rest(&mut self, mut branch: Vec<Stmt>, rest: &[Stmt]) -> Read {
        let inner_return = branch.iter().any(returns);
        match branch.first() {
            _ if ends(&branch) || rest.is_empty() => {}
            // The block of a branch has variables of its own; `else if` has none before its condition.
            Some(Stmt::Expr(Expr::Block(block), _)) if inner_return => return Err(Unreadable::new(block, "an early `return`")),
            _ => branch.extend(rest.iter().cloned()),
        }
        self.returning(&branch)
    }

    /// Functions and constants of a block, which are seen from before their own line; other items are repeated in emitted code.
    fn items(&mut self, statements: &[Stmt]) -> Read<()> {
        let items = || statements.iter().filter_map(|statement| if let Stmt::Item(item) = statement { Some(item) } else { None });
        let depth = self.scopes.depth();
        for item in items() {
            if let Item::Fn(function) = item
                && function.sig.generics.params.is_empty()
            {
                let value = Value::Function(Function::Inner(Rc::new(function.clone()), depth));
                self.scopes.declare_item(function.sig.ident.to_string(), value);
            }
        }
        items().try_for_each(|item| self.item(item, depth))
    }

    fn item(&mut self, item: &Item, depth: usize) -> Read<()> {
        match item {
            Item::Fn(function) if function.sig.generics.params.is_empty() => return Ok(()),
            Item::Const(constant) => {
                let scopes = self.scopes.around_function(depth);
                let value = self.within(scopes, |reader| {
                    let value = reader.expression(&constant.expr)?;
                    reader.typed(value, &constant.ty, &constant.expr)
                });
                if let Ok(value) = value
                    && self.is_known(&value)
                {
                    self.scopes.declare_item(constant.ident.to_string(), value);
                    return Ok(());
                }
            }
            Item::Macro(_) | Item::Impl(_) => return Err(Unreadable::new(item, "an item inside the body")),
            _ => {}
        }
        // Emitted code repeats an item for the whole body, so it must not come out of an inner block.
        if depth != self.body_depth {
            return Err(Unreadable::new(item, "an item inside of an inner block"));
        }
        self.repeated_items.push(item.clone());
        Ok(())
    }

    /// Whether a value holds constants of the graph only.
    fn is_known(&self, value: &Value) -> bool {
        match value {
            Value::Integer(..) => true,
            Value::Condition(node) => self.graph.is_number(*node),
            value => value.numbers().is_some_and(|(nodes, _)| nodes.iter().all(|&n| self.graph.is_number(n))),
        }
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
        let value = self.raw_expression(&init.expr)?;
        let value = match ty {
            Some(ty) => self.typed(value, ty, &init.expr)?,
            None => value,
        };
        self.bind(pattern, value)
    }

    /// Macros that only say that there is no value here; others are rustc's.
    pub fn macro_call(&mut self, call: &syn::Macro) -> Read {
        let name = call.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        match name.as_str() {
            "unreachable" | "panic" | "todo" | "unimplemented" => Ok(Value::Never),
            "matches" => self.matches_macro(call),
            _ => Err(Unreadable::new(&call.path, "a macro")),
        }
    }

    /// `matches!(value, pattern if guard)`
    fn matches_macro(&mut self, call: &syn::Macro) -> Read {
        let parse = |input: syn::parse::ParseStream| {
            let value: Expr = input.parse()?;
            input.parse::<syn::Token![,]>()?;
            let pattern = Pat::parse_multi_with_leading_vert(input)?;
            let guard: Option<Expr> = input.parse::<Option<syn::Token![if]>>()?.map(|_| input.parse()).transpose()?;
            input.parse::<Option<syn::Token![,]>>()?;
            Ok((value, pattern, guard))
        };
        let Ok((value, pattern, guard)) = call.parse_body_with(parse) else { return Err(Unreadable::new(&call.path, "a macro")) };
        let value = self.matchable(&value)?;
        self.scopes.push();
        let matched = self.tested(&pattern, guard.as_ref(), &value);
        self.scopes.pop();
        matched.map(Value::Condition)
    }
}

/// Whether a `return` of the function itself is somewhere in a statement.
fn returns(statement: &Stmt) -> bool {
    struct Search(bool);
    impl Visit<'_> for Search {
        fn visit_expr_return(&mut self, _: &syn::ExprReturn) {
            self.0 = true;
        }
        fn visit_expr_closure(&mut self, _: &syn::ExprClosure) {}
        fn visit_item(&mut self, _: &Item) {}
    }
    let mut search = Search(false);
    search.visit_stmt(statement);
    search.0
}

/// Whether the last of these statements returns, whatever happens.
fn ends(statements: &[Stmt]) -> bool {
    match statements.last() {
        Some(Stmt::Expr(Expr::Return(_), _)) => true,
        Some(Stmt::Expr(Expr::Block(block), _)) => ends(&block.block.stmts),
        Some(Stmt::Expr(Expr::If(branch), _)) => {
            let otherwise = branch.else_branch.as_ref().map(|(_, otherwise)| Stmt::Expr((**otherwise).clone(), None));
            ends(&branch.then_branch.stmts) && ends(otherwise.as_slice())
        }
        _ => false,
    }
}

fn block_of(branch: &syn::ExprIf) -> Expr {
    Expr::Block(syn::ExprBlock { attrs: vec![], label: None, block: branch.then_branch.clone() })
}
