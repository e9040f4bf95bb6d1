//! Calls: constructors of vectors and matrices, functions of f64 by path, functions declared in the
//! body, and functions of the user's program.

use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::{Expr, ExprCall, ExprPath};

use super::Reader;
use super::method::numbers_beside;
use crate::lower::methods::constructors::PathCall;
use crate::lower::values::{
    Adt, Branching, Components, Function, Read, Template, Unreadable, Value,
};
use crate::vocabulary::{is_type_name, is_underived, names, strip};
use kin_graph::Node;

impl Reader {
    pub fn call(&mut self, call: &ExprCall) -> Read {
        let places: Vec<&Expr> = call.args.iter().collect();
        let callee = match strip(&call.func) {
            Expr::Path(path) => {
                match single_name(path)
                    .and_then(|(name, given)| Some((self.named(&name)?.clone(), given)))
                {
                    Some((Value::Function(Function::Inner(item, depth)), given)) => {
                        let arguments = self.expressions(call.args.iter())?;
                        return self.deeper(call, |reader| {
                            reader.apply_inner(&item, depth, (arguments, &places), given, call)
                        });
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
                let name = crate::error::tidy_text(&call.func);
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
            return self.apply(&Function::Inner(item, depth), arguments, places, at);
        }
        let call = PathCall { path, places, at };
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
    fn call_known(&mut self, names: &[&str], arguments: Vec<Value>, call: &PathCall) -> Read {
        let PathCall { path, places, at } = *call;
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

    /// Reads `std::array::from_fn(f)` with the length from its type arguments or from its place.
    fn array_from_fn(&mut self, mut arguments: Vec<Value>, call: &PathCall) -> Read {
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

    /// Reads `Planar::point(&i, u)` as `i.point(u)`.
    pub fn method_by_path(
        &mut self,
        path: &ExprPath,
        arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        let (Some(method), Some((receiver, rest))) =
            (path.path.segments.last(), places.split_first())
        else {
            return Err(Unreadable::new(at, "this function"));
        };
        let method = &method.ident;
        let rest = rest.iter();
        let whole: syn::ExprMethodCall = syn::parse_quote!((#receiver).#method(#(#rest),*));
        self.method_with(&whole, arguments)
    }

    /// Calls `f64::sin(x)`.
    pub fn number_function(
        &mut self,
        function: &str,
        mut arguments: Vec<Value>,
        call: &PathCall,
    ) -> Read {
        if arguments.is_empty() {
            return Ok(self.mistake(call.at, format!("`f64::{function}` needs an argument")));
        }
        let first = arguments.remove(0);
        let x = self.scalar(first, call.place(0));
        if function == "powi" && arguments.len() == 1 {
            return self.power(x, arguments.remove(0), call.place(1), call.at);
        }
        if numbers_beside(function).is_none() {
            return Err(Unreadable::new(call.path, format!("`f64::{function}`")));
        }
        let rest: Vec<Node> = arguments
            .into_iter()
            .enumerate()
            .map(|(k, value)| self.scalar(value, call.place(k + 1)))
            .collect();
        Ok(self.scalar_function(x, function, &rest, call.at))
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
    fn constructors_and_functions_are_called_by_name() {
        let (reader, value) = read(syn::parse_quote!(f64::max(Vec2::new(3.0, 4.0).norm(), 2.0)));
        let Some(Value::Scalar(x)) = value else { panic!("a number") };
        assert_eq!(reader.graph.constant_value(x), Some(5.0));
        let (_, value) = read(syn::parse_quote!(users_function(1.0)));
        assert!(matches!(value, Some(Value::Opaque(_))));
    }
}
