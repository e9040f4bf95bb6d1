//! Calls: constructors of vectors and matrices, functions of f64 by path, functions declared in the
//! body, and functions of the user's program.

mod components;

use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::{Expr, ExprCall, ExprPath};

use super::integer::IntegerType;
use super::method::KINDS_OF_NUMBERS;
use super::template::Template;
use super::value::{Adt, Components, Value};
use super::{Read, Reader, Unreadable};
use crate::vocabulary::{is_std_function, is_type_name, is_underived, names};
use kin_graph::{Function, Function2, Graph, Node};

impl Reader {
    pub fn call(&mut self, call: &ExprCall) -> Read {
        let places: Vec<&Expr> = call.args.iter().collect();
        let callee = match strip(&call.func) {
            Expr::Path(path) => {
                match single_name(path)
                    .and_then(|(name, given)| Some((self.named(&name)?.clone(), given)))
                {
                    Some((
                        Value::Function(super::function::Function::Inner(item, depth)),
                        given,
                    )) => {
                        let arguments = self.expressions(call.args.iter())?;
                        return self.apply_given(&item, depth, arguments, given, call);
                    }
                    Some((variable, _)) => variable,
                    None => {
                        let arguments = self.expressions(call.args.iter())?;
                        return self.call_path(path, arguments, &places, call);
                    }
                }
            }
            other => self.expression(other)?,
        };
        let arguments = self.expressions(call.args.iter())?;
        let callee = self.loaded(callee);
        self.each(callee, &call.func, &mut |reader, callee| {
            reader.call_of(callee, arguments.clone(), &places, call)
        })
    }

    /// Calls a function declared in the body, `f::<3>(x)`, within the allowed depth of calls.
    fn apply_given(
        &mut self,
        item: &syn::ItemFn,
        depth: usize,
        arguments: Vec<Value>,
        given: Option<&syn::AngleBracketedGenericArguments>,
        call: &ExprCall,
    ) -> Read {
        self.calls += 1;
        if self.calls > super::MOST_CALLS {
            return Err(Unreadable::new(call, "a recursion of this depth"));
        }
        let places: Vec<&Expr> = call.args.iter().collect();
        let value = self.apply_inner(item, depth, (arguments, &places), given, call);
        self.calls -= 1;
        value
    }

    fn call_of(
        &mut self,
        callee: Value,
        arguments: Vec<Value>,
        places: &[&Expr],
        call: &ExprCall,
    ) -> Read {
        match callee {
            Value::Function(function) => self.apply(&function, arguments, places, call),
            Value::Opaque(Template::Path(path, _)) => {
                self.call_path(&path, arguments, places, call)
            }
            Value::Opaque(template) if !template.has_choice() => {
                self.own_function(template, arguments, places, call)
            }
            Value::Opaque(_) => Err(Unreadable::new(&call.func, "a call of one of two functions")),
            value @ (Value::Poison | Value::Never | Value::Left) => Ok(value),
            other => {
                let name = crate::error::tidy(&call.func.to_token_stream().to_string());
                Ok(self.mistake(&call.func, not_called(&other, &name)))
            }
        }
    }

    /// Calls a function by its name.
    pub fn call_path(
        &mut self,
        path: &ExprPath,
        mut arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        if let Some(left) = arguments.iter().position(|value| matches!(value, Value::Left)) {
            return Ok(arguments.swap_remove(left));
        }
        let names = names(path);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        if let Some((item, depth)) = self.own.by_path(path, &arguments) {
            return self.apply(
                &super::function::Function::Inner(item, depth),
                arguments,
                places,
                at,
            );
        }
        let call = Call { path, places, at };
        match names[..] {
            [.., "vec2"] => Ok(self.make(Components::Vector(2), arguments, &call)),
            [.., "vec3"] => Ok(self.make(Components::Vector(3), arguments, &call)),
            ["Some" | "Ok" | "Err"] | ["Option", "Some"] | ["Result", "Ok" | "Err"]
                if arguments.len() == 1 =>
            {
                Ok(Value::Adt(Adt::new(names[names.len() - 1], arguments.pop())))
            }
            ["Box" | "Rc" | "Arc" | "Cell", "new"] | ["drop"] if arguments.len() == 1 => {
                Ok(arguments.remove(0))
            }
            [.., "mem", "swap"] | [.., "mem", "replace"] | [.., "mem", "take"] => {
                self.exchange(names[names.len() - 1], arguments, &call)
            }
            [.., "array", "from_fn"] if arguments.len() == 1 => {
                self.array_from_fn(arguments, &call)
            }
            ["Vec", "new" | "with_capacity"] => Ok(Value::Array(vec![])),
            ["Vec", "from"] if matches!(arguments[..], [Value::Array(_)]) => {
                Ok(arguments.remove(0))
            }
            [.., "iter", "once"] if arguments.len() == 1 => Ok(Value::Iterator(arguments)),
            [.., "iter", "empty"] if arguments.is_empty() => Ok(Value::Iterator(vec![])),
            [.., "iter", name @ ("repeat" | "repeat_n" | "successors")] => {
                self.endless_by_path(name, &arguments, places, path)
            }
            [
                ..,
                ty @ ("Vec2" | "Vec3" | "Mat2" | "Mat3" | "EulerParameters" | "Planar" | "Spatial"
                | "Law" | "Option" | "Vec"),
                function,
            ] if !arguments.is_empty()
                && !matches!(
                    function,
                    "new" | "from" | "from_rows" | "from_columns" | "skew" | "rotation"
                )
                && function != "from_axis_angle"
                && self.is_receiver(ty, &arguments[0]) =>
            {
                self.method_by_path(path, arguments, places, at)
            }
            _ => self.call_known(&names, arguments, &call),
        }
    }

    /// Calls a constructor or a function of vectors, matrices and numbers, or else a function of
    /// the user's program.
    fn call_known(&mut self, names: &[&str], arguments: Vec<Value>, call: &Call) -> Read {
        let Call { path, places, at } = *call;
        match names[..] {
            [.., "Vector2", "new"] => Ok(self.make(Components::Vector(2), arguments, call)),
            [.., "Vector3", "new"] => Ok(self.make(Components::Vector(3), arguments, call)),
            [.., ty @ ("Vec2" | "Vec3" | "Mat2" | "Mat3" | "EulerParameters"), function] => {
                self.associated(ty, function, arguments, call)
            }
            ["f64", "from"] => self.number_from(arguments, call),
            [.., ty, "default"]
                if arguments.is_empty() && (ty == "f64" || self.own.is_type(ty)) =>
            {
                let ty = Ident::new(ty, Span::call_site());
                self.default_of(&syn::parse_quote!(#ty), at)
            }
            ["f64", function] if is_underived(function) => {
                if let Some(k) = arguments.iter().position(|value| self.value_varies(value)) {
                    return Ok(self.no_derivative(function, call.place(k)));
                }
                self.own_function(Template::path(path), arguments, places, at)
            }
            ["f64", function] => self.number_function(function, arguments, call),
            _ if is_type_name(path) => Ok(self.own_tuple(&path.path, arguments, at)),
            _ => {
                let path = Template::path(call.path);
                self.own_function(path, arguments, places, at)
            }
        }
    }

    fn number_from(&mut self, mut arguments: Vec<Value>, call: &Call) -> Read {
        match (arguments.len(), arguments.pop().map(Value::referent)) {
            (1, Some(Value::Integer(k, ty))) => {
                if ty.is_some_and(IntegerType::is_wide) {
                    self.told_by_rustc(call.path, super::rustc::WIDE);
                }
                Ok(Value::Scalar(self.graph.constant(k as f64)))
            }
            (1, Some(Value::Scalar(n))) => Ok(Value::Scalar(n)),
            (1, Some(value)) => {
                let template = self.template(value, call.at)?;
                Ok(Value::Opaque(Template::Call(
                    Box::new(Template::path(call.path)),
                    vec![template],
                    last_span(call.at),
                )))
            }
            _ => Ok(self.mistake(call.at, "`f64::from` takes one argument")),
        }
    }

    /// Calls `f64::sin(x)`.
    fn number_function(&mut self, function: &str, mut arguments: Vec<Value>, call: &Call) -> Read {
        if arguments.is_empty() {
            return Ok(self.mistake(call.at, format!("`f64::{function}` needs an argument")));
        }
        let first = arguments.remove(0);
        let x = self.scalar(first, call.place(0));
        if function == "powi" && arguments.len() == 1 {
            return self.power(x, arguments.remove(0), call.place(1), call.at);
        }
        let known = Function::from_method(function).is_some()
            || Function2::from_method(function).is_some()
            || KINDS_OF_NUMBERS.contains(&function)
            || matches!(
                function,
                "sin_cos"
                    | "recip"
                    | "to_radians"
                    | "to_degrees"
                    | "copysign"
                    | "log"
                    | "mul_add"
                    | "clamp"
            );
        if !known {
            return Err(Unreadable::new(call.path, format!("`f64::{function}`")));
        }
        let rest: Vec<Node> = arguments
            .into_iter()
            .enumerate()
            .map(|(k, value)| self.scalar(value, call.place(k + 1)))
            .collect();
        Ok(self.scalar_function(x, function, &rest, call.at))
    }

    /// Returns true if a value depends on coordinates or time.
    pub fn value_varies(&self, value: &Value) -> bool {
        let numbers = value.clone().referent().numbers();
        numbers
            .is_some_and(|(nodes, _)| nodes.iter().any(|&node| self.graph.depends(node).varies()))
    }

    /// Reports a function of f64 without a derivative, such as `to_bits`, on a value that depends
    /// on coordinates or time.
    pub fn no_derivative(&mut self, function: &str, at: &dyn ToTokens) -> Value {
        self.mistake(
            at,
            format!("`{function}` has no derivative, but the value depends on coordinates or time"),
        )
    }

    /// Reads `std::array::from_fn(f)` with the length from its type arguments or from its place.
    fn array_from_fn(&mut self, mut arguments: Vec<Value>, call: &Call) -> Read {
        let value = arguments.remove(0).referent();
        let Some(place) = call.places.first() else {
            return Err(Unreadable::new(call.path, "a function that is not a closure"));
        };
        let f = self.function(value, place)?;
        let given = call.path.path.segments.last().and_then(|last| match &last.arguments {
            syn::PathArguments::AngleBracketed(given) => given.args.iter().nth(1),
            _ => None,
        });
        match given {
            Some(syn::GenericArgument::Const(length)) => {
                let ty: syn::Type = syn::parse_quote!([_; #length]);
                self.typed(Value::Generator(f), &ty, call.at)
            }
            _ => Ok(Value::Generator(f)),
        }
    }

    /// Calls a function of the user's program. Emitted code repeats the call; it passes numbers
    /// that carry derivatives where the arguments do.
    fn own_function(
        &mut self,
        callee: Template,
        arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        let mut templates = Vec::new();
        for (k, value) in arguments.into_iter().enumerate() {
            let place = places.get(k).map_or(at, |place| *place as &dyn ToTokens);
            templates.push(self.template(value, place)?);
        }
        let std = matches!(&callee, Template::Path(path, _) if is_std_function(path));
        if std && templates.iter().any(|template| !template.nodes().is_empty()) {
            return Err(Unreadable::new(at, "this function of the standard library"));
        }
        Ok(Value::Opaque(Template::Call(Box::new(callee), templates, last_span(at))))
    }

    pub fn norm(&mut self, v: &[Node]) -> Node {
        let square = self.dot(v, v);
        self.graph.call(Function::Sqrt, square)
    }

    /// Returns a (1 − t) + b t.
    pub fn lerp(&mut self, a: &[Node], b: &[Node], t: Node) -> Vec<Node> {
        let one = self.graph.constant(1.0);
        let rest = self.graph.sub(one, t);
        let weighted = |g: &mut Graph, a: Node, b: Node| {
            let a = g.mul(a, rest);
            let b = g.mul(b, t);
            g.add(a, b)
        };
        a.iter().zip(b).map(|(&a, &b)| weighted(&mut self.graph, a, b)).collect()
    }
}

/// A call by name, with the expressions of its arguments, for messages.
pub struct Call<'a> {
    pub path: &'a ExprPath,
    pub places: &'a [&'a Expr],
    pub at: &'a dyn ToTokens,
}

impl Call<'_> {
    fn place(&self, k: usize) -> &dyn ToTokens {
        self.places.get(k).map_or(self.at, |place| *place as &dyn ToTokens)
    }
}

/// Returns the message for a call of a value that is no function, with a suggestion.
fn not_called(value: &Value, name: &str) -> String {
    match value {
        Value::Law(_) => format!("`{name}` is a Law: get a value with `{name}.at(x)`"),
        Value::Scalar(_) => {
            format!("`{name}` is a number and no function: write a product as `{name} * x`")
        }
        Value::Vector(_) => {
            format!("`{name}` is {} and no function: write a component as `{name}.x`", value.name())
        }
        Value::Array(_) => {
            format!("`{name}` is {} and no function: write an element as `{name}[0]`", value.name())
        }
        _ => format!("`{name}` is {} and no function", value.name()),
    }
}

/// Returns the span of a call's parentheses, which are its last token.
fn last_span(at: &dyn ToTokens) -> Span {
    at.to_token_stream().into_iter().last().map_or_else(Span::call_site, |token| token.span())
}

fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => strip(&inner.expr),
        Expr::Group(inner) => strip(&inner.expr),
        other => other,
    }
}

/// Returns the single name of a path, with the arguments in `f::<3>`.
fn single_name(path: &ExprPath) -> Option<(String, Option<&syn::AngleBracketedGenericArguments>)> {
    let segment = path
        .path
        .segments
        .first()
        .filter(|_| path.path.segments.len() == 1 && path.path.leading_colon.is_none())?;
    match &segment.arguments {
        syn::PathArguments::None => Some((segment.ident.to_string(), None)),
        syn::PathArguments::AngleBracketed(given) => Some((segment.ident.to_string(), Some(given))),
        syn::PathArguments::Parenthesized(_) => None,
    }
}
