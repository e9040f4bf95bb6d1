//! Calls: vectors and matrices by their constructors, f64's functions as paths, closures, and functions of the user's.

use quote::ToTokens;
use syn::{Expr, ExprCall};

use super::value::{Template, Value};
use super::{Read, Reader, Unreadable};
use crate::graph::{Function, Function2, Node};

impl Reader {
    pub fn call(&mut self, call: &ExprCall) -> Read {
        let Expr::Path(callee) = strip(&call.func) else {
            return match self.expression(&call.func)? {
                Value::Closure(closure) => {
                    let arguments = self.expressions(call.args.iter())?;
                    self.apply(&closure, arguments, call)
                }
                _ => Err(Unreadable::new(&call.func, "a call of this")),
            };
        };
        let variable = callee.path.get_ident().and_then(|name| self.scopes.get(&name.to_string()).cloned());
        let arguments = self.expressions(call.args.iter())?;
        match variable {
            Some(Value::Closure(closure)) => return self.apply(&closure, arguments, call),
            Some(Value::Opaque(Template::Parameter(_))) => return Err(Unreadable::new(callee, "a call of a parameter")),
            Some(Value::Poison) => return Ok(Value::Poison),
            Some(Value::Opaque(_)) | None => {}
            Some(other) => return Ok(self.mistake(callee, format!("{} cannot be called", other.name()))),
        }
        let names: Vec<String> = callee.path.segments.iter().map(|s| s.ident.to_string()).collect();
        let path: Vec<&str> = names.iter().map(String::as_str).collect();
        match path[..] {
            [.., "vec2"] => self.make_vector(2, arguments, call),
            [.., "vec3"] => self.make_vector(3, arguments, call),
            [.., ty @ ("Vec2" | "Vec3" | "Mat2" | "Mat3"), function] => self.associated(ty, function, arguments, call),
            ["f64", "from"] => self.number_from(arguments, call),
            ["f64", function] => self.number_function(function, arguments, call),
            _ => self.own_function(callee, arguments, call),
        }
    }

    fn make_vector(&mut self, n: usize, arguments: Vec<Value>, call: &ExprCall) -> Read {
        Ok(match self.numbers(n, arguments, call) {
            Some(nodes) => Value::Vector(nodes),
            None => Value::Poison,
        })
    }

    /// The arguments as `n` numbers.
    fn numbers(&mut self, n: usize, arguments: Vec<Value>, call: &ExprCall) -> Option<Vec<Node>> {
        if arguments.len() != n {
            let name = super::tidy(&call.func.to_token_stream().to_string());
            self.mistake(&call.func, format!("`{name}` takes {n} number{}, not {}", if n == 1 { "" } else { "s" }, arguments.len()));
            return None;
        }
        Some(arguments.into_iter().zip(&call.args).map(|(value, at)| self.scalar(value, at)).collect())
    }

    /// Constructors and other functions of vector and matrix types.
    fn associated(&mut self, ty: &str, function: &str, arguments: Vec<Value>, call: &ExprCall) -> Read {
        let n = if ty.ends_with('2') { 2 } else { 3 };
        let vector = ty.starts_with('V');
        let count = if vector { n } else { n * n };
        let constant = |reader: &mut Self, entries: &[f64]| {
            let nodes = entries.iter().map(|&x| reader.graph.constant(x)).collect();
            if vector { Value::Vector(nodes) } else { Value::Matrix(n, nodes) }
        };
        Ok(match (function, arguments.len()) {
            ("new", _) => match self.numbers(count, arguments, call) {
                Some(nodes) if vector => Value::Vector(nodes),
                Some(nodes) => Value::Matrix(n, nodes),
                None => Value::Poison,
            },
            ("zeros", 0) => constant(self, &vec![0.0; count]),
            ("x" | "y" | "z", 0) if vector => {
                let k = ["x", "y", "z"].iter().position(|name| *name == function).unwrap_or(0);
                constant(self, &(0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect::<Vec<_>>())
            }
            ("identity", 0) if !vector => constant(self, &(0..n * n).map(|k| if k % n == k / n { 1.0 } else { 0.0 }).collect::<Vec<_>>()),
            ("rotation", 1) if ty == "Mat2" => {
                let Some(angle) = self.numbers(1, arguments, call) else { return Ok(Value::Poison) };
                let (sin, cos) = (self.graph.call(Function::Sin, angle[0]), self.graph.call(Function::Cos, angle[0]));
                Value::Matrix(2, vec![cos, self.graph.neg(sin), sin, cos])
            }
            _ => return Err(Unreadable::new(&call.func, format!("`{ty}::{function}`"))),
        })
    }

    fn number_from(&mut self, mut arguments: Vec<Value>, call: &ExprCall) -> Read {
        match (arguments.len(), arguments.pop()) {
            (1, Some(Value::Integer(k))) => Ok(Value::Scalar(self.graph.constant(k as f64))),
            (1, Some(Value::Scalar(n))) => Ok(Value::Scalar(n)),
            (1, Some(value)) => {
                let template = self.template(value, call);
                Ok(Value::Opaque(Template::Call(call.func.to_token_stream(), vec![template])))
            }
            _ => Ok(self.mistake(call, "`f64::from` takes one argument")),
        }
    }

    /// `f64::sin(x)`
    fn number_function(&mut self, function: &str, mut arguments: Vec<Value>, call: &ExprCall) -> Read {
        if arguments.is_empty() {
            return Ok(self.mistake(call, format!("`f64::{function}` needs an argument")));
        }
        if function == "powi" {
            return match (&arguments[..], arguments.len()) {
                ([base, Value::Integer(k)], 2) if i32::try_from(*k).is_ok() => {
                    let (base, k) = (base.clone(), *k as i32);
                    let x = self.scalar(base, &call.args[0]);
                    let power = self.graph.powi(x, k);
                    self.risk(power, call);
                    Ok(Value::Scalar(power))
                }
                _ => Err(Unreadable::new(call, "an exponent that is not known here")),
            };
        }
        let first = arguments.remove(0);
        let x = self.scalar(first, &call.args[0]);
        let rest: Vec<Node> = arguments.into_iter().zip(call.args.iter().skip(1)).map(|(v, at)| self.scalar(v, at)).collect();
        let known = Function::from_method(function).is_some()
            || Function2::from_method(function).is_some()
            || matches!(function, "sin_cos" | "recip" | "to_radians" | "to_degrees" | "copysign" | "log" | "mul_add" | "clamp");
        match known {
            true => Ok(self.scalar_function(x, function, &rest, call)),
            false => Err(Unreadable::new(&call.func, format!("`f64::{function}`"))),
        }
    }

    /// A function of the user's: repeated in emitted code, called with numbers that carry derivatives where its arguments do.
    fn own_function(&mut self, callee: &syn::ExprPath, arguments: Vec<Value>, call: &ExprCall) -> Read {
        let mut templates = Vec::new();
        for (value, at) in arguments.into_iter().zip(&call.args) {
            match value {
                Value::Closure(_) | Value::Iterator(_) => return Err(Unreadable::new(at, "a closure handed to a function of your own")),
                Value::Planar(_) | Value::Spatial(_) => return Err(Unreadable::new(at, "the state of a body handed to a function of your own")),
                Value::Euler(_) => return Err(Unreadable::new(at, "Euler parameters handed to a function of your own")),
                value => templates.push(self.template(value, at)),
            }
        }
        Ok(Value::Opaque(Template::Call(callee.to_token_stream(), templates)))
    }
}

fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => strip(&inner.expr),
        Expr::Group(inner) => strip(&inner.expr),
        other => other,
    }
}
