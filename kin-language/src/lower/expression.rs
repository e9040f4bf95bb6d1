//! Expressions: the table of the reading of each kind.

mod index;
mod whole;

use std::rc::Rc;

use quote::ToTokens;
use syn::{Expr, ExprLit, Ident, Lit, Member};

use super::endless::Endless;
use super::function::Function;
use super::integer::IntegerType;
use super::template::Template;
use super::value::{Value, entry, position};
use super::{MOST_EXPRESSIONS, MOST_NODES, MOST_PARTS, MOST_TURNS, Read, Reader, Unreadable};
use crate::vocabulary::is_integer;

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
            self.expressions.ended(expression, first..self.graph.len());
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

    fn literal(&mut self, literal: &ExprLit) -> Read {
        match &literal.lit {
            Lit::Float(x) if x.suffix() == "f32" => {
                Ok(self.mistake(x, "write `f64`: Kin computes with `f64` only"))
            }
            Lit::Float(x) => Ok(Value::Scalar(self.graph.decimal(x.base10_digits()))),
            Lit::Int(k) if k.suffix() == "f64" => {
                Ok(Value::Scalar(self.graph.decimal(k.base10_digits())))
            }
            Lit::Int(k) => match k.base10_parse() {
                Ok(value) => Ok(Value::Integer(value, IntegerType::named(k.suffix()))),
                Err(_) => Err(Unreadable::new(k, "an integer of this size")),
            },
            Lit::Bool(b) => Ok(Value::Condition(self.graph.bool(b.value))),
            other => Ok(Value::Opaque(Template::Tokens(other.to_token_stream()))),
        }
    }

    /// Reads a variable, or a path that only rustc knows.
    fn path(&mut self, path: &syn::ExprPath) -> Read {
        let known = path.path.get_ident().and_then(|name| self.named(&name.to_string()).cloned());
        if let (None, Some(constant)) = (&known, self.own_constant(path)?) {
            return Ok(constant);
        }
        match known {
            Some(Value::Unassigned) => Ok(self.mistake(path, "the variable has no value yet")),
            Some(Value::Perhaps(_)) => Ok(self.mistake(path, super::rustc::PERHAPS)),
            Some(value) => {
                let size = value.size();
                self.expressions_read += size;
                match value {
                    Value::Opaque(_) if size > MOST_PARTS => {
                        Err(Unreadable::new(path, "a value with so many operations"))
                    }
                    Value::Opaque(Template::Parameter(name)) => {
                        Ok(Value::Opaque(Template::Parameter(at(name, path))))
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
                Ok(Value::Adt(super::value::Adt::new(
                    &crate::vocabulary::names(path).pop().unwrap_or_default(),
                    None,
                )))
            }
            None if self.is_own_variant(path) => {
                let path = self.own.whole_path(&path.path);
                Ok(Value::Adt(super::value::Adt::tuple(&path, vec![])))
            }
            None if crate::vocabulary::is_number_function(path) => {
                Ok(Value::Function(Function::Path(std::rc::Rc::new(path.clone()))))
            }
            None => Ok(Value::Opaque(Template::Path(path.clone(), self.variables_beside(path)))),
        }
    }

    /// Returns true for a variant such as `Shape::Flat` of an enum that the body declares.
    fn is_own_variant(&self, path: &syn::ExprPath) -> bool {
        let names: Vec<String> = self
            .own
            .whole_path(&path.path)
            .segments
            .iter()
            .map(|segment| segment.ident.to_string())
            .collect();
        let ty = names.iter().rev().nth(1).or(names.last().filter(|_| names.len() == 1));
        ty.is_some_and(|ty| self.own.is_type(ty)) && crate::vocabulary::is_type_name(path)
    }

    /// Returns the variables in scope at a name in small letters.
    fn variables_beside(&self, path: &syn::ExprPath) -> Rc<[Ident]> {
        let Some(word) = path.path.get_ident() else { return Rc::from([]) };
        if word.to_string().chars().any(char::is_uppercase) {
            return Rc::from([]);
        }
        let names = self
            .scopes
            .variables()
            .into_iter()
            .filter_map(|name| syn::parse_str::<Ident>(name).ok());
        names.map(|name| at(name, path)).collect()
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
                Ok(Value::Place(super::scope::Place::whole(slot)))
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

    /// Reads `base.member`.
    pub fn field(&mut self, base: Value, member: &Member) -> Read {
        let name = member.to_token_stream().to_string();
        let found = match &base {
            Value::Planar(slot) => self.state_field(*slot, 2, &name),
            Value::Spatial(slot) => self.state_field(*slot, 3, &name),
            Value::Vector(v) => {
                position(&name, &["x", "y", "z"][..v.len()]).map(|k| Value::Scalar(v[k]))
            }
            Value::Axis(vectors) => {
                position(&name, &["h", "f", "g"]).map(|k| Value::Vector(vectors[k].clone()))
            }
            Value::Euler(p) => {
                position(&name, &["e0", "e1", "e2", "e3"]).map(|k| Value::Scalar(p[k]))
            }
            Value::Matrix(n, m) => entry(&name, *n).map(|k| Value::Scalar(m[k])),
            Value::Tuple(all) => name.parse::<usize>().ok().and_then(|k| all.get(k).cloned()),
            Value::Adt(adt) => adt.field(&name).cloned(),
            Value::Place(_) | Value::Reference(_) | Value::Choice(_) => {
                let base = self.loaded(base);
                return self.each(base, member, &mut |reader, base| reader.field(base, member));
            }
            Value::Opaque(template) => Some(Value::Opaque(
                template.clone().each(&|part| Template::Field(Box::new(part), member.clone())),
            )),
            Value::Poison | Value::Never | Value::Left => Some(base.clone()),
            _ => None,
        };
        Ok(found.unwrap_or_else(|| {
            let cure = field_cure(&base, &name);
            self.mistake(member, format!("{} has no field `{name}`{cure}", base.name()))
        }))
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

    fn cast_of(
        &mut self,
        value: Value,
        ty: &proc_macro2::TokenStream,
        name: &str,
        cast: &syn::ExprCast,
    ) -> Read {
        let integer = is_integer(name);
        Ok(match value {
            Value::Integer(k, _) if name == "f64" => Value::Scalar(self.graph.constant(k as f64)),
            Value::Integer(k, _) if integer && fits(k, name) => {
                Value::Integer(k, IntegerType::named(name))
            }
            Value::Integer(k, _) if integer => {
                let cut = super::integer::cut(k, name);
                cut.ok_or_else(|| Unreadable::new(&cast.as_token, "this cast of an integer"))?
            }
            Value::Integer(..) => {
                return Err(Unreadable::new(&cast.as_token, "this cast of an integer"));
            }
            Value::Scalar(n) if name == "f64" => Value::Scalar(n),
            Value::Scalar(x) if integer => match self.graph.constant_value(x) {
                Some(x) if x.is_finite() && x.abs() < 1e9 && fits(x as i64, name) => {
                    Value::Integer(x as i64, IntegerType::named(name))
                }
                _ => return self.whole_of(x, name, cast),
            },
            Value::Condition(holds) if integer => {
                let [one, zero] = [1, 0].map(|k| Value::Integer(k, IntegerType::named(name)));
                return self.joined(holds, &one, &zero, cast);
            }
            Value::Condition(_) => {
                return Err(Unreadable::new(
                    &cast.as_token,
                    "a cast of a condition to another type",
                ));
            }
            Value::Opaque(template) => {
                Value::Opaque(template.each(&|part| Template::Cast(Box::new(part), ty.clone())))
            }
            Value::Adt(adt) if integer => match self.discriminant(&adt) {
                Some(k) => Value::Integer(k, IntegerType::named(name)),
                None => return Err(Unreadable::new(&cast.as_token, "this cast")),
            },
            value @ (Value::Poison | Value::Never | Value::Left) => value,
            other => {
                self.mistake(&cast.as_token, format!("{} cannot be cast to {name}", other.name()))
            }
        })
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
}

/// Returns the name of a parameter with the span of its use in the body, for messages.
fn at(mut name: syn::Ident, path: &syn::ExprPath) -> syn::Ident {
    if let Some(word) = path.path.get_ident() {
        name.set_span(word.span());
    }
    name
}

/// Returns true if an integer keeps its value under `as`.
fn fits(k: i64, name: &str) -> bool {
    match name {
        "u8" => u8::try_from(k).is_ok(),
        "i8" => i8::try_from(k).is_ok(),
        "u16" => u16::try_from(k).is_ok(),
        "i16" => i16::try_from(k).is_ok(),
        "u32" => u32::try_from(k).is_ok(),
        "i32" => i32::try_from(k).is_ok(),
        "usize" | "u64" | "u128" => k >= 0,
        _ => true,
    }
}

fn field_cure(base: &Value, name: &str) -> &'static str {
    match (base, name) {
        (Value::Planar(_), "x" | "y") | (Value::Spatial(_), "x" | "y" | "z") => {
            ": write `.r.x` and `.r.y` for the origin"
        }
        (Value::Planar(_), "a") => ": write `.a()` for the rotation matrix",
        (Value::Planar(_), _) => {
            ": the fields are `r` and `theta`, the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`"
        }
        (Value::Spatial(_), "theta") => ": write `p` for the Euler parameters of a spatial body",
        (Value::Spatial(_), _) => {
            ": the fields are `r` and `p`, the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`"
        }
        (Value::Axis(_), _) => ": the fields are `h`, and `f` and `g` across `h`",
        (Value::Vector(v), _) if v.len() == 2 => ": the fields are `x` and `y`",
        (Value::Vector(_), _) => ": the fields are `x`, `y` and `z`",
        (Value::Euler(_), _) => ": the fields are `e0`, `e1`, `e2` and `e3`",
        (Value::Law(_), _) => ": write `.at(x)` for a value",
        _ => "",
    }
}

/// Returns the name of the whole expression in a remark.
fn describe(expression: &Expr) -> &'static str {
    match expression {
        Expr::Unsafe(_) => "`unsafe`",
        _ => "this expression",
    }
}
