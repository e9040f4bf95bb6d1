//! Expressions: the table of what is read how.

use proc_macro2::Span;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, Lit, Member};

use super::value::{Closure, Template, Value};
use super::{MOST_NODES, MOST_TURNS, Read, Reader, Unreadable};

impl Unreadable {
    pub fn new(at: &dyn ToTokens, what: impl Into<String>) -> Self {
        let span = at.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| token.span());
        Unreadable { span, what: what.into() }
    }
}

impl Reader {
    /// The value of an expression.
    pub fn expression(&mut self, expression: &Expr) -> Read {
        if self.graph.len() > MOST_NODES {
            return Err(Unreadable::new(expression, "an equation this long"));
        }
        match expression {
            Expr::Lit(literal) => self.literal(literal),
            Expr::Path(path) => self.path(path),
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Reference(inner) => self.reference(inner),
            Expr::Unary(unary) => self.unary(&unary.op, &unary.expr),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Call(call) => self.call(call),
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Field(field) => {
                let base = self.expression(&field.base)?;
                self.field(base, &field.member, &field.base)
            }
            Expr::Index(index) => self.index(index),
            Expr::Tuple(tuple) => Ok(Value::Tuple(self.expressions(tuple.elems.iter())?)),
            Expr::Array(array) => Ok(Value::Array(self.expressions(array.elems.iter())?)),
            Expr::Repeat(repeat) => self.repeat(repeat),
            Expr::Struct(literal) => self.struct_literal(literal),
            Expr::Block(block) if block.label.is_none() => self.block(&block.block),
            Expr::If(branch) => self.if_expression(branch),
            Expr::Match(branch) => self.match_expression(branch),
            Expr::ForLoop(each) if each.label.is_none() => self.for_loop(each),
            Expr::Assign(assign) => {
                let value = self.expression(&assign.right)?;
                self.assign(&assign.left, value)?;
                Ok(super::statement::unit())
            }
            Expr::Cast(cast) => self.cast(cast),
            Expr::Range(range) => self.range(range),
            Expr::Closure(closure) => self.closure(closure),
            other => Err(Unreadable::new(other, describe(other))),
        }
    }

    pub fn expressions<'a>(&mut self, all: impl Iterator<Item = &'a Expr>) -> Read<Vec<Value>> {
        all.map(|expression| self.expression(expression)).collect()
    }

    fn literal(&mut self, literal: &ExprLit) -> Read {
        match &literal.lit {
            Lit::Float(x) if x.suffix() == "f32" => Ok(self.mistake(x, "numbers are `f64`")),
            Lit::Float(x) => Ok(Value::Scalar(self.graph.constant(x.base10_parse().unwrap_or(f64::NAN)))),
            Lit::Int(k) if k.suffix() == "f64" => Ok(Value::Scalar(self.graph.constant(k.base10_parse().unwrap_or(f64::NAN)))),
            Lit::Int(k) => match k.base10_parse() {
                Ok(k) => Ok(Value::Integer(k)),
                Err(_) => Err(Unreadable::new(k, "an integer this large")),
            },
            Lit::Bool(b) => Ok(Value::Condition(self.graph.bool(b.value))),
            other => Ok(Value::Opaque(Template::Tokens(other.to_token_stream()))),
        }
    }

    /// A variable, or else a path that only rustc knows.
    fn path(&mut self, path: &syn::ExprPath) -> Read {
        let known = path.path.get_ident().and_then(|name| self.scopes.get(&name.to_string()).cloned());
        match known {
            Some(Value::Unassigned) => Ok(self.mistake(path, "this variable has no value yet")),
            Some(value) => Ok(value),
            None => Ok(Value::Opaque(Template::Tokens(path.to_token_stream()))),
        }
    }

    fn reference(&mut self, reference: &syn::ExprReference) -> Read {
        if let Some(word) = &reference.mutability {
            return Err(Unreadable::new(word, "`&mut`"));
        }
        Ok(match self.expression(&reference.expr)? {
            Value::Opaque(template) => Value::Opaque(Template::Reference(Box::new(template))),
            value => value,
        })
    }

    /// `base.member`
    pub fn field(&mut self, base: Value, member: &Member, at: &dyn ToTokens) -> Read {
        let name = member.to_token_stream().to_string();
        let found = match &base {
            Value::Planar(slot) => self.state_field(*slot, 2, &name),
            Value::Spatial(slot) => self.state_field(*slot, 3, &name),
            Value::Vector(v) => position(&name, &["x", "y", "z"][..v.len()]).map(|k| Value::Scalar(v[k])),
            Value::Euler(p) => position(&name, &["e0", "e1", "e2", "e3"]).map(|k| Value::Scalar(p[k])),
            Value::Matrix(n, m) => entry(&name, *n).map(|k| Value::Scalar(m[k])),
            Value::Tuple(all) => name.parse::<usize>().ok().and_then(|k| all.get(k).cloned()),
            Value::Opaque(template) => Some(Value::Opaque(Template::Field(Box::new(template.clone()), member.clone()))),
            Value::Combined(terms) => {
                let part = |(template, n): (Template, _)| (Template::Field(Box::new(template), member.clone()), n);
                Some(Value::Combined(terms.clone().into_iter().map(part).collect()))
            }
            Value::Poison => Some(Value::Poison),
            _ => None,
        };
        Ok(found.unwrap_or_else(|| {
            let cure = field_cure(&base, &name);
            let _ = at;
            self.mistake(member, format!("{} has no field `{name}`{cure}", base.name()))
        }))
    }

    fn index(&mut self, index: &syn::ExprIndex) -> Read {
        let base = self.expression(&index.expr)?;
        let at = self.expression(&index.index)?;
        match (base, at) {
            (Value::Poison, _) | (_, Value::Poison) => Ok(Value::Poison),
            (Value::Matrix(n, m), Value::Tuple(pair)) => match pair[..] {
                [Value::Integer(r), Value::Integer(c)] if (0..n as i64).contains(&r) && (0..n as i64).contains(&c) => {
                    Ok(Value::Scalar(m[r as usize * n + c as usize]))
                }
                [Value::Integer(_), Value::Integer(_)] => Ok(self.mistake(&index.index, format!("a Mat{n} has rows and columns 0 to {}", n - 1))),
                _ => Err(Unreadable::new(&index.index, "an index that is not known here")),
            },
            (Value::Opaque(base), at) => {
                let at = self.template(at, &index.index);
                Ok(Value::Opaque(Template::Index(Box::new(base), Box::new(at))))
            }
            (base, Value::Integer(k)) => Ok(self.element(base, k, index)),
            (base, Value::Opaque(at)) => self.element_at_run_time(base, at, index),
            (base, at) => Ok(self.mistake(&index.index, format!("{} cannot be indexed by {}", base.name(), at.name()))),
        }
    }

    fn element(&mut self, base: Value, k: i64, index: &syn::ExprIndex) -> Value {
        let all: Vec<Value> = match &base {
            Value::Array(all) => all.clone(),
            Value::Vector(v) | Value::Euler(v) => v.iter().copied().map(Value::Scalar).collect(),
            other => return self.mistake(&index.expr, format!("{} cannot be indexed", other.name())),
        };
        match usize::try_from(k).ok().and_then(|k| all.get(k)) {
            Some(value) => value.clone(),
            None => self.mistake(&index.index, format!("index {k} is out of range: this is {}", base.name())),
        }
    }

    /// An element of an array by an index that is only known when the program runs: one of all of them.
    fn element_at_run_time(&mut self, base: Value, at: Template, index: &syn::ExprIndex) -> Read {
        let Some((nodes, shape)) = base.numbers() else { return Err(Unreadable::new(&index.index, "an index that is not known here")) };
        Ok(Value::Opaque(Template::Index(Box::new(Template::Numbers(nodes, shape)), Box::new(at))))
    }

    fn repeat(&mut self, repeat: &syn::ExprRepeat) -> Read {
        let value = self.expression(&repeat.expr)?;
        match self.expression(&repeat.len)? {
            Value::Integer(n) if (0..=MOST_TURNS).contains(&n) => Ok(Value::Array(vec![value; n as usize])),
            _ => Err(Unreadable::new(&repeat.len, "an array whose length is not known here")),
        }
    }

    /// `Vec2 { x: …, y: … }`
    fn struct_literal(&mut self, literal: &syn::ExprStruct) -> Read {
        let name = literal.path.segments.last().map(|s| s.ident.to_string()).unwrap_or_default();
        let fields: &[&str] = match name.as_str() {
            "Vec2" => &["x", "y"],
            "Vec3" => &["x", "y", "z"],
            _ => return Err(Unreadable::new(literal, "a struct of your own")),
        };
        let mut nodes = Vec::new();
        for field in fields {
            let Some(given) = literal.fields.iter().find(|f| f.member.to_token_stream().to_string() == *field) else {
                return Ok(self.mistake(literal, format!("`{name}` needs `{field}`")));
            };
            let value = self.expression(&given.expr)?;
            nodes.push(self.scalar(value, &given.expr));
        }
        Ok(Value::Vector(nodes))
    }

    fn cast(&mut self, cast: &syn::ExprCast) -> Read {
        let ty = cast.ty.to_token_stream();
        let name = ty.to_string();
        let integer = matches!(name.as_str(), "usize" | "i32" | "u32" | "i64" | "u64" | "isize" | "i16" | "u16" | "i8" | "u8");
        Ok(match self.expression(&cast.expr)? {
            Value::Integer(k) if name == "f64" => Value::Scalar(self.graph.constant(k as f64)),
            Value::Integer(k) if integer => Value::Integer(k),
            Value::Scalar(n) if name == "f64" => Value::Scalar(n),
            Value::Scalar(_) if integer => return Err(Unreadable::new(&cast.as_token, "turning a number into an integer")),
            Value::Condition(_) => return Err(Unreadable::new(&cast.as_token, "turning a condition into an integer")),
            Value::Opaque(template) => {
                let cast = Template::Cast(Box::new(template), ty);
                Value::Opaque(cast)
            }
            Value::Poison => Value::Poison,
            other => self.mistake(&cast.as_token, format!("{} cannot be cast to {name}", other.name())),
        })
    }

    fn range(&mut self, range: &syn::ExprRange) -> Read {
        let (Some(start), Some(end)) = (&range.start, &range.end) else { return Err(Unreadable::new(range, "a range without an end")) };
        let (from, to) = match (self.expression(start)?, self.expression(end)?) {
            (Value::Integer(a), Value::Integer(b)) => (a, b),
            (Value::Poison, _) | (_, Value::Poison) => return Ok(Value::Poison),
            _ => return Err(Unreadable::new(range, "a range whose bounds are not known here")),
        };
        let to = if matches!(range.limits, syn::RangeLimits::Closed(_)) { to.saturating_add(1) } else { to };
        if to.saturating_sub(from) > MOST_TURNS {
            return Err(Unreadable::new(range, format!("a loop of more than {MOST_TURNS} turns")));
        }
        Ok(Value::Iterator((from..to).map(Value::Integer).collect()))
    }

    fn closure(&mut self, closure: &syn::ExprClosure) -> Read {
        let inputs = closure.inputs.iter().cloned().collect();
        Ok(Value::Closure(std::rc::Rc::new(Closure { inputs, body: (*closure.body).clone(), scopes: self.scopes.clone() })))
    }

    /// The value of a closure at `arguments`.
    pub fn apply(&mut self, closure: &Closure, arguments: Vec<Value>, at: &dyn ToTokens) -> Read {
        if closure.inputs.len() != arguments.len() {
            let text = format!("this closure takes {} arguments, not {}", closure.inputs.len(), arguments.len());
            return Ok(self.mistake(at, text));
        }
        let mut scopes = closure.scopes.clone();
        scopes.raise_floor();
        scopes.push();
        let outer = std::mem::replace(&mut self.scopes, scopes);
        let bound = closure.inputs.iter().zip(arguments).try_for_each(|(pattern, value)| self.bind(pattern, value));
        let value = bound.and_then(|()| self.expression(&closure.body));
        self.scopes = outer;
        value
    }

    /// `place = value`
    pub fn assign(&mut self, place: &Expr, value: Value) -> Read<()> {
        match place {
            Expr::Paren(inner) => self.assign(&inner.expr, value),
            Expr::Unary(inner) if matches!(inner.op, syn::UnOp::Deref(_)) => self.assign(&inner.expr, value),
            Expr::Infer(_) => Ok(()),
            Expr::Tuple(tuple) => match value {
                Value::Tuple(all) if all.len() == tuple.elems.len() => {
                    tuple.elems.iter().zip(all).try_for_each(|(place, value)| self.assign(place, value))
                }
                Value::Poison => Ok(()),
                other => {
                    self.mistake(tuple, format!("this takes a tuple apart, but the value is {}", other.name()));
                    Ok(())
                }
            },
            Expr::Path(path) => self.assign_variable(path, value),
            Expr::Field(field) => {
                let mut base = self.expression(&field.base)?;
                let name = field.member.to_token_stream().to_string();
                let done = match (&mut base, value) {
                    (Value::Tuple(all), value) => name.parse::<usize>().ok().and_then(|k| all.get_mut(k)).map(|place| *place = value),
                    (Value::Vector(v), value) => {
                        let node = self.scalar(value, field);
                        position(&name, &["x", "y", "z"][..v.len()]).map(|k| v[k] = node)
                    }
                    (Value::Matrix(n, m), value) => {
                        let node = self.scalar(value, field);
                        entry(&name, *n).map(|k| m[k] = node)
                    }
                    _ => None,
                };
                self.assigned(done, base, &field.base, place)
            }
            Expr::Index(index) => {
                let mut base = self.expression(&index.expr)?;
                let at = self.expression(&index.index)?;
                let done = match (&mut base, at, value) {
                    (Value::Array(all), Value::Integer(k), value) => usize::try_from(k).ok().and_then(|k| all.get_mut(k)).map(|place| *place = value),
                    (Value::Vector(v), Value::Integer(k), value) => {
                        let node = self.scalar(value, index);
                        usize::try_from(k).ok().and_then(|k| v.get_mut(k)).map(|place| *place = node)
                    }
                    (Value::Matrix(n, m), Value::Tuple(pair), value) => {
                        let node = self.scalar(value, index);
                        match pair[..] {
                            [Value::Integer(r), Value::Integer(c)] => m.get_mut((r * *n as i64 + c) as usize).map(|place| *place = node),
                            _ => None,
                        }
                    }
                    _ => None,
                };
                self.assigned(done, base, &index.expr, place)
            }
            other => Err(Unreadable::new(other, "an assignment to this place")),
        }
    }

    /// Puts a changed whole back where its part was assigned to.
    fn assigned(&mut self, done: Option<()>, base: Value, place: &Expr, at: &Expr) -> Read<()> {
        match done {
            Some(()) => self.assign(place, base),
            None => Err(Unreadable::new(at, "an assignment to this place")),
        }
    }

    fn assign_variable(&mut self, path: &syn::ExprPath, value: Value) -> Read<()> {
        let name = path.path.get_ident().map(ToString::to_string).unwrap_or_default();
        let place = match self.scopes.get_mut(&name) {
            Ok(place) => place,
            Err(super::scope::OutsideClosure) => return Err(Unreadable::new(path, "a closure that changes a variable around it")),
        };
        match place {
            Some(place) => *place = value,
            None => drop(self.mistake(path, format!("there is no variable `{name}` to assign to"))),
        }
        Ok(())
    }

    /// What the span of an expression is blamed for.
    pub fn span_of(at: &dyn ToTokens) -> Span {
        at.to_token_stream().span()
    }
}

fn position(name: &str, names: &[&str]) -> Option<usize> {
    names.iter().position(|n| *n == name)
}

/// Place of `m12` in a matrix of side `n`.
fn entry(name: &str, n: usize) -> Option<usize> {
    let digits: Vec<usize> = name.strip_prefix('m')?.chars().filter_map(|c| c.to_digit(10)).map(|d| d as usize).collect();
    match digits[..] {
        [r, c] if (1..=n).contains(&r) && (1..=n).contains(&c) => Some((r - 1) * n + c - 1),
        _ => None,
    }
}

fn field_cure(base: &Value, name: &str) -> &'static str {
    match (base, name) {
        (Value::Planar(_), "x" | "y") | (Value::Spatial(_), "x" | "y" | "z") => "; the origin is `.r.x`, `.r.y`",
        (Value::Planar(_), "a") => "; the rotation matrix is `.a()`",
        (Value::Planar(_), _) => "; it has `r`, `theta`, and the methods `a()`, `point(u)`, `direction(h)`, `local(p)`",
        (Value::Spatial(_), "theta") => "; a spatial body has Euler parameters, `p`",
        (Value::Spatial(_), _) => "; it has `r`, `p`, and the methods `a()`, `point(u)`, `direction(h)`, `local(p)`",
        (Value::Law(_), _) => "; ask it for a value with `.at(x)`",
        _ => "",
    }
}

/// What the whole expression is called in a remark.
fn describe(expression: &Expr) -> &'static str {
    match expression {
        Expr::While(_) => "`while`",
        Expr::Loop(_) => "`loop`",
        Expr::Return(_) => "an early `return`",
        Expr::Break(_) => "`break`",
        Expr::Continue(_) => "`continue`",
        Expr::Macro(_) => "a macro",
        Expr::Try(_) => "`?`",
        Expr::Unsafe(_) => "`unsafe`",
        Expr::ForLoop(_) | Expr::Block(_) => "a label",
        _ => "this expression",
    }
}
