//! Methods, by the kind of their receiver.

use quote::{ToTokens, quote};
use syn::{Expr, ExprMethodCall};

use super::value::{Template, Value};
use super::{Read, Reader, Unreadable};
use crate::graph::{Comparison, Function, Function2, Graph, Node};

impl Reader {
    pub fn method_call(&mut self, call: &ExprMethodCall) -> Read {
        let receiver = self.expression(&call.receiver)?;
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        if matches!(name.as_str(), "clone" | "to_owned" | "copied" | "cloned" | "borrow" | "as_ref") && arguments.is_empty() && !matches!(receiver, Value::Opaque(_)) {
            return Ok(receiver);
        }
        match receiver {
            Value::Poison => Ok(Value::Poison),
            Value::Scalar(n) => self.scalar_method(n, &name, &arguments, call),
            Value::Integer(k) => self.integer_method(k, &name, &arguments, call),
            Value::Vector(v) => self.vector_method(v, &name, &arguments, call),
            Value::Matrix(n, m) => self.matrix_method(n, m, &name, &arguments, call),
            Value::Euler(p) => self.euler_method(p, &name, &arguments, call),
            Value::Planar(slot) => self.state_method(slot, 2, &name, &arguments, call),
            Value::Spatial(slot) => self.state_method(slot, 3, &name, &arguments, call),
            Value::Law(law) => self.law_method(law, &name, &arguments, call),
            Value::Array(all) | Value::Iterator(all) => self.list_method(all, &name, &arguments, call),
            Value::Opaque(template) => self.opaque_method(template, &name, &arguments, call),
            Value::Combined(_) if vector_only(&name) => Err(Unreadable::new(&call.method, format!("`{name}` of a value of unknown type"))),
            combined @ Value::Combined(_) => {
                let n = self.scalar(combined, &call.receiver);
                self.scalar_method(n, &name, &arguments, call)
            }
            other => Ok(self.unknown(call, &other.name(), "")),
        }
    }

    fn unknown(&mut self, call: &ExprMethodCall, receiver: &str, cure: &str) -> Value {
        self.mistake(&call.method, format!("{receiver} has no method `{}`{cure}", call.method))
    }

    /// The arguments as numbers, if there are `count` of them.
    fn scalars_of(&mut self, arguments: &[&Expr], count: usize, call: &ExprMethodCall) -> Read<Option<Vec<Node>>> {
        if !self.counted(arguments, count, call) {
            return Ok(None);
        }
        let mut nodes = Vec::new();
        for argument in arguments {
            let value = self.expression(argument)?;
            nodes.push(self.scalar(value, argument));
        }
        Ok(Some(nodes))
    }

    fn counted(&mut self, arguments: &[&Expr], count: usize, call: &ExprMethodCall) -> bool {
        if arguments.len() != count {
            let text = format!("`{}` takes {count} argument{}, not {}", call.method, if count == 1 { "" } else { "s" }, arguments.len());
            self.mistake(&call.method, text);
        }
        arguments.len() == count
    }

    /// A method of a number, by f64's names.
    fn scalar_method(&mut self, n: Node, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        if name == "powi" {
            if !self.counted(arguments, 1, call) {
                return Ok(Value::Poison);
            }
            return match self.expression(arguments[0])? {
                Value::Integer(k) if i32::try_from(k).is_ok() => {
                    let power = self.graph.powi(n, k as i32);
                    self.risk(power, call);
                    Ok(Value::Scalar(power))
                }
                Value::Poison => Ok(Value::Poison),
                Value::Opaque(_) => Err(Unreadable::new(arguments[0], "an exponent that is not known here")),
                other => Ok(self.mistake(arguments[0], format!("`powi` takes an integer, but this is {}; `powf` takes a number", other.name()))),
            };
        }
        if matches!(name, "is_nan" | "is_finite" | "is_infinite" | "is_sign_negative" | "is_sign_positive" | "is_normal" | "total_cmp" | "partial_cmp") {
            return Err(Unreadable::new(&call.method, format!("`{name}`")));
        }
        let count = match name {
            _ if Function::from_method(name).is_some() => 0,
            "sin_cos" | "recip" | "to_radians" | "to_degrees" => 0,
            _ if Function2::from_method(name).is_some() => 1,
            "copysign" | "log" => 1,
            "mul_add" | "clamp" => 2,
            _ => return Ok(self.unknown(call, "a number", scalar_cure(name))),
        };
        let Some(arguments) = self.scalars_of(arguments, count, call)? else { return Ok(Value::Poison) };
        Ok(self.scalar_function(n, name, &arguments, call))
    }

    /// f(x, …) by f64's names, with as many arguments as it takes.
    pub fn scalar_function(&mut self, x: Node, name: &str, arguments: &[Node], at: &dyn ToTokens) -> Value {
        if let Some(f) = Function::from_method(name) {
            let y = self.graph.call(f, x);
            self.risk(y, at);
            return Value::Scalar(y);
        }
        if let (Some(f), [y]) = (Function2::from_method(name), arguments) {
            let z = self.graph.call2(f, x, *y);
            self.risk(z, at);
            return Value::Scalar(z);
        }
        let g = &mut self.graph;
        let y = match (name, arguments) {
            ("sin_cos", []) => {
                let (sin, cos) = (g.call(Function::Sin, x), g.call(Function::Cos, x));
                return Value::Tuple(vec![Value::Scalar(sin), Value::Scalar(cos)]);
            }
            ("recip", []) => g.powi(x, -1),
            ("to_radians", []) => {
                let factor = g.constant(std::f64::consts::PI / 180.0);
                g.mul(factor, x)
            }
            ("to_degrees", []) => {
                let factor = g.constant(180.0 / std::f64::consts::PI);
                g.mul(factor, x)
            }
            ("copysign", [sign]) => {
                let (size, sign) = (g.call(Function::Abs, x), g.call(Function::Signum, *sign));
                g.mul(size, sign)
            }
            ("log", [base]) => {
                let (x, base) = (g.call(Function::Ln, x), g.call(Function::Ln, *base));
                g.div(x, base)
            }
            ("mul_add", [a, b]) => {
                let product = g.mul(x, *a);
                g.add(product, *b)
            }
            ("clamp", [low, high]) => {
                let x = g.call2(Function2::Max, x, *low);
                g.call2(Function2::Min, x, *high)
            }
            _ => return self.mistake(at, format!("`{name}` takes another number of arguments")),
        };
        self.risk(y, at);
        Value::Scalar(y)
    }

    fn integer_method(&mut self, k: i64, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let argument = match arguments {
            [] => None,
            [one] => match self.expression(one)? {
                Value::Integer(n) => Some(n),
                _ => return Err(Unreadable::new(one, "integer arithmetic with something not known here")),
            },
            _ => return Err(Unreadable::new(&call.method, "this method of an integer")),
        };
        let value = match (name, argument) {
            ("pow", Some(n)) => u32::try_from(n).ok().and_then(|n| k.checked_pow(n)),
            ("abs", None) => k.checked_abs(),
            ("rem_euclid", Some(n)) => k.checked_rem_euclid(n),
            ("min", Some(n)) => Some(k.min(n)),
            ("max", Some(n)) => Some(k.max(n)),
            ("abs_diff", Some(n)) => k.checked_sub(n).and_then(i64::checked_abs),
            _ if Function::from_method(name).is_some() => {
                return Ok(self.mistake(&call.receiver, format!("`{k}` is an integer; a number is written `{k}.0`")));
            }
            _ => None,
        };
        value.map(Value::Integer).ok_or_else(|| Unreadable::new(&call.method, "this method of an integer"))
    }

    fn vector_method(&mut self, v: Vec<Node>, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let n = v.len();
        let count = match name {
            "norm" | "norm_squared" | "normalize" | "perp" | "to_array" | "iter" | "into_iter" | "sum" | "magnitude" | "magnitude_squared" => 0,
            "dot" | "cross" | "component_mul" | "component_div" => 1,
            "lerp" => 2,
            _ => return Ok(self.unknown(call, &format!("a Vec{n}"), vector_cure(name))),
        };
        if !self.counted(arguments, count, call) {
            return Ok(Value::Poison);
        }
        let other = match arguments.first() {
            Some(argument) => {
                let value = self.expression(argument)?;
                if let Value::Vector(w) = &value
                    && w.len() != n
                {
                    return Ok(self.mistake(argument, format!("`{name}` of a Vec{n} needs a Vec{n}, but this is a Vec{}", w.len())));
                }
                self.vector(value, n, argument)
            }
            None => vec![],
        };
        Ok(match name {
            "norm" | "magnitude" => {
                let norm = self.norm(&v);
                self.risk(norm, call);
                Value::Scalar(norm)
            }
            "norm_squared" | "magnitude_squared" => Value::Scalar(self.dot(&v, &v)),
            "normalize" => {
                let norm = self.norm(&v);
                self.risk(norm, call);
                Value::Vector(self.scaled(&v, norm, Graph::div))
            }
            "perp" if n == 2 => Value::Vector(vec![self.graph.neg(v[1]), v[0]]),
            "to_array" => Value::Array(v.into_iter().map(Value::Scalar).collect()),
            "iter" | "into_iter" => Value::Iterator(v.into_iter().map(Value::Scalar).collect()),
            "sum" => {
                let zero = self.graph.zero();
                Value::Scalar(v.iter().fold(zero, |sum, &x| self.graph.add(sum, x)))
            }
            "dot" => Value::Scalar(self.dot(&v, &other)),
            "cross" if n == 2 => Value::Scalar(self.determinant2(v[0], v[1], other[0], other[1])),
            "cross" => Value::Vector((0..3).map(|k| [(k + 1) % 3, (k + 2) % 3]).map(|[a, b]| self.determinant2(v[a], v[b], other[a], other[b])).collect()),
            "component_mul" => Value::Vector(v.iter().zip(other).map(|(&a, b)| self.graph.mul(a, b)).collect()),
            "component_div" => {
                let v: Vec<Node> = v.iter().zip(other).map(|(&a, b)| self.graph.div(a, b)).collect();
                v.iter().for_each(|&n| self.risk(n, call));
                Value::Vector(v)
            }
            "lerp" => {
                let value = self.expression(arguments[1])?;
                let t = self.scalar(value, arguments[1]);
                Value::Vector(self.lerp(&v, &other, t))
            }
            _ => self.unknown(call, &format!("a Vec{n}"), vector_cure(name)),
        })
    }

    pub fn norm(&mut self, v: &[Node]) -> Node {
        let square = self.dot(v, v);
        self.graph.call(Function::Sqrt, square)
    }

    /// a d − b c
    fn determinant2(&mut self, a: Node, b: Node, c: Node, d: Node) -> Node {
        let (ad, bc) = (self.graph.mul(a, d), self.graph.mul(b, c));
        self.graph.sub(ad, bc)
    }

    /// a (1 − t) + b t
    fn lerp(&mut self, a: &[Node], b: &[Node], t: Node) -> Vec<Node> {
        let one = self.graph.constant(1.0);
        let rest = self.graph.sub(one, t);
        a.iter()
            .zip(b)
            .map(|(&a, &b)| {
                let (a, b) = (self.graph.mul(a, rest), self.graph.mul(b, t));
                self.graph.add(a, b)
            })
            .collect()
    }

    fn matrix_method(&mut self, n: usize, m: Vec<Node>, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let count = match name {
            "transpose" | "determinant" | "trace" => 0,
            "column" | "row" => 1,
            _ => return Ok(self.unknown(call, &format!("a Mat{n}"), "; it has `transpose`, `determinant`, `trace`, `column(k)`, `row(k)`")),
        };
        if !self.counted(arguments, count, call) {
            return Ok(Value::Poison);
        }
        Ok(match name {
            "transpose" => Value::Matrix(n, super::state::transpose(&m)),
            "trace" => {
                let zero = self.graph.zero();
                Value::Scalar((0..n).fold(zero, |sum, k| self.graph.add(sum, m[k * n + k])))
            }
            "determinant" if n == 2 => Value::Scalar(self.determinant2(m[0], m[1], m[2], m[3])),
            "determinant" => {
                let minors: Vec<Node> = [(4, 8, 5, 7), (5, 6, 3, 8), (3, 7, 4, 6)]
                    .map(|(a, d, b, c)| self.determinant2(m[a], m[b], m[c], m[d]))
                    .to_vec();
                Value::Scalar(self.dot(&m[..3], &minors))
            }
            _ => match self.expression(arguments[0])? {
                Value::Integer(k) if (0..n as i64).contains(&k) => {
                    let k = k as usize;
                    Value::Vector((0..n).map(|i| if name == "row" { m[k * n + i] } else { m[i * n + k] }).collect())
                }
                Value::Integer(k) => self.mistake(arguments[0], format!("a Mat{n} has no {name} {k}")),
                _ => return Err(Unreadable::new(arguments[0], "an index that is not known here")),
            },
        })
    }

    fn euler_method(&mut self, p: Vec<Node>, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let count = match name {
            "norm" | "norm_squared" | "vector" | "conjugate" | "to_array" => 0,
            "dot" => 1,
            "rotation" | "product" => return Err(Unreadable::new(&call.method, format!("`{name}` of Euler parameters"))),
            _ => return Ok(self.unknown(call, "a set of Euler parameters", "; it has `norm`, `norm_squared`, `dot`, `vector`, `conjugate`")),
        };
        if !self.counted(arguments, count, call) {
            return Ok(Value::Poison);
        }
        Ok(match name {
            "norm" => Value::Scalar(self.norm(&p)),
            "norm_squared" => Value::Scalar(self.dot(&p, &p)),
            "vector" => Value::Vector(p[1..].to_vec()),
            "conjugate" => Value::Euler(vec![p[0], self.graph.neg(p[1]), self.graph.neg(p[2]), self.graph.neg(p[3])]),
            "to_array" => Value::Array(p.into_iter().map(Value::Scalar).collect()),
            _ => match self.expression(arguments[0])? {
                Value::Euler(q) => Value::Scalar(self.dot(&p, &q)),
                Value::Poison => Value::Poison,
                other => self.mistake(arguments[0], format!("expected Euler parameters, but this is {}", other.name())),
            },
        })
    }

    fn state_method(&mut self, slot: usize, n: usize, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let body = if n == 2 { "a planar body" } else { "a spatial body" };
        if name == "a" {
            return Ok(match self.counted(arguments, 0, call) {
                true => Value::Matrix(n, self.rotation(slot, n)),
                false => Value::Poison,
            });
        }
        if !matches!(name, "point" | "direction" | "local") {
            let cure = match self.state_field(slot, n, name) {
                Some(_) => format!("; `{name}` is a field, without `()`"),
                None => "; it has `a()`, `point(u)`, `direction(h)`, `local(p)`".into(),
            };
            return Ok(self.unknown(call, &format!("the state of {body}"), &cure));
        }
        if !self.counted(arguments, 1, call) {
            return Ok(Value::Poison);
        }
        let value = self.expression(arguments[0])?;
        let value = match value {
            // A pair or an array of numbers converts into a vector.
            Value::Array(all) | Value::Tuple(all) if all.len() == n => {
                let mut nodes = Vec::new();
                for part in all {
                    nodes.push(self.scalar(part, arguments[0]));
                }
                Value::Vector(nodes)
            }
            Value::Vector(v) if v.len() != n => {
                let text = format!("`{name}` of {body} needs a Vec{n}, but this is a Vec{}", v.len());
                self.mistake(arguments[0], text)
            }
            value => value,
        };
        let v = self.vector(value, n, arguments[0]);
        Ok(Value::Vector(match name {
            "point" => self.point(slot, &v),
            "direction" => self.direction(slot, &v),
            _ => self.local(slot, &v),
        }))
    }

    /// `law.at(x)`
    fn law_method(&mut self, law: Template, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        if name != "at" {
            return Ok(self.unknown(call, "a Law", "; ask it for a value with `.at(x)`"));
        }
        let Some(x) = self.scalars_of(arguments, 1, call)? else { return Ok(Value::Poison) };
        let number = *self.law_index.entry(super::coerce::key(&law)).or_insert_with(|| {
            self.laws.push(law);
            self.laws.len() - 1
        });
        let value = self.graph.law(number, x[0], 0);
        self.risk(value, call);
        Ok(Value::Scalar(value))
    }

    fn list_method(&mut self, all: Vec<Value>, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let closure = |reader: &mut Self, at: &Expr| match reader.expression(at)? {
            Value::Closure(closure) => Ok(closure),
            _ => Err(Unreadable::new(at, "a function that is not a closure")),
        };
        match (name, arguments) {
            ("len", []) => Ok(Value::Integer(all.len() as i64)),
            ("iter" | "into_iter" | "by_ref", []) => Ok(Value::Iterator(all)),
            ("rev", []) => Ok(Value::Iterator(all.into_iter().rev().collect())),
            ("enumerate", []) => Ok(Value::Iterator((0..).zip(all).map(|(k, v)| Value::Tuple(vec![Value::Integer(k), v])).collect())),
            ("sum", []) => self.fold_operator(all, 0.0, quote!(+), call),
            ("product", []) => self.fold_operator(all, 1.0, quote!(*), call),
            ("map", [f]) => {
                let f = closure(self, f)?;
                let mapped = all.into_iter().map(|v| self.apply(&f, vec![v], call)).collect::<Read<Vec<_>>>()?;
                Ok(Value::Iterator(mapped).into_array_if(!matches!(*call.receiver, Expr::MethodCall(_) | Expr::Range(_) | Expr::Paren(_))))
            }
            ("fold", [start, f]) => {
                let (start, f) = (self.expression(start)?, closure(self, f)?);
                all.into_iter().try_fold(start, |sum, v| self.apply(&f, vec![sum, v], call))
            }
            ("zip" | "chain", [other]) => {
                let value = self.expression(other)?;
                let Some(items) = self.items(value, other)? else { return Ok(Value::Poison) };
                Ok(Value::Iterator(match name {
                    "zip" => all.into_iter().zip(items).map(|(a, b)| Value::Tuple(vec![a, b])).collect(),
                    _ => all.into_iter().chain(items).collect(),
                }))
            }
            ("skip" | "take", [count]) => match self.expression(count)? {
                Value::Integer(k) => {
                    let k = usize::try_from(k).unwrap_or(0);
                    Ok(Value::Iterator(if name == "skip" { all.into_iter().skip(k).collect() } else { all.into_iter().take(k).collect() }))
                }
                _ => Err(Unreadable::new(*count, "a count that is not known here")),
            },
            _ => Err(Unreadable::new(&call.method, format!("`{name}` of an array or iterator"))),
        }
    }

    fn fold_operator(&mut self, all: Vec<Value>, start: f64, op: proc_macro2::TokenStream, call: &ExprMethodCall) -> Read {
        let plus = op.to_string() == "+";
        match all.first() {
            Some(Value::Vector(v)) if plus => {
                let n = v.len();
                let zero = self.graph.zero();
                let mut sum = vec![zero; n];
                for value in all {
                    let v = self.vector(value, n, call);
                    sum = sum.iter().zip(v).map(|(&a, b)| self.graph.add(a, b)).collect();
                }
                Ok(Value::Vector(sum))
            }
            Some(Value::Integer(_)) => Err(Unreadable::new(&call.method, "a sum of integers")),
            _ => {
                let mut sum = self.graph.constant(start);
                for value in all {
                    let x = self.scalar(value, call);
                    sum = if plus { self.graph.add(sum, x) } else { self.graph.mul(sum, x) };
                }
                Ok(Value::Scalar(sum))
            }
        }
    }

    /// A method of a value that only rustc knows. A name of f64's vocabulary takes it for a number, unless it is a parameter itself.
    fn opaque_method(&mut self, template: Template, name: &str, arguments: &[&Expr], call: &ExprMethodCall) -> Read {
        let own = matches!(template, Template::Parameter(_));
        if own && matches!(name, "point" | "direction" | "local") {
            let text = format!(
                "`{}` has a type the macro does not know, so `{name}` cannot be read: types go by name; if it is an alias of `Planar` or \
                 `Spatial`, write that name itself",
                call.receiver.to_token_stream()
            );
            return Ok(self.mistake(&call.receiver, text));
        }
        let known = Function::from_method(name).is_some() || Function2::from_method(name).is_some() || matches!(name, "powi" | "sin_cos" | "recip");
        if known && !own {
            let n = self.scalar(Value::Opaque(template), &call.receiver);
            return self.scalar_method(n, name, arguments, call);
        }
        let mut templates = Vec::new();
        for argument in arguments {
            let value = self.expression(argument)?;
            if matches!(value, Value::Closure(_) | Value::Iterator(_)) {
                return Err(Unreadable::new(*argument, "a closure handed to a function of your own"));
            }
            templates.push(self.template(value, argument));
        }
        let (method, turbofish) = (&call.method, &call.turbofish);
        Ok(Value::Opaque(Template::Method(Box::new(template), quote!(#method #turbofish), templates)))
    }

    /// A comparison of two numbers, for callers that build conditions.
    pub fn at_least(&mut self, a: Node, b: Node) -> Node {
        self.graph.compare(Comparison::GreaterEqual, a, b)
    }
}

impl Value {
    /// `map` of an array is an array, of an iterator an iterator.
    fn into_array_if(self, array: bool) -> Value {
        match self {
            Value::Iterator(all) if array => Value::Array(all),
            other => other,
        }
    }
}

/// Names that only vectors and matrices have.
fn vector_only(name: &str) -> bool {
    matches!(name, "dot" | "cross" | "norm" | "norm_squared" | "normalize" | "perp" | "transpose" | "lerp" | "component_mul" | "component_div")
}

fn scalar_cure(name: &str) -> &'static str {
    match name {
        "pow" => "; `powi` takes an integer, `powf` a number",
        "square" => "; write `x * x` or `x.powi(2)`",
        "log" => "; `ln`, `log2`, `log10` or `log(base)`",
        "arctan2" | "atan_2" => "; it is `y.atan2(x)`",
        "norm" => "; the size of a number is `abs()`",
        "arcsin" | "arccos" | "arctan" => "; f64's names are `asin`, `acos`, `atan`",
        _ => "; it has those of f64, such as `sin`, `sqrt`, `atan2`, `powi`, `hypot`, `max`",
    }
}

fn vector_cure(name: &str) -> &'static str {
    match name {
        "length" | "len" | "abs" => "; it is `norm()`",
        "length_squared" => "; it is `norm_squared()`",
        "normalized" | "unit" => "; it is `normalize()`",
        _ => "; it has `dot`, `cross`, `norm`, `norm_squared`, `normalize`, `perp`, and the fields `x`, `y`",
    }
}
