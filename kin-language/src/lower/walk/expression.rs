//! Expressions: the table of the reading of each kind.

use quote::ToTokens;
use syn::Expr;

use super::{MOST_EXPRESSIONS, MOST_NODES, MOST_PARTS, Reader};
use crate::lower::values::{
    Adt, Branching, Endless, Function, MOST_TURNS, PERHAPS, Place, Read, Template, Unreadable,
    Value, Values, name_at_use,
};

const LET_WITHIN: &str = "`let` begins a statement, or tests a pattern in the condition of an `if` or `while`: write `;` before this `let`";

impl Reader {
    /// Returns the value of an expression. If it is a reference, the function returns the value
    /// behind it.
    pub fn expression(&mut self, expression: &Expr) -> Read {
        let value = self.raw_expression(expression)?;
        Ok(self.loaded(value))
    }

    /// Returns the value of an expression, which may be a reference.
    pub fn raw_expression(&mut self, expression: &Expr) -> Read {
        self.expressions_read += 1;
        if self.graph.len() > MOST_NODES || self.expressions_read > MOST_EXPRESSIONS {
            return Err(Unreadable::new(expression, "an equation of this length"));
        }
        let first = self.graph.len();
        let value = self.by_kind(expression)?;
        if !matches!(expression, Expr::Paren(_) | Expr::Group(_)) {
            let last = self.graph.len();
            self.expressions.ended(expression, first..last);
            if let Value::Opaque(template) = &value {
                self.expressions.note(template, expression);
            }
        }
        Ok(value)
    }

    fn by_kind(&mut self, expression: &Expr) -> Read {
        match expression {
            Expr::Lit(literal) => self.literal(literal),
            Expr::Path(path) => self.path(path),
            Expr::Paren(inner) => self.raw_expression(&inner.expr),
            Expr::Group(inner) => self.raw_expression(&inner.expr),
            Expr::Reference(inner) => self.reference(inner),
            Expr::Unary(unary) => self.unary(&unary.op, &unary.expr),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Call(call) => self.call(call),
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Field(field) => self.field_expression(field),
            Expr::Index(index) => self.index(index),
            Expr::Tuple(tuple) => self.expressions(tuple.elems.iter()).map(Value::Tuple),
            Expr::Array(array) => self.expressions(array.elems.iter()).map(Value::Array),
            Expr::Repeat(repeat) => self.repeat(repeat),
            Expr::Struct(literal) => self.struct_literal(literal),
            Expr::Block(block) => match &block.label {
                None => self.block(&block.block),
                Some(label) => self.labelled_block(&block.block, label),
            },
            Expr::If(branch) => self.if_expression(branch),
            Expr::Match(branch) => self.match_expression(branch),
            Expr::ForLoop(each) => self.for_loop(each),
            Expr::While(each) => self.while_loop(each),
            Expr::Loop(each) => self.endless_loop(each),
            Expr::Break(leaving) => self.break_expression(leaving),
            Expr::Continue(leaving) => self.continue_expression(leaving),
            Expr::Return(leaving) => self.return_expression(leaving),
            Expr::Try(tried) => self.try_expression(tried),
            // `tested_condition` reads the conditions that contain `let`.
            Expr::Let(test) => Ok(self.mistake(&test.let_token, LET_WITHIN)),
            Expr::Assign(assign) => self.assignment(assign),
            Expr::Cast(cast) => self.cast(cast),
            Expr::Range(range) => self.range(range),
            Expr::Closure(closure) => self.closure(closure),
            Expr::Macro(call) => self.macro_call(&call.mac),
            other => Err(Unreadable::new(other, describe(other))),
        }
    }

    pub fn expressions<'a>(&mut self, all: impl Iterator<Item = &'a Expr>) -> Read<Vec<Value>> {
        all.map(|expression| self.raw_expression(expression)).collect()
    }

    /// Reads a variable, or a path that only rustc knows.
    fn path(&mut self, path: &syn::ExprPath) -> Read {
        let known = path.path.get_ident().and_then(|name| self.named(&name.to_string()).cloned());
        if let (None, Some(constant)) = (&known, self.own_constant(path)?) {
            return Ok(constant);
        }
        match known {
            Some(Value::Unassigned) => Ok(self.mistake(path, "the variable has no value yet")),
            Some(Value::Perhaps(_)) => Ok(self.mistake(path, PERHAPS)),
            Some(value) => {
                let size = value.size();
                self.expressions_read += size;
                match value {
                    Value::Opaque(_) if size > MOST_PARTS => {
                        Err(Unreadable::new(path, "a value with so many operations"))
                    }
                    Value::Opaque(Template::Parameter(name)) => {
                        Ok(Value::Opaque(Template::Parameter(name_at_use(name, path))))
                    }
                    value => Ok(value),
                }
            }
            None if path.path.is_ident("None") => Ok(Value::none()),
            None if crate::vocabulary::names(path)
                .iter()
                .rev()
                .nth(1)
                .is_some_and(|name| name == "Ordering") =>
            {
                Ok(Value::Adt(Adt::new(
                    &crate::vocabulary::names(path).pop().unwrap_or_default(),
                    None,
                )))
            }
            None if self.is_own_variant(path) => {
                let path = self.own.whole_path(&path.path);
                Ok(Value::Adt(Adt::tuple(&path, vec![])))
            }
            None if crate::vocabulary::is_number_function(path) => {
                Ok(Value::Function(Function::Path(std::rc::Rc::new(path.clone()))))
            }
            None => Ok(Value::Opaque(Template::Path(path.clone(), self.variables_beside(path)))),
        }
    }

    fn reference(&mut self, reference: &syn::ExprReference) -> Read {
        if let Some(word) = &reference.mutability {
            return self.mutable_reference(&reference.expr, word);
        }
        Ok(match self.raw_expression(&reference.expr)? {
            Value::Opaque(template) => {
                Value::Opaque(template.each(&|part| Template::Reference(Box::new(part))))
            }
            value => Value::Reference(Box::new(value)),
        })
    }

    /// Reads `&mut place`, or `&mut` of a value without a name.
    fn mutable_reference(&mut self, of: &Expr, word: &syn::token::Mut) -> Read {
        if let Some(place) = self.place(of)? {
            self.change(of, &place);
            return match self.at_place(&place) {
                Some(Value::Place(inner)) => Ok(Value::Place(inner)),
                Some(Value::Opaque(_)) | None => {
                    Err(Unreadable::new(word, "`&mut` of an unknown value"))
                }
                Some(_) => Ok(Value::Place(place)),
            };
        }
        match self.expression(of)? {
            Value::Opaque(_) | Value::Choice(_) => {
                Err(Unreadable::new(word, "`&mut` of an unknown value"))
            }
            value => {
                let slot = self.store.declare(value);
                Ok(Value::Place(Place::whole(slot)))
            }
        }
    }

    fn field_expression(&mut self, field: &syn::ExprField) -> Read {
        if let Some(value) = self.field_of_place(&field.base, &field.member)? {
            return Ok(value);
        }
        let base = self.expression(&field.base)?;
        self.each(base, &field.base, &mut |reader, base| reader.field(base, &field.member))
    }

    fn repeat(&mut self, repeat: &syn::ExprRepeat) -> Read {
        self.repeated(&repeat.expr, &repeat.len)
    }

    /// Reads `[value; length]`.
    pub fn repeated(&mut self, value: &Expr, length: &Expr) -> Read {
        let value = self.expression(value)?;
        match self.expression(length)? {
            Value::Integer(n, _)
                if (0..=MOST_TURNS).contains(&n) && n as usize * value.size() <= MOST_NODES =>
            {
                Ok(Value::Array(vec![value; n as usize]))
            }
            _ => Err(Unreadable::new(length, "an array of unknown length")),
        }
    }

    fn cast(&mut self, cast: &syn::ExprCast) -> Read {
        let ty = cast.ty.to_token_stream();
        let name = ty.to_string();
        let value = self.expression(&cast.expr)?;
        self.each(value, cast, &mut |reader, value| reader.cast_of(value, &ty, &name, cast))
    }

    fn range(&mut self, range: &syn::ExprRange) -> Read {
        let Some(start) = &range.start else {
            return Err(Unreadable::new(range, "a range without a beginning"));
        };
        let Some(end) = &range.end else {
            return match self.expression(start)? {
                Value::Integer(k, ty) => Ok(Value::Endless(Endless::From(k, ty))),
                _ => Err(Unreadable::new(range, "a range without an end")),
            };
        };
        let (from, to, ty) = match (self.expression(start)?, self.expression(end)?) {
            (Value::Integer(a, x), Value::Integer(b, y)) => (a, b, x.or(y)),
            (Value::Poison, _) | (_, Value::Poison) => return Ok(Value::Poison),
            _ => return Err(Unreadable::new(range, "a range with unknown bounds")),
        };
        let to = if matches!(range.limits, syn::RangeLimits::Closed(_)) {
            to.saturating_add(1)
        } else {
            to
        };
        if to.saturating_sub(from) > MOST_TURNS {
            return Err(Unreadable::new(range, format!("a loop of more than {MOST_TURNS} turns")));
        }
        Ok(Value::Iterator((from..to).map(|k| Value::Integer(k, ty)).collect()))
    }

    pub fn index(&mut self, index: &syn::ExprIndex) -> Read {
        let base = self.expression(&index.expr)?;
        if let Expr::Range(range) = &*index.index
            && !matches!(base, Value::Opaque(_))
        {
            return self.each(base, &index.expr, &mut |reader, base| match base {
                Value::Array(all) => reader.slice(&all, range),
                value @ (Value::Poison | Value::Never | Value::Left) => Ok(value),
                _ => Err(Unreadable::new(range, "a part of this value")),
            });
        }
        let at = self.expression(&index.index)?;
        self.each_list(
            vec![base, at],
            index,
            &mut |reader, mut both| match (both.pop(), both.pop()) {
                (Some(at), Some(base)) => reader.element_of(base, at, index),
                _ => Ok(Value::Poison),
            },
        )
    }

    fn element_of(&mut self, base: Value, at: Value, index: &syn::ExprIndex) -> Read {
        match (base, at) {
            (Value::Poison, _) | (_, Value::Poison) => Ok(Value::Poison),
            (Value::Left, _) | (_, Value::Left) => Ok(Value::Left),
            (Value::Matrix(n, m), Value::Tuple(pair)) => match pair[..] {
                [Value::Integer(r, _), Value::Integer(c, _)]
                    if (0..n as i64).contains(&r) && (0..n as i64).contains(&c) =>
                {
                    Ok(Value::Scalar(m[r as usize * n + c as usize]))
                }
                [Value::Integer(..), Value::Integer(..)] => Ok(self.mistake(
                    &index.index,
                    format!("a Mat{n} has rows and columns 0 to {}", n - 1),
                )),
                _ => Err(Unreadable::new(&index.index, "an unknown index")),
            },
            (Value::Opaque(base), at) => {
                let at = self.template(at, &index.index)?;
                Ok(Value::Opaque(
                    base.each(&|part| Template::Index(Box::new(part), Box::new(at.clone()))),
                ))
            }
            (Value::Adt(adt), at) => {
                let ty = adt.type_name();
                let arguments = vec![Value::Adt(adt), at];
                match self.own_method(&ty, "index", arguments, index)? {
                    Some(value) => Ok(self.loaded(value)),
                    None => Err(Unreadable::new(&index.index, "an index of a user-defined type")),
                }
            }
            (base, Value::Integer(k, _)) => Ok(self.element(&base, k, index)),
            (base, Value::Opaque(at)) => self.element_at_run_time(&base, at, index),
            (base, at) => Ok(self.mistake(
                &index.index,
                format!("{} cannot be indexed by {}", base.name(), at.name()),
            )),
        }
    }

    /// Reads `all[from..to]`.
    fn slice(&mut self, all: &[Value], range: &syn::ExprRange) -> Read {
        let (from, to) = self.bounds_of(range, all.len())?;
        let part =
            all.get(from..to).ok_or_else(|| Unreadable::new(range, "an index out of range"))?;
        Ok(Value::Array(part.to_vec()))
    }

    /// Returns the first index of a range and the index after its last one.
    pub fn bounds_of(&mut self, range: &syn::ExprRange, length: usize) -> Read<(usize, usize)> {
        let mut bound = |end: &Option<Box<Expr>>, otherwise: usize| match end {
            None => Ok(otherwise),
            Some(end) => {
                let remarks = ["an index out of range", "an unknown index"];
                Values::index_of(&self.expression(end)?, end, remarks)
            }
        };
        let from = bound(&range.start, 0)?;
        let to = bound(&range.end, length)?;
        Ok((
            from,
            if matches!(range.limits, syn::RangeLimits::Closed(_)) && range.end.is_some() {
                to.saturating_add(1)
            } else {
                to
            },
        ))
    }
}

/// Returns the name of the whole expression in a remark.
fn describe(expression: &Expr) -> &'static str {
    match expression {
        Expr::Unsafe(_) => "`unsafe`",
        _ => "this expression",
    }
}

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
    fn constants_are_computed() {
        let (reader, value) = read(syn::parse_quote!([1.0, 2.5][1] * 2.0));
        let Some(Value::Scalar(x)) = value else { panic!("a number") };
        assert_eq!(reader.graph.constant_value(x), Some(5.0));
        assert!(read(syn::parse_quote!(unsafe { 1.0 })).1.is_none());
        let (reader, value) = read(syn::parse_quote!([1.0, 2.5][2]));
        assert!(matches!(value, Some(Value::Poison)) && !reader.mistakes.is_empty());
    }
}
